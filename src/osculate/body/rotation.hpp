#pragma once
#include "osculate/core/types.hpp"

namespace osculate::body {

/// Finite rotations by their rotation vector theta: axis times angle [radians], x = R y.
/// All formulas below are entire functions of theta: no special case at theta = 0.

/// [v]: the matrix of the cross product, [v] w = v x w.
[[nodiscard]] Mat<3, 3> cross_matrix(const Vec3& v);

/// Formula    R = cos(t) I + sin(t)/t [theta] + (1 - cos t)/t^2 theta theta^T ,  t = |theta|
///            (Rodrigues; the exponential of [theta])
/// Tested by  tests/unit/body/test_rotation.cpp
[[nodiscard]] Mat<3, 3> rotation_matrix(const Vec3& theta);

/// The rotation vector of a rotation matrix, of at most half a turn.
///
/// Tested by  tests/unit/body/test_base_rotation.cpp
[[nodiscard]] Vec3 rotation_vector(const Mat<3, 3>& r);

/// Of all rotation vectors of `r` (they differ by whole turns about its axis) the one next to
/// `guess`. Near a whole turn, where every axis would do, a turn that is about the axis of `guess`
/// up to 1e-6 is about it exactly.
///
/// Tested by  tests/unit/body/test_base_rotation.cpp
[[nodiscard]] Vec3 rotation_vector_near(const Mat<3, 3>& r, const Vec3& guess);

/// Spin of a change of the rotation vector: dR R^T = [T dtheta].
///
/// Formula    T = I + (1 - cos t)/t^2 [theta] + (t - sin t)/t^3 [theta]^2
/// Requires   nothing; singular at whole turns (t = 2 pi k, k > 0), except along theta
/// Tested by  tests/unit/body/test_rotation.cpp
[[nodiscard]] Mat<3, 3> rotation_tangent(const Vec3& theta);

/// Second derivative of f . R(theta) a with respect to theta (symmetric).
///
/// Tested by  tests/unit/body/test_rotation.cpp
[[nodiscard]] Mat<3, 3> rotation_hessian(const Vec3& theta, const Vec3& f, const Vec3& a);

/// Derivative of T(theta)^T m with respect to theta for a moment m fixed in space (unsymmetric:
/// such a moment has no potential).
///
/// Tested by  tests/unit/body/test_rotation.cpp
[[nodiscard]] Mat<3, 3> moment_gradient(const Vec3& theta, const Vec3& m);

}  // namespace osculate::body
