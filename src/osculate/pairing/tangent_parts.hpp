#pragma once
#include "osculate/pairing/pair.hpp"

namespace osculate::pairing {

/// max_i sum_j |k_ij|.
///
/// Source     KSVD:61
/// Tested by  tests/unit/pairing/test_curvature_share.cpp
[[nodiscard]] inline double row_sum_norm(const Eigen::Ref<const Eigen::MatrixXd>& k) {
  return k.cwiseAbs().rowwise().sum().maxCoeff();  // @eq KSVD:61
}

/// What the parts of the covariant tangent of the normal contact beside the main one weigh, point
/// by point.
///
/// Formula    eps = |K - K_m| / |K_m|,  |K| = max_i sum_j |k_ij| over the rows of one contact
///            element (slave node and master nodes); the weight of the point cancels. K has the
///            main part and those of `parts`
/// Source     KSVD:60, KSVD:61
/// Requires   `evaluation` of `pair` at `x`
/// Returns    the largest value over the points in contact, 0 where there are none
/// Tested by  tests/unit/pairing/test_curvature_share.cpp
template <int Dim>
[[nodiscard]] double curvature_share(const PairDefinition<Dim>& pair, Points<Dim> x,
                                     const PairEvaluation<Dim>& evaluation,
                                     const contact::TangentForm& parts = {false, true, true, true},
                                     int threads = 1);

}  // namespace osculate::pairing
