// Steps with inertia: the residual and tangent of one step in time, velocities, energies.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "osculate/la/by_itself.hpp"
#include "osculate/model/system_motion.hpp"
#include "osculate/pairing/point_penalty.hpp"

namespace osculate::model {
namespace {

template <int Dim, class Value>
double sum_of_points(const std::vector<pairing::PairEvaluation<Dim>>& contact, const Value& value) {
  double sum = 0;
  for (const pairing::PairEvaluation<Dim>& pair : contact)
    for (const pairing::PointResult<Dim>& point : pair.points) sum += value(point);
  return sum;
}

}  // namespace

template <int Dim>
BasicSystem<Dim>::Impl::Motion::Motion(Impl& whole)
    : system(whole),
      model(whole.model),
      dofs(whole.dofs),
      step(whole.step),
      assembler(whole.assembler),
      last(whole.last),
      settings(*whole.step.dynamics),
      inertia(whole.model, whole.step.dynamics->lumped),
      coupled(whole.model.rigid.size(), false),
      builder(whole.dofs.unknowns()) {
  std::vector<bool> carries(model.rigid.size(), false);
  for (const typename BasicInertia<Dim>::CellMass& cell : inertia.cells())
    for (const Index node : cell.nodes)
      if (const Index b = dofs.body_of(node); b >= 0) carries[static_cast<std::size_t>(b)] = true;
  for (std::size_t b = 0; b < model.rigid.size(); ++b) {
    const bool alone = inertia.body_has_mass(b) && !carries[b] && !turns_by_rule(b);
    coupled[b] = Dim == 3 && !alone;
    if (free_rotations(b) > 0 && (carries[b] || coupled[b])) turns = true;
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::Motion::measure_damping(const State& committed) {
  const double factor = settings.damping_stiffness;
  if (!(factor > 0)) return;
  const bool first = damping.empty();
  damping.resize(system.bulk.jobs.size());
  BulkBlock block;
  for (std::size_t c = 0; c < system.bulk.jobs.size(); ++c) {
    const bool finite =
        system.bulk.jobs[c].section->section.kinematics == solid::Kinematics::finite;
    if (!first && !finite) continue;
    system.bulk.evaluate(c, committed.u, committed.memory, {}, 0, true, block);
    if (block.dof_count == 0)
      damping[c].resize(0, 0);
    else
      damping[c] = factor * block.result.tangent;
  }
}

/// Dampers that turn act along the lines that they will have at the end of the increment, as far as
/// rates tell: to h^3, so that their forces are of the scheme's order in time, and need no tangent.
template <int Dim>
void BasicSystem<Dim>::Impl::Motion::place_dampers(const State& committed) {
  const Eigen::Index n = committed.u.size();
  const Eigen::VectorXd u =
      committed.u + h * past.velocity.head(n) + 0.5 * h * h * past.acceleration.head(n);
  dampers = system.springs.dampers(committed, system.positions(u));
}

template <int Dim>
void BasicSystem<Dim>::Impl::Motion::begin_increment(const State& committed, double fraction,
                                                     double duration) {
  Motion& m = *this;
  const bool same_length = m.h == duration && m.target == fraction;
  m.h = duration;
  m.target = fraction;
  if (!(duration > 0)) return;
  if (!(m.size_of_mass > 0)) m.size_of_mass = m.inertia.size();
  m.factors = solve::step_factors(m.settings.scheme, duration);
  Eigen::VectorXd values = system.dof_values(committed);
  const bool same_start = values.size() == m.start.size() && values == m.start &&
                          m.past.velocity.size() == committed.rates.velocity.size() &&
                          m.past.velocity == committed.rates.velocity &&
                          m.past.acceleration == committed.rates.acceleration &&
                          m.past.energies.elapsed == committed.rates.energies.elapsed;
  if (same_start && same_length) return;
  if (!same_start) {
    m.start = std::move(values);
    measure_damping(committed);
    m.from = committed.rigid;
    m.past = committed.rates;
  }
  mass_x = system.positions(
      committed.u);  // a step of another length may have been committed and dropped
  mass_rigid = committed.rigid;
  place_dampers(committed);
  move_past_to_bodies();
  correct_damping();
  if (m.settings.scheme.impact != solve::Impact::average && !m.mass_known) factor_mass();
}

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::Motion::damping_of(const Eigen::VectorXd& velocity) const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(velocity.size());
  if (settings.damping_mass > 0) force = settings.damping_mass * inertia.multiply(velocity);
  for (std::size_t c = 0; c < damping.size(); ++c) {
    if (damping[c].size() == 0) continue;
    const std::vector<Index>& nodes = inertia.cells()[c].nodes;
    Eigen::VectorXd v(Dim * static_cast<Eigen::Index>(nodes.size()));
    for (std::size_t k = 0; k < nodes.size(); ++k)
      v.segment<Dim>(Dim * static_cast<Eigen::Index>(k)) = velocity.segment<Dim>(Dim * nodes[k]);
    const Eigen::VectorXd f = damping[c] * v;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      force.segment<Dim>(Dim * nodes[k]) += f.segment<Dim>(Dim * static_cast<Eigen::Index>(k));
  }
  for (const auto& [coefficient, motion] : dampers) {
    double rate = 0;
    for (std::size_t i = 0; i < motion.dofs.size(); ++i)
      rate += motion.gradient[static_cast<Eigen::Index>(i)] * velocity[motion.dofs[i]];
    for (std::size_t i = 0; i < motion.dofs.size(); ++i)
      force[motion.dofs[i]] += coefficient * rate * motion.gradient[static_cast<Eigen::Index>(i)];
  }
  return force;
}

template <int Dim>
void BasicSystem<Dim>::Impl::Motion::add_inertia(const State& trial, Assembly<Dim>& to) {
  const solve::TimeScheme& s = settings.scheme;
  const Eigen::VectorXd ahead =
      system.dof_values(trial) -
      (start + h * past.velocity + h * h * (0.5 - s.beta) * past.acceleration);
  effective = inertia.multiply(factors.mass * ahead) + past_force;
  const bool damped = settings.damping_mass > 0 || !damping.empty() || !dampers.empty();
  damping_force.setZero(ahead.size());
  if (damped)
    damping_force = damping_of(past.velocity + h * (1 - s.gamma) * past.acceleration +
                               factors.rate * ahead + correction);
  if constexpr (Dim == 3) add_spins(trial, to);
  if (!to.with_tangent) return;
  for (const auto& [coefficient, motion] : dampers)
    to.add_stiffness(motion.dofs, Eigen::MatrixXd(factors.force * factors.rate * coefficient *
                                                  motion.gradient * motion.gradient.transpose()));
  const CellInertia<Dim> factors_of = cell_inertia();
  for (const PointMass& point : model.masses)
    for (int i = 0; i < Dim; ++i)
      to.add_stiffness(std::array{dofs.node_dof(point.node, i)},
                       Mat<1, 1>(factors_of.mass * point.mass));
  const double of_mass = factors_of.mass;
  for (std::size_t b = 0; b < model.rigid.size(); ++b) {
    if (!inertia.body_has_mass(b)) continue;
    std::array<Dof, body::motions<Dim>> d{};
    for (int i = 0; i < body::motions<Dim>; ++i)
      d[static_cast<std::size_t>(i)] = dofs.body_dof(static_cast<Index>(b), i);
    to.add_stiffness(d,
                     Mat<body::motions<Dim>, body::motions<Dim>>(of_mass * inertia.body_mass(b)));
  }
}

template <int Dim>
CellInertia<Dim> BasicSystem<Dim>::Impl::Motion::cell_inertia() const {
  const solve::StepFactors& f = factors;
  return {inertia, damping, f.force, f.force * f.rate,
          f.mass + f.force * f.rate * settings.damping_mass};
}

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::Motion::balance() const {
  const Forces& forces = last.forces;
  return effective + forces.contact +
         factors.force * (forces.internal - forces.external + damping_force);
}

template <int Dim>
void BasicSystem<Dim>::Impl::Motion::factor_mass() {
  if (mass_known && !turns) return;
  mass_known = false;
  builder.clear();
  BasicAssembler<Dim> into(dofs, builder);
  std::vector<bool> prescribed(static_cast<std::size_t>(dofs.unknowns()));
  for (Index u = 0; u < dofs.unknowns(); ++u)
    prescribed[static_cast<std::size_t>(u)] = assembler.prescribed(u);
  into.set_prescribed(prescribed);
  into.set_configuration(mass_x, mass_rigid);
  for (const typename BasicInertia<Dim>::CellMass& cell : inertia.cells())
    for (int d = 0; d < Dim; ++d) {
      std::vector<Dof> of;
      for (const Index node : cell.nodes) of.push_back(dofs.node_dof(node, d));
      into.add_block(of, cell.mass);
    }
  for (std::size_t b = 0; b < model.rigid.size(); ++b) {
    std::vector<Dof> of;
    for (int i = 0; i < body::motions<Dim>; ++i)
      of.push_back(dofs.body_dof(static_cast<Index>(b), i));
    Mat<body::motions<Dim>, body::motions<Dim>> mass = inertia.body_mass(b);
    if constexpr (Dim == 3)
      if (coupled[b]) {
        const Mat<3, 3> t =
            mass_rigid[b].orientation().transpose() * body::spin_tangent(mass_rigid[b]);
        mass.template bottomRightCorner<3, 3>() = t.transpose() * model.rigid[b].inertia * t;
      }
    into.add_block(of, mass);
  }
  const la::SparseMatrix& k = builder.finish();
  massless.assign(static_cast<std::size_t>(dofs.unknowns()), false);
  for (Index u = 0; u < dofs.unknowns(); ++u) {
    double diagonal = 0;
    for (Index at = k.row_start[static_cast<std::size_t>(u)];
         at < k.row_start[static_cast<std::size_t>(u) + 1]; ++at)
      if (k.column[static_cast<std::size_t>(at)] == u)
        diagonal = k.value[static_cast<std::size_t>(at)];
    massless[static_cast<std::size_t>(u)] = !(diagonal > 0);
  }
  for (Index u = 0; u < dofs.unknowns(); ++u)
    if (massless[static_cast<std::size_t>(u)]) builder.add(u, u, 1.0);
  const la::FactorReport report = la::by_itself(system.ranks, [&] {
    return solver->factor(builder.finish(), builder.pattern_version(), la::Symmetry::indefinite);
  });
  mass_known = report.status == la::SolveStatus::ok;
  if (mass_known) return;
  failure = "the mass matrix cannot be factored: ";
  failure += report.status == la::SolveStatus::singular ? "it is singular" : report.message;
}

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::Motion::spread(const Eigen::VectorXd& of_unknowns) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(dofs.dofs());
  std::vector<Expansion> terms;
  for (Dof d = 0; d < dofs.dofs(); ++d) {
    terms.clear();
    dofs.expand(d, 1.0, mass_x, mass_rigid, terms);
    for (const Expansion& e : terms) out[d] += e.factor * of_unknowns[e.unknown];
  }
  return out;
}

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::Motion::accelerations_by(const Eigen::VectorXd& force) {
  assembler.set_configuration(mass_x, mass_rigid);
  Eigen::VectorXd a = assembler.gather(force);
  if (a.isZero(0)) return Eigen::VectorXd::Zero(dofs.dofs());
  factor_mass();
  for (Index u = 0; u < dofs.unknowns(); ++u)
    if (massless[static_cast<std::size_t>(u)]) a[u] = 0;
  if (!failure.empty()) return Eigen::VectorXd::Zero(dofs.dofs());
  const la::SolveStatus solved = la::by_itself(system.ranks, [&] { return solver->solve(a); });
  if (solved != la::SolveStatus::ok || !a.allFinite()) {
    failure = "the mass matrix cannot be solved with";
    a.setZero();
  }
  return spread(a);
}

template <int Dim>
double BasicSystem<Dim>::Impl::Motion::contact_energy() const {
  return sum_of_points<Dim>(last.contact, [](const auto& p) { return p.weight * p.stored; });
}

template <int Dim>
double BasicSystem<Dim>::Impl::Motion::damping_work() const {
  return sum_of_points<Dim>(last.contact, [](const auto& p) { return p.history.damping_work; });
}

template <int Dim>
double BasicSystem<Dim>::Impl::Motion::friction_work() const {
  return sum_of_points<Dim>(last.contact, [](const auto& p) { return p.history.friction_work; });
}

/// Forces of the free unknowns that the last evaluation leaves, as mass times acceleration at the
/// end of the increment holds them; over the primary dofs.
template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::Motion::unbalanced() const {
  const double factor = 1 / (factors.balance * (1 - settings.scheme.alpha_m));
  const Eigen::VectorXd rest = assembler.gather(balance());
  Eigen::VectorXd out = Eigen::VectorXd::Zero(dofs.dofs());
  for (Index u = 0; u < dofs.unknowns(); ++u) out[dofs.dof_of_unknown(u)] = factor * rest[u];
  return out;
}

template <int Dim>
double BasicSystem<Dim>::Impl::Motion::kinetic_energy(const Rates& rates) const {
  return 0.5 * rates.velocity.dot(inertia.multiply(rates.velocity)) + spin_energy(rates);
}

template <int Dim>
Rates BasicSystem<Dim>::Impl::Motion::begin_rates(const State& committed) {
  Rates rates = committed.rates;
  rates.length = 0;
  const bool first = rates.empty();
  mass_x = system.positions(committed.u);
  mass_rigid = committed.rigid;
  const Driven prescribed = driven(0, 1.0 / step.increments);
  // With the masses of this step: they may be others than those of the one before.
  const double brought = first ? 0 : kinetic_energy(rates);
  if (first)
    rates.velocity = start_velocity(prescribed);
  else
    settle_velocities(rates, prescribed);
  solve::Evaluation out;
  system.assemble(committed, {committed}, 0.0, false, Impl::Pass::whole, out);
  rates.internal = last.forces.internal;
  rates.external = last.forces.external;
  rates.contact = last.forces.contact;
  measure_damping(committed);
  dampers = system.springs.dampers(committed, system.positions(committed.u));
  rates.damping = damping_of(rates.velocity);
  if constexpr (Dim == 3) damp_spins(rates.velocity, rates.damping);
  Eigen::VectorXd force = rates.external - rates.internal - rates.damping;
  if (settings.scheme.impact == solve::Impact::average) force -= rates.contact;
  rates.acceleration.setZero(dofs.dofs());
  if constexpr (Dim == 3) begin_spins(committed, force, rates);
  if constexpr (Dim == 3) begin_coupled_spins(rates, force);
  settle_accelerations(rates, prescribed, force);
  last.forces.inertia = rates.damping + inertia_of(rates);
  Energies& e = rates.energies;
  const double kinetic = kinetic_energy(rates);
  const solid::CellEnergy bulk = bulk_energy(model, committed.u, committed.memory);
  const double strain = bulk.stored + system.springs.stored(committed, mass_x);
  e.contact = contact_energy();
  e.damped = damping_work();
  if (first) {
    e.strain = strain;
    e.start = kinetic + e.strain + e.contact;
    e.friction_before = friction_work();
    e.plastic_before = bulk.dissipated;
  } else {
    e.external += kinetic - brought;  // of what is prescribed from now on
    // What cells had that are gone, and what changes with a material, leaves the balance.
    e.numerical += e.kinetic - brought + e.strain - strain;
    e.plastic_before = bulk.dissipated - e.plastic;
    e.strain = strain;
  }
  e.kinetic = kinetic;
  return rates;
}

template <int Dim>
Rates BasicSystem<Dim>::Impl::Motion::new_rates(const State& trial) {
  const solve::TimeScheme& s = settings.scheme;
  Rates now;
  mass_x = system.positions(trial.u);
  mass_rigid = trial.rigid;
  assembler.set_configuration(mass_x, mass_rigid);
  // What the iterations have left out of balance is no mass times acceleration.
  const Eigen::VectorXd left_over = unbalanced();
  const Eigen::VectorXd step_of = system.dof_values(trial) - start;
  Eigen::VectorXd ahead = step_of - h * past.velocity - h * h * (0.5 - s.beta) * past.acceleration;
  Eigen::VectorXd impulse = Eigen::VectorXd::Zero(ahead.size());  // acceleration by contact
  if (s.impact != solve::Impact::average) impulse = accelerations_by(-last.forces.contact);
  now.acceleration = (ahead - solve::impulse_way(s.impact) * h * h * impulse) / (s.beta * h * h);
  now.velocity = past.velocity +
                 h * ((1 - s.gamma) * past.acceleration + s.gamma * now.acceleration + impulse);
  Eigen::VectorXd of_impulse = inertia.multiply(impulse);
  if constexpr (Dim == 3) new_spins(trial, impulse, left_over, now, of_impulse);
  const Driven prescribed = driven(target, h / step.duration);
  settle_velocities(now, prescribed);
  settle_accelerations(now, prescribed, -left_over);
  now.internal = last.forces.internal;
  now.external = last.forces.external;
  now.contact = last.forces.contact;
  now.damping = damping_force;
  now.energies = past.energies;
  now.energies.elapsed += h;
  now.length = h;
  add_energies(trial, now, step_of, s.gamma * left_over.dot(step_of), now.energies);
  last.forces.inertia = now.damping + of_impulse + inertia_of(now);
  return now;
}

template <int Dim>
void BasicSystem<Dim>::Impl::Motion::add_energies(const State& trial, const Rates& now,
                                                  const Eigen::VectorXd& step_of, double left_over,
                                                  Energies& e) const {
  const Energies before = e;
  const bool average = settings.scheme.impact == solve::Impact::average;
  const auto mean = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return Eigen::VectorXd(0.5 * (a + b));
  };
  const Eigen::VectorXd internal = mean(past.internal, now.internal);
  const Eigen::VectorXd external = mean(past.external, now.external);
  const Eigen::VectorXd damped = mean(past.damping, now.damping);
  const Eigen::VectorXd by_contact = average ? mean(past.contact, now.contact) : now.contact;
  const Eigen::VectorXd inertial =
      inertia.multiply(now.velocity - past.velocity) / h + spin_force(past, now);
  const Eigen::VectorXd rest = inertial + internal - external + damped + by_contact;
  // What is left at prescribed unknowns is the force of the supports.
  double supports = 0;
  std::vector<Expansion> terms;
  for (Dof d = 0; d < dofs.dofs(); ++d) {
    if (rest[d] == 0.0) continue;
    terms.clear();
    dofs.expand(d, 1.0, mass_x, mass_rigid, terms);
    for (const Expansion& t : terms)
      if (assembler.prescribed(t.unknown))
        supports += rest[d] * t.factor * step_of[dofs.dof_of_unknown(t.unknown)];
  }
  e.kinetic = kinetic_energy(now);
  const solid::CellEnergy bulk = bulk_energy(model, trial.u, last.memory);
  e.strain = bulk.stored + system.springs.stored(trial, system.positions(trial.u));
  e.plastic = bulk.dissipated - e.plastic_before;
  e.contact = contact_energy();
  e.external += external.dot(step_of) + supports;
  e.damped = damping_work();
  e.damping += damped.dot(step_of) + (e.damped - before.damped);
  e.friction = friction_work() - e.friction_before;
  const double of_contact = by_contact.dot(step_of) - (e.contact - before.contact) -
                            (e.friction - before.friction) - (e.damped - before.damped);
  const double of_time = inertial.dot(step_of) - (e.kinetic - before.kinetic) -
                         (rest.dot(step_of) - supports - left_over);
  e.numerical += of_contact + of_time;
  e.residual = e.start + e.external - e.friction - e.damping - e.plastic - e.numerical -
               (e.kinetic + e.strain + e.contact);
}

template struct BasicSystem<2>::Impl::Motion;
template struct BasicSystem<3>::Impl::Motion;

}  // namespace osculate::model
