#pragma once
#include <span>

#include "osculate/cell/cell_type.hpp"
#include "osculate/core/types.hpp"

namespace osculate::api {

/// A surface as a list of facets of one kind.
template <int Dim>
struct BasicFacetList;

/// Line facets with the same number of nodes each (2..8): end nodes first, then the interior ones;
/// the body is on the right of the direction of travel.
template <>
struct BasicFacetList<2> {
  int nodes_per_facet = 2;
  std::span<const Index> nodes;
};

/// Facets tri3, tri6, quad4, quad8 or quad9 (Gmsh's order of nodes); r_1 x r_2 points out of the
/// body: seen from outside, the corners run counterclockwise.
template <>
struct BasicFacetList<3> {
  cell::CellType type = cell::CellType::quad4;
  std::span<const Index> nodes;
};

using FacetList = BasicFacetList<2>;
using FacetList3 = BasicFacetList<3>;

}  // namespace osculate::api
