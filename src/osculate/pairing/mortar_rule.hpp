#pragma once
#include <array>

#include "osculate/cell/facet_shape.hpp"
#include "osculate/cell/quadrature.hpp"

namespace osculate::pairing {

using FacetPoints = std::array<Vec3, cell::max_facet_nodes>;

/// Gauss rule on the triangles that the overlap of two facets is cut into, by the facets' reference
/// positions. Exact where the shape functions are polynomials of the plane's coordinates: triangles
/// and parallelograms with straight edges. On other quadrilaterals they are not: the more a facet
/// differs from a parallelogram, the more points are taken (up to 100), so that the integral of a
/// bilinear function over half of it is right to 1e-11 of its area up to a skew of 0.27 (|x_0 - x_1
/// + x_2 - x_3| over the shorter diagonal) and to 1e-9 up to 0.45.
[[nodiscard]] const cell::Quadrature2D& mortar_rule(cell::CellType slave,
                                                    const FacetPoints& slave_reference,
                                                    cell::CellType master,
                                                    const FacetPoints& master_reference);

}  // namespace osculate::pairing
