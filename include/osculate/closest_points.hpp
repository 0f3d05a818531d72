#pragma once
#include <memory>
#include <span>
#include <vector>

#include "osculate/surface.hpp"

namespace osculate {

/// How good an answer is.
enum class ClosestStatus : std::uint8_t {
  projected,       ///< one closest point
  ambiguous,       ///< another place is as near
  outside_domain,  ///< beyond the centre of curvature: another place, or none, is as good locally
  invalid          ///< no numbers
};

/// How it is looked for.
enum class ClosestMode : std::uint8_t {
  nearest,   ///< proved by bounds: nothing is nearer; the margin is not looked for
  fast,      ///< Newton's method from a good guess
  certified  ///< proved by bounds; the margin is found
};

/// One entry a point, in the order of the points.
template <int Dim>
struct ClosestPointArrays {
  std::vector<ClosestStatus> status;
  std::vector<Feature> feature;      ///< none where invalid
  std::vector<Index> facet;          ///< in the order given, -1 where invalid
  std::vector<double> xi;            ///< two a point, on the facet; NaN where they do not apply
  std::vector<double> point;         ///< Dim a point: the foot point; NaN where invalid
  std::vector<double> distance;      ///< negative inside
  std::vector<double> margin;        ///< how much farther the next place is; NaN: not looked for
  std::vector<std::uint8_t> unique;  ///< 0 or 1; 0 where the margin was not looked for
};

struct ClosestPointOptions {
  ClosestMode mode = ClosestMode::certified;
  int threads = 1;  ///< results have the same bits for any number of threads
};

/// A surface (in the plane a curve) prepared once and asked many times, from several threads too.
///
/// Tested by  tests/unit/embed/test_closest_points.cpp, tests/install/main.cpp
template <int Dim>
class ClosestPoints {
 public:
  /// Facets that share nodes, in the plane of up to four; `coordinates` of all nodes, copied.
  /// Errors     Refused for a list, node or coordinate that cannot be used
  ClosestPoints(std::span<const Facets> facets, std::span<const double> coordinates);
  /// One shape.
  explicit ClosestPoints(const Shape<Dim>& shape);
  ~ClosestPoints();
  ClosestPoints(ClosestPoints&&) noexcept;
  ClosestPoints& operator=(ClosestPoints&&) noexcept;

  /// `points`: Dim coordinates each; any values, also NaN and infinite ones.
  /// Errors     Refused if their number is no multiple of Dim, or threads < 1
  [[nodiscard]] ClosestPointArrays<Dim> find(std::span<const double> points,
                                             const ClosestPointOptions& options = {}) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

extern template class ClosestPoints<2>;
extern template class ClosestPoints<3>;

}  // namespace osculate
