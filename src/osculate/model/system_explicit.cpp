// Explicit time integration: the forces and accelerations of one time step.
#include "osculate/model/system_explicit.hpp"

#include <omp.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "osculate/body/free_turn.hpp"
#include "osculate/model/temperatures.hpp"

namespace osculate::model {
namespace {

constexpr std::size_t fours_a_part = 512, others_a_part = 512;

}  // namespace

template <int Dim>
BasicSystem<Dim>::Impl::Explicit::Explicit(Impl& s)
    : system(s),
      options(*s.step.dynamics->explicit_steps),
      damping(s.step.dynamics->damping_mass),
      batches(s.bulk),
      work(static_cast<std::size_t>(s.bulk.threads)),
      active_set(s.model.pairs.size()),
      turning(s.model.rigid.size()) {
  const Eigen::Index n = system.dofs.dofs();
  loaded = !s.step.pressure.empty() || !s.step.centrifugal.empty() || !s.step.dead.empty() ||
           !s.step.gravity.empty();
  for (Vector* const v : {&past_internal, &past_contact, &past_external, &past_damping})
    v->setZero(n);
  x.resize(system.model.reference.size());
  make_masses();
  make_followers();
  look_at_contact();
  make_parts();
  system.bulk.linear.reserve([&](std::size_t cell) { return batches.takes(cell); });
  inverse.setZero(n);
  for (Dof d = 0; d < n; ++d) {
    const Index unknown = system.dofs.unknown_of(d);
    if (unknown >= 0 && !system.assembler.prescribed(unknown) && mass[d] > 0)
      inverse[d] = 1 / mass[d];
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::make_masses() {
  const BasicModel<Dim>& whole = system.model;
  node_mass.assign(whole.reference.size(), 0.0);
  mass.setZero(system.dofs.dofs());
  for (const typename BasicInertia<Dim>::CellMass& cell : system.motion->inertia.cells())
    for (std::size_t k = 0; k < cell.nodes.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      node_mass[static_cast<std::size_t>(cell.nodes[k])] += cell.mass(i, i);
    }
  for (std::size_t n = 0; n < node_mass.size(); ++n)
    if (system.dofs.body_of(static_cast<Index>(n)) < 0)
      mass.segment<Dim>(Dim * static_cast<Eigen::Index>(n)).setConstant(node_mass[n]);
  for (std::size_t b = 0; b < whole.rigid.size(); ++b)
    mass.segment<body::motions<Dim>>(system.dofs.body_dof(static_cast<Index>(b), 0)) =
        system.motion->inertia.body_mass(b).diagonal();
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
      mass[f.lead] += f.factor * f.factor * mass[f.dof];
    }
    mass[f.dof] = 0;
    followers.push_back(f);
  }
  for (std::size_t b = 0; b < system.model.rigid.size(); ++b)
    turns.push_back(Dim == 3 && system.model.rigid[b].mass > 0 &&
                    system.motion->free_rotations(b) > 0);
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
void BasicSystem<Dim>::Impl::Explicit::make_parts() {
  const std::size_t nodes = system.model.reference.size();
  parts.of_fours = (batches.count() + fours_a_part - 1) / fours_a_part;
  parts.count = parts.of_fours + (batches.others().size() + others_a_part - 1) / others_a_part;
  std::vector<std::size_t> part_of(system.bulk.jobs.size());
  for (std::size_t f = 0; f < batches.count(); ++f)
    for (const std::size_t job : batches.jobs(f)) part_of[job] = f / fours_a_part;
  for (std::size_t i = 0; i < batches.others().size(); ++i)
    part_of[batches.others()[i]] = parts.of_fours + i / others_a_part;
  std::vector<std::vector<std::size_t>> of_node(nodes);  // parts, rising
  for (std::size_t j = 0; j < part_of.size(); ++j)
    for (const Index node : cell_nodes(system.model.mesh, system.bulk.jobs[j].cell).nodes) {
      std::vector<std::size_t>& of = of_node[static_cast<std::size_t>(node)];
      const auto at = std::lower_bound(of.begin(), of.end(), part_of[j]);
      if (at == of.end() || *at != part_of[j]) of.insert(at, part_of[j]);
    }
  std::vector<std::size_t> first_slot(nodes, 0);
  std::size_t slots = 0;
  for (std::size_t n = 0; n < nodes; ++n) {
    if (of_node[n].size() < 2) continue;
    parts.shared.push_back(static_cast<Index>(n));
    first_slot[n] = slots;
    slots += of_node[n].size();
    parts.begin.push_back(first_slot[n]);
  }
  parts.begin.push_back(slots);
  parts.slots.assign(Dim * slots, 0.0);
  const auto dofs = static_cast<Index>(system.dofs.dofs());
  for (std::size_t j = 0; j < part_of.size(); ++j) {
    parts.first.push_back(parts.place.size());
    for (const Index node : cell_nodes(system.model.mesh, system.bulk.jobs[j].cell).nodes) {
      const std::vector<std::size_t>& of = of_node[static_cast<std::size_t>(node)];
      const auto here = std::lower_bound(of.begin(), of.end(), part_of[j]) - of.begin();
      const auto slot =
          static_cast<Index>(first_slot[static_cast<std::size_t>(node)]) + static_cast<Index>(here);
      parts.place.push_back(of.size() < 2 ? Dim * node : dofs + Dim * slot);
    }
  }
}

template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::place(const Vector& position) {
  for (std::size_t n = 0; n < x.size(); ++n)
    x[n] = system.model.reference[n] + position.segment<Dim>(Dim * static_cast<Eigen::Index>(n));
}

template <int Dim>
bool BasicSystem<Dim>::Impl::Explicit::add_cell(std::size_t cell, const Vector& u, double h) {
  BulkBlock& block = work[static_cast<std::size_t>(omp_get_thread_num())];
  const typename BulkTerm<Dim>::Job& job = system.bulk.jobs[cell];
  system.bulk.linear.force(cell, system.model, *job.section, job.cell, u,
                           job.memory.of(now.memory, system.last.memory, h), block);
  if (!block.ok) return false;
  const Index* const place = &parts.place[parts.first[cell]];
  for (int k = 0; k < block.dof_count / Dim; ++k) {
    double* const to = at_place(place[k]);
    for (int i = 0; i < Dim; ++i) to[i] += block.result.force[Dim * k + i];
  }
  return true;
}

template <int Dim>
std::ptrdiff_t BasicSystem<Dim>::Impl::Explicit::add_part(std::size_t part, const Vector& u,
                                                          double h) {
  auto failed = static_cast<std::ptrdiff_t>(system.bulk.jobs.size());
  const auto alone = [&](std::size_t cell) {
    if (!add_cell(cell, u, h)) failed = std::min(failed, static_cast<std::ptrdiff_t>(cell));
  };
  if (part >= parts.of_fours) {
    const std::vector<std::size_t>& others = batches.others();
    const std::size_t begin = (part - parts.of_fours) * others_a_part;
    for (std::size_t i = begin; i < std::min(others.size(), begin + others_a_part); ++i)
      alone(others[i]);
    return failed;
  }
  typename ForceBatches<Dim>::Values force;
  const std::size_t begin = part * fours_a_part;
  for (std::size_t f = begin; f < std::min(batches.count(), begin + fours_a_part); ++f) {
    const std::span<const std::size_t> jobs = batches.jobs(f);
    if (!batches.forces(f, u, force)) {
      for (const std::size_t cell : jobs) alone(cell);
      continue;
    }
    const std::size_t nodes = batches.nodes(f);
    for (std::size_t lane = 0; lane < jobs.size(); ++lane) {
      const Index* const place = &parts.place[parts.first[jobs[lane]]];
      for (std::size_t k = 0; k < nodes; ++k) {
        double* const to = at_place(place[k]);
        for (std::size_t i = 0; i < Dim; ++i) to[i] += force[Dim * k + i][static_cast<int>(lane)];
      }
    }
  }
  return failed;
}

template <int Dim>
bool BasicSystem<Dim>::Impl::Explicit::add_cells(const Vector& u, double h) {
  const Stopwatch watch;
  const auto count = static_cast<std::ptrdiff_t>(system.bulk.jobs.size());
  const auto shared = static_cast<std::ptrdiff_t>(parts.shared.size());
  const auto all = static_cast<std::ptrdiff_t>(parts.count);
  std::ptrdiff_t failed = count;
  Vector& internal = system.last.forces.internal;
  internal.setZero();
  std::fill(parts.slots.begin(), parts.slots.end(), 0.0);
#pragma omp parallel num_threads(system.bulk.threads)
  {
#pragma omp for schedule(static) reduction(min : failed)
    for (std::ptrdiff_t p = 0; p < all; ++p)
      failed = std::min(failed, add_part(static_cast<std::size_t>(p), u, h));
#pragma omp for schedule(static)
    for (std::ptrdiff_t s = 0; s < shared; ++s) {
      const auto at = static_cast<std::size_t>(s);
      Vec<Dim> sum = Vec<Dim>::Zero();
      for (std::size_t e = parts.begin[at]; e < parts.begin[at + 1]; ++e)
        sum += Eigen::Map<const Vec<Dim>>(&parts.slots[Dim * e]);
      internal.template segment<Dim>(Dim * parts.shared[at]) = sum;
    }
  }
  system.bulk.seconds += watch.seconds();
  if (failed == count) return true;
  system.bulk.evaluate(static_cast<std::size_t>(failed), u, now.memory, {}, h, false, work.front());
  trouble = work.front().message;
  return false;
}

template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::add_contact(double h, double fraction) {
  if (active_set.empty()) return;
  const Stopwatch watch;
  system.last.forces.contact.setZero();
  for (std::size_t p = 0; p < active_set.size(); ++p) {
    const pairing::PairDefinition<Dim>& pair = system.model.pairs[p].definition;
    active_set[p].duration = h;
    active_set[p].mean_onset = h > 0;
    active_set[p].relief = system.contact.relief(pair, fraction);
    pairing::evaluate<Dim>(pair, x, now.pairs[p], false, system.last.contact[p], active_set[p]);
    for (const pairing::ContactBlock<Dim>& block : system.last.contact[p].blocks)
      for (int k = 0; k < block.count; ++k)
        system.last.forces.contact.template segment<Dim>(
            Dim * block.nodes[static_cast<std::size_t>(k)]) +=
            block.force.template segment<Dim>(Dim * k);
  }
  system.contact.seconds += watch.seconds();
}

/// As pairing::commit, without new memory.
template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::commit_contact() {
  for (std::size_t p = 0; p < now.pairs.size(); ++p) {
    const pairing::PairEvaluation<Dim>& evaluation = system.last.contact[p];
    system.touched[p] = system.touched[p] || pairing::touches(evaluation);
    now.pairs[p].points.resize(evaluation.points.size());
    for (std::size_t i = 0; i < evaluation.points.size(); ++i)
      now.pairs[p].points[i] = evaluation.points[i].history;
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
  total = f.internal;
  if (!active_set.empty()) total += f.contact;
  if (loaded) total -= f.external;
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

/// Damping enters by the velocity at the end of the step, which is the mean of those around it.
///
/// Formula    M a = f - alpha M v ,  v = v_half + h/2 a
template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::set_accelerations(double h, solve::ExplicitMotion& m) {
  m.acceleration = -(total.array() * inverse.array()).matrix();
  if (!(damping > 0)) return;
  for (Eigen::Index d = 0; d < inverse.size(); ++d) {
    if (!(inverse[d] > 0)) continue;
    double& a = m.acceleration[d];
    a = (a - damping * m.velocity[d]) / (1 + 0.5 * h * damping);
    damping_force[d] = damping * mass[d] * (m.velocity[d] + 0.5 * h * a);
  }
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
void BasicSystem<Dim>::Impl::Explicit::add_works(double h, const solve::ExplicitMotion& m) {
  const Forces& f = system.last.forces;
  const double half = 0.5 * h;
  works.internal += half * (past_internal + f.internal).dot(m.velocity);
  if (!active_set.empty()) works.contact += half * (past_contact + f.contact).dot(m.velocity);
  if (loaded) works.external += half * (past_external + f.external).dot(m.velocity);
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
  add_contact(h, fraction);
  commit_contact();
  add_loads(fraction);
  sum_forces();
  if (!std::isfinite(total.squaredNorm())) {
    lost = true;
    return false;
  }
  set_accelerations(h, m);
  end_turns(h);
  add_works(h, m);
  ++stable.since;
  return true;
}

template struct BasicSystem<2>::Impl::Explicit;
template struct BasicSystem<3>::Impl::Explicit;

}  // namespace osculate::model
