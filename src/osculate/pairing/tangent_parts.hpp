#pragma once
#include "osculate/pairing/pair.hpp"

namespace osculate::pairing {

/// What the parts of the covariant tangent beside the main one weigh, point by point.
///
/// Formula    eps = |K - K_m| / |K_m|,  |K| = max_i sum_j |k_ij| over the rows of one contact
///            element (slave node and master nodes); K and K_m with their common weight
/// Source     KSVD:60, KSVD:61
/// Returns    the largest value over the points in contact, 0 where there are none
/// Tested by  tests/unit/pairing/test_pair3_identities.cpp
template <int Dim>
[[nodiscard]] double curvature_share(const PairDefinition<Dim>& pair, Points<Dim> x,
                                     const PairState<Dim>& committed);

}  // namespace osculate::pairing
