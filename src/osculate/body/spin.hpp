#pragma once
#include "osculate/body/rigid_body.hpp"
#include "osculate/core/types.hpp"

namespace osculate::body {

/// How fast a body turns, as the time integration carries it along. In the plane all have one
/// component and no frame.
template <int Dim>
struct RotationRates {
  using Vector = Vec<rotations<Dim>>;
  Vector velocity = Vector::Zero();      ///< W: angular velocity in the body's frame
  Vector acceleration = Vector::Zero();  ///< A: its rate there
  Vector moment = Vector::Zero();        ///< f: rate of the angular momentum, in space
};

/// One time step of the generalised-alpha family (Newmark: alpha_m = 0). The moments that the
/// inertia balances, and their weights alpha_f, are the caller's.
struct RotationScheme {
  double step = 0;  ///< h > 0
  double alpha_m = 0.5;
  double beta = 0.25;
  double gamma = 0.5;
};

/// Moment that changes the angular momentum, about the centre of mass, axes fixed in space.
template <int Dim>
struct InertiaMoment {
  using Vector = Vec<rotations<Dim>>;
  using Matrix = Mat<rotations<Dim>, rotations<Dim>>;
  Vector moment = Vector::Zero();
  Matrix gradient = Matrix::Zero();  ///< d moment = gradient (T dtheta): by the spin at the end
  RotationRates<Dim> rates;          ///< at the end of the step
};

/// Inertia of a body that turns by the rotation vector t (in space) within a step.
///
/// Newmark's formulas hold in the body's frame, the balance of momentum in space:
///
/// Formula    R' = exp[t] R ,  R^T t = h W + h^2 ((1/2 - beta) A + beta A')
///            W' = W + h ((1 - gamma) A + gamma A')
///            R' J W' = R J W + h ((1 - gamma) f + gamma f')
///            moment = (1 - alpha_m) f' + alpha_m f
/// Source     A, W: Simo, Vu-Quoc (1988); balance of momentum: Simo, Wong (1991), whose conserving
///            algorithm this is for beta = 1/4, gamma = alpha_m = 1/2; docs/decisions/022
/// Conserves  R J W without moments, to round-off, for all parameters. Of the free body
///            E + h^2 (beta - gamma/2)/2 A . J A never grows (gamma >= 1/2, beta >= gamma/2), and
///            stays for gamma = 1/2.
/// Requires   |t| < 2 pi
/// Tested by  tests/unit/body/test_spin.cpp
[[nodiscard]] InertiaMoment<3> inertia_moment(const Mat<3, 3>& inertia,
                                              const Mat<3, 3>& orientation,
                                              const RotationRates<3>& rates,
                                              const RotationScheme& scheme, const Vec3& turn);
/// The same in the plane, where A = f / J.
[[nodiscard]] InertiaMoment<2> inertia_moment(const Mat<1, 1>& inertia,
                                              const RotationRates<2>& rates,
                                              const RotationScheme& scheme, const Vec<1>& turn);

/// The same for a body between the motions at the beginning and at the end of a step.
[[nodiscard]] inline InertiaMoment<3> inertia_moment(const Mat<3, 3>& inertia,
                                                     const RotationRates<3>& rates,
                                                     const RotationScheme& scheme,
                                                     const RigidMotion3& from,
                                                     const RigidMotion3& to) {
  return inertia_moment(inertia, from.orientation(), rates, scheme, turn_between(from, to));
}
[[nodiscard]] inline InertiaMoment<2> inertia_moment(const Mat<1, 1>& inertia,
                                                     const RotationRates<2>& rates,
                                                     const RotationScheme& scheme,
                                                     const RigidMotion& from,
                                                     const RigidMotion& to) {
  return inertia_moment(inertia, rates, scheme, turn_between(from, to));
}

/// The rates at the end of a step in which the moment of the contact forces counts by its value
/// there (`contact`, in space), with a share `way` of the turn that its impulse h C makes.
///
/// Formula    R^T t = h W + h^2 ((1/2 - beta) A + beta A') + way h^2 B ,  J B = R'^T C
///            W' = W + h ((1 - gamma) A + gamma A') + h B
///            R' J W' = R J W + h ((1 - gamma) f + gamma f') + h C
///            so that ((1 - alpha_m) f' + alpha_m f) (without: inertia_moment) satisfies
///            beta/(1 - alpha_m)/way inertia_moment.moment = C + beta/(1 - alpha_m)/way M ,
///            M what balances (1 - alpha_m) f' + alpha_m f
/// Source     Kane et al. (1999) for displacements
/// Requires   the inertia is positive definite; `without` from inertia_moment of this step
/// Tested by  tests/unit/body/test_spin.cpp
[[nodiscard]] RotationRates<3> with_contact(const RotationRates<3>& without,
                                            const Mat<3, 3>& inertia, const RotationScheme& scheme,
                                            const RigidMotion3& to, const Vec3& contact,
                                            double way);
[[nodiscard]] RotationRates<2> with_contact(const RotationRates<2>& without,
                                            const Mat<1, 1>& inertia, const RotationScheme& scheme,
                                            const RigidMotion& to, const Vec<1>& contact,
                                            double way);

/// A moment about axes in space as the force that does its work on the rotation vector, and the
/// derivative of that.
template <int Dim>
struct RotationForce {
  Vec<rotations<Dim>> force;
  Mat<rotations<Dim>, rotations<Dim>> tangent;  ///< by theta
};

/// Formula    q = T^T m ,  dq = (d(T^T m)/dtheta at fixed m + T^T G T) dtheta ,  dm = G (T dtheta)
/// Tested by  tests/unit/body/test_spin.cpp
[[nodiscard]] RotationForce<3> rotation_force(const RigidMotion3& motion, const Vec3& moment,
                                              const Mat<3, 3>& gradient);
[[nodiscard]] inline RotationForce<2> rotation_force(const RigidMotion&, const Vec<1>& moment,
                                                     const Mat<1, 1>& gradient) {
  return {moment, gradient};
}

/// The moment about axes in space that does the work of a force on the rotation vector.
///
/// Formula    T^T m = q
/// Tested by  tests/unit/body/test_spin.cpp
[[nodiscard]] Vec3 moment_of(const RigidMotion3& motion, const Vec3& force);
[[nodiscard]] inline Vec<1> moment_of(const RigidMotion&, const Vec<1>& force) { return force; }

/// Rates at the start: angular velocity and moment about the centre of mass, both in space.
///
/// Formula    J A = R^T m - W x J W
/// Requires   the inertia is positive definite
/// Tested by  tests/unit/body/test_spin.cpp
[[nodiscard]] RotationRates<3> initial_rates(const Mat<3, 3>& inertia, const RigidMotion3& motion,
                                             const Vec3& velocity, const Vec3& moment);
[[nodiscard]] RotationRates<2> initial_rates(const Mat<1, 1>& inertia, const RigidMotion& motion,
                                             const Vec<1>& velocity, const Vec<1>& moment);

/// Angular velocity in space.
[[nodiscard]] inline Vec3 spin(const RigidMotion3& motion, const RotationRates<3>& rates) {
  return motion.orientation() * rates.velocity;
}
[[nodiscard]] inline Vec<1> spin(const RigidMotion&, const RotationRates<2>& rates) {
  return rates.velocity;
}

/// Rate of the rotation vector of a body that turns with an angular velocity in space.
///
/// Formula    T theta' = w
/// Tested by  tests/unit/body/test_spin.cpp
[[nodiscard]] Vec3 rotation_rate(const RigidMotion3& motion, const Vec3& spin);
[[nodiscard]] inline Vec<1> rotation_rate(const RigidMotion&, const Vec<1>& spin) { return spin; }

/// Angular momentum about the centre of mass, in space.
[[nodiscard]] inline Vec3 angular_momentum(const Mat<3, 3>& inertia, const RigidMotion3& motion,
                                           const RotationRates<3>& rates) {
  const Vec3 in_body = inertia * rates.velocity;
  return motion.orientation() * in_body;
}
[[nodiscard]] inline Vec<1> angular_momentum(const Mat<1, 1>& inertia, const RigidMotion&,
                                             const RotationRates<2>& rates) {
  return inertia * rates.velocity;
}

/// Kinetic energy of the turning: W . J W / 2.
template <int Dim>
[[nodiscard]] double rotation_energy(const Mat<rotations<Dim>, rotations<Dim>>& inertia,
                                     const RotationRates<Dim>& rates) {
  return 0.5 * rates.velocity.dot(inertia * rates.velocity);
}

/// Where the body would turn to within a step of length `step` if nothing changed: a first guess
/// of the rotation vector of the step, in space.
[[nodiscard]] inline Vec3 predicted_turn(const RigidMotion3& from, const RotationRates<3>& rates,
                                         double step) {
  const Vec3 in_body = step * (rates.velocity + 0.5 * step * rates.acceleration);
  return from.orientation() * in_body;
}
[[nodiscard]] inline Vec<1> predicted_turn(const RigidMotion&, const RotationRates<2>& rates,
                                           double step) {
  return step * (rates.velocity + 0.5 * step * rates.acceleration);
}

}  // namespace osculate::body
