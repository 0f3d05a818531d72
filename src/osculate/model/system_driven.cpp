// Steps with inertia: the rates of what is prescribed and of what follows from it.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "osculate/model/system_motion.hpp"

namespace osculate::model {
namespace {

double weaker(double a, double b) {
  if (!(a * b > 0)) return 0;
  return std::abs(a) < std::abs(b) ? a : b;
}

/// First and second derivative of a ramp by the fraction.
struct Slope {
  double rate = 0, curvature = 0;
};

/// From its values a `spacing` apart, so that the velocities of a step add up to the way. At the
/// ends of the step one-sided: by a parabola, or where there is a kink within two spacings by the
/// straight line before it. Second order for smooth tables, and exact for ramps.
Slope slope_of(const Ramp& ramp, double at, double spacing) {
  if (ramp.amplitude.empty()) return {ramp.target - ramp.start, 0};
  constexpr double sliver = 1e-9;
  const double room = std::min(at, 1 - at);
  if (room > sliver) {
    const double s = std::min(spacing, room);
    const double before = ramp.value(at - s), here = ramp.value(at), after = ramp.value(at + s);
    return {(after - before) / (2 * s), (after - 2 * here + before) / (s * s)};
  }
  const double s = (at < 0.5 ? 1 : -1) * std::min(spacing, 1.0 / 3);
  const auto slope = [&](int k) {
    return (ramp.value(at + k * s) - ramp.value(at + (k - 1) * s)) / s;
  };
  const double first = slope(1), second = slope(2), third = slope(3);
  const double curvature = weaker(second - first, third - second) / s;
  return {first - 0.5 * s * curvature, curvature};
}

/// Change of the spin at fixed rates of the rotation vector: the part of its acceleration that is
/// not T times theirs.
Vec3 spin_change(const body::RigidMotion3& motion, const Vec3& rates) {
  Vec3 change;
  for (int i = 0; i < 3; ++i)
    change[i] = rates.dot(body::moment_gradient(motion, Vec3::Unit(i)) * rates);
  return change;
}

Mat<3, 3> inertia_in_space(const Mat<3, 3>& inertia, const body::RigidMotion3& motion) {
  const Mat<3, 3> r = motion.orientation();
  return r * inertia * r.transpose();
}

}  // namespace

template <int Dim>
typename BasicSystem<Dim>::Impl::Motion::Driven BasicSystem<Dim>::Impl::Motion::driven(
    double fraction, double spacing) const {
  Driven out{Eigen::VectorXd::Zero(dofs.dofs()), Eigen::VectorXd::Zero(dofs.dofs())};
  const double t = step.duration;
  for (const PrescribedDof& p : step.prescribed) {
    const Slope slope = slope_of(p.ramp, fraction, spacing);
    out.velocity[p.dof] = slope.rate / t;
    out.acceleration[p.dof] = slope.curvature / (t * t);
  }
  return out;
}

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::Motion::moving_constants() const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(dofs.dofs());
  const double rate = (step.equation_end - step.equation_start) / step.duration;
  for (const Equation& equation : dofs.equations()) {
    double rest = equation.value * rate;
    for (std::size_t t = 1; t < equation.terms.size(); ++t)
      rest -= equation.terms[t].factor * out[equation.terms[t].dof];
    out[equation.terms.front().dof] = rest / equation.terms.front().factor;
  }
  return out;
}

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::Motion::turning_accelerations(
    const Eigen::VectorXd& velocity) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(dofs.dofs());
  for (std::size_t b = 0; b < model.rigid.size(); ++b) {
    const body::BasicRigidMotion<Dim>& motion_of = mass_rigid[b];
    const Dof first = dofs.body_dof(static_cast<Index>(b), Dim);
    const Vec<body::rotations<Dim>> rates = velocity.segment<body::rotations<Dim>>(first);
    if (motion_of.small || rates.isZero(0)) continue;
    for (const Index node : model.rigid[b].nodes) {
      const Vec<Dim> arm = mass_x[static_cast<std::size_t>(node)] - motion_of.center();
      if constexpr (Dim == 2) {
        out.segment<2>(2 * node) = -rates[0] * rates[0] * arm;
      } else {
        const Vec3 spin = body::spin_tangent(motion_of) * rates;
        out.segment<3>(3 * node) =
            spin_change(motion_of, rates).cross(arm) + spin.cross(spin.cross(arm));
      }
    }
  }
  for (const Equation& equation : dofs.equations()) {
    double rest = 0;
    for (std::size_t t = 1; t < equation.terms.size(); ++t)
      rest -= equation.terms[t].factor * out[equation.terms[t].dof];
    out[equation.terms.front().dof] = rest / equation.terms.front().factor;
  }
  return out;
}

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::Motion::momenta_of(const Eigen::VectorXd& rates) const {
  Eigen::VectorXd out = inertia.multiply(rates);
  if constexpr (Dim == 3) {
    for (std::size_t b = 0; b < model.rigid.size(); ++b) {
      if (!coupled[b]) continue;
      const Dof first = dofs.body_dof(static_cast<Index>(b), Dim);
      const Mat<3, 3> t = body::spin_tangent(mass_rigid[b]);
      const Vec3 spin = t * rates.segment<3>(first);
      out.segment<3>(first) +=
          t.transpose() * (inertia_in_space(model.rigid[b].inertia, mass_rigid[b]) * spin);
    }
  }
  return out;
}

