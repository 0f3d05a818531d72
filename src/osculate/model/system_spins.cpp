// Steps with inertia: rotations of rigid bodies in space.
#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "osculate/model/system_impl.hpp"

namespace osculate::model {
namespace {

body::RotationScheme rotation_scheme(const solve::TimeScheme& s, double h) {
  return {h, s.alpha_m, s.beta, s.gamma};
}

}  // namespace

template <int Dim>
bool BasicSystem<Dim>::Impl::turns_freely(std::size_t body) const {
  if (!(model.rigid[body].mass > 0)) return false;
  for (const PrescribedDof& p : step.prescribed)
    for (int i = Dim; i < body::motions<Dim>; ++i)
      if (p.dof == dofs.body_dof(static_cast<Index>(body), i)) return false;
  return true;
}

template <int Dim>
Vec<body::rotations<Dim>> BasicSystem<Dim>::Impl::moment_on(
    const State& s, std::size_t body, const Eigen::VectorXd& forces_on_dofs) const {
  Vec<body::rotations<Dim>> moment = Vec<body::rotations<Dim>>::Zero();
  const body::BasicRigidMotion<Dim>& motion_of = s.rigid[body];
  for (const Index node : model.rigid[body].nodes) {
    const Vec<Dim> f = forces_on_dofs.segment<Dim>(Dim * node);
    const Vec<Dim> arm =
        motion_of.position(model.reference[static_cast<std::size_t>(node)]) - motion_of.center();
    if constexpr (Dim == 2)
      moment[0] += turn(arm).dot(f);
    else
      moment += arm.cross(f);
  }
  return moment;
}

template <int Dim>
void BasicSystem<Dim>::Impl::add_spins(const State& trial, bool with_tangent,
                                       const Eigen::VectorXd* inc) {
  if constexpr (Dim == 3) {
    Motion& m = *motion;
    const body::RotationScheme scheme = rotation_scheme(m.settings.scheme, m.h);
    for (std::size_t b = 0; b < model.rigid.size(); ++b) {
      if (!m.inertia->body_has_mass(b)) continue;
      const body::InertiaMoment<3> inertial = body::inertia_moment(
          model.rigid[b].inertia, m.past.spins[b], scheme, m.from[b], trial.rigid[b]);
      const body::RotationForce<3> force =
          body::rotation_force(trial.rigid[b], inertial.moment, inertial.gradient);
      const Dof first = dofs.body_dof(static_cast<Index>(b), 3);
      m.effective.template segment<3>(first) += m.factors.balance * force.force;
      const std::array<Dof, 3> d{first, first + 1, first + 2};
      if (with_tangent) add_stiffness(d, Mat<3, 3>(m.factors.balance * force.tangent), inc);
    }
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::begin_spins(const State& committed, Rates& rates) const {
  if constexpr (Dim == 3) {
    rates.spins.resize(model.rigid.size());
    const bool average = motion->settings.scheme.impact == solve::Impact::average;
    Eigen::VectorXd force = forces.external - forces.internal;
    if (average) force -= forces.contact;
    for (std::size_t b = 0; b < model.rigid.size(); ++b) {
      if (!motion->inertia->body_has_mass(b)) continue;
      const Dof first = dofs.body_dof(static_cast<Index>(b), 3);
      Vec3 moment = moment_on(committed, b, force);
      for (const DeadLoad& load : step.dead)  // about axes fixed in space
        for (const auto& entry : load.unit)
          if (entry.first >= first && entry.first < first + 3)
            moment[entry.first - first] += load.ramp.value(0) * entry.second;
      rates.spins[b] = body::initial_rates(model.rigid[b].inertia, committed.rigid[b],
                                           rates.velocity.template segment<3>(first), moment);
      rates.acceleration.template segment<3>(first).setZero();
    }
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::new_spins(const State& trial, Rates& now) const {
  if constexpr (Dim == 3) {
    const Motion& m = *motion;
    const body::RotationScheme scheme = rotation_scheme(m.settings.scheme, m.h);
    now.spins = m.past.spins;
    for (std::size_t b = 0; b < model.rigid.size(); ++b) {
      const Dof first = dofs.body_dof(static_cast<Index>(b), 3);
      now.acceleration.template segment<3>(first).setZero();
      const Vec3 turn_of = body::turn_between(m.from[b], trial.rigid[b]);
      const Mat<3, 3> to_body = trial.rigid[b].orientation().transpose();
      body::RotationRates<3>& rates = now.spins[b];
      if (!turns_freely(b)) {
        rates = {};
        rates.velocity = to_body * turn_of / m.h;
        now.velocity.template segment<3>(first) = turn_of / m.h;
        continue;
      }
      const Mat<3, 3>& inertia = model.rigid[b].inertia;
      rates =
          body::inertia_moment(inertia, m.past.spins[b], scheme, m.from[b], trial.rigid[b]).rates;
      if (m.settings.scheme.impact != solve::Impact::average) {
        const Vec3 by_contact = -moment_on(trial, b, forces.contact);
        const Vec3 in_body = inertia.ldlt().solve(to_body * by_contact);
        rates.moment -= m.factors.impulse_in_rate * by_contact;
        rates.acceleration -= m.factors.impulse_in_rate * in_body;
        rates.velocity += m.h * m.factors.impulse_in_velocity * in_body;
      }
      now.velocity.template segment<3>(first) = body::spin(trial.rigid[b], rates);
    }
  }
}

template <int Dim>
double BasicSystem<Dim>::Impl::spin_energy(const Rates& rates) const {
  double sum = 0;
  if constexpr (Dim == 3)
    for (std::size_t b = 0; b < rates.spins.size(); ++b)
      if (motion->inertia->body_has_mass(b))
        sum += body::rotation_energy<3>(model.rigid[b].inertia, rates.spins[b]);
  return sum;
}

template struct BasicSystem<2>::Impl;
template struct BasicSystem<3>::Impl;

}  // namespace osculate::model
