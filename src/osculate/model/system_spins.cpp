// Steps with inertia: rotations of rigid bodies in space.
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "osculate/model/system_impl.hpp"

namespace osculate::model {
namespace {

body::RotationScheme rotation_scheme(const solve::TimeScheme& s, double h) {
  return {h, s.alpha_m, s.beta, s.gamma};
}

}  // namespace

template <int Dim>
int BasicSystem<Dim>::Impl::free_rotations(std::size_t body) const {
  int count = body::rotations<Dim>;
  for (const PrescribedDof& p : step.prescribed) count -= turns_body(p.dof, body) ? 1 : 0;
  return count;
}

template <int Dim>
bool BasicSystem<Dim>::Impl::turns_body(Dof dof, std::size_t body) const {
  const Dof first = dofs.body_dof(static_cast<Index>(body), 0);
  return dof >= first + Dim && dof < first + body::motions<Dim>;
}

template <int Dim>
bool BasicSystem<Dim>::Impl::total_matters(std::size_t body) const {
  if (free_rotations(body) < body::rotations<Dim>) return true;
  for (const Equation& equation : model.equations)
    for (const Equation::Term& term : equation.terms)
      if (turns_body(term.dof, body)) return true;
  const auto running = std::find_if(model.steps.begin(), model.steps.end(),
                                    [&](const Step& s) { return s.name == step.name; });
  for (auto later = running; later != model.steps.end(); ++later)
    for (const PrescribedDof& p : later->prescribed)
      if (turns_body(p.dof, body)) return true;
  return false;
}

template <int Dim>
void BasicSystem<Dim>::Impl::rebase(State& state) const {
  if constexpr (Dim == 3) {
    for (std::size_t b = 0; b < state.rigid.size(); ++b) {
      if (!(model.rigid[b].mass > 0) || total_matters(b)) continue;
      const body::RigidMotion3 before = state.rigid[b];
      state.rigid[b] = body::rebased(before);
      if (state.rigid[b].rotation == before.rotation) continue;
      // Forces on the rotation vector are forces on another one now.
      const Dof first = dofs.body_dof(static_cast<Index>(b), Dim);
      Rates& r = state.rates;
      for (Eigen::VectorXd* const forces_on : {&r.internal, &r.external, &r.contact, &r.damping})
        forces_on->template segment<3>(first) =
            body::moment_of(before, Vec3(forces_on->template segment<3>(first)));
    }
  } else {
    (void)state;
  }
}

/// What turns a body: the moment without the part that the supports of its prescribed rotations
/// take at once. `spinning`: angular velocity times momentum, whose change needs a moment too.
///
/// Formula    J P (P^T J P)^-1 P^T (m - w) + w ,  P the spins of the free rotations
template <int Dim>
Vec3 BasicSystem<Dim>::Impl::turning_moment(const body::RigidMotion3& motion_of, std::size_t body,
                                            const Vec3& moment, const Vec3& spinning) const {
  if constexpr (Dim == 3) {
    const int count = free_rotations(body);
    if (count == 3) return moment;
    if (count == 0) return spinning;
    const Mat<3, 3> tangent = body::rotation_tangent(motion_of.rotation);
    std::array<bool, 3> held{};
    const Dof first = dofs.body_dof(static_cast<Index>(body), 3);
    for (const PrescribedDof& p : step.prescribed)
      if (turns_body(p.dof, body)) held[static_cast<std::size_t>(p.dof - first)] = true;
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> spins(3, count);
    for (int i = 0, at = 0; i < 3; ++i)
      if (!held[static_cast<std::size_t>(i)]) spins.col(at++) = tangent.col(i);
    const Mat<3, 3> r = motion_of.orientation();
    const Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> momenta =
        r * model.rigid[body].inertia * r.transpose() * spins;
    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3> mass =
        spins.transpose() * momenta;
    return momenta * mass.ldlt().solve(spins.transpose() * (moment - spinning)) + spinning;
  } else {
    (void)motion_of, (void)body, (void)spinning;
    return moment;
  }
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
      const Vec3 velocity = rates.velocity.template segment<3>(first);
      const Mat<3, 3> r = committed.rigid[b].orientation();
      const Vec3 momentum = r * model.rigid[b].inertia * r.transpose() * velocity;
      rates.spins[b] = body::initial_rates(
          model.rigid[b].inertia, committed.rigid[b], velocity,
          turning_moment(committed.rigid[b], b, moment, velocity.cross(momentum)));
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
      if (!m.inertia->body_has_mass(b) || free_rotations(b) == 0) {
        rates = {};
        rates.velocity = to_body * turn_of / m.h;
        now.velocity.template segment<3>(first) = turn_of / m.h;
        continue;
      }
      const Mat<3, 3>& inertia = model.rigid[b].inertia;
      rates =
          body::inertia_moment(inertia, m.past.spins[b], scheme, m.from[b], trial.rigid[b]).rates;
      if (m.settings.scheme.impact != solve::Impact::average) {
        const Vec3 by_contact =
            turning_moment(trial.rigid[b], b, -moment_on(trial, b, forces.contact), Vec3::Zero());
        rates = body::with_contact(rates, inertia, scheme, trial.rigid[b], by_contact,
                                   solve::impulse_way(m.settings.scheme.impact));
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
