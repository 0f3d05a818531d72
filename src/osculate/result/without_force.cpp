#include "osculate/result/without_force.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "osculate/core/text.hpp"
#include "osculate/model/supports.hpp"

namespace osculate::result {

template <int Dim>
std::string without_force(const model::BasicModel<Dim>& model,
                          const model::BasicContactPair<Dim>& pair, const Penetration& found) {
  constexpr double rounding = 1e-12;  // of the height of the cells: a pressure of some 1e-11 E
  const pairing::PairDefinition<Dim>& definition = pair.definition;
  if (!found.closed || found.share > rounding || !(pair.height > 0) || !pair.group.empty() ||
      pairing::held_from_start(definition) || pairing::by_multipliers(definition))
    return {};
  if (std::ranges::any_of(model.steps, [](const auto& step) { return step.dynamics.has_value(); }))
    return {};
  std::vector<std::string> loose;
  for (const model::Support& body : model::supports(model, model.steps.back()))
    if (body.held == 0 && std::ranges::find(body.contact, pair.name) != body.contact.end())
      loose.push_back("'" + body.body + "'");
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
