#pragma once
// Inside of the public library; included by its sources only.
#include <string>
#include <type_traits>

#include "osculate/cell/cell_type.hpp"
#include "osculate/geometry/catalogue.hpp"
#include "osculate/geometry/surface_catalogue.hpp"
#include "osculate/pairing/slave_side.hpp"
#include "osculate/surface.hpp"

namespace osculate::embed {

/// A facet type: `cell` has no meaning for lines of more than four nodes.
struct FacetKind {
  const char* name;
  int dimension, nodes;
  cell::CellType cell;
};
[[nodiscard]] const FacetKind& kind_of(FacetType type);

/// Facet by facet: the right kind and number of nodes, which exist and differ. Throws Refused,
/// `name` before the text.
void check_facets(const Facets& facets, int dimension, std::size_t nodes, const std::string& name);

template <int Dim>
using GeometryShape = std::conditional_t<Dim == 2, geometry::Curve, geometry::Surface>;
/// A shape of the host's. Throws Refused for one that cannot be.
[[nodiscard]] geometry::Curve geometry_of(const CurveShape& shape, const std::string& name);
[[nodiscard]] geometry::Surface geometry_of(const SurfaceShape& shape, const std::string& name);

/// The facets and shapes of a side, joined. Throws Refused for what cannot be used.
template <int Dim>
[[nodiscard]] pairing::Boundary<Dim> boundary_of(const Surface<Dim>& surface, std::size_t nodes,
                                                 const std::string& name);

}  // namespace osculate::embed
