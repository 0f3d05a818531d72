#include "osculate/result/without_force.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "osculate/core/text.hpp"
#include "osculate/model/supports.hpp"

namespace osculate::result {

namespace {

/// Whether anything but prescriptions and contact may hold a body: what `supports` does not judge.
template <int Dim>
bool has_other_holds(const model::BasicModel<Dim>& model) {
  return !model.equations.empty() || !model.node_constraints.empty() || !model.springs.empty() ||
         std::ranges::any_of(model.body_of_node, [](Index body) { return body >= 0; }) ||
         std::ranges::any_of(
             model.pairs, [](const auto& p) { return pairing::held_from_start(p.definition); }) ||
         std::ranges::any_of(model.steps, [](const auto& s) { return s.dynamics.has_value(); });
}

/// Bodies of this pair that no step holds in any way.
template <int Dim>
std::vector<std::string> loose_bodies(const model::BasicModel<Dim>& model,
                                      const std::string& pair) {
  std::vector<std::string> loose;
  for (const model::Support& body : model::supports(model, model.steps.back()))
    if (body.all_free && std::ranges::find(body.contact, pair) != body.contact.end())
      loose.push_back(body.body);
  for (const model::Step& step : model.steps)
    for (const model::Support& body : model::supports(model, step))
      if (!body.all_free || body.held > 0) std::erase(loose, body.body);
  for (std::string& name : loose) name = "'" + name + "'";
  return loose;
}

}  // namespace

template <int Dim>
std::string without_force(const model::BasicModel<Dim>& model,
                          const model::BasicContactPair<Dim>& pair, const Penetration& found) {
  constexpr double rounding = 1e-12;  // of the height of the cells: a pressure of some 1e-11 E
  // An automatic penalty is one of the bodies' stiffness: then no depth is no pressure.
  if (!found.closed || found.share > rounding || !(pair.height > 0) || !pair.automatic ||
      !pair.group.empty() || pairing::by_multipliers(pair.definition) || has_other_holds(model))
    return {};
  const std::vector<std::string> loose = loose_bodies(model, pair.name);
  if (loose.empty()) return {};
  return fmt::format(
      "warning: contact '{}' touched, but pressed nowhere: nothing but contact holds {}, and no "
      "load presses it on; prescribe what holds it (`osculate check` lists the supports)",
      pair.name, core::join_with(loose, "and"));
}

template std::string without_force(const model::Model&, const model::ContactPair&,
                                   const Penetration&);
template std::string without_force(const model::Model3&, const model::ContactPair3&,
                                   const Penetration&);

}  // namespace osculate::result
