#pragma once
// Places of points on facets of the mesh; shared by build_*.cpp, not for users.
#include <utility>
#include <vector>

#include "osculate/deck/build_context.hpp"
#include "osculate/projection/projector.hpp"

namespace osculate::deck {

/// The nearest place of a point on facets.
template <int Dim>
struct Foot {
  std::vector<std::pair<Index, double>> weights;  ///< shape functions there by nodes, sum 1; at a
                                                  ///< node that alone, exactly
  Vec<Dim> place = Vec<Dim>::Zero();
  Index facet = -1;     ///< in the order given
  double distance = 0;  ///< not signed; infinite: there is no facet
};

/// Facets as they lie in the reference coordinates, in which places are looked for.
///
/// Tested by  tests/unit/deck/test_cyclic_symmetry.cpp, test_ties.cpp
template <int Dim>
class FacetFeet {
 public:
  FacetFeet(const std::vector<Vec<Dim>>& nodes, std::vector<Side<Dim>> facets);
  [[nodiscard]] Foot<Dim> at(const Vec<Dim>& place) const;
  /// Of the whole surface.
  [[nodiscard]] double size() const { return projector_.size(); }
  [[nodiscard]] const std::vector<Side<Dim>>& facets() const { return facets_; }

 private:
  std::vector<Side<Dim>> facets_;
  projection::Projector<Dim> projector_;
};

}  // namespace osculate::deck
