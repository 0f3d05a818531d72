#pragma once
#include <array>

#include "osculate/cell/facet_shape.hpp"
#include "osculate/cell/quadrature.hpp"

namespace osculate::pairing {

using FacetPoints = std::array<Vec3, cell::max_facet_nodes>;

/// Gauss rule on the triangles that the overlap of two facets is cut into, by the facets' reference
/// positions. Exact where the shape functions are polynomials of the plane's coordinates: triangles
/// and parallelograms with straight edges. On other quadrilaterals they are not, and 49 points are
/// taken, with which a uniform pressure is passed on to 1e-10.
[[nodiscard]] const cell::Quadrature2D& mortar_rule(cell::CellType slave,
                                                    const FacetPoints& slave_reference,
                                                    cell::CellType master,
                                                    const FacetPoints& master_reference);

}  // namespace osculate::pairing
