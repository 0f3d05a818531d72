#include "osculate/deck/parse_parts.hpp"
#include "osculate/solve/central_differences.hpp"

namespace osculate::deck {

namespace {

/// What central differences do not do.
void check_explicit(const Value& v, const DynamicsDescription& d) {
  if (v.at("mass").given && d.mass == MassWord::consistent)
    throw core::InputError(
        v.at("mass").mark,
        "central differences need masses at the nodes: lumped, which is what they "
        "have without this key");
  for (const char* const key : {"impact", "impact_times"})
    if (v.at(key).given)
      throw core::InputError(v.at(key).mark,
                             "is of the implicit schemes; central differences take contact as any "
                             "other force");
  if (d.time_steps)
    throw core::InputError(
        d.time_steps->mark,
        "is of the implicit schemes; central differences take their stable step, "
        "or less by `scheme: {central_differences: {step}}`");
  if (d.damping_stiffness > 0)
    throw core::InputError(v.at("damping").at("stiffness").mark,
                           "damping by the stiffness makes the stable step of central differences "
                           "far shorter; they take damping by the mass only");
}

}  // namespace

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
  } else if (const Value* const central = scheme.find("central_differences")) {
    d.scheme = SchemeWord::central_differences;
    d.safety = central->at("safety").number;
    if (const Value* const step = central->find("step")) d.step = step->number;
  } else if (scheme.entries.empty()) {
    d.scheme = word_of<SchemeWord>(scheme).value;
    d.safety = solve::CentralDifferences{}.safety;
  }
  d.impact = word_of<ImpactWord>(v, "impact").value;
  d.mass = word_of<MassWord>(v, "mass").value;
  d.impact_times = word_of<ImpactTimesWord>(v, "impact_times").value;
  const Value& damping = v.at("damping");
  d.damping_mass = damping.at("mass").number;
  d.damping_stiffness = damping.at("stiffness").number;
  if (const Value* const steps = v.find("time_steps"))
    d.time_steps = {steps->mark, steps->at("error").number, number_if(*steps, "smallest")};
  if (d.scheme == SchemeWord::central_differences) check_explicit(v, d);
  return d;
}

}  // namespace osculate::deck