/// Rates of all dofs that follow from those of the unknowns. What is prescribed has its own, and
/// the free unknowns keep the momenta that the scheme and `force` have given them: so the masses
/// between both take part in what is prescribed, without a trace of how its rates were found in the
/// motion of the others.
///
/// Formula    E^T M (w - by_scheme) = E^T force ,  w = E q + constant ,  E of the free unknowns
template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::Motion::settled(const Eigen::VectorXd& by_scheme,
                                                        const Eigen::VectorXd& prescribed,
                                                        const Eigen::VectorXd& constant,
                                                        const Eigen::VectorXd& force) {
  Eigen::VectorXd q(dofs.unknowns());
  for (Index u = 0; u < dofs.unknowns(); ++u) {
    const Dof dof = dofs.dof_of_unknown(u);
    q[u] = assembler.prescribed(u) ? prescribed[dof] : by_scheme[dof];
  }
  Eigen::VectorXd follows = spread(q) + constant;
  follows += accelerations_by(force + momenta_of(by_scheme - follows));
  return follows;
}

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::Motion::rotation_rates(
    const Eigen::VectorXd& velocity) const {
  Eigen::VectorXd rates = velocity;
  if constexpr (Dim == 3) {
    for (std::size_t b = 0; b < model.rigid.size(); ++b) {
      const Dof first = dofs.body_dof(static_cast<Index>(b), Dim);
      rates.segment<3>(first) = body::rotation_rate(mass_rigid[b], velocity.segment<3>(first));
    }
  }
  return rates;
}

template <int Dim>
void BasicSystem<Dim>::Impl::Motion::set_rotations(const Eigen::VectorXd& rates,
                                                   Eigen::VectorXd& velocity) const {
  const Eigen::VectorXd before = velocity;
  velocity = rates;
  if constexpr (Dim == 3) {
    for (std::size_t b = 0; b < model.rigid.size(); ++b) {
      const Dof first = dofs.body_dof(static_cast<Index>(b), Dim);
      velocity.segment<3>(first) = before.segment<3>(first);
      if (coupled[b])
        velocity.segment<3>(first) = body::spin_tangent(mass_rigid[b]) * rates.segment<3>(first);
    }
  }
}

template <int Dim>
typename BasicSystem<Dim>::Impl::Motion::Given BasicSystem<Dim>::Impl::Motion::given_velocity()
    const {
  const auto running = std::find_if(model.steps.begin(), model.steps.end(),
                                    [](const Step& s) { return s.dynamics.has_value(); });
  Given given{Eigen::VectorXd::Zero(dofs.dofs()),
              std::vector<bool>(static_cast<std::size_t>(dofs.dofs()))};
  if (running != model.steps.end() && running->name != step.name) return given;
  for (const auto& entry : model.initial_velocity) {
    given.velocity[entry.first] = entry.second;
    given.told[static_cast<std::size_t>(entry.first)] = true;
  }
  return given;
}

/// What follows takes part in velocities that were given for it as after an inelastic impact, and
/// otherwise has what follows from the unknowns.
template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::Motion::start_velocity(const Driven& prescribed) {
  const Given given = given_velocity();
  Eigen::VectorXd rates = rotation_rates(given.velocity);
  Eigen::VectorXd q(dofs.unknowns());
  for (Index u = 0; u < dofs.unknowns(); ++u) {
    const Dof dof = dofs.dof_of_unknown(u);
    q[u] = assembler.prescribed(u) ? prescribed.velocity[dof] : rates[dof];
  }
  const Eigen::VectorXd follows = spread(q) + moving_constants();
  std::vector<Expansion> terms;
  for (Dof d = 0; d < dofs.dofs(); ++d) {
    if (dofs.unknown_of(d) >= 0 && !assembler.prescribed(dofs.unknown_of(d))) continue;
    terms.clear();
    dofs.expand(d, 1.0, mass_x, mass_rigid, terms);
    const bool free = std::any_of(terms.begin(), terms.end(), [&](const Expansion& e) {
      return !assembler.prescribed(e.unknown);
    });
    if (!free || !given.told[static_cast<std::size_t>(d)]) rates[d] = follows[d];
  }
  Eigen::VectorXd velocity = given.velocity;
  set_rotations(
      settled(rates, prescribed.velocity, moving_constants(), Eigen::VectorXd::Zero(dofs.dofs())),
      velocity);
  return velocity;
}

