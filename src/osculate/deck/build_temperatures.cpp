// Temperatures of nodes: at first, and over the steps.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "osculate/deck/build_context.hpp"

namespace osculate::deck {
namespace {

/// Temperatures that one entry gives: nodes that have the same one.
template <int Dim>
std::map<double, std::vector<Index>> heated_nodes(const BuildContext<Dim>& c, const Load& load) {
  const std::vector<Index>& nodes = c.set(load.on).nodes;
  if (nodes.empty())
    throw core::InputError(load.on.mark,
                           "set '" + load.on.value + "' has no nodes to have a temperature");
  const auto part = [&](std::size_t k) { return load.values[k] ? load.values[k]->value : 0; };
  const bool graded = part(1) != 0 || part(2) != 0;
  std::map<double, std::vector<Index>> out;
  std::vector<bool> here(c.model().reference.size());
  for (const Index node : nodes) here[static_cast<std::size_t>(node)] = true;
  bool any = false;
  for (const mesh::Expanded& one : c.model().mesh.expanded) {
    const bool named = here[static_cast<std::size_t>(one.node)];
    if (!named && !here[static_cast<std::size_t>(one.of)]) continue;
    any = true;
    here[static_cast<std::size_t>(one.node)] = false;
    out[part(0) + part(1) * one.height[0] + part(2) * one.height[1]].push_back(one.node);
  }
  for (const Index node : nodes)
    if (here[static_cast<std::size_t>(node)]) out[part(0)].push_back(node);
  if (!any && graded)
    throw core::InputError(load.mark,
                           fmt::format("gradients of the temperature are for nodes of shells and "
                                       "beams of an input file: '{}' has none",
                                       load.on.value));
  return out;
}

bool any_temperature(const Description& d) {
  if (!d.initial_temperature.empty()) return true;
  return std::any_of(d.steps.begin(), d.steps.end(),
                     [](const Step& s) { return !s.temperature.empty(); });
}

}  // namespace

template <int Dim>
void build_initial_temperature(BuildContext<Dim>& c) {
  const auto warms = [](const Material& m) { return material::over_temperature(m.law.value); };
  if (!any_temperature(c.description)) {
    for (const Material& m : c.description.materials)
      if (warms(m))
        throw core::InputError(
            m.law.mark,
            fmt::format("material '{}' depends on the temperature, which is given nowhere: "
                        "add `initial_temperature`",
                        m.name.value));
    return;
  }
  std::vector<double>& of = c.model().initial_temperature;
  of.assign(c.model().reference.size(), 0.0);
  for (const Load& load : c.description.initial_temperature)
    for (const auto& [value, nodes] : heated_nodes(c, load))
      for (const Index node : nodes) of[static_cast<std::size_t>(node)] = value;
  const auto feels = [](const Material& m) {
    return material::strains_of(m.expansion) > 0 || material::takes_temperature(m.law.value);
  };
  const std::vector<Material>& materials = c.description.materials;
  if (std::none_of(materials.begin(), materials.end(), feels))
    c.built.warnings.emplace_back(
        "temperatures have no effect: no material has an `expansion` or a "
        "table over the temperature");
}

template <int Dim>
void build_temperatures(const BuildContext<Dim>& c, const Step& step, std::vector<double>& now,
                        model::Step& out) {
  out.temperature.start = now;
  for (const Load& load : step.temperature) {
    model::Amplitude amplitude;
    if (load.amplitude) amplitude = c.description.find_amplitude(load.amplitude->value)->points;
    for (auto& [value, nodes] : heated_nodes(c, load))
      out.temperature.changes.push_back({std::move(nodes), value, amplitude});
  }
  now = out.temperature.at(1);
}

template void build_initial_temperature(BuildContext<2>&);
template void build_initial_temperature(BuildContext<3>&);
template void build_temperatures(const BuildContext<2>&, const Step&, std::vector<double>&,
                                 model::Step&);
template void build_temperatures(const BuildContext<3>&, const Step&, std::vector<double>&,
                                 model::Step&);

}  // namespace osculate::deck
