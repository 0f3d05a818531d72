// What changes of bodies and equations from step to step.
#include <fmt/format.h>

#include <algorithm>

#include "osculate/core/text.hpp"
#include "osculate/deck/build_cells.hpp"
#include "osculate/deck/build_displacements.hpp"
#include "osculate/model/bulk.hpp"

namespace osculate::deck {
namespace {

using CellKey = std::pair<Index, Index>;

/// Cells that come back new, without strain.
template <int Dim>
void require_renewable(const BuildContext<Dim>& c, const CellChange& change,
                       model::BasicBulkSection<Dim>& section) {
  if (material::strains_of(section.section.expansion) > 0 && !c.model().initial_temperature.empty())
    throw core::InputError(change.on.mark,
                           fmt::format("cells of '{}' expand with their temperature: they come "
                                       "back with `with_strain: true` only",
                                       section.name));
  section.returns.resize(section.cells.size(), 0);
}

template <int Dim>
void take_away(BuildContext<Dim>& c, const CellChange& change, std::set<CellKey>& removed,
               model::BasicBodyChange<Dim>& to) {
  for (auto& part : cells_on(c, change.on)) {
    for (const std::size_t i : part.cells) {
      const mesh::CellRef& ref = c.model().sections[part.section].cells[i];
      if (!removed.emplace(ref.block, ref.cell).second)
        throw core::InputError(
            change.on.mark, fmt::format("cell {} of '{}' is not there any more",
                                        mesh::cell_number(c.model().mesh, ref), change.on.value));
    }
    to.removed.push_back(std::move(part));
  }
}

template <int Dim>
void bring_back(BuildContext<Dim>& c, const CellChange& change, std::set<CellKey>& removed,
                model::BasicBodyChange<Dim>& to) {
  for (auto& part : cells_on(c, change.on)) {
    model::BasicBulkSection<Dim>& section = c.model().sections[part.section];
    if (!change.with_strain) require_renewable(c, change, section);
    for (const std::size_t i : part.cells) {
      const mesh::CellRef& ref = section.cells[i];
      if (removed.erase({ref.block, ref.cell}) == 0)
        throw core::InputError(
            change.on.mark, fmt::format("cell {} of '{}' is there: no step has removed it",
                                        mesh::cell_number(c.model().mesh, ref), change.on.value));
      if (!change.with_strain) section.returns[i] = 1;
    }
    (change.with_strain ? to.restored : to.renewed).push_back(std::move(part));
  }
}

/// Nodes that have cells, and none that is there.
template <int Dim>
std::set<Index> bare_nodes_of(const model::BasicModel<Dim>& m, const std::set<CellKey>& removed) {
  std::set<Index> bare;
  for (const auto& [block, cell] : removed)
    for (const Index n : model::cell_nodes(m.mesh, {block, cell}).nodes) bare.insert(n);
  for (const model::BasicBulkSection<Dim>& section : m.sections)
    for (const mesh::CellRef& ref : section.cells)
      if (!removed.contains({ref.block, ref.cell}))
        for (const Index n : model::cell_nodes(m.mesh, ref).nodes) bare.erase(n);
  return bare;
}

/// What two laws remember, one after the other.
bool remembers_the_same(const material::Law& one, const material::Law& other) {
  return std::ranges::equal(material::memory_of(one), material::memory_of(other), {},
                            &material::Remembered::name, &material::Remembered::name) &&
         material::takes_temperature(one) == material::takes_temperature(other) &&
         (material::memory_of(one).empty() || material::key_of(one) == material::key_of(other));
}

template <int Dim>
void change_material(BuildContext<Dim>& c, const MaterialChange& change,
                     model::BasicBodyChange<Dim>& to) {
  const Material* const material = c.description.find_material(change.material.value);
  if (!material) {
    std::vector<std::string> names;
    for (const Material& one : c.description.materials) names.push_back(one.name.value);
    throw core::InputError(change.material.mark,
                           core::unknown_name_message("material", change.material.value, names));
  }
  for (const auto& part : cells_on(c, change.on)) {
    const model::BasicBulkSection<Dim>& section = c.model().sections[part.section];
    const Section& of = c.description.sections[part.section];
    if (part.cells.size() != section.cells.size())
      throw core::InputError(change.on.mark,
                             fmt::format("'{}' has some cells of the section on '{}' only: give "
                                         "these a section of their own",
                                         change.on.value, section.name));
    typename model::BasicBodyChange<Dim>::Material now{
        part.section, make_solid_section<Dim>(of, *material), material->name.value};
    now.now.formulation = section.section.formulation;
    const bool finite = of.kinematics.value == Kinematics::finite;
    if (material::finite_strain(now.now.law) != finite)
      throw core::InputError(
          change.material.mark,
          fmt::format("the section on '{}' has {} strains, which material '{}' "
                      "is not for",
                      section.name, finite ? "finite" : "small", change.material.value));
    if (!remembers_the_same(section.section.law, now.now.law) ||
        material::strains_of(section.section.expansion) != material::strains_of(now.now.expansion))
      throw core::InputError(
          change.material.mark,
          fmt::format("material '{}' remembers something else than that of the section on '{}': "
                      "one elastic law may take the place of another, one elastoplastic of "
                      "another, both with an expansion or both without",
                      change.material.value, section.name));
    if constexpr (Dim == 2)
      for (const mesh::CellRef& ref : section.cells)
        check_plane(c, of, now.now, change.material, ref);
    if (!section.initial.empty()) require_hooke(now.now, section.name, change.material.mark);
    check_durations(c.description, *material);
    to.materials.push_back(std::move(now));
  }
}

bool changes_bodies(const Step& step) {
  return !step.remove.empty() || !step.add.empty() || !step.materials.empty() ||
         !step.equations.empty() || !step.free_equations.empty() || step.frees_all_equations;
}

/// Vibrations that move are those of the bodies as they were; explicit steps take bodies once.
void require_possible(const Description& d, const Step& step) {
  if (!changes_bodies(step)) return;
  const auto mark = !step.remove.empty()           ? step.remove.front().mark
                    : !step.add.empty()            ? step.add.front().mark
                    : !step.materials.empty()      ? step.materials.front().mark
                    : !step.equations.empty()      ? step.equations.front().mark
                    : !step.free_equations.empty() ? step.free_equations.front().mark
                                                   : *step.frees_all_equations;
  if (step.modal || step.harmonic)
    throw core::InputError(mark,
                           "bodies and equations do not change in steps along vibrations, which "
                           "were found without");
  for (const Step& other : d.steps)
    if (other.dynamics && other.dynamics->scheme == SchemeWord::central_differences)
      throw core::InputError(mark,
                             "bodies and equations do not change in analyses with explicit steps");
  if (!d.cyclic_symmetry.empty())
    throw core::InputError(mark, "bodies and equations of a cyclic symmetry do not change");
}

}  // namespace

template <int Dim>
void build_body_changes(BuildContext<Dim>& c) {
  std::set<CellKey> removed;
  const std::vector<Step>& steps = c.description.steps;
  for (std::size_t s = 0; s < steps.size(); ++s) {
    const Step& step = steps[s];
    require_possible(c.description, step);
    model::BasicBodyChange<Dim> change;
    change.step = s;
    for (const CellChange& one : step.remove) take_away(c, one, removed, change);
    for (const CellChange& one : step.add) bring_back(c, one, removed, change);
    for (const MaterialChange& one : step.materials) change_material(c, one, change);
    change.equations = equations_from(c, s);
    c.removed_cells.push_back(removed);
    c.bare_nodes.push_back(bare_nodes_of(c.model(), removed));
    if (!c.bare_nodes.back().empty() && !step.remove.empty())
      c.built.warnings.push_back(
          fmt::format("step '{}' takes all cells from {} nodes: they stay where they are, or move "
                      "as they are told, and forces on them have no effect",
                      step.name.value, c.bare_nodes.back().size()));
    if (changes_bodies(step) || change.equations)
      c.model().body_changes.push_back(std::move(change));
  }
}

template void build_body_changes(BuildContext<2>&);
template void build_body_changes(BuildContext<3>&);

}  // namespace osculate::deck
