#include "osculate/model/changing_unknowns.hpp"

#include <algorithm>

#include "osculate/model/bulk.hpp"
#include "osculate/model/marks.hpp"

namespace osculate::model {
namespace {

template <int Dim>
void mark_cells(const BasicModel<Dim>& model, Marks<Dim>& marks) {
  for (const BasicBulkSection<Dim>& section : model.sections)
    for (const mesh::CellRef& cell : section.cells) {
      if (!is_constant(model, marks.dofs, section, cell))
        marks.nodes(cell_nodes(model.mesh, cell).nodes);
      marks.of_cells = marks.of_cells || !is_linear(section);
    }
}

}  // namespace

template <int Dim>
bool is_linear(const BasicBulkSection<Dim>& section) {
  return section.section.kinematics == solid::Kinematics::small &&
         material::linear(section.section.law);
}

template <int Dim>
bool is_constant(const BasicModel<Dim>& model, const BasicDofSpace<Dim>& dofs,
                 const BasicBulkSection<Dim>& section, const mesh::CellRef& cell) {
  return is_linear(section) &&
         std::ranges::none_of(cell_nodes(model.mesh, cell).nodes, [&](Index n) {
           for (int i = 0; i < Dim; ++i)
             if (dofs.turns(dofs.node_dof(n, i))) return true;
           return false;
         });
}

template <int Dim>
std::vector<Index> changing_unknowns(const BasicModel<Dim>& model, const BasicDofSpace<Dim>& dofs,
                                     Index multipliers) {
  constexpr std::size_t fewest = 4;
  Marks<Dim> marks{model, dofs};
  mark_contact(model, marks);
  mark_cells(model, marks);
  const bool changes = !model.pair_changes.empty() || !model.springs.empty() ||
                       !model.node_constraints.empty() || marks.of_contact || marks.of_cells;
  if (!changes) return {};  // one iteration is all it takes
  mark_connectors(model, marks);
  for (const Step& step : model.steps) {
    for (const PressureLoad& load : step.pressure)
      for (const PressureLoad::Facet& facet : load.facets) marks.nodes(facet.nodes);
    for (const CentrifugalLoad& load : step.centrifugal)
      for (const CentrifugalLoad::Cell& cell : *load.cells)
        if (cell.moves) marks.nodes(cell.nodes);
  }
  for (Index b = 0; b < dofs.bodies(); ++b)
    for (int k = 0; k < body::motions<Dim>; ++k) marks.dof(dofs.body_dof(b, k));
  std::vector<Index> out;
  for (std::size_t u = 0; u < marks.of_unknown.size(); ++u)
    if (marks.of_unknown[u]) out.push_back(static_cast<Index>(u));
  for (Index m = 0; m < multipliers; ++m) out.push_back(dofs.unknowns() + m);
  if (fewest * out.size() > marks.of_unknown.size()) out.clear();
  return out;
}

template bool is_linear(const BulkSection&);
template bool is_linear(const BulkSection3&);
template bool is_constant(const Model&, const DofSpace&, const BulkSection&, const mesh::CellRef&);
template bool is_constant(const Model3&, const DofSpace3&, const BulkSection3&,
                          const mesh::CellRef&);
template std::vector<Index> changing_unknowns(const Model&, const DofSpace&, Index);
template std::vector<Index> changing_unknowns(const Model3&, const DofSpace3&, Index);

}  // namespace osculate::model
