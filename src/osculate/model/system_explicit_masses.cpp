// Explicit time integration: masses, and what is added to them so that time steps can be longer.
#include <algorithm>
#include <cmath>

#include "osculate/model/system_explicit.hpp"

namespace osculate::model {

/// Of dofs with their followers.
template <int Dim>
std::vector<double> BasicSystem<Dim>::Impl::Explicit::set_masses() {
  const BasicModel<Dim>& whole = system.model;
  const Eigen::Index n = system.dofs.dofs();
  node_mass.assign(whole.reference.size(), 0.0);
  std::vector<double> moved(node_mass);
  mass.setZero(n);
  const std::vector<typename BasicInertia<Dim>::CellMass>& cells = system.motion->inertia.cells();
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (std::size_t k = 0; k < cells[c].nodes.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const auto node = static_cast<std::size_t>(cells[c].nodes[k]);
      const double of_cell = cells[c].mass(i, i);
      node_mass[node] += of_cell;
      moved[node] += of_cell * (c < system.bulk.jobs.size() ? scaled.factor(c) : 1.0);
    }
  for (std::size_t k = 0; k < scaled.at_nodes.size(); ++k) moved[k] += scaled.at_nodes[k];
  for (std::size_t k = 0; k < moved.size(); ++k)
    if (system.dofs.body_of(static_cast<Index>(k)) < 0)
      mass.segment<Dim>(Dim * static_cast<Eigen::Index>(k)).setConstant(moved[k]);
  for (std::size_t b = 0; b < whole.rigid.size(); ++b)
    mass.segment<body::motions<Dim>>(system.dofs.body_dof(static_cast<Index>(b), 0)) =
        system.motion->inertia.body_mass(b).diagonal();
  for (const Follower& f : followers) {
    if (f.lead >= 0) mass[f.lead] += f.factor * f.factor * mass[f.dof];
    mass[f.dof] = 0;
  }
  inverse.setZero(n);
  for (Dof d = 0; d < n; ++d) {
    const Index unknown = system.dofs.unknown_of(d);
    if (unknown >= 0 && !system.assembler.prescribed(unknown) && mass[d] > 0)
      inverse[d] = 1 / mass[d];
  }
  return moved;
}

/// Cells, then nodes in contact, reach the stable step that is wanted: what the springs need of it
/// is what they have, or what time steps of that length leave them.
///
/// Formula    cells: lambda <= 4/h^2 - s at contacts; springs: s <= (0.75 / (safety h))^2 and
///            2/h^2 , s of both sides together as in `contact_frequency`
template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::scale_masses() {
  const MassScaling& wanted = system.step.dynamics->mass_scaling;
  (void)set_masses();
  if (!(wanted.stable_step > 0) && wanted.factor == 1.0) return;
  const BasicInertia<Dim>& inertia = system.motion->inertia;
  const auto with = [&](const MassScaling& scaling, double springs) {
    scaled = model::scaled_masses<Dim>(system.model, scaling, inertia, {touching, springs},
                                       system.bulk.threads);
  };
  with({0, wanted.factor}, 0);
  (void)set_masses();
  if (!(wanted.stable_step > 0)) return;
  x.assign(system.model.reference.begin(), system.model.reference.end());
  now.rigid.clear();
  for (const BasicRigidBody<Dim>& body : system.model.rigid) {
    now.rigid.emplace_back();
    now.rigid.back().reference = body.reference;
    now.rigid.back().small = body.small;
  }
  Springs slave = no_springs(), master = slave;
  collect_springs(false, {}, slave, master);
  const Swing a = swing_of(slave), b = swing_of(master);
  const double springs = bound_of(a, b).most() + bound_of(b, a).most();
  const double faithful = faithful_share / (options.safety * wanted.stable_step);
  const double room = std::min(faithful * faithful, 2 / (wanted.stable_step * wanted.stable_step));
  with(wanted, std::min(springs, room));
  add_node_masses(slave, master, room);
}

/// A limit for all nodes by which both sides together stay within what is allowed: rigid bodies
/// have the mass that they have. Where that alone is too much, nothing is added.
template <int Dim>
void BasicSystem<Dim>::Impl::Explicit::add_node_masses(const Springs& slave, const Springs& master,
                                                       double allowed) {
  constexpr int halvings = 60;
  const std::vector<double> moved = set_masses();
  const Swing a = swing_of(slave), b = swing_of(master);
  const Bound here = bound_of(a, b), there = bound_of(b, a);
  if (here.most() + there.most() <= allowed || here.bodies + there.bodies >= allowed) return;
  double limit = 0, above = std::max(here.nodes, there.nodes);
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (limit + above);
    const double sum = std::max(here.bodies, std::min(here.nodes, middle)) +
                       std::max(there.bodies, std::min(there.nodes, middle));
    (sum <= allowed ? limit : above) = middle;
  }
  std::vector<bool> moves(moved.size(), false);
  const auto see = [&](Dof dof, Dof by) {
    if (inverse[by] > 0) moves[static_cast<std::size_t>(dof / Dim)] = true;
  };
  const Dof nodes = Dim * system.dofs.nodes();
  for (Dof d = 0; d < nodes; ++d) see(d, d);
  for (const Follower& f : followers)
    if (f.lead >= 0 && f.dof < nodes) see(f.dof, f.lead);
  std::vector<double> more(moved.size(), 0.0);
  for (std::size_t n = 0; n < more.size(); ++n)
    if (moves[n] && system.dofs.body_of(static_cast<Index>(n)) < 0)
      more[n] = std::max(0.0, (slave.nodes[n] + master.nodes[n]) / limit - moved[n]);
  model::add_at_nodes(system.model, more, scaled);
  (void)set_masses();
}

template struct BasicSystem<2>::Impl::Explicit;
template struct BasicSystem<3>::Impl::Explicit;

}  // namespace osculate::model
