// Steps with inertia: what one step in time is off by.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "osculate/model/system_motion.hpp"

namespace osculate::model {

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::Motion::speeds_of(const Rates& rates) const {
  Eigen::VectorXd out = rates.velocity;
  if constexpr (Dim == 3)
    for (std::size_t b = 0; b < model.rigid.size(); ++b)
      out.segment<3>(dofs.body_dof(static_cast<Index>(b), Dim)) =
          inertia.body_has_mass(b) ? rates.spins[b].velocity : Vec3(Vec3::Zero());
  return out;
}

template <int Dim>
double BasicSystem<Dim>::Impl::Motion::size_by_mass(const Eigen::VectorXd& w) const {
  double sum = w.dot(inertia.multiply(w));
  if constexpr (Dim == 3)
    for (std::size_t b = 0; b < model.rigid.size(); ++b) {
      const Vec3 turn = w.segment<3>(dofs.body_dof(static_cast<Index>(b), Dim));
      if (inertia.body_has_mass(b)) sum += turn.dot(model.rigid[b].inertia * turn);
    }
  return std::sqrt(std::max(sum, 0.0));
}

/// Change of the accelerations of the free unknowns, and of all that follows from them. What is
/// prescribed has no error, and the masses between it and the others carry its own accelerations
/// into theirs: these are taken away as they were put in (decision 027).
template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::Motion::free_accelerations(const Rates& before,
                                                                   const Rates& after) {
  Eigen::VectorXd change = after.acceleration - before.acceleration;
  if constexpr (Dim == 3)
    for (std::size_t b = 0; b < model.rigid.size(); ++b) {
      if (!coupled[b]) continue;
      const Vec3 turning = after.spins[b].acceleration - before.spins[b].acceleration;
      change.segment<3>(dofs.body_dof(static_cast<Index>(b), Dim)) =
          body::rotation_rate(mass_rigid[b], Vec3(mass_rigid[b].orientation() * turning));
    }
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(dofs.dofs());
  return settled(change, none, none, none);
}

/// Rotations in space: `error` holds those of rotation vectors that the mass matrix has; they come
/// out about the axes of the bodies.
///
/// Formula    h^2 factor (A_n+1 - A_n) - h^3/12 W x A , with W, A in the middle: what the rotation
///            vector of the step leaves out, whose second derivative is not that of the turn
/// Source     Magnus1954 (R' = R skew W: second term of the exponent + 1/2 of the commutators)
/// Tested by  tests/unit/deck/test_time_steps.cpp
template <int Dim>
void BasicSystem<Dim>::Impl::Motion::add_spin_errors(const Rates& before, const Rates& after,
                                                     double length, Eigen::VectorXd& error) const {
  if constexpr (Dim == 3) {
    const double factor = solve::error_factor(settings.scheme);
    for (std::size_t b = 0; b < model.rigid.size(); ++b) {
      auto turn = error.segment<3>(dofs.body_dof(static_cast<Index>(b), Dim));
      const body::RigidMotion3& at = mass_rigid[b];
      if (!inertia.body_has_mass(b) || free_rotations(b) == 0) {
        turn.setZero();
        continue;
      }
      const body::RotationRates<3>&was = before.spins[b], &is = after.spins[b];
      if (coupled[b])
        turn = at.orientation().transpose() * (body::spin_tangent(at) * Vec3(turn));
      else
        turn = length * length * factor * (is.acceleration - was.acceleration);
      if (free_rotations(b) < body::rotations<Dim>) continue;
      const Vec3 spin = 0.5 * (was.velocity + is.velocity);
      const Vec3 change = 0.5 * (was.acceleration + is.acceleration);
      turn -= length * length * length / 12 * spin.cross(change);
    }
  } else {
    (void)before, (void)after, (void)length, (void)error;
  }
}

template <int Dim>
solve::TimeError BasicSystem<Dim>::Impl::Motion::time_error(const State& committed,
                                                            const State& next) {
  const Rates &before = committed.rates, &after = next.rates;
  const double length = system.time_between(committed, next.fraction);
  const solve::TimeScheme& scheme = settings.scheme;
  const auto size_of = [&](const Eigen::VectorXd& change) {
    Eigen::VectorXd error = length * length * solve::error_factor(scheme) * change;
    add_spin_errors(before, after, length, error);
    return size_by_mass(error);
  };
  const Eigen::VectorXd change = free_accelerations(before, after);
  double error = size_of(change);
  // Contact that lasts holds what it holds: the acceleration of both is what the bodies have. That
  // of an impact is an impulse, and no acceleration at all.
  if (scheme.impact != solve::Impact::average && after.contact != before.contact)
    error = std::min(error, size_of(change + accelerations_by(before.contact - after.contact)));
  // What moves less than this share of the bodies' extent in the whole step is at rest.
  constexpr double at_rest = 1e-6;
  double extent = system.bulk.jobs.empty() ? 0.0 : system.resistance.extent;
  for (const BasicRigidBody<Dim>& body : model.rigid)
    if (body.mass > 0) extent = std::max(extent, std::sqrt(body.inertia.trace() / body.mass));
  const double slowest = at_rest * extent * std::sqrt(inertia.total()) / step.duration;
  return {error / length, std::max(slowest, size_by_mass(speeds_of(after) - speeds)), length};
}

template <int Dim>
solve::TimeError BasicSystem<Dim>::time_error(const State& committed, const State& next) const {
  return impl_->motion->time_error(committed, next);
}

template solve::TimeError BasicSystem<2>::time_error(const State&, const State&) const;
template solve::TimeError BasicSystem<3>::time_error(const State3&, const State3&) const;
template struct BasicSystem<2>::Impl::Motion;
template struct BasicSystem<3>::Impl::Motion;

}  // namespace osculate::model
