#pragma once
#include <Eigen/Core>

#include "osculate/pairing/chain.hpp"
#include "osculate/pairing/surface.hpp"

namespace osculate::pairing {

/// How much of its edges' functions a corner of tri6 and quad8 takes over.
inline constexpr double edge_share = 0.2;

/// Functions psi_j that a slave facet's multipliers are dual to: rows over its shape functions.
/// They belong to the facet's first nodes, sum up to 1, and their integrals over what is covered
/// are positive.
///
/// Formula    facets that are wholly covered: the shape functions themselves; tri6 and quad8
///            (whose corners have no positive integrals): corners N_c + a sum N_e over both edges,
///            edges (1 - 2 a) N_e, a = 1/5
///            facets that are partly covered: the linear functions of the corners, which are
///            positive everywhere (those of higher order are not)
/// Requires   a facet through nodes
/// Tested by  tests/unit/pairing/test_mortar_facet.cpp
[[nodiscard]] const Eigen::MatrixXd& multiplier_basis(const Facet& facet, bool whole);
[[nodiscard]] const Eigen::MatrixXd& multiplier_basis(const SurfaceFacet& facet, bool whole);

}  // namespace osculate::pairing
