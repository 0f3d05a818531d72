#include "osculate/deck/parse_parts.hpp"

namespace osculate::deck {

DynamicsDescription parse_dynamics(const Value& v) {
  DynamicsDescription d;
  d.mark = v.mark;
  const Value& scheme = v.at("scheme");
  if (const Value* const hht = scheme.find("hht")) {
    d.scheme = SchemeWord::hht;
    d.parameter = hht->at("alpha").number;
  } else if (const Value* const alpha = scheme.find("generalized_alpha")) {
    d.scheme = SchemeWord::generalized_alpha;
    d.parameter = alpha->at("radius").number;
  }
  d.impact = word_of<ImpactWord>(v, "impact").value;
  d.mass = word_of<MassWord>(v, "mass").value;
  d.impact_times = word_of<ImpactTimesWord>(v, "impact_times").value;
  const Value& damping = v.at("damping");
  d.damping_mass = damping.at("mass").number;
  d.damping_stiffness = damping.at("stiffness").number;
  return d;
}

}  // namespace osculate::deck
