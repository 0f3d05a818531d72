// Explicit time integration: the forces and accelerations of one time step.
#include "osculate/model/system_explicit.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "osculate/body/free_turn.hpp"
#include "osculate/model/temperatures.hpp"

namespace osculate::model {
namespace {

constexpr Eigen::Index dofs_a_turn = 1024;  // that stay in the first cache

}  // namespace

template <int Dim>
BasicSystem<Dim>::Impl::Explicit::Explicit(Impl& s)
    : system(s),
      options(*s.step.dynamics->explicit_steps),
      damping(s.step.dynamics->damping_mass),
      batches(s.bulk),
      work(static_cast<std::size_t>(s.bulk.threads)),
      active_set(s.model.pairs.size()),
      far(s.model.pairs.size()),
      turning(s.model.rigid.size()) {
  const Eigen::Index n = system.dofs.dofs();
  loaded = !s.step.pressure.empty() || !s.step.centrifugal.empty() || !s.step.dead.empty() ||
           !s.step.gravity.empty();
  for (Vector* const v : {&past_internal, &past_contact, &past_external, &past_damping})
    v->setZero(n);
  x.resize(system.model.reference.size());
  make_followers();
  look_at_contact();
  scale_masses();
  make_parts();
  system.bulk.linear.reserve([&](std::size_t cell) { return batches.takes(cell); },
                             [](std::size_t) { return false; });
  total.setZero(n);
}

template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::make_followers() {
  for (const PrescribedDof& p : system.step.prescribed) {
    prescribed.push_back(&p);
    if (system.dofs.unknown_of(p.dof) >= 0) held.push_back(p.dof);
  }
  past_held.setZero(static_cast<Eigen::Index>(held.size()));
  for (const Equation& equation : system.dofs.equations()) {
    const Equation::Term& of = equation.terms.front();
    Follower f{of.dof, -1, 0};
    if (equation.terms.size() > 1) {
      f.lead = equation.terms[1].dof;
      f.factor = -equation.terms[1].factor / of.factor;
    }
    followers.push_back(f);
  }
  gathered = held;
  for (const Follower& f : followers) {
    gathered.push_back(f.dof);
    if (f.lead >= 0) gathered.push_back(f.lead);
  }
  for (std::size_t b = 0; b < system.model.rigid.size(); ++b) {
    for (int i = 0; i < body::motions<Dim>; ++i)
      gathered.push_back(system.dofs.body_dof(static_cast<Index>(b), i));
    for (const Index node : system.model.rigid[b].nodes)
      for (Dof i = 0; i < Dim; ++i) gathered.push_back(Dim * node + i);
    turns.push_back(Dim == 3 && system.model.rigid[b].mass > 0 &&
                    system.motion->free_rotations(b) > 0);
  }
}

/// Which cells touch, and whether the stiffness changes.
template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::look_at_contact() {
  std::vector<bool> in_contact(system.model.reference.size(), false);
  for (const BasicContactPair<Dim>& pair : system.model.pairs) {
    changes = changes || !(contact::penalty_of(pair.definition.normal) > 0);
    for (const Index n : pair.definition.slave.nodes)
      in_contact[static_cast<std::size_t>(n)] = true;
    for (const auto& f : pair.definition.master.facets)
      for (std::size_t k = 0; k < static_cast<std::size_t>(f.count); ++k)
        in_contact[static_cast<std::size_t>(f.nodes[k])] = true;
  }
  for (const typename BulkTerm<Dim>::Job& job : system.bulk.jobs) {
    touching.push_back(false);
    changes = changes || job.section->section.kinematics == solid::Kinematics::finite;
    for (const Index node : cell_nodes(system.model.mesh, job.cell).nodes)
      if (in_contact[static_cast<std::size_t>(node)]) touching.back() = true;
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::place(const Vector& position) {
  for (std::size_t n = 0; n < x.size(); ++n)
    x[n] = system.model.reference[n] + position.segment<Dim>(Dim * static_cast<Eigen::Index>(n));
}

template <int Dim>
bool BasicSystem<Dim>::Impl::Explicit::add_cell(std::size_t cell, const Vector& u, double h,
                                                Work& with) {
  const typename BulkTerm<Dim>::Job& job = system.bulk.jobs[cell];
  system.bulk.linear.force(cell, system.model, *job.section, job.cell, u,
                           job.memory.of(now.memory, system.last.memory, h), with.block);
  if (with.block.ok) batches.add_alone(cell, with.block.result.force, with.force);
  return with.block.ok;
}

template <int Dim>
std::size_t BasicSystem<Dim>::Impl::Explicit::add_part(std::size_t part, const Vector& u, double h,
                                                       Work& with) {
  std::size_t failed = system.bulk.jobs.size();
  const auto alone = [&](std::size_t cell) {
    if (!add_cell(cell, u, h, with)) failed = std::min(failed, cell);
  };
  batches.gather(part, u, with.along);
  with.force.assign(with.along.size(), core::Pack::Zero());
  const auto fours = batches.fours(part), others = batches.alone(part);
  typename ForceBatches<Dim>::Values force, of_next;
  for (std::size_t f = fours.begin; f < fours.end; ++f) {
    if (batches.goes_with_next(f) && batches.forces(f, with.along, force, of_next)) {
      batches.add(f, force, with.force);
      batches.add(++f, of_next, with.force);
    } else if (batches.forces(f, with.along, force)) {
      batches.add(f, force, with.force);
    } else {
      for (const std::size_t cell : batches.jobs(f)) alone(cell);
    }
  }
  for (std::size_t i = others.begin; i < others.end; ++i) alone(batches.others()[i]);
  const Index* const place = &parts.place[parts.first[part - parts.from]];
  for (std::size_t n = 0; n < with.force.size(); ++n) {
    double* const to = at_place(place[n]);
    for (int i = 0; i < Dim; ++i) to[i] = with.force[n][i];
  }
  return failed;
}

template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::add_contact(double h, double fraction, bool all) {
  if (active_set.empty()) return;
  const Stopwatch watch;
  system.last.forces.contact.setZero();
  for (std::size_t p = 0; p < active_set.size(); ++p) {
    const pairing::PairDefinition<Dim>& pair = system.model.pairs[p].definition;
    active_set[p].duration = h;
    active_set[p].mean_onset = h > 0;
    active_set[p].relief = system.contact.relief(pair, fraction);
    pairing::evaluate<Dim>(pair, x, now.pairs[p], system.last.contact[p], active_set[p], far[p],
                           all, &system.bulk.crew);
    const auto add = [&](const pairing::ContactBlock<Dim>& block) {
      for (int k = 0; k < block.count; ++k)
        system.last.forces.contact.template segment<Dim>(
            Dim * block.nodes[static_cast<std::size_t>(k)]) +=
            block.force.template segment<Dim>(Dim * k);
    };
    const std::vector<pairing::ContactBlock<Dim>>& blocks = system.last.contact[p].blocks;
    if (far[p].leaves_out()) {
      for (const std::size_t i : far[p].looked_at()) add(blocks[i]);
    } else {
      for (const pairing::ContactBlock<Dim>& block : blocks) add(block);
    }
  }
  system.contact.seconds += watch.seconds();
}

/// As pairing::commit, without new memory.
template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::commit_contact() {
  for (std::size_t p = 0; p < now.pairs.size(); ++p) {
    const pairing::PairEvaluation<Dim>& evaluation = system.last.contact[p];
    std::vector<contact::PointHistory<Dim>>& committed = now.pairs[p].points;
    committed.resize(evaluation.points.size());
    bool touches = false;
    const auto commit = [&](std::size_t i) {
      const pairing::PointResult<Dim>& point = evaluation.points[i];
      committed[i] = point.history;
      touches = touches || point.status != contact::Status::open;
    };
    if (far[p].leaves_out()) {
      for (const std::size_t i : far[p].looked_at()) commit(i);
    } else {
      for (std::size_t i = 0; i < committed.size(); ++i) commit(i);
    }
    system.touched[p] = system.touched[p] || touches;
    now.pairs[p].places = evaluation.mortar.places;
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::add_loads(double fraction) {
  if (!loaded) return;
  Vector& external = system.last.forces.external;
  external.setZero();
  if (!system.step.pressure.empty() || !system.step.centrifugal.empty()) {
    now.u = motion.position.head(now.u.size());
    Assembly<Dim> to = system.assembly();
    system.loads.add_following(system.step, now, fraction, LoadPlaces::strains, to);
  }
  system.loads.add_dead_loads(system.step, fraction, system.last.forces);
  if (system.step.gravity.empty()) return;
  Vec<Dim> g;
  for (int i = 0; i < Dim; ++i)
    g[i] = system.step.gravity[static_cast<std::size_t>(i)].value(fraction);
  for (std::size_t n = 0; n < node_mass.size(); ++n)
    external.segment<Dim>(Dim * static_cast<Eigen::Index>(n)) += node_mass[n] * g;
  for (std::size_t b = 0; b < now.rigid.size(); ++b)
    external.segment<Dim>(system.dofs.body_dof(static_cast<Index>(b), 0)) +=
        system.model.rigid[b].mass * g;
}

template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::sum_forces() {
  const Forces& f = system.last.forces;
  for (const Dof d : gathered) {
    total[d] = f.internal[d];
    if (!active_set.empty()) total[d] += f.contact[d];
    if (loaded) total[d] -= f.external[d];
  }
  gather(total);
}

template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::gather(Vector& forces) const {
  for (std::size_t b = 0; b < now.rigid.size(); ++b) {
    Vec<Dim> force = Vec<Dim>::Zero();
    Vec<body::rotations<Dim>> moment = Vec<body::rotations<Dim>>::Zero();
    for (const Index node : system.model.rigid[b].nodes) {
      const Vec<Dim> of_node = forces.segment<Dim>(Dim * node);
      const Vec<Dim> arm = body::arm_of(now.rigid[b], x[static_cast<std::size_t>(node)]);
      force += of_node;
      if constexpr (Dim == 2)
        moment[0] += turn(arm).dot(of_node);
      else
        moment += arm.cross(of_node);
    }
    const Dof first = system.dofs.body_dof(static_cast<Index>(b), 0);
    forces.segment<Dim>(first) += force;
    forces.segment<body::rotations<Dim>>(first + Dim) += moment;
  }
  for (const Follower& f_of : followers)
    if (f_of.lead >= 0) forces[f_of.lead] += f_of.factor * forces[f_of.dof];
}

/// Damping enters by the velocity at the end of the step, which is the mean of those around it. All
/// in one pass over the dofs, in turns that do not depend on the number of threads.
///
/// Formula    M a = f - alpha M v ,  v = v_half + h/2 a
template <int Dim>
bool BasicSystem<Dim>::Impl::Explicit::set_accelerations(double h, solve::ExplicitMotion& m) {
  const Forces& f = system.last.forces;
  const Eigen::Index dofs = inverse.size(), turn_count = (dofs + dofs_a_turn - 1) / dofs_a_turn;
  const double half = 0.5 * h;
  of_turns.assign(static_cast<std::size_t>(turn_count), {});
  const auto take = [&](Eigen::Index turn) {
    const Eigen::Index begin = turn * dofs_a_turn, n = std::min(dofs_a_turn, dofs - begin);
    const auto here = [&](const Vector& v) { return v.segment(begin, n); };
    const auto work_of = [&](const Vector& past, const Vector& force) {
      return half * (here(past) + here(force)).dot(here(m.velocity));
    };
    Works& w = of_turns[static_cast<std::size_t>(turn)];
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, dofs_a_turn, 1> sum = here(f.internal);
    w.internal = work_of(past_internal, f.internal);
    if (!active_set.empty()) {
      sum += here(f.contact);
      w.contact = work_of(past_contact, f.contact);
    }
    if (loaded) {
      sum -= here(f.external);
      w.external = work_of(past_external, f.external);
    }
    w.square = sum.squaredNorm();
    m.acceleration.segment(begin, n) = -sum.cwiseProduct(here(inverse));
  };
  constexpr std::size_t worth_it = 4;
  system.bulk.crew.share_runs(of_turns.size(), worth_it, [&](std::size_t from, std::size_t to) {
    for (std::size_t turn = from; turn < to; ++turn) take(static_cast<Eigen::Index>(turn));
  });
  for (const Dof d : gathered) m.acceleration[d] = -total[d] * inverse[d];
  works.square = 0;
  for (const Works& w : of_turns) {
    works.internal += w.internal;
    works.contact += w.contact;
    works.external += w.external;
    works.square += w.square;
  }
  for (Eigen::Index d = 0; damping > 0 && d < dofs; ++d) {
    if (!(inverse[d] > 0)) continue;
    double& a = m.acceleration[d];
    a = (a - damping * m.velocity[d]) / (1 + 0.5 * h * damping);
    damping_force[d] = damping * mass[d] * (m.velocity[d] + 0.5 * h * a);
  }
  return std::isfinite(works.square);
}

/// Angular momenta at the end of a time step, damped as the velocities.
///
/// Formula    L' = m - alpha L ,  L = L_half + h/2 L'
template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::end_turns(double h) {
  if constexpr (Dim == 3) {
    for (std::size_t b = 0; b < turning.size(); ++b) {
      if (!turns[b]) continue;
      const Dof first = system.dofs.body_dof(static_cast<Index>(b), 3);
      Turning& t = turning[b];
      t.moment = (-total.segment<3>(first) - damping * t.momentum) / (1 + 0.5 * h * damping);
      t.momentum += 0.5 * h * t.moment;
      damping_force.segment<3>(first) = damping * t.momentum;
    }
  } else {
    (void)h;
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::add_held_works(double h, const solve::ExplicitMotion& m) {
  const double half = 0.5 * h;
  if (damping > 0) works.damping += half * (past_damping + damping_force).dot(m.velocity);
  for (std::size_t i = 0; i < held.size(); ++i) {
    double& past = past_held[static_cast<Eigen::Index>(i)];
    works.supports += half * (past + total[held[i]]) * m.velocity[held[i]];
    past = total[held[i]];
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::move_body(std::size_t body, double fraction, double h,
                                                 solve::ExplicitMotion& m) {
  body::BasicRigidMotion<Dim>& motion_of = now.rigid[body];
  const body::BasicRigidMotion<Dim> before = motion_of;
  const Dof first = system.dofs.body_dof(static_cast<Index>(body), 0);
  for (int i = 0; i < body::motions<Dim>; ++i)
    motion_of.component(i) = before.component(i) + h * m.velocity[first + i];
  if constexpr (Dim == 3) motion_of.rotation = before.rotation;
  for (const PrescribedDof* const p : prescribed) {
    const Dof i = p->dof - first;
    if (i < 0 || i >= body::motions<Dim>) continue;
    motion_of.component(i) = p->ramp.value(fraction);
    m.velocity[p->dof] = (motion_of.component(i) - before.component(i)) / h;
  }
  if constexpr (Dim == 3) {
    Turning& t = turning[body];
    Vec3 turn_of;
    if (turns[body]) {
      t.momentum += 0.5 * h * t.moment;
      turn_of =
          body::free_turn(system.model.rigid[body].inertia, before.orientation(), t.momentum, h);
      motion_of.rotation = body::rotation_vector_near(
          body::rotation_matrix(turn_of) * body::rotation_matrix(before.rotation),
          before.rotation + turn_of);
      if (!system.motion->total_matters(body)) motion_of = body::rebased(motion_of);
    } else {
      turn_of = body::turn_between(before, motion_of);
    }
    m.velocity.segment<3>(first + 3) = turn_of / h;
  }
  for (const Index node : system.model.rigid[body].nodes) {
    const Vec<Dim>& material = system.model.reference[static_cast<std::size_t>(node)];
    m.velocity.segment<Dim>(Dim * node) =
        (motion_of.position(material) - material - m.position.segment<Dim>(Dim * node)) / h;
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::follow(double time, double h, solve::ExplicitMotion& m) {
  const double fraction = time / system.step.duration;
  const Dof nodes = Dim * system.dofs.nodes();
  for (const PrescribedDof* const p : prescribed)
    if (p->dof < nodes) m.velocity[p->dof] = (p->ramp.value(fraction) - m.position[p->dof]) / h;
  for (std::size_t b = 0; b < now.rigid.size(); ++b) move_body(b, fraction, h, m);
  for (const Follower& f : followers) {
    const double target =
        f.lead < 0 ? 0.0 : f.factor * (m.position[f.lead] + h * m.velocity[f.lead]);
    m.velocity[f.dof] = (target - m.position[f.dof]) / h;
  }
}

template <int Dim>
bool BasicSystem<Dim>::Impl::Explicit::accelerate(double time, double h, solve::ExplicitMotion& m) {
  Forces& f = system.last.forces;
  last_step = h;
  past_internal.swap(f.internal);
  past_contact.swap(f.contact);
  past_external.swap(f.external);
  past_damping.swap(damping_force);
  if (!active_set.empty() || !now.rigid.empty()) place(m.position);  // nobody else asks
  const double fraction = time / system.step.duration;
  warm(system.model, system.step.temperature, fraction, system.last.memory);
  if (!add_cells(m.position, h)) return false;
  now.memory.swap(system.last.memory);
  add_contact(h, fraction, !(time < until));
  commit_contact();
  add_loads(fraction);
  sum_forces();
  lost = !set_accelerations(h, m);
  if (lost) return false;
  end_turns(h);
  add_held_works(h, m);
  ++stable.since;
  return true;
}

template struct BasicSystem<2>::Impl::Explicit;
template struct BasicSystem<3>::Impl::Explicit;

}  // namespace osculate::model
