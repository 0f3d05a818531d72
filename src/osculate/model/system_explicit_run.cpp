// Explicit time integration: increments from one committed state to the next, and their energies.
#include <fmt/format.h>

#include <Eigen/LU>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "osculate/model/system_explicit.hpp"
#include "osculate/model/temperatures.hpp"

namespace osculate::model {
namespace {

constexpr int inspect_after = 50;  ///< time steps between two looks at the stable step

template <int Dim>
solve::StateCounts counts_of(const BasicModel<Dim>& model,
                             const std::vector<pairing::PairEvaluation<Dim>>& contact) {
  solve::StateCounts counts;
  for (std::size_t p = 0; p < contact.size(); ++p)
    for (const pairing::PointResult<Dim>& point : contact[p].points)
      count_point(model.pairs[p].definition, point, counts);
  return counts;
}

}  // namespace

template <int Dim>
Vec3 BasicSystem<Dim>::Impl::Explicit::angular_velocity(std::size_t body) const {
  if constexpr (Dim == 3) {
    const Mat<3, 3> r = now.rigid[body].orientation();
    const Vec3 in_body = r.transpose() * turning[body].momentum;
    return r * system.model.rigid[body].inertia.inverse() * in_body;
  } else {
    (void)body;
    return Vec3::Zero();
  }
}

/// Of the motion at the end of a time step. What follows has its mass where it follows from.
template <int Dim>
double BasicSystem<Dim>::Impl::Explicit::kinetic(const Vector& velocity) const {
  double sum = 0.5 * (mass.array() * velocity.array().square()).sum();
  for (std::size_t b = 0; b < turns.size(); ++b)
    if (turns[b]) sum += 0.5 * angular_velocity(b).dot(turning[b].momentum);
  return sum;
}

/// The share of what is prescribed.
template <int Dim>
double BasicSystem<Dim>::Impl::Explicit::kinetic_of_held(const Vector& velocity) const {
  double sum = 0;
  for (const Dof d : held) sum += 0.5 * mass[d] * velocity[d] * velocity[d];
  return sum;
}

/// Energy that the loads give within half a time step, before they have worked along any way: the
/// velocity at the end of a step is that of its middle and what half a step adds.
///
/// Formula    h^2/8 f . M^-1 f , f the external forces
template <int Dim>
double BasicSystem<Dim>::Impl::Explicit::kick() {
  if (!loaded) return 0;
  of_loads = system.last.forces.external;
  gather(of_loads);
  double sum = (inverse.array() * of_loads.array().square()).sum();
  if constexpr (Dim == 3)
    for (std::size_t b = 0; b < turns.size(); ++b) {
      if (!turns[b]) continue;
      const Vec3 moment = now.rigid[b].orientation().transpose() *
                          of_loads.segment<3>(system.dofs.body_dof(static_cast<Index>(b), 3));
      sum += moment.dot(system.model.rigid[b].inertia.inverse() * moment);
    }
  return last_step * last_step / 8 * sum;
}

/// Energy that the temperatures of now store where nothing has moved since the increment began.
template <int Dim>
double BasicSystem<Dim>::Impl::Explicit::heat() const {
  if (system.step.temperature.changes.empty()) return 0;
  return cells_energy(u_before, now.memory).stored;
}

template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::load(const State& committed) {
  const Rates& r = committed.rates;
  now = committed;
  motion = {system.dof_values(committed), r.velocity, r.acceleration};
  system.last.forces.internal = r.internal;
  system.last.forces.contact = r.contact;
  system.last.forces.external = r.external;
  damping_force = r.damping;
  for (pairing::FarPoints<Dim>& of_pair : far) of_pair.forget();
  stable = r.stable;
  works = {};
  without_way = 0;
  if (!system.step.temperature.changes.empty()) u_before = committed.u;
  place(motion.position);
  sum_forces();
  for (std::size_t i = 0; i < held.size(); ++i)
    past_held[static_cast<Eigen::Index>(i)] = total[held[i]];
  if constexpr (Dim == 3)
    for (std::size_t b = 0; b < turning.size(); ++b) {
      if (!turns[b]) continue;
      const Vec3 in_body = system.model.rigid[b].inertia * r.spins[b].velocity;
      turning[b] = {now.rigid[b].orientation() * in_body, r.spins[b].moment};
    }
  energy_before = kinetic(motion.velocity);
  held_before = kinetic_of_held(motion.velocity);
  energy_available = std::max(0.0, r.energies.start + r.energies.external);
}

template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::set_rates(double fraction, Rates& rates) const {
  rates.velocity = motion.velocity;
  rates.acceleration = motion.acceleration;
  const typename Motion::Driven told =
      system.motion->driven(fraction, 1.0 / system.step.increments);
  for (const Dof d : held) {
    const Dof of_body = d - Dim * system.dofs.nodes();
    if (Dim == 3 && of_body >= 0 && of_body % body::motions<Dim> >= Dim) continue;
    rates.velocity[d] = told.velocity[d];
    rates.acceleration[d] = told.acceleration[d];
  }
}

/// Damping and mass times acceleration, as forces on the dofs (of rotations in space: on the
/// rotation vectors).
template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::Explicit::inertia_forces(const Vector& acceleration) const {
  Vector out = damping_force + mass.cwiseProduct(acceleration);
  if constexpr (Dim == 3)
    for (std::size_t b = 0; b < turning.size(); ++b) {
      if (!turns[b]) continue;
      const Dof first = system.dofs.body_dof(static_cast<Index>(b), 3);
      const Vec3 moment = damping_force.segment<3>(first) + turning[b].moment;
      out.segment<3>(first) = body::spin_tangent(now.rigid[b]).transpose() * moment;
    }
  return out;
}

/// Forces and accelerations of the configuration in which the step begins, with `rates` that have
/// its velocities.
template <int Dim>
Rates BasicSystem<Dim>::Impl::Explicit::begin(const State& committed, Rates rates) {
  const Eigen::Index n = system.dofs.dofs();
  for (Vector* const v :
       {&rates.acceleration, &rates.internal, &rates.external, &rates.contact, &rates.damping})
    v->setZero(n);
  rates.spins.assign(Dim == 3 ? system.model.rigid.size() : 0, {});
  rates.stable = {};
  State start = committed;
  start.rates = rates;
  load(start);
  warm(system.model, system.step.temperature, 0, system.last.memory);
  if (!add_cells(motion.position, 0)) return rates;  // the first time step says why
  add_contact(0, 0, true);
  add_loads(0);
  sum_forces();
  (void)set_accelerations(0, motion);  // likewise
  rates.internal = system.last.forces.internal;
  rates.contact = system.last.forces.contact;
  rates.external = system.last.forces.external;
  if constexpr (Dim == 3)
    for (std::size_t b = 0; b < turning.size(); ++b) {
      if (!turns[b]) continue;
      const Dof first = system.dofs.body_dof(static_cast<Index>(b), 3);
      const Mat<3, 3> r = now.rigid[b].orientation();
      rates.spins[b].velocity = r.transpose() * rates.velocity.template segment<3>(first);
      const Vec3 in_body = system.model.rigid[b].inertia * rates.spins[b].velocity;
      turning[b].momentum = r * in_body;
    }
  end_turns(0);
  for (std::size_t b = 0; b < rates.spins.size(); ++b)
    if (turns[b]) rates.spins[b].moment = turning[b].moment;
  rates.damping = damping_force;
  set_rates(0, rates);
  Assembly<Dim> to = system.assembly();
  turn_moments(system.model, now, false, to);
  system.last.forces.inertia = inertia_forces(rates.acceleration);
  Energies& e = rates.energies;
  e.kinetic = kinetic(rates.velocity);
  const solid::CellEnergy bulk = cells_energy(committed.u, committed.memory);
  e.strain = bulk.stored;
  if (committed.rates.empty()) e.plastic_before = bulk.dissipated;
  e.contact = system.motion->contact_energy();
  e.damped = system.motion->damping_work();
  return rates;
}

/// Part by part, in order.
template <int Dim>
solid::CellEnergy BasicSystem<Dim>::Impl::Explicit::cells_energy(
    const Eigen::VectorXd& u, const std::vector<double>& memory) const {
  constexpr double nothing = core::Ranks::nothing;
  std::vector<std::array<double, 2>> of_part(batches.parts(), {nothing, nothing});
  system.bulk.crew.share(parts.to - parts.from, [&](std::size_t number) {
    const std::size_t part = parts.from + number;
    solid::CellEnergy sum;
    const auto alone = [&](std::size_t cell) {
      const typename BulkTerm<Dim>::Job& job = system.bulk.jobs[cell];
      const solid::CellEnergy e =
          energy_of_cell(system.model, *job.section, job.cell, job.memory, u, memory);
      sum.stored += e.stored;
      sum.dissipated += e.dissipated;
    };
    typename ForceBatches<Dim>::Nodal along;
    batches.gather(part, u, along);
    const auto fours = batches.fours(part), others = batches.alone(part);
    for (std::size_t f = fours.begin; f < fours.end; ++f) {
      double stored = 0;
      if (batches.energy(f, along, stored)) {
        sum.stored += stored;
      } else {
        for (const std::size_t cell : batches.jobs(f)) alone(cell);
      }
    }
    for (std::size_t i = others.begin; i < others.end; ++i) alone(batches.others()[i]);
    of_part[part] = {sum.stored, sum.dissipated};
  });
  if (system.ranks && !of_part.empty())
    system.ranks->sum({of_part.front().data(), 2 * of_part.size()});
  solid::CellEnergy sum;
  for (const auto& [stored, dissipated] : of_part) {
    sum.stored += stored;
    sum.dissipated += dissipated;
  }
  return sum;
}

/// Energy that nothing has put in: the time step is not stable, whatever the estimate says.
///
/// Formula    T + work of all forces against the motion = T_0 + sum h^2/8 d(a . M a), which a
///            stable step keeps below the energy there is and what loads and heat
///            give before anything moves
template <int Dim>
bool BasicSystem<Dim>::Impl::Explicit::grows(const solve::ExplicitMotion& m) {
  if (system.ranks &&
      !system.ranks->agree_on({m.position.data(), static_cast<std::size_t>(m.position.size())}))
    throw std::runtime_error("the processes have come to different states");
  const double moving = kinetic(m.velocity);
  const double put_in = works.external + works.supports + kinetic_of_held(m.velocity) - held_before;
  const double gain = moving - energy_before + works.internal + works.contact + works.damping -
                      put_in - now.rates.energies.numerical;
  // At the share s of the critical step the energy of the fastest mode goes up to 1/(1 - s^2) times
  // that of its velocity and back: 50 times for s = 0.99.
  constexpr double more_than_exchange = 100;
  without_way = std::max(without_way, kick() + heat());
  const double available = energy_available + std::max(0.0, put_in) + without_way;
  if (std::isfinite(moving) && std::isfinite(gain) && !(gain > more_than_exchange * available))
    return false;
  trouble = fmt::format(
      "the time integration is unstable: {} (the longest stable time step was estimated as {:.4g} "
      "from {})",
      std::isfinite(moving)
          ? fmt::format("the energy has grown by {:.3g}, where {:.3g} was there", gain, available)
          : std::string("the velocities are no numbers any more"),
      stable.step, governed());
  return true;
}

template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::add_energies(Rates& rates) {
  Energies& e = rates.energies;
  const Energies before = e;
  works.supports += kinetic_of_held(rates.velocity) - held_before;
  e.kinetic = kinetic(rates.velocity);
  const solid::CellEnergy bulk = cells_energy(now.u, now.memory);
  e.strain = bulk.stored;
  e.plastic = bulk.dissipated - e.plastic_before;
  e.contact = system.motion->contact_energy();
  e.friction = system.motion->friction_work() - e.friction_before;
  e.external += works.external + works.supports;
  e.damped = system.motion->damping_work();
  e.damping += works.damping + (e.damped - before.damped);
  const double of_contact = works.contact - (e.contact - before.contact) -
                            (e.friction - before.friction) - (e.damped - before.damped);
  const double of_time = works.external + works.supports - works.internal - works.contact -
                         works.damping - (e.kinetic - energy_before);
  e.numerical += of_contact + of_time;
  e.residual = e.start + e.external - e.friction - e.damping - e.plastic - e.numerical -
               (e.kinetic + e.strain + e.contact);
}

template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::finish(double fraction, double duration,
                                              ExplicitIncrement<State>& out) {
  Rates& rates = now.rates;
  exchange_memory(now.memory);
  now.fraction = fraction;
  now.u = motion.position.head(now.u.size());
  for (const PrescribedDof* const p : prescribed)
    if (p->dof < now.u.size()) now.u[p->dof] = p->ramp.value(fraction);
  set_rates(fraction, rates);
  if constexpr (Dim == 3)
    for (std::size_t b = 0; b < turning.size(); ++b) {
      if (!turns[b]) continue;
      const Vec3 spin = angular_velocity(b);
      rates.spins[b].velocity = now.rigid[b].orientation().transpose() * spin;
      rates.spins[b].moment = turning[b].moment;
      rates.velocity.template segment<3>(system.dofs.body_dof(static_cast<Index>(b), 3)) = spin;
    }
  for (const Follower& f : followers)
    rates.velocity[f.dof] = f.lead < 0 ? 0.0 : f.factor * rates.velocity[f.lead];
  system.move_with_bodies(now, rates);
  rates.internal = system.last.forces.internal;
  rates.contact = system.last.forces.contact;
  rates.external = system.last.forces.external;
  rates.damping = damping_force;
  rates.stable = stable;
  rates.energies.elapsed += duration;
  add_energies(rates);
  Assembly<Dim> to = system.assembly();
  turn_moments(system.model, now, false, to);
  system.last.forces.inertia = inertia_forces(rates.acceleration);
  out.counts = counts_of(system.model, system.last.contact);
}

template <int Dim>
ExplicitIncrement<BasicState<Dim>> BasicSystem<Dim>::Impl::Explicit::increment(
    const State& committed, double fraction) {
  ExplicitIncrement<State> out;
  load(committed);
  trouble.clear();
  lost = false;
  const double whole = system.step.duration;
  const double from = committed.fraction < fraction ? committed.fraction : 0.0;
  until = fraction * whole;
  out.outcome =
      solve::advance(*this, motion, from * whole, until, options, out.time_steps, inspect_after);
  out.time_steps.governed = governed();
  if (lost) {
    out.outcome = solve::TimeStepping::unstable;
    trouble = "the time integration is unstable: the forces are no numbers any more";
  }
  out.reason = trouble;
  if (out.outcome == solve::TimeStepping::too_many)
    out.reason = fmt::format(
        "the stable time step of {:.3g} is too short for an increment of {:.3g}"
        " (estimated from {})",
        stable.step, (fraction - from) * whole, governed());
  if (out.outcome == solve::TimeStepping::done) {
    finish(fraction, (fraction - from) * whole, out);
    if (!std::isfinite(now.rates.energies.kinetic + now.rates.energies.strain)) {
      out.outcome = solve::TimeStepping::unstable;
      out.reason = "the time integration is unstable: there are no numbers any more";
    }
  } else {
    now.u = motion.position.head(now.u.size());
    exchange_memory(now.memory);
  }
  out.state = now;
  return out;
}

template <int Dim>
void BasicSystem<Dim>::Impl::move_with_bodies(const State& s, Rates& rates) const {
  const std::vector<Vec<Dim>> x = positions(s.u);
  for (Index node = 0; node < dofs.nodes(); ++node) {
    const Index b = dofs.body_of(node);
    if (b < 0) continue;
    const Vec<Dim> arm =
        body::arm_of(s.rigid[static_cast<std::size_t>(b)], x[static_cast<std::size_t>(node)]);
    const Dof first = dofs.body_dof(b, 0);
    Vec<Dim> v = rates.velocity.template segment<Dim>(first);
    if constexpr (Dim == 2)
      v += rates.velocity[first + 2] * turn(arm);
    else
      v += Vec3(rates.velocity.template segment<3>(first + 3)).cross(arm);
    rates.velocity.template segment<Dim>(Dim * node) = v;
  }
}

template <int Dim>
Rates BasicSystem<Dim>::Impl::begin_explicit_rates(const State& committed) {
  Rates rates = committed.rates;
  rates.length = 0;
  const bool first = rates.empty();
  if (first) {
    motion->mass_x = positions(committed.u);
    motion->mass_rigid = committed.rigid;
    rates.velocity = motion->start_velocity(motion->driven(0, 1.0 / step.increments));
    move_with_bodies(committed, rates);
  }
  rates = explicit_motion->begin(committed, std::move(rates));
  Energies& e = rates.energies;
  if (first) {
    e.start = e.kinetic + e.strain + e.contact;
    e.friction_before = motion->friction_work();
  } else {
    e.numerical += committed.rates.energies.kinetic - e.kinetic;  // of other masses, before
  }
  return rates;
}

template <int Dim>
ExplicitIncrement<BasicState<Dim>> BasicSystem<Dim>::advance(const State& committed,
                                                             double fraction) {
  return impl_->explicit_motion->increment(committed, fraction);
}

template <int Dim>
const ScaledMasses& BasicSystem<Dim>::scaled_masses() const {
  return impl_->explicit_motion->scaled;
}

template <int Dim>
typename BasicSystem<Dim>::FirstTimeStep BasicSystem<Dim>::first_time_step(const State& begun) {
  typename Impl::Explicit& motion = *impl_->explicit_motion;
  motion.load(begun);
  const double stable = motion.options.safety * motion.stable_step(motion.motion);
  double length = std::min(stable, motion.faithful_step());
  std::string governed = length < stable ? motion.faithful_by() : motion.governed();
  if (motion.options.step > 0 && motion.options.step < length) {
    length = motion.options.step;
    governed = "the longest one that is asked for";
  }
  return {length, governed};
}

template struct BasicSystem<2>::Impl;
template struct BasicSystem<3>::Impl;
template const ScaledMasses& BasicSystem<2>::scaled_masses() const;
template const ScaledMasses& BasicSystem<3>::scaled_masses() const;
template BasicSystem<2>::FirstTimeStep BasicSystem<2>::first_time_step(const State&);
template BasicSystem<3>::FirstTimeStep BasicSystem<3>::first_time_step(const State3&);
template ExplicitIncrement<State> BasicSystem<2>::advance(const State&, double);
template ExplicitIncrement<State3> BasicSystem<3>::advance(const State3&, double);

}  // namespace osculate::model
