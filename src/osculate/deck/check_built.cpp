#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/build_context.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/model/explicit_obstacle.hpp"

namespace osculate::deck {
namespace {

/// Nodes of rigid bodies and of what follows them, contacts, prescriptions, equations and springs.
template <int Dim>
std::vector<bool> held_nodes(const model::BasicModel<Dim>& m) {
  std::vector<bool> held(m.reference.size(), false);
  for (const model::BasicContactPair<Dim>& pair : m.pairs) {
    for (const Index n : pair.definition.slave.nodes) held[static_cast<std::size_t>(n)] = true;
    for (const auto& f : pair.definition.master.facets)
      for (int k = 0; k < f.count; ++k)
        held[static_cast<std::size_t>(f.nodes[static_cast<std::size_t>(k)])] = true;
  }
  for (const model::Step& step : m.steps)
    for (const model::PrescribedDof& p : step.prescribed)
      if (p.dof < Dim * static_cast<Index>(m.reference.size()))
        held[static_cast<std::size_t>(p.dof / Dim)] = true;
  for (const model::Equation& e : m.equations)
    for (const model::Equation::Term& t : e.terms)
      if (t.dof < Dim * static_cast<Index>(m.reference.size()))
        held[static_cast<std::size_t>(t.dof / Dim)] = true;
  for (const model::Spring& spring : m.springs) {
    for (const Index n : spring.ends)
      if (n >= 0) held[static_cast<std::size_t>(n)] = true;
    for (const model::Equation::Term& t : spring.terms)
      if (t.dof < Dim * static_cast<Index>(m.reference.size()))
        held[static_cast<std::size_t>(t.dof / Dim)] = true;
  }
  for (const model::NodeConstraint& one : m.node_constraints)
    for (const Index n : one.nodes)
      if (one.body >= 0) held[static_cast<std::size_t>(n)] = true;
  for (std::size_t n = 0; n < held.size(); ++n)
    if (m.body_of_node[n] >= 0) held[n] = true;
  return held;
}

/// Deformable parts that nothing holds or touches. Sections that share nodes are one part.
template <int Dim>
void check_connected(const BuildContext<Dim>& c) {
  const model::BasicModel<Dim>& m = c.model();
  const auto inert = [](const model::Step& step) {
    return model::takes_time(step) || step.frequencies || step.harmonic;
  };
  if (std::all_of(m.steps.begin(), m.steps.end(), inert)) return;
  const std::vector<bool> held = held_nodes(m);
  std::vector<mesh::CellRef> cells;
  for (const model::BasicBulkSection<Dim>& section : m.sections)
    cells.insert(cells.end(), section.cells.begin(), section.cells.end());
  for (const auto& part : mesh::connected_parts(m.mesh, cells)) {
    bool any = false;
    for (const mesh::CellRef& ref : part) {
      const mesh::Block& block = m.mesh.blocks[static_cast<std::size_t>(ref.block)];
      for (int k = 0; k < cell::info(block.type).nodes; ++k)
        any = any || held[static_cast<std::size_t>(block.cell(ref.cell)[k])];
    }
    if (any) continue;
    const mesh::CellRef& at = part.front();
    const Index node = m.mesh.blocks[static_cast<std::size_t>(at.block)].cell(at.cell)[0];
    const Section& section =
        c.description.sections[static_cast<std::size_t>(c.section_of_cell.at({at.block, at.cell}))];
    throw core::InputError(
        section.on.mark,
        fmt::format("a part of body '{}' ({} cells, at {}) is held by nothing: no contact, no "
                    "prescribed displacement, no shared node",
                    section.on.value, part.size(), mesh::describe_node(m.mesh, node)));
  }
}

/// Steps with central differences.
template <int Dim>
void check_explicit_steps(const BuildContext<Dim>& c) {
  for (std::size_t s = 0; s < c.model().steps.size(); ++s) {
    const model::Step& step = c.model().steps[s];
    if (!step.dynamics || !step.dynamics->explicit_steps) continue;
    const std::string obstacle = model::explicit_obstacle(c.model(), step);
    if (!obstacle.empty())
      throw core::InputError(c.description.steps[s].dynamics->mark,
                             "central differences are not possible: " + obstacle);
  }
}

}  // namespace

template <int Dim>
void check_model(BuildContext<Dim>& c) {
  check_connected(c);
  check_explicit_steps(c);
}

template void check_model(BuildContext<2>&);
template void check_model(BuildContext<3>&);

}  // namespace osculate::deck
