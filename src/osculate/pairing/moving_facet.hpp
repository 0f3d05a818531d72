#pragma once
#include <map>
#include <vector>

#include "osculate/pairing/slave_side.hpp"
#include "osculate/projection/piece.hpp"
#include "osculate/search/box.hpp"

namespace osculate::pairing {

/// A place or direction of a facet, and how far it may move: at most `lever` times what the nodes
/// do.
template <int Dim>
struct MovingVector {
  Vec<Dim> value = Vec<Dim>::Zero();
  double lever = 0;
};

/// Where a facet is, and where it may come if no node moves farther than a given distance. All are
/// bounds, of the facet continued by a tenth beyond its borders (a foot may lie up to
/// `end_extension` beyond an open one).
///
/// Formula    facets that are polynomials have Bezier control points c_j = sum_k w_jk x_k, and lie
///            in their hull; a node's motion by d moves c_j by at most d sum_k |w_jk|. Normals are
///            combinations, with weights that are not negative, of products of the differences of
///            the points in both directions (in the plane: of the turned differences)
template <int Dim>
struct MovingFacet {
  search::Box<Dim> box;  ///< now; infinite for an analytic shape
  double lever = 1;      ///< of every place
  /// Control points and normals (not of unit length); empty: not known (rational patches, shapes).
  std::vector<MovingVector<Dim>> points, normals;
  /// Of all unit normals there may be; not narrow: not known.
  projection::Cone<Dim> cone;
};

/// Weights of the control points of a facet's nodes, one row a point; and which differences of two
/// points are tangents in which direction.
struct Net {
  Eigen::MatrixXd weight;
  std::array<std::vector<std::array<int, 2>>, 2> tangents;
};

/// Makes them; facets of one type share a net.
///
/// Tested by  tests/unit/embed/test_pattern.cpp
template <int Dim>
class MovingFacets {
 public:
  /// `reach`: how far any node may move.
  [[nodiscard]] std::vector<MovingFacet<Dim>> of(const Boundary<Dim>& boundary,
                                                 std::type_identity_t<std::span<const Vec<Dim>>> x,
                                                 double reach);

 private:
  std::map<int, Net> nets_;       ///< by type
  std::map<int, double> levers_;  ///< likewise, of all places
};

extern template class MovingFacets<2>;
extern template class MovingFacets<3>;

}  // namespace osculate::pairing
