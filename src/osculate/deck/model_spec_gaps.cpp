// `initial` of a contact pair: what becomes of the gaps that the mesh has.
#include "osculate/deck/bind.hpp"
#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
namespace {

Spec initial_spec() {
  const Spec tolerance =
      number("Initial gaps up to this are closed too.").in("length").at_least(0).such_as("0.01");
  const Spec clearance =
      number(
          "Every gap over the master begins with this, whatever it is in the mesh; negative: an "
          "overlap.")
          .in("length")
          .such_as("0.01");
  const Spec nodes = text("Adjust these slave nodes alone, whatever their gap.").such_as("rim");
  return either("What becomes of slave points that are inside the master from the beginning.",
                {choice("One of these.",
                        {word("ignore", InitialWord::ignore, "they are pushed out at once"),
                         word("ramp", InitialWord::ramp,
                              "the overlap is let in over the first step, as for a press fit"),
                         word("keep", InitialWord::keep,
                              "the overlap never counts: gaps are measured from it"),
                         word("adjust", InitialWord::adjust,
                              "the slave nodes are moved onto the master without strain, before "
                              "anything is computed")}),
                 map("Adjust with a tolerance, or certain nodes; or a clearance that is given.",
                     {optional("adjust", tolerance), optional("nodes", nodes),
                      optional("clearance", clearance)})
                     .with(Group::Rule::exactly_one, {"adjust", "nodes", "clearance"})})
      .otherwise("ignore")
      .such_as("ramp");
}

void read_initial(Contact& c, const Value& v) {
  if (v.alternative == 0) {
    c.initial = word_of<InitialWord>(v);
    return;
  }
  c.initial = {InitialWord::adjust, v.mark};
  if (const Value* const clearance = v.find("clearance")) {
    c.initial.value = InitialWord::clearance;
    c.initial_clearance = number_of(*clearance).value;
    return;
  }
  if (const Value* const nodes = v.find("nodes"))
    c.initial_nodes = name_of(*nodes);
  else
    c.initial_tolerance = number_of(v.at("adjust")).value;
}

}  // namespace

BoundKey<Contact> initial_gaps_key() { return {optional("initial", initial_spec()), read_initial}; }

}  // namespace osculate::deck
