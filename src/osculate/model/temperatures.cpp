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
void warm(const BasicModel<Dim>& model, const Temperatures& temperature, double fraction,
          std::span<double> memory) {
  if (temperature.start.empty()) return;
  const std::vector<double> nodal = temperature.at(fraction);
  std::vector<double> now, before;
  for_each_cell(model, [&](const auto& section, const mesh::CellRef& ref, const CellMemory& m) {
    if (m.strains == 0 && !m.warms) return;
    const CellNodes cell = cell_nodes(model.mesh, ref);
    now.clear();
    before.clear();
    for (const Index node : cell.nodes) {
      now.push_back(nodal[static_cast<std::size_t>(node)]);
      before.push_back(model.initial_temperature[static_cast<std::size_t>(node)]);
    }
    const auto of = section_on(section, cell.type);
    const auto write = [](const auto& values, std::span<double> to) {
      std::copy_n(values.begin(), to.size(), to.begin());
    };
    if (m.strains > 0)
      write(solid::expansion_at_points(of, cell.type, reference_of(model, cell.nodes), now, before),
            m.expansion(memory));
    if (m.warms) write(solid::values_at_points(of, cell.type, now), m.temperature(memory));
  });
}

template void warm(const Model&, const Temperatures&, double, std::span<double>);
template void warm(const Model3&, const Temperatures&, double, std::span<double>);

}  // namespace osculate::model
