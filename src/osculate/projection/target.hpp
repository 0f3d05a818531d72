#pragma once
#include <array>
#include <variant>
#include <vector>

#include "osculate/cell/cell_type.hpp"
#include "osculate/cell/facet_shape.hpp"
#include "osculate/geometry/catalogue.hpp"
#include "osculate/geometry/surface_catalogue.hpp"

namespace osculate::projection {

/// One facet of a mesh: line2 to line4 in the plane, tri3 to quad9 in space, nodes in Gmsh's order.
struct MeshFacet {
  cell::CellType type = cell::CellType::line2;
  std::array<Index, cell::max_facet_nodes> nodes{};  ///< the first info(type).nodes are used
};

/// Facets that share nodes: one composed curve or surface. The body lies on the right of the
/// direction of travel (plane); r_1 x r_2 points out of it (space).
template <int Dim>
struct FacetMesh {
  std::vector<Vec<Dim>> nodes;
  std::vector<MeshFacet> facets;
};

/// A single smooth shape in closed form, or a NURBS curve or patch.
template <int Dim>
using Shape = std::conditional_t<Dim == 2, geometry::Curve, geometry::Surface>;

/// What points are projected onto.
template <int Dim>
using Target = std::variant<FacetMesh<Dim>, Shape<Dim>>;

}  // namespace osculate::projection
