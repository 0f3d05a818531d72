#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "osculate/model/bulk.hpp"

namespace osculate::model {

/// Where the material points of all cells keep what they remember: numbers one after the other, in
/// the order of sections, cells and points. Cells of laws that remember nothing have none. Behind
/// them stand the strains by the temperature, one a point, of cells that expand, and then the
/// temperatures of those whose constants depend on them.
struct CellMemory {
  std::size_t first = 0;   ///< of the cell's numbers
  std::size_t size = 0;    ///< numbers of the law a point
  std::size_t count = 0;   ///< of the cell
  std::size_t points = 0;  ///< where there are numbers
  bool expands = false, warms = false;

  /// `next` may be empty: what comes next is not asked for. `duration` of the increment.
  [[nodiscard]] material::Memory of(std::span<const double> committed, std::span<double> next = {},
                                    double duration = 0) const {
    if (count == 0) return {};
    material::Memory memory{committed.data() + first, next.empty() ? nullptr : next.data() + first,
                            size, duration};
    const double* const behind = (memory.next ? memory.next : memory.committed) + size * points;
    if (expands) memory.expansion = behind;
    if (!warms) return memory;
    const std::size_t strains = expands ? points : 0;
    memory.temperature = behind + strains;
    memory.temperature_before = memory.committed + size * points + strains;
    return memory;
  }
  /// The strains by the temperature.
  [[nodiscard]] std::span<double> expansion(std::span<double> of) const {
    return of.subspan(first + size * points, expands ? points : 0);
  }
  [[nodiscard]] std::span<double> temperature(std::span<double> of) const {
    return of.subspan(first + (size + (expands ? 1 : 0)) * points, warms ? points : 0);
  }
};

/// The next cell after `before`.
///
/// Tested by  tests/unit/model/test_material_memory.cpp
template <int Dim>
[[nodiscard]] CellMemory memory_after(const CellMemory& before,
                                      const BasicBulkSection<Dim>& section, cell::CellType type) {
  CellMemory here{before.first + before.count, material::memory_of(section.section.law).size()};
  here.expands = !section.section.expansion.table.empty();
  here.warms = material::takes_temperature(section.section.law);
  const std::size_t each = here.size + (here.expands ? 1 : 0) + (here.warms ? 1 : 0);
  if (each == 0) return here;
  here.points = solid::point_count(section_on(section, type), type);
  here.count = each * here.points;
  return here;
}

/// Calls visit(section, cell, memory) for all cells.
template <int Dim, class Visit>
void for_each_cell(const BasicModel<Dim>& model, const Visit& visit) {
  CellMemory memory;
  for (const BasicBulkSection<Dim>& section : model.sections)
    for (const mesh::CellRef& ref : section.cells) {
      memory = memory_after(memory, section, cell_nodes(model.mesh, ref).type);
      visit(section, ref, memory);
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
