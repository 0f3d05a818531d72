#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "osculate/model/bulk.hpp"

namespace osculate::model {

/// Where the material points of all cells keep what they remember: numbers one after the other, in
/// the order of sections, cells and points. Cells of laws that remember nothing have none. Behind
/// them stand the strains by the temperature of cells that expand, one or six a point, then the
/// temperatures of those whose constants depend on them, and last the displacements of the nodes at
/// which cells that come back are free of strain.
struct CellMemory {
  std::size_t first = 0;    ///< of the cell's numbers
  std::size_t size = 0;     ///< numbers of the law a point
  std::size_t count = 0;    ///< of the cell
  std::size_t points = 0;   ///< where there are numbers
  std::size_t strains = 0;  ///< by the temperature a point: 0, 1, or 6
  bool warms = false;
  std::size_t nodes = 0;            ///< displacements of a cell that comes back
  std::size_t index = 0;            ///< of the cell in its section
  const double* initial = nullptr;  ///< strains of the undeformed body
  bool removed = false;             ///< the cell is not there now

  /// `next` may be empty: what comes next is not asked for. `duration` of the increment.
  [[nodiscard]] material::Memory of(std::span<const double> committed, std::span<double> next = {},
                                    double duration = 0) const {
    material::Memory memory;
    memory.initial = initial;
    if (count == 0) return memory;
    memory.committed = committed.data() + first;
    memory.next = next.empty() ? nullptr : next.data() + first;
    memory.size = size;
    memory.duration = duration;
    if (nodes > 0) memory.origin = memory.committed + count - nodes;
    const double* const behind = (memory.next ? memory.next : memory.committed) + size * points;
    if (strains > 0) {
      memory.expansion = behind;
      memory.strains = strains;
    }
    if (!warms) return memory;
    memory.temperature = behind + strains * points;
    memory.temperature_before = memory.committed + (size + strains) * points;
    return memory;
  }
  /// The displacements of a cell that comes back.
  [[nodiscard]] std::span<double> origin(std::span<double> of) const {
    return of.subspan(first + count - nodes, nodes);
  }
  /// The strains by the temperature.
  [[nodiscard]] std::span<double> expansion(std::span<double> of) const {
    return of.subspan(first + size * points, strains * points);
  }
  [[nodiscard]] std::span<double> temperature(std::span<double> of) const {
    return of.subspan(first + (size + strains) * points, warms ? points : 0);
  }
};

/// The next cell after `before`, number `index` of its section.
///
/// Tested by  tests/unit/deck/test_plasticity.cpp, test_body_changes.cpp
template <int Dim>
[[nodiscard]] CellMemory memory_after(const CellMemory& before,
                                      const BasicBulkSection<Dim>& section, std::size_t index,
                                      cell::CellType type) {
  CellMemory here{before.first + before.count, material::memory_of(section.section.law).size()};
  here.index = index;
  here.removed = is_removed(section, index);
  if (!section.initial.empty() && !section.initial[index].empty())
    here.initial = section.initial[index].data();
  if (!section.returns.empty() && section.returns[index] != 0)
    here.nodes = Dim * static_cast<std::size_t>(cell::info(type).nodes);
  here.strains = material::strains_of(section.section.expansion);
  here.warms = material::takes_temperature(section.section.law);
  const std::size_t each = here.size + here.strains + (here.warms ? 1 : 0);
  if (each > 0) here.points = solid::point_count(section_on(section, type), type);
  here.count = each * here.points + here.nodes;
  return here;
}

/// Calls visit(section, cell, memory) for all cells.
template <int Dim, class Visit>
void for_each_cell(const BasicModel<Dim>& model, const Visit& visit) {
  CellMemory memory;
  for (const BasicBulkSection<Dim>& section : model.sections)
    for (std::size_t i = 0; i < section.cells.size(); ++i) {
      memory = memory_after(memory, section, i, cell_nodes(model.mesh, section.cells[i]).type);
      visit(section, section.cells[i], memory);
    }
}

/// How many numbers the material points of all cells remember.
template <int Dim>
[[nodiscard]] std::size_t memory_size(const BasicModel<Dim>& model) {
  std::size_t size = 0;
  for_each_cell(model, [&](const auto&, const auto&, const CellMemory& m) { size += m.count; });
  return size;
}

}  // namespace osculate::model
