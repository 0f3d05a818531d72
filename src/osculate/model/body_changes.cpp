#include "osculate/model/body_changes.hpp"

#include <algorithm>

#include "osculate/model/material_memory.hpp"

namespace osculate::model {
namespace {

/// Those that are there from now on, or are not.
template <int Dim>
void set_removed(const std::vector<typename BasicBodyChange<Dim>::Cells>& of, bool removed,
                 bool without_strain, BasicModel<Dim>& now) {
  for (const typename BasicBodyChange<Dim>::Cells& part : of) {
    BasicBulkSection<Dim>& section = now.sections[part.section];
    section.removed.resize(section.cells.size(), 0);
    for (const std::size_t cell : part.cells) {
      section.removed[cell] = removed ? 1 : 0;
      if (without_strain && !section.initial.empty()) section.initial[cell].clear();
    }
  }
}

}  // namespace

template <int Dim>
bool bodies_change(const BasicModel<Dim>& original, std::size_t step) {
  return std::ranges::any_of(original.body_changes,
                             [&](const auto& change) { return change.step == step; });
}

template <int Dim>
void change_bodies(const BasicModel<Dim>& original, std::size_t step, BasicModel<Dim>& now) {
  now.sections = original.sections;
  now.equations = original.equations;
  for (const BasicBodyChange<Dim>& change : original.body_changes) {
    if (change.step > step) continue;
    for (const typename BasicBodyChange<Dim>::Material& m : change.materials) {
      now.sections[m.section].section = m.now;
      now.sections[m.section].material = m.name;
    }
    set_removed(change.removed, true, false, now);
    set_removed(change.renewed, false, true, now);
    set_removed(change.restored, false, false, now);
    if (change.equations) now.equations = *change.equations;
  }
}

template <int Dim>
BasicState<Dim> begin_bodies(const BasicModel<Dim>& original, std::size_t step,
                             BasicState<Dim> state) {
  for (const BasicBodyChange<Dim>& change : original.body_changes) {
    if (change.step != step || change.renewed.empty()) continue;
    std::vector<std::vector<char>> renewed(original.sections.size());
    for (const auto& part : change.renewed) {
      std::vector<char>& of = renewed[part.section];
      of.resize(original.sections[part.section].cells.size(), 0);
      for (const std::size_t cell : part.cells) of[cell] = 1;
    }
    const BasicBulkSection<Dim>* const first = original.sections.data();
    for_each_cell(
        original, [&](const auto& section, const mesh::CellRef& ref, const CellMemory& m) {
          const std::vector<char>& of = renewed[static_cast<std::size_t>(&section - first)];
          if (of.empty() || of[m.index] == 0) return;
          std::fill_n(state.memory.begin() + static_cast<std::ptrdiff_t>(m.first),
                      m.size * m.points, 0.0);
          std::size_t k = 0;
          const std::span<double> origin = m.origin(state.memory);
          for (const Index node : cell_nodes(original.mesh, ref).nodes)
            for (int i = 0; i < Dim; ++i) origin[k++] = state.u[Dim * node + i];
        });
  }
  return state;
}

template <int Dim>
void keep_memory(const BasicModel<Dim>& now, std::span<const double> committed,
                 std::span<double> next) {
  for_each_cell(now, [&](const auto&, const mesh::CellRef&, const CellMemory& m) {
    if (m.count == 0) return;
    const std::size_t kept = m.removed ? m.count : m.nodes;
    const std::size_t at = m.first + m.count - kept;
    std::copy_n(committed.begin() + static_cast<std::ptrdiff_t>(at), kept,
                next.begin() + static_cast<std::ptrdiff_t>(at));
  });
}

template bool bodies_change(const Model&, std::size_t);
template bool bodies_change(const Model3&, std::size_t);
template void change_bodies(const Model&, std::size_t, Model&);
template void change_bodies(const Model3&, std::size_t, Model3&);
template State begin_bodies(const Model&, std::size_t, State);
template State3 begin_bodies(const Model3&, std::size_t, State3);
template void keep_memory(const Model&, std::span<const double>, std::span<double>);
template void keep_memory(const Model3&, std::span<const double>, std::span<double>);

}  // namespace osculate::model
