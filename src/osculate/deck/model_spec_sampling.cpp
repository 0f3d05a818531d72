// Where the slave side of a pair is tested for contact.
#include "osculate/deck/bind.hpp"
#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
namespace {

Spec sampling_spec() {
  const Spec points = integer("Points per direction of a facet.").at_most(20);
  const Spec parts = integer("Equal parts per direction of a facet, each with its own points.")
                         .at_least(1)
                         .at_most(50)
                         .otherwise("1")
                         .such_as("2");
  const Spec segments =
      boolean(
          "A facet that edges of the master cross at the start has these points on each of its "
          "parts (segment-based integration).")
          .otherwise("false")
          .such_as("true");
  return either(
             "Where the slave side is tested for contact.",
             {choice(
                  "Points of the slave side.",
                  {word("auto", SamplingRule::automatic,
                        "with normal: {penalty: auto}, where the master has a mesh or nodes would "
                        "scatter: Gauss points, 2 per direction, 3 on second-order facets; "
                        "else, with two passes, edges, weight: node, explicit dynamics "
                        "and tractions that are corrected or unknown: nodes"),
                   word("nodes", SamplingRule::nodes, "the slave nodes"),
                   word("mortar", SamplingRule::mortar,
                        "integrals over the overlaps of slave and master facets, "
                        "weighted by dual functions of the slave's nodes")}),
              map("Points of a quadrature rule on the slave facets (segment to segment).",
                  {optional("gauss", Spec(points).at_least(1).such_as("2")),
                   optional("lobatto", Spec(points).at_least(2).such_as("5")),
                   optional("subdomains", parts), optional("segments", segments)})
                  .with(Group::Rule::exactly_one, {"gauss", "lobatto"})})
      .otherwise("auto")
      .such_as("{lobatto: 5, subdomains: 2}");
}

Marked<Sampling> sampling_of(const Value& v) {
  if (v.alternative == 0) return {{word_of<SamplingRule>(v).value}, v.mark};
  const Value* const gauss = v.find("gauss");
  return {{gauss ? SamplingRule::gauss : SamplingRule::lobatto,
           integer_of(gauss ? *gauss : v.at("lobatto")).value, integer_of(v.at("subdomains")).value,
           v.at("segments").code != 0},
          v.mark};
}

}  // namespace

BoundKey<Contact> sampling_key() {
  return {optional("sampling", sampling_spec()),
          [](Contact& c, const Value& v) { c.sampling = sampling_of(v); }};
}

}  // namespace osculate::deck
