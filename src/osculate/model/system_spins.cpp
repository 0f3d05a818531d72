// Steps with inertia: rotations of rigid bodies in space.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>

#include "osculate/model/system_motion.hpp"

namespace osculate::model {
namespace {

body::RotationScheme rotation_scheme(const solve::TimeScheme& s, double h) {
  return {h, s.alpha_m, s.beta, s.gamma};
}

}  // namespace

template <int Dim>
int BasicSystem<Dim>::Impl::Motion::free_rotations(std::size_t body) const {
  int count = body::rotations<Dim>;
  for (const PrescribedDof& p : step.prescribed) count -= turns_body(p.dof, body) ? 1 : 0;
  return count;
}

template <int Dim>
bool BasicSystem<Dim>::Impl::Motion::turns_body(Dof dof, std::size_t body) const {
  const Dof first = dofs.body_dof(static_cast<Index>(body), 0);
  return dof >= first + Dim && dof < first + body::motions<Dim>;
}

template <int Dim>
bool BasicSystem<Dim>::Impl::Motion::turns_by_rule(std::size_t body) const {
  if (free_rotations(body) < body::rotations<Dim>) return true;
  for (const Equation& equation : model.equations)
    for (const Equation::Term& term : equation.terms)
      if (turns_body(term.dof, body)) return true;
  return false;
}

template <int Dim>
bool BasicSystem<Dim>::Impl::Motion::total_matters(std::size_t body) const {
  if (turns_by_rule(body)) return true;
  const auto running = std::find_if(model.steps.begin(), model.steps.end(),
                                    [&](const Step& s) { return s.name == step.name; });
  for (auto later = running; later != model.steps.end(); ++later)
    for (const PrescribedDof& p : later->prescribed)
      if (turns_body(p.dof, body)) return true;
  return false;
}

template <int Dim>
void BasicSystem<Dim>::Impl::Motion::rebase(State& state) const {
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

template <int Dim>
Vec<body::rotations<Dim>> BasicSystem<Dim>::Impl::Motion::moment_on(
    const State& s, std::size_t body, const Eigen::VectorXd& forces_on_dofs) const {
  Vec<body::rotations<Dim>> moment = Vec<body::rotations<Dim>>::Zero();
  const body::BasicRigidMotion<Dim>& motion_of = s.rigid[body];
  for (const Index node : model.rigid[body].nodes) {
    const Vec<Dim> f = forces_on_dofs.segment<Dim>(Dim * node);
    const Vec<Dim>& material = model.reference[static_cast<std::size_t>(node)];
    const Vec<Dim> arm = body::arm_of(motion_of, motion_of.position(material));
    if constexpr (Dim == 2)
      moment[0] += turn(arm).dot(f);
    else
      moment += arm.cross(f);
  }
  return moment;
}

template <int Dim>
void BasicSystem<Dim>::Impl::Motion::add_spins(const State& trial, Assembly<Dim>& to) {
  if constexpr (Dim == 3) {
    Motion& m = *this;
    const body::RotationScheme scheme = rotation_scheme(m.settings.scheme, m.h);
    for (std::size_t b = 0; b < model.rigid.size(); ++b) {
      const Dof first = dofs.body_dof(static_cast<Index>(b), 3);
      const std::array<Dof, 3> d{first, first + 1, first + 2};
      const Vec3 before = m.past_force.template segment<3>(first);
      m.effective.template segment<3>(first) +=
          body::spin_tangent(trial.rigid[b]).transpose() * before - before;
      if (to.with_tangent && !before.isZero(0))
        to.add_stiffness(d, body::moment_gradient(trial.rigid[b], before));
      if (!m.inertia.body_has_mass(b)) continue;
      const body::InertiaMoment<3> inertial = body::inertia_moment(
          model.rigid[b].inertia, m.past.spins[b], scheme, m.from[b], trial.rigid[b]);
      const body::RotationForce<3> force =
          body::rotation_force(trial.rigid[b], inertial.moment, inertial.gradient);
      m.effective.template segment<3>(first) += m.factors.balance * force.force;
      if (to.with_tangent) to.add_stiffness(d, Mat<3, 3>(m.factors.balance * force.tangent));
      if (m.settings.damping_mass > 0) add_spin_damping(trial, b, inertial, to);
    }
  }
}

/// Damping by mass: a moment of the angular momentum times its factor.
template <int Dim>
void BasicSystem<Dim>::Impl::Motion::add_spin_damping(const State& trial, std::size_t body,
                                                      const body::InertiaMoment<3>& inertial,
                                                      Assembly<Dim>& to) {
  if constexpr (Dim == 3) {
    const solve::TimeScheme& s = settings.scheme;
    const double factor = settings.damping_mass;
    const Vec3 momentum =
        body::angular_momentum(model.rigid[body].inertia, trial.rigid[body], inertial.rates);
    // The inertial moment is (1 - alpha_m) / (gamma h) times the momentum, up to what stands.
    const Mat<3, 3> gradient = factor * s.gamma * h / (1 - s.alpha_m) * inertial.gradient;
    const body::RotationForce<3> force =
        body::rotation_force(trial.rigid[body], factor * momentum, gradient);
    const Dof first = dofs.body_dof(static_cast<Index>(body), 3);
    damping_force.template segment<3>(first) += force.force;
    const std::array<Dof, 3> d{first, first + 1, first + 2};
    if (to.with_tangent) to.add_stiffness(d, Mat<3, 3>(factors.force * force.tangent));
  } else {
    (void)trial, (void)body, (void)inertial, (void)to;
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::Motion::damp_spins(const Eigen::VectorXd& velocity,
                                                Eigen::VectorXd& to) const {
  if constexpr (Dim == 3) {
    for (std::size_t b = 0; b < model.rigid.size(); ++b) {
      if (!inertia.body_has_mass(b)) continue;
      const Dof first = dofs.body_dof(static_cast<Index>(b), 3);
      const Mat<3, 3> r = mass_rigid[b].orientation();
      const Vec3 momentum =
          r * model.rigid[b].inertia * r.transpose() * velocity.template segment<3>(first);
      to.template segment<3>(first) +=
          settings.damping_mass *
          (body::rotation_tangent(mass_rigid[b].rotation).transpose() * momentum);
    }
  } else {
    (void)velocity, (void)to;
  }
}

/// Of bodies that turn freely; of the others the accelerations follow (settle_accelerations).
template <int Dim>
void BasicSystem<Dim>::Impl::Motion::begin_spins(const State& committed,
                                                 const Eigen::VectorXd& force, Rates& rates) const {
  if constexpr (Dim == 3) {
    rates.spins.assign(model.rigid.size(), {});
    for (std::size_t b = 0; b < model.rigid.size(); ++b) {
      if (coupled[b]) continue;
      const Dof first = dofs.body_dof(static_cast<Index>(b), 3);
      const Vec3 moment =
          moment_on(committed, b, force) +
          body::moment_of(committed.rigid[b], Vec3(force.template segment<3>(first)));
      rates.spins[b] = body::initial_rates(model.rigid[b].inertia, committed.rigid[b],
                                           Vec3(rates.velocity.template segment<3>(first)), moment);
    }
  } else {
    (void)committed, (void)force, (void)rates;
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::Motion::new_spins(const State& trial, const Eigen::VectorXd& impulse,
                                               const Eigen::VectorXd& left_over, Rates& now,
                                               Eigen::VectorXd& of_impulse) const {
  if constexpr (Dim == 3) {
    const Motion& m = *this;
    const solve::TimeScheme& s = m.settings.scheme;
    const body::RotationScheme scheme = rotation_scheme(s, m.h);
    now.spins = m.past.spins;
    for (std::size_t b = 0; b < model.rigid.size(); ++b) {
      const Dof first = dofs.body_dof(static_cast<Index>(b), 3);
      now.acceleration.template segment<3>(first).setZero();
      of_impulse.template segment<3>(first).setZero();
      const body::RigidMotion3& to = trial.rigid[b];
      body::RotationRates<3>& rates = now.spins[b];
      if (!m.inertia.body_has_mass(b)) {
        const Vec3 turn_of = body::turn_between(m.from[b], to);
        rates = {};
        rates.velocity = to.orientation().transpose() * turn_of / m.h;
        now.velocity.template segment<3>(first) = turn_of / m.h;
        continue;
      }
      const Mat<3, 3>& of_body = model.rigid[b].inertia;
      rates = body::inertia_moment(of_body, m.past.spins[b], scheme, m.from[b], to).rates;
      if (s.impact != solve::Impact::average) {
        const Mat<3, 3> tangent = body::rotation_tangent(to.rotation);
        const Mat<3, 3> r = to.orientation();
        const Vec3 by_contact =
            m.coupled[b]
                ? Vec3(r * of_body * r.transpose() * tangent * impulse.template segment<3>(first))
                : Vec3(-moment_on(trial, b, last.forces.contact));
        rates = body::with_contact(rates, of_body, scheme, to, by_contact,
                                   solve::impulse_way(s.impact));
        of_impulse.template segment<3>(first) = tangent.transpose() * by_contact;
      }
      now.velocity.template segment<3>(first) = body::spin(to, rates);
      if (m.coupled[b]) continue;
      const Vec3 moment = body::moment_of(to, Vec3(left_over.template segment<3>(first)));
      rates.moment -= moment;
      rates.acceleration -= of_body.inverse() * (to.orientation().transpose() * moment);
    }
  } else {
    (void)trial, (void)impulse, (void)left_over, (void)now, (void)of_impulse;
  }
}

template <int Dim>
double BasicSystem<Dim>::Impl::Motion::spin_energy(const Rates& rates) const {
  double sum = 0;
  if constexpr (Dim == 3)
    for (std::size_t b = 0; b < rates.spins.size(); ++b)
      if (inertia.body_has_mass(b))
        sum += body::rotation_energy<3>(model.rigid[b].inertia, rates.spins[b]);
  return sum;
}

template struct BasicSystem<2>::Impl::Motion;
template struct BasicSystem<3>::Impl::Motion;

}  // namespace osculate::model
