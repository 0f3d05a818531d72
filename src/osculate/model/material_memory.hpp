#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "osculate/model/bulk.hpp"

namespace osculate::model {

/// Where the material points of all cells keep what they remember: numbers one after the other, in
/// the order of sections, cells and points. Cells of laws that remember nothing have none.
struct CellMemory {
  std::size_t first = 0;  ///< of the cell's numbers
  std::size_t size = 0;   ///< numbers a point
  std::size_t count = 0;  ///< of the cell

  /// `next` may be empty: what comes next is not asked for. `duration` of the increment.
  [[nodiscard]] material::Memory of(std::span<const double> committed, std::span<double> next = {},
                                    double duration = 0) const {
    if (size == 0) return {};
    return {committed.data() + first, next.empty() ? nullptr : next.data() + first, size, duration};
  }
};

/// The next cell after `before`.
///
/// Tested by  tests/unit/model/test_material_memory.cpp
template <int Dim>
[[nodiscard]] CellMemory memory_after(const CellMemory& before,
                                      const BasicBulkSection<Dim>& section, cell::CellType type) {
  CellMemory here{before.first + before.count, material::memory_of(section.section.law).size()};
  if (here.size > 0) here.count = here.size * solid::point_count(section_on(section, type), type);
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