/// Velocities of the scheme become those of bodies that move as they are told.
template <int Dim>
void BasicSystem<Dim>::Impl::Motion::settle_velocities(Rates& now, const Driven& prescribed) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(dofs.dofs());
  set_rotations(
      settled(rotation_rates(now.velocity), prescribed.velocity, moving_constants(), none),
      now.velocity);
}

/// The same for accelerations, with the velocities that they belong to. `force`: what accelerates
/// beside what they hold already. Rotations in space stand in `spins`: what changes their
/// accelerations changes the moments with them, and both keep what the scheme has made of them.
template <int Dim>
void BasicSystem<Dim>::Impl::Motion::settle_accelerations(Rates& now, const Driven& prescribed,
                                                          const Eigen::VectorXd& force) {
  const Eigen::VectorXd rates = rotation_rates(now.velocity);
  Eigen::VectorXd by_scheme = now.acceleration;
  if constexpr (Dim == 3) {
    for (std::size_t b = 0; b < model.rigid.size(); ++b) {
      if (!coupled[b]) continue;
      const Dof first = dofs.body_dof(static_cast<Index>(b), Dim);
      const Vec3 spinning = mass_rigid[b].orientation() * now.spins[b].acceleration;
      by_scheme.segment<3>(first) = body::rotation_rate(
          mass_rigid[b], spinning - spin_change(mass_rigid[b], rates.segment<3>(first)));
    }
  }
  now.acceleration =
      settled(by_scheme, prescribed.acceleration, turning_accelerations(rates), force);
  if constexpr (Dim == 3) {
    for (std::size_t b = 0; b < model.rigid.size(); ++b) {
      const Dof first = dofs.body_dof(static_cast<Index>(b), Dim);
      const Vec3 rotation = now.acceleration.segment<3>(first);
      now.acceleration.segment<3>(first).setZero();
      if (!coupled[b]) continue;
      const body::RigidMotion3& motion_of = mass_rigid[b];
      const Mat<3, 3> to_body = motion_of.orientation().transpose();
      const Vec3 spin = now.velocity.segment<3>(first);
      const Vec3 spinning = body::spin_tangent(motion_of) * rotation +
                            spin_change(motion_of, rates.segment<3>(first));
      const Vec3 change = to_body * spinning - now.spins[b].acceleration;
      const Vec3 moment = to_body.transpose() * (model.rigid[b].inertia * change);
      now.spins[b] = {to_body * spin, to_body * spinning, now.spins[b].moment + moment};
    }
  }
}

/// Rotations in space at the start, of bodies that the mass matrix has: as if their rotation
/// vectors were not accelerated, and the moments that this takes are taken from the force.
template <int Dim>
void BasicSystem<Dim>::Impl::Motion::begin_coupled_spins(Rates& rates,
                                                         Eigen::VectorXd& force) const {
  if constexpr (Dim == 3) {
    const Eigen::VectorXd turning = rotation_rates(rates.velocity);
    for (std::size_t b = 0; b < model.rigid.size(); ++b) {
      if (!coupled[b]) continue;
      const Dof first = dofs.body_dof(static_cast<Index>(b), Dim);
      const Vec3 spin = rates.velocity.segment<3>(first);
      const Vec3 change = spin_change(mass_rigid[b], turning.segment<3>(first));
      const Mat<3, 3> of_body = inertia_in_space(model.rigid[b].inertia, mass_rigid[b]);
      const Vec3 moment = of_body * change + spin.cross(of_body * spin);
      const Mat<3, 3> to_body = mass_rigid[b].orientation().transpose();
      rates.spins[b] = {to_body * spin, to_body * change, moment};
      force.segment<3>(first) -= body::spin_tangent(mass_rigid[b]).transpose() * moment;
    }
  } else {
    (void)rates, (void)force;
  }
}

