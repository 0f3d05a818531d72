#include "osculate/model/temperatures.hpp"

#include <algorithm>

#include "osculate/model/material_memory.hpp"

namespace osculate::model {

std::vector<double> Temperatures::at(double fraction) const {
  std::vector<double> now = start;
  for (const Change& change : changes)
    for (const Index node : change.nodes) {
      const auto n = static_cast<std::size_t>(node);
      now[n] = Ramp{start[n], change.target, change.amplitude}.value(fraction);
    }
  return now;
}

template <int Dim>
void expand(const BasicModel<Dim>& model, const Temperatures& temperature, double fraction,
            std::span<double> memory) {
  if (temperature.start.empty()) return;
  const std::vector<double> nodal = temperature.at(fraction);
  std::vector<double> now, before;
  for_each_cell(model, [&](const auto& section, const mesh::CellRef& ref, const CellMemory& m) {
    if (!m.expands) return;
    const CellNodes cell = cell_nodes(model.mesh, ref);
    now.clear();
    before.clear();
    for (const Index node : cell.nodes) {
      now.push_back(nodal[static_cast<std::size_t>(node)]);
      before.push_back(model.initial_temperature[static_cast<std::size_t>(node)]);
    }
    const auto strains =
        solid::expansion_at_points(section_on(section, cell.type), cell.type, now, before);
    const std::span<double> to = m.expansion(memory);
    std::copy_n(strains.begin(), to.size(), to.begin());
  });
}

template void expand(const Model&, const Temperatures&, double, std::span<double>);
template void expand(const Model3&, const Temperatures&, double, std::span<double>);

}  // namespace osculate::model
