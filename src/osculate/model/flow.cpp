#include "osculate/model/flow.hpp"

#include <algorithm>

#include "osculate/model/material_memory.hpp"

namespace osculate::model {
namespace {

/// Place of the equivalent plastic strain among what a law remembers; -1: it does not flow.
int place_of_flow(const material::Law& law) {
  const auto names = material::memory_of(law);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i].name == "PEEQ") return static_cast<int>(i);
  return -1;
}

}  // namespace

template <int Dim>
double largest_flow(const BasicModel<Dim>& model, std::span<const double> before,
                    std::span<const double> after) {
  double largest = 0;
  const bool began = !before.empty();
  for_each_cell(model, [&](const BasicBulkSection<Dim>& section, const mesh::CellRef&,
                           const CellMemory& memory) {
    if (section.section.kinematics != solid::Kinematics::finite || memory.removed) return;
    const int place = place_of_flow(section.section.law);
    if (place < 0) return;
    for (std::size_t p = 0; p < memory.points; ++p) {
      const std::size_t at = memory.first + p * memory.size + static_cast<std::size_t>(place);
      if (at < after.size()) largest = std::max(largest, after[at] - (began ? before[at] : 0.0));
    }
  });
  return largest;
}

template double largest_flow(const Model&, std::span<const double>, std::span<const double>);
template double largest_flow(const Model3&, std::span<const double>, std::span<const double>);

}  // namespace osculate::model
