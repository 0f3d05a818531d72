#include "osculate/body/spin.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace osculate::body {

InertiaMoment<3> inertia_moment(const Mat<3, 3>& inertia, const Mat<3, 3>& orientation,
                                const RotationRates<3>& rates, const RotationScheme& scheme,
                                const Vec3& turn) {
  const auto& [h, alpha_m, beta, gamma] = scheme;
  const Mat<3, 3> now = rotation_matrix(turn) * orientation;
  const Vec3 in_body = orientation.transpose() * turn;
  InertiaMoment<3> out;
  auto& [velocity, acceleration, moment] = out.rates;
  acceleration =
      (in_body - h * rates.velocity) / (beta * h * h) - (0.5 - beta) / beta * rates.acceleration;
  velocity = rates.velocity + h * ((1 - gamma) * rates.acceleration + gamma * acceleration);
  const Vec3 momentum = now * (inertia * velocity);
  const Vec3 before = orientation * (inertia * rates.velocity);
  moment = ((momentum - before) / h - (1 - gamma) * rates.moment) / gamma;
  out.moment = (1 - alpha_m) * moment + alpha_m * rates.moment;
  // d momentum = spin x momentum + R' J dW' ,  dW' = gamma/(beta h) R^T dt ,  spin = T(t) dt
  const Mat<3, 3> turned = now * inertia * orientation.transpose();
  const Mat<3, 3> change = gamma / (beta * h) * turned * rotation_tangent(turn).inverse();
  out.gradient = (1 - alpha_m) / (gamma * h) * (change - cross_matrix(momentum));
  return out;
}

InertiaMoment<2> inertia_moment(const Mat<1, 1>& inertia, const RotationRates<2>& rates,
                                const RotationScheme& scheme, const Vec<1>& turn) {
  const auto& [h, alpha_m, beta, gamma] = scheme;
  InertiaMoment<2> out;
  auto& [velocity, acceleration, moment] = out.rates;
  acceleration =
      (turn - h * rates.velocity) / (beta * h * h) - (0.5 - beta) / beta * rates.acceleration;
  velocity = rates.velocity + h * ((1 - gamma) * rates.acceleration + gamma * acceleration);
  moment = inertia * acceleration;
  out.moment = (1 - alpha_m) * moment + alpha_m * rates.moment;
  out.gradient = (1 - alpha_m) / (beta * h * h) * inertia;
  return out;
}

RotationRates<3> with_contact(const RotationRates<3>& without, const Mat<3, 3>& inertia,
                              const RotationScheme& scheme, const RigidMotion3& to,
                              const Vec3& contact, double way) {
  const double share = way / scheme.beta;
  const Vec3 b = inertia.inverse() * (to.orientation().transpose() * contact);
  return {without.velocity + scheme.step * (1 - scheme.gamma * share) * b,
          without.acceleration - share * b, without.moment - share * contact};
}

RotationRates<2> with_contact(const RotationRates<2>& without, const Mat<1, 1>& inertia,
                              const RotationScheme& scheme, const RigidMotion&,
                              const Vec<1>& contact, double way) {
  const double share = way / scheme.beta;
  const Vec<1> b = contact / inertia(0, 0);
  return {without.velocity + scheme.step * (1 - scheme.gamma * share) * b,
          without.acceleration - share * b, without.moment - share * contact};
}

Vec3 rotation_rate(const RigidMotion3& motion, const Vec3& spin) {
  return spin_tangent(motion).fullPivLu().solve(spin);
}

Vec3 moment_of(const RigidMotion3& motion, const Vec3& force) {
  return Mat<3, 3>(spin_tangent(motion).transpose()).fullPivLu().solve(force);
}

RotationForce<3> rotation_force(const RigidMotion3& motion, const Vec3& moment,
                                const Mat<3, 3>& gradient) {
  const Mat<3, 3> t = rotation_tangent(motion.rotation);
  return {t.transpose() * moment,
          moment_gradient(motion.rotation, moment) + t.transpose() * gradient * t};
}

RotationRates<3> initial_rates(const Mat<3, 3>& inertia, const RigidMotion3& motion,
                               const Vec3& velocity, const Vec3& moment) {
  const Mat<3, 3> r = motion.orientation();
  const Vec3 w = r.transpose() * velocity;
  const Vec3 momentum = inertia * w;
  const Vec3 rate = r.transpose() * moment - w.cross(momentum);
  return {w, inertia.inverse() * rate, moment};
}

RotationRates<2> initial_rates(const Mat<1, 1>& inertia, const RigidMotion&, const Vec<1>& velocity,
                               const Vec<1>& moment) {
  return {velocity, moment / inertia(0, 0), moment};
}

}  // namespace osculate::body
