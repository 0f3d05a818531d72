#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "osculate/api/facet_list.hpp"
#include "osculate/projection/projector.hpp"

namespace osculate::api {

/// Closest points for another code: plain arrays in, plain arrays out; one entry a point, in the
/// order of the points. What an entry means: projection::ClosestPoint.
template <int Dim>
struct ClosestPointArrays {
  std::vector<projection::Status> status;
  std::vector<projection::Feature> feature;  ///< face, edge, corner; none where invalid
  std::vector<Index> facet;                  ///< in the order given, -1 where invalid
  std::vector<double> xi;  ///< two a point: coordinates on the facet; NaN where they do not apply
  std::vector<double> point;         ///< Dim a point: the foot point; NaN where invalid
  std::vector<double> distance;      ///< negative inside
  std::vector<double> margin;        ///< NaN where it was not looked for, and where invalid
  std::vector<std::uint8_t> unique;  ///< 0 or 1; 0 where the margin was not looked for
};

struct ClosestPointOptions {
  projection::Mode mode = projection::Mode::certified;
  int threads = 1;  ///< results have the same bits for any number of threads
};

/// A surface (in the plane a curve) prepared once and asked many times; several may live at once,
/// and one may be asked from several threads.
///
/// Tested by  tests/unit/api/test_closest_points.cpp, tests/install/main.cpp
template <int Dim>
class BasicClosestPoints {
 public:
  /// Facets that share nodes: numbered across the lists in their order. `coordinates`: x0 y0 (z0)
  /// x1 y1 ... of the nodes that the lists name; copied.
  /// Errors     core::InputError for a list, node or coordinate that cannot be used
  BasicClosestPoints(std::span<const BasicFacetList<Dim>> facets,
                     std::span<const double> coordinates);
  /// A mesh or a single shape; deck::read_surface() reads one from a file.
  explicit BasicClosestPoints(projection::Target<Dim> target);

  /// `points`: Dim coordinates each; any values, also NaN and infinite ones.
  /// Errors     core::InputError if the number of coordinates is no multiple of Dim, or threads < 1
  [[nodiscard]] ClosestPointArrays<Dim> find(std::span<const double> points,
                                             const ClosestPointOptions& options = {}) const;
  [[nodiscard]] const projection::Projector<Dim>& projector() const { return projector_; }

 private:
  projection::Projector<Dim> projector_;
};

using ClosestPoints = BasicClosestPoints<2>;
using ClosestPoints3 = BasicClosestPoints<3>;

}  // namespace osculate::api
