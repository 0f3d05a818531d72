// Steps with inertia: the residual and tangent of one step in time, velocities, energies.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "osculate/model/system_impl.hpp"

namespace osculate::model {

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::dof_values(const State& s) const {
  Eigen::VectorXd q(dofs.dofs());
  q.head(s.u.size()) = s.u;
  for (std::size_t b = 0; b < s.rigid.size(); ++b)
    for (int i = 0; i < body::motions<Dim>; ++i)
      q[dofs.body_dof(static_cast<Index>(b), i)] = s.rigid[b].component(i);
  return q;
}

template <int Dim>
void BasicSystem<Dim>::Impl::begin_dynamics() {
  motion.reset();
  if (!step.dynamics) return;
  motion.emplace(dofs.unknowns());
  motion->settings = *step.dynamics;
  motion->inertia.emplace(model, step.dynamics->lumped);
  for (const typename BasicInertia<Dim>::CellMass& cell : motion->inertia->cells())
    for (const Index node : cell.nodes)
      if (dofs.body_of(node) >= 0) motion->turns = true;
}

template <int Dim>
void BasicSystem<Dim>::Impl::measure_damping(const Eigen::VectorXd& u) {
  const double factor = motion->settings.damping_stiffness;
  if (!(factor > 0)) return;
  const bool first = motion->damping.empty();
  motion->damping.resize(jobs.size());
  BulkBlock block;
  for (std::size_t c = 0; c < jobs.size(); ++c) {
    const bool finite = jobs[c].section->section.kinematics == solid::Kinematics::finite;
    if (!first && !finite) continue;
    evaluate_cell(model, *jobs[c].section, jobs[c].cell, u, true, block);
    motion->damping[c] = factor * block.result.tangent;
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::begin_increment(const State& committed, double /*fraction*/,
                                             double duration) {
  motion->h = duration;
  if (!(duration > 0)) return;
  if (!(motion->size_of_mass > 0)) motion->size_of_mass = motion->inertia->size();
  motion->factors = solve::step_factors(motion->settings.scheme, duration);
  Eigen::VectorXd start = dof_values(committed);
  if (start.size() != motion->start.size() || start != motion->start) {
    motion->start = std::move(start);
    measure_damping(committed.u);
  }
  motion->from = committed.rigid;
  motion->past = committed.rates;
}

template <int Dim>
double BasicSystem<Dim>::Impl::round_off_in_time(std::span<const Vec<Dim>> x) const {
  const double h = timed() ? motion->h : 0.0;
  const double of_mass = timed() ? motion->factors.mass * motion->size_of_mass : 0.0;
  double farthest = 0, springs = 0;
  for (const Vec<Dim>& p : x) farthest = std::max(farthest, p.norm());
  for (std::size_t p = 0; p < contact.size(); ++p) {
    const pairing::PairDefinition<Dim>& pair = model.pairs[p].definition;
    if (!timed() && !pair.damping) continue;  // a penalty is not steep enough to show
    double penalty = contact::penalty_of(pair.normal);
    if (pair.damping) penalty = contact::stiffest(*pair.damping, penalty, h);
    for (const pairing::PointResult<Dim>& point : contact[p].points)
      if (point.status != contact::Status::open)
        springs += penalty * penalty * point.weight * point.weight;
  }
  return 2 * std::numeric_limits<double>::epsilon() * farthest * (of_mass + std::sqrt(springs));
}

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::damping_of(const Eigen::VectorXd& velocity) const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(velocity.size());
  if (motion->settings.damping_mass > 0)
    force = motion->settings.damping_mass * motion->inertia->multiply(velocity);
  for (std::size_t c = 0; c < motion->damping.size(); ++c) {
    const std::vector<Index>& nodes = motion->inertia->cells()[c].nodes;
    Eigen::VectorXd v(Dim * static_cast<Eigen::Index>(nodes.size()));
    for (std::size_t k = 0; k < nodes.size(); ++k)
      v.segment<Dim>(Dim * static_cast<Eigen::Index>(k)) = velocity.segment<Dim>(Dim * nodes[k]);
    const Eigen::VectorXd f = motion->damping[c] * v;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      force.segment<Dim>(Dim * nodes[k]) += f.segment<Dim>(Dim * static_cast<Eigen::Index>(k));
  }
  return force;
}

template <int Dim>
void BasicSystem<Dim>::Impl::add_inertia(const State& trial, bool with_tangent,
                                         const Eigen::VectorXd* inc) {
  Motion& m = *motion;
  const solve::TimeScheme& s = m.settings.scheme;
  const double h = m.h;
  const Eigen::VectorXd ahead = dof_values(trial) - (m.start + h * m.past.velocity +
                                                     h * h * (0.5 - s.beta) * m.past.acceleration);
  m.effective =
      m.inertia->multiply(m.factors.mass * ahead + m.factors.past_mass * m.past.acceleration);
  const bool damped = m.settings.damping_mass > 0 || !m.damping.empty();
  m.damping_force.setZero(ahead.size());
  if (damped)
    m.damping_force = damping_of(m.past.velocity + h * (1 - s.gamma) * m.past.acceleration +
                                 m.factors.rate * ahead);
  if (m.factors.past_force != 0.0) {
    m.effective += m.factors.past_force * (m.past.internal - m.past.external + m.past.damping);
    if (s.impact == solve::Impact::average) m.effective += m.factors.past_force * m.past.contact;
  }
  if constexpr (Dim == 3) add_spins(trial, with_tangent, inc);
  if (!with_tangent) return;
  const double of_mass =
      m.factors.mass + m.factors.force * m.factors.rate * m.settings.damping_mass;
  for (std::size_t b = 0; b < model.rigid.size(); ++b) {
    if (!m.inertia->body_has_mass(b)) continue;
    std::array<Dof, body::motions<Dim>> d{};
    for (int i = 0; i < body::motions<Dim>; ++i)
      d[static_cast<std::size_t>(i)] = dofs.body_dof(static_cast<Index>(b), i);
    add_stiffness(d, Mat<body::motions<Dim>, body::motions<Dim>>(of_mass * m.inertia->body_mass(b)),
                  inc);
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::add_cell_inertia(std::size_t cell,
                                              Eigen::Ref<Eigen::MatrixXd> tangent) const {
  const Motion& m = *motion;
  tangent *= m.factors.force;
  if (!m.damping.empty()) tangent += m.factors.force * m.factors.rate * m.damping[cell];
  const double of_mass =
      m.factors.mass + m.factors.force * m.factors.rate * m.settings.damping_mass;
  const Eigen::MatrixXd& mass = m.inertia->cells()[cell].mass;
  for (Eigen::Index i = 0; i < mass.rows(); ++i)
    for (Eigen::Index j = 0; j < mass.cols(); ++j)
      for (int d = 0; d < Dim; ++d) tangent(Dim * i + d, Dim * j + d) += of_mass * mass(i, j);
}

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::total_force() const {
  if (!timed()) return forces.internal + forces.contact - forces.external;
  return motion->effective + forces.contact +
         motion->factors.force * (forces.internal - forces.external + motion->damping_force);
}

template <int Dim>
void BasicSystem<Dim>::Impl::add_gravity(double fraction) {
  if (step.gravity.empty()) return;
  Vec<Dim> g;
  for (int i = 0; i < Dim; ++i) g[i] = step.gravity[static_cast<std::size_t>(i)].value(fraction);
  if (g.isZero(0)) return;
  if (motion) {
    forces.external += motion->inertia->times(g);
    return;
  }
  if (!resting) resting.emplace(model, false);
  forces.external += resting->times(g);
}

template <int Dim>
void BasicSystem<Dim>::Impl::factor_mass() {
  Motion& m = *motion;
  if (m.mass_known && !m.turns) return;
  m.builder.clear();
  BasicAssembler<Dim> into(dofs, m.builder);
  std::vector<bool> prescribed(static_cast<std::size_t>(dofs.unknowns()));
  for (Index u = 0; u < dofs.unknowns(); ++u)
    prescribed[static_cast<std::size_t>(u)] = assembler.prescribed(u);
  into.set_prescribed(prescribed);
  into.set_configuration(mass_x, mass_rigid);
  for (const typename BasicInertia<Dim>::CellMass& cell : m.inertia->cells())
    for (int d = 0; d < Dim; ++d) {
      std::vector<Dof> of;
      for (const Index node : cell.nodes) of.push_back(dofs.node_dof(node, d));
      into.add_block(of, cell.mass);
    }
  for (std::size_t b = 0; b < model.rigid.size(); ++b) {
    std::vector<Dof> of;
    for (int i = 0; i < body::motions<Dim>; ++i)
      of.push_back(dofs.body_dof(static_cast<Index>(b), i));
    into.add_block(of, m.inertia->body_mass(b));
  }
  const la::SparseMatrix& k = m.builder.finish();
  m.massless.assign(static_cast<std::size_t>(dofs.unknowns()), false);
  for (Index u = 0; u < dofs.unknowns(); ++u) {
    double diagonal = 0;
    for (Index at = k.row_start[static_cast<std::size_t>(u)];
         at < k.row_start[static_cast<std::size_t>(u) + 1]; ++at)
      if (k.column[static_cast<std::size_t>(at)] == u)
        diagonal = k.value[static_cast<std::size_t>(at)];
    m.massless[static_cast<std::size_t>(u)] = !(diagonal > 0);
  }
  for (Index u = 0; u < dofs.unknowns(); ++u)
    if (m.massless[static_cast<std::size_t>(u)]) m.builder.add(u, u, 1.0);
  m.solver.factor(m.builder.finish(), m.builder.pattern_version(), la::Symmetry::indefinite);
  m.mass_known = true;
}

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::spread(const Eigen::VectorXd& of_unknowns) const {
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
Eigen::VectorXd BasicSystem<Dim>::Impl::accelerations_by(const Eigen::VectorXd& force) {
  if (force.isZero(0)) return Eigen::VectorXd::Zero(dofs.dofs());
  assembler.set_configuration(mass_x, mass_rigid);
  factor_mass();
  Eigen::VectorXd a = assembler.gather(force);
  for (Index u = 0; u < dofs.unknowns(); ++u)
    if (motion->massless[static_cast<std::size_t>(u)]) a[u] = 0;
  if (motion->solver.solve(a) != la::SolveStatus::ok) a.setZero();
  return spread(a);
}

template <int Dim>
double BasicSystem<Dim>::Impl::contact_energy() const {
  double sum = 0;
  for (const pairing::PairEvaluation<Dim>& pair : contact)
    for (const pairing::PointResult<Dim>& point : pair.points) sum += point.weight * point.stored;
  return sum;
}

template <int Dim>
double BasicSystem<Dim>::Impl::damping_work() const {
  double sum = 0;
  for (const pairing::PairEvaluation<Dim>& pair : contact)
    for (const pairing::PointResult<Dim>& point : pair.points) sum += point.history.damping_work;
  return sum;
}

template <int Dim>
double BasicSystem<Dim>::Impl::friction_work() const {
  double sum = 0;
  for (const pairing::PairEvaluation<Dim>& pair : contact)
    for (const pairing::PointResult<Dim>& point : pair.points) sum += point.history.friction_work;
  return sum;
}

template <int Dim>
void BasicSystem<Dim>::Impl::move_with_bodies(const State& s, Rates& rates) const {
  const std::vector<Vec<Dim>> x = positions(s.u);
  for (Index node = 0; node < dofs.nodes(); ++node) {
    const Index b = dofs.body_of(node);
    if (b < 0) continue;
    const Vec<Dim> arm =
        x[static_cast<std::size_t>(node)] - s.rigid[static_cast<std::size_t>(b)].center();
    const Dof first = dofs.body_dof(b, 0);
    Vec<Dim> v = rates.velocity.segment<Dim>(first);
    if constexpr (Dim == 2)
      v += rates.velocity[first + 2] * turn(arm);
    else
      v += Vec3(rates.velocity.segment<3>(first + 3)).cross(arm);
    rates.velocity.segment<Dim>(Dim * node) = v;
  }
}

template <int Dim>
Eigen::VectorXd BasicSystem<Dim>::Impl::start_velocity() const {
  const auto first = std::find_if(model.steps.begin(), model.steps.end(),
                                  [](const Step& s) { return s.dynamics.has_value(); });
  Eigen::VectorXd velocity = Eigen::VectorXd::Zero(dofs.dofs());
  if (first == model.steps.end() || first->name == step.name)
    for (const auto& entry : model.initial_velocity) velocity[entry.first] = entry.second;
  for (Index u = 0; u < dofs.unknowns(); ++u)
    if (assembler.prescribed(u)) velocity[dofs.dof_of_unknown(u)] = 0;
  return velocity;
}

template <int Dim>
Rates BasicSystem<Dim>::Impl::begin_rates(const State& committed) {
  Rates rates = committed.rates;
  const bool first = rates.empty();
  if (first) {
    rates.velocity = start_velocity();
    move_with_bodies(committed, rates);
  }
  rates.acceleration.setZero(dofs.dofs());
  solve::Evaluation out;
  assemble(committed, committed, 0.0, false, false, out);
  mass_x = positions(committed.u);
  mass_rigid = committed.rigid;
  rates.internal = forces.internal;
  rates.external = forces.external;
  rates.contact = forces.contact;
  measure_damping(committed.u);
  rates.damping = damping_of(rates.velocity);
  Eigen::VectorXd force = rates.external - rates.internal - rates.damping;
  if (motion->settings.scheme.impact == solve::Impact::average) force -= rates.contact;
  rates.acceleration = accelerations_by(force);
  if constexpr (Dim == 3) begin_spins(committed, rates);
  forces.inertia = rates.damping + motion->inertia->multiply(rates.acceleration);
  Energies& e = rates.energies;
  e.kinetic =
      0.5 * rates.velocity.dot(motion->inertia->multiply(rates.velocity)) + spin_energy(rates);
  e.strain = strain_energy(model, committed.u);
  e.contact = contact_energy();
  e.damped = damping_work();
  if (first) {
    e.start = e.kinetic + e.strain + e.contact;
    e.friction_before = friction_work();
  }
  return rates;
}

template <int Dim>
Rates BasicSystem<Dim>::Impl::new_rates(const State& trial) {
  const Motion& m = *motion;
  const solve::TimeScheme& s = m.settings.scheme;
  const double h = m.h;
  Rates now;
  mass_x = positions(trial.u);
  mass_rigid = trial.rigid;
  const Eigen::VectorXd step_of = dof_values(trial) - m.start;
  Eigen::VectorXd ahead =
      step_of - h * m.past.velocity - h * h * (0.5 - s.beta) * m.past.acceleration;
  Eigen::VectorXd impulse = Eigen::VectorXd::Zero(ahead.size());  // acceleration by contact
  if (s.impact != solve::Impact::average) impulse = accelerations_by(-forces.contact);
  now.acceleration = (ahead - solve::impulse_way(s.impact) * h * h * impulse) / (s.beta * h * h);
  now.velocity = m.past.velocity +
                 h * ((1 - s.gamma) * m.past.acceleration + s.gamma * now.acceleration + impulse);
  const auto follow = [&](Dof d) {
    now.velocity[d] = step_of[d] / h;
    now.acceleration[d] = 0;
  };
  for (Index u = 0; u < dofs.unknowns(); ++u)
    if (assembler.prescribed(u)) follow(dofs.dof_of_unknown(u));
  if constexpr (Dim == 3) new_spins(trial, now);
  move_with_bodies(trial, now);
  now.internal = forces.internal;
  now.external = forces.external;
  now.contact = forces.contact;
  now.damping = m.damping_force;
  now.energies = m.past.energies;
  now.energies.elapsed += h;
  add_energies(trial, now, step_of, now.energies);
  forces.inertia = now.damping + m.inertia->multiply(now.acceleration + impulse);
  return now;
}

template <int Dim>
void BasicSystem<Dim>::Impl::add_energies(const State& trial, const Rates& now,
                                          const Eigen::VectorXd& step_of, Energies& e) const {
  const Motion& m = *motion;
  const Energies before = e;
  const bool average = m.settings.scheme.impact == solve::Impact::average;
  const auto mean = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return Eigen::VectorXd(0.5 * (a + b));
  };
  const Eigen::VectorXd internal = mean(m.past.internal, now.internal);
  const Eigen::VectorXd external = mean(m.past.external, now.external);
  const Eigen::VectorXd damping = mean(m.past.damping, now.damping);
  const Eigen::VectorXd by_contact = average ? mean(m.past.contact, now.contact) : now.contact;
  const Eigen::VectorXd inertial = m.inertia->multiply(now.velocity - m.past.velocity) / m.h;
  const Eigen::VectorXd rest = inertial + internal - external + damping + by_contact;
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
  e.kinetic = 0.5 * now.velocity.dot(m.inertia->multiply(now.velocity)) + spin_energy(now);
  e.strain = strain_energy(model, trial.u);
  e.contact = contact_energy();
  e.external += external.dot(step_of) + supports;
  e.damped = damping_work();
  e.damping += damping.dot(step_of) + (e.damped - before.damped);
  e.friction = friction_work() - e.friction_before;
  const double of_contact = by_contact.dot(step_of) - (e.contact - before.contact) -
                            (e.friction - before.friction) - (e.damped - before.damped);
  const double of_time =
      inertial.dot(step_of) - (e.kinetic - before.kinetic) - (rest.dot(step_of) - supports);
  e.numerical += of_contact + of_time;
  e.residual = e.start + e.external - e.friction - e.damping - e.numerical -
               (e.kinetic + e.strain + e.contact);
}

template struct BasicSystem<2>::Impl;
template struct BasicSystem<3>::Impl;

}  // namespace osculate::model