/// Mass times acceleration.
template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::Motion::inertia_of(const Rates& rates) const {
  Eigen::VectorXd out = inertia.multiply(rates.acceleration);
  if constexpr (Dim == 3) {
    for (std::size_t b = 0; b < model.rigid.size(); ++b)
      if (inertia.body_has_mass(b))
        out.segment<3>(dofs.body_dof(static_cast<Index>(b), Dim)) +=
            body::spin_tangent(mass_rigid[b]).transpose() * rates.spins[b].moment;
  }
  return out;
}

/// The scheme's velocity at the end of an increment is not that of what is prescribed; the damping
/// forces are those of the latter.
template <int Dim>
void BasicSystem<Dim>::Impl::Motion::correct_damping() {
  correction = Eigen::VectorXd::Zero(dofs.dofs());
  if (!(settings.damping_mass > 0) && damping.empty()) return;
  const Driven at_end = driven(target, h / step.duration);
  const solve::TimeScheme& s = settings.scheme;
  Eigen::VectorXd q = Eigen::VectorXd::Zero(dofs.unknowns());
  for (const PrescribedDof& p : step.prescribed) {
    const Index unknown = dofs.unknown_of(p.dof);
    const Dof local = p.dof - Dim * dofs.nodes();
    if (unknown < 0 || (Dim == 3 && local >= 0 && local % body::motions<Dim> >= Dim)) continue;
    const double v = past.velocity[p.dof], a = past.acceleration[p.dof];
    const double way = p.ramp.value(target) - start[p.dof];
    const double by_scheme =
        v + h * (1 - s.gamma) * a + factors.rate * (way - h * v - h * h * (0.5 - s.beta) * a);
    q[unknown] = at_end.velocity[p.dof] - by_scheme;
  }
  if (q.isZero(0)) return;
  const Eigen::VectorXd told = spread(q);
  correction = told + accelerations_by(-momenta_of(told));
}

/// Forces of the beginning of an increment act with the arms that they had there.
template <int Dim>
void BasicSystem<Dim>::Impl::Motion::move_past_to_bodies() {
  Motion& m = *this;
  const solve::StepFactors& f = m.factors;
  Eigen::VectorXd sum = f.past_mass * m.inertia.multiply(m.past.acceleration);
  if (f.past_force != 0.0) {
    sum += f.past_force * (m.past.internal - m.past.external + m.past.damping);
    if (m.settings.scheme.impact == solve::Impact::average) sum += f.past_force * m.past.contact;
  }
  for (std::size_t b = 0; b < model.rigid.size(); ++b) {
    const body::BasicRigidMotion<Dim>& at = m.from[b];
    const Dof first = dofs.body_dof(static_cast<Index>(b), 0);
    if constexpr (Dim == 3) {
      const Vec3 on_rotation = sum.segment<3>(first + 3);
      sum.segment<3>(first + 3) = body::moment_of(at, on_rotation);
    }
    for (const Index node : model.rigid[b].nodes) {
      const Vec<Dim> force = sum.segment<Dim>(Dim * node);
      if (force.isZero(0)) continue;
      const Vec<Dim>& material = model.reference[static_cast<std::size_t>(node)];
      const Vec<Dim> arm = body::arm_of(at, at.position(material));
      sum.segment<Dim>(first) += force;
      if constexpr (Dim == 2)
        sum[first + 2] += turn(arm).dot(force);
      else
        sum.segment<3>(first + 3) += arm.cross(force);
      sum.segment<Dim>(Dim * node).setZero();
    }
  }
  m.past_force = std::move(sum);
}

/// Mean of what changes the angular momenta of bodies in space over the increment, as forces on
/// their rotation vectors.
template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::Motion::spin_force(const Rates& before,
                                                           const Rates& now) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(dofs.dofs());
  if constexpr (Dim == 3) {
    for (std::size_t b = 0; b < model.rigid.size(); ++b) {
      if (!inertia.body_has_mass(b)) continue;
      const Mat<3, 3>& of_body = model.rigid[b].inertia;
      const Vec3 change = body::angular_momentum(of_body, mass_rigid[b], now.spins[b]) -
                          body::angular_momentum(of_body, from[b], before.spins[b]);
      const Vec3 between = 0.5 * (from[b].rotation + mass_rigid[b].rotation);
      out.segment<3>(dofs.body_dof(static_cast<Index>(b), Dim)) =
          body::rotation_tangent(between).transpose() * change / h;
    }
  }
  return out;
}

template struct BasicSystem<2>::Impl::Motion;
template struct BasicSystem<3>::Impl::Motion;

}  // namespace osculate::model
