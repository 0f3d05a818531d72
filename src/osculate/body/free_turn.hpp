#pragma once
#include "osculate/core/types.hpp"

namespace osculate::body {

/// The rotation vector (in space) by which a body turns within a time h while its angular momentum
/// about the centre of mass stays as it is.
///
/// Formula    R^T t = h/2 (W + W') ,  J W = R^T p ,  J W' = R'^T p ,  R' = exp[t] R
/// Source     the midpoint rule of Simo, Wong (1991)
/// Conserves  the energy W . J W / 2, to round-off; second order in h
/// Requires   J positive definite and h |W| well below one
/// Tested by  tests/unit/body/test_free_turn.cpp
[[nodiscard]] Vec3 free_turn(const Mat<3, 3>& inertia, const Mat<3, 3>& orientation,
                             const Vec3& momentum, double h);

}  // namespace osculate::body
