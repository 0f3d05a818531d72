#include "osculate/deck/bind.hpp"
#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
namespace {

/// Elongations that increase.
void check_curve(const Value& v) {
  for (std::size_t i = 1; i < v.items.size(); ++i)
    if (!(v.items[i].items[0].number > v.items[i - 1].items[0].number))
      throw core::InputError(v.items[i].mark, "the elongations must increase");
}

void check_spring(const Value& v, const Spring& spring) {
  const bool curve = !spring.table.value.empty();
  const int laws = (curve ? 1 : 0) + (spring.stiffness ? 1 : 0) + (spring.gap ? 1 : 0);
  if (laws > 1)
    throw core::InputError(spring.gap ? spring.gap->mark : spring.table.mark,
                           "a spring has a stiffness, a table or a gap, not two of them");
  if (laws == 0 && !(spring.damping > 0))
    throw core::InputError(v.mark, "one of stiffness, table, gap and damping is missing");
}

BoundKey<Spring> gap_key() {
  using G = Spring::Gap;
  const BoundKeys<G> keys(
      {may(&G::clearance, "clearance",
           number("How much shorter it becomes until it is closed.").in("length").otherwise("0")),
       need(&G::stiffness, "stiffness",
            number("Force per length once it is closed.")
                .in("force/length")
                .above(0)
                .such_as("1e6")),
       need(&G::tension, "tension",
            number("Force that pulls what is apart, for want of a corner in the law: the smaller, "
                   "the sharper.")
                .in("force")
                .above(0)
                .such_as("1e-3"))});
  return {optional("gap", keys.spec("Free until it has closed, and stiff then, as CalculiX' "
                                    "gap elements.")
                              .such_as("{clearance: 0.5, stiffness: 1e6, tension: 1e-3}")),
          [keys](Spring& s, const Value& v) { s.gap = keys.read(v); }};
}

BoundKeys<Spring> keys_of_spring() {
  using S = Spring;
  const BoundKeys<EquationTerm> term = term_keys();
  return {
      {may(&S::between, "between",
           list("Two nodes, by the names of their sets: the spring acts along the line that joins "
                "them.",
                text("Set of one node.").such_as("left"))
               .count(2, 2)
               .such_as("[left, right]")),
       {optional("terms", list("Its elongation as the sum of these displacements: of one node a "
                               "spring to the ground.",
                               term.spec("One term of the elongation."))
                              .count(1)
                              .such_as("[{on: A, of: ux, factor: 1}]")),
        [term](S& s, const Value& v) { s.terms = term.read_all(v); }},
       may(&S::stiffness, "stiffness",
           number("Force per elongation.").in("force/length").above(0).such_as("10")),
       checked(may(&S::table, "table",
                   list("Force over elongation, by straight lines; constant beyond the ends.",
                        list("Elongation and force.", number("One of both.")).count(2, 2))
                       .count(2)
                       .such_as("[[-1, 0], [0, 0], [1, 25]]")),
               check_curve),
       gap_key(),
       may(&S::damping, "damping",
           number("Force per rate of the elongation, in steps with inertia.")
               .in("force time/length")
               .at_least(0)
               .otherwise("0")),
       may(&S::kinematics, "kinematics",
           choice("Of the line between two nodes.",
                  {word("finite", Kinematics::finite, "it turns with the nodes"),
                   word("small", Kinematics::small, "its direction stays")})
               .otherwise("finite")
               .such_as("small"))}};
}

}  // namespace

std::vector<BoundKey<Description>> spring_keys() {
  using M = PointMass;
  const BoundKeys<Spring> springs = keys_of_spring();
  const BoundKeys<M> masses(
      {on_key<M>("Set of nodes, of which each has the mass.", "tip"),
       need(&M::mass, "mass", number("The mass.").in("mass").above(0).such_as("2"))});
  return {
      {optional(
           "springs",
           list("Springs and dampers between nodes, or to the ground.",
                springs.spec("One spring.").with(Group::Rule::exactly_one, {"between", "terms"}))
               .otherwise("[]")
               .such_as("[{between: [left, right], stiffness: 10}]")),
       [springs](Description& d, const Value& v) {
         d.springs = springs.read_all(v, check_spring);
       }},
      {optional("masses", list("Masses at nodes.", masses.spec("Masses of one set."))
                              .otherwise("[]")
                              .such_as("[{on: tip, mass: 2}]")),
       [masses](Description& d, const Value& v) { d.masses = masses.read_all(v); }}};
}

}  // namespace osculate::deck
