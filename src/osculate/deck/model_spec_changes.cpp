// What bodies have in them before the first step, and what changes of them from step to step.
#include "osculate/deck/bind.hpp"
#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
namespace {

constexpr const char* components_doc =
    "xx, yy, zz, xy in the plane; xx, yy, zz, xy, xz, yz in space, as .dat files have them. Shears "
    "of strains are those of the tensor, half the angle.";

Spec tensor_spec(std::string doc, const char* unit) {
  return list(std::move(doc) + components_doc, number("One component.").in(unit)).count(4, 6);
}

BoundKey<Description> initial_key(std::vector<InitialState> Description::*member, const char* name,
                                  std::string doc, const char* what, const char* unit,
                                  const char* example) {
  using I = InitialState;
  const std::string of = what;
  const BoundKeys<I> keys{
      {on_key<I>("Set of cells that have a section.", "bar"),
       may(&I::value, "value", tensor_spec(of + " of all their points: ", unit).such_as(example)),
       {optional("points",
                 list(of + " point by point of each cell, in the order of .dat files: along the "
                           "first direction of the cell first. Cells of few points leave the "
                           "others out; points that are not given have none.",
                      tensor_spec("One point: ", unit))
                     .count(1, 50)
                     .such_as("[[-100, -100, -100, 0, 0, 0]]")),
        [](I& i, const Value& v) {
          for (const Value& item : v.items) i.points.value.push_back(numbers_of(item).value);
          i.points.mark = v.mark;
        }}}};
  return {
      optional(name,
               list(std::move(doc),
                    keys.spec("Of one set.").with(Group::Rule::exactly_one, {"value", "points"}))
                   .otherwise("[]")
                   .such_as("[{on: bar, value: " + std::string(example) + "}]")),
      [member, keys](Description& d, const Value& v) { d.*member = keys.read_all(v); }};
}

BoundKey<Step> remove_key() {
  using C = CellChange;
  const BoundKeys<C> keys{{on_key<C>("Set of cells that have a section.", "plug")}};
  return {optional("remove",
                   list("Cells that are taken away when the step begins, with their forces, their "
                        "mass and the loads on them, at once. Nodes without any cell stay where "
                        "they are, or move as they are told.",
                        keys.spec("Cells of a set."))
                       .otherwise("[]")
                       .such_as("[{on: plug}]")),
          [keys](Step& s, const Value& v) { s.remove = keys.read_all(v); }};
}

BoundKey<Step> add_key() {
  using C = CellChange;
  const BoundKeys<C> keys{
      {on_key<C>("Set of cells that a step before has taken away.", "plug"),
       may(&C::with_strain, "with_strain",
           boolean("With the strain of the way from where they were undeformed. Without it they "
                   "are new: free of strain and stress where their nodes are when the step begins, "
                   "and their material as nothing had happened to it.")
               .otherwise("false")
               .such_as("true"))}};
  return {optional("add",
                   list("Cells that come back when the step begins.", keys.spec("Cells of a set."))
                       .otherwise("[]")
                       .such_as("[{on: plug}]")),
          [keys](Step& s, const Value& v) { s.add = keys.read_all(v); }};
}

BoundKey<Step> materials_change_key() {
  using M = MaterialChange;
  const BoundKeys<M> keys{
      {on_key<M>("Set with all cells of one section, or of several.", "bar"),
       need(&M::material, "material",
            text("Name of their material from now on: one that remembers the same things.")
                .such_as("soft"))}};
  return {optional("materials",
                   list("Sections that have another material when the step begins. Their strains "
                        "stay; what is not in balance with them any more acts at once.",
                        keys.spec("Material of a set."))
                       .otherwise("[]")
                       .such_as("[{on: bar, material: soft}]")),
          [keys](Step& s, const Value& v) { s.materials = keys.read_all(v); }};
}

BoundKey<Step> free_equations_key() {
  const BoundKeys<Release> keys = displacements_of("Set of nodes, or rigid body.");
  return {
      optional("free_equations",
               either("Equations, also those of `equal`, that do not hold any more when the "
                      "step begins; what they carried acts at once.",
                      {choice("All.", {Choice{"all", "every one", 0, true}}),
                       list("Those whose first term (of `equal`: any but the first node) is one "
                            "of these.",
                            keys.spec("Displacements."))
                           .count(1)
                           .such_as("[{on: top, of: [ux]}]")})
                   .such_as("all")),
      [keys](Step& s, const Value& v) {
        if (!v.given) return;
        if (v.alternative == 0)
          s.frees_all_equations = v.mark;
        else
          s.free_equations = keys.read_all(v);
      }};
}

}  // namespace

std::vector<BoundKey<Description>> initial_state_keys() {
  return {initial_key(&Description::initial_stress, "initial_stress",
                      "Stresses of bodies before the first step, where they are not deformed. What "
                      "is not in balance moves at once, when the first step begins.",
                      "Stress", "force/length^2", "[0, 100, 0, 0]"),
          initial_key(&Description::initial_strain, "initial_strain",
                      "Strains of bodies without stress, before the first step: what is left of "
                      "plastic flow, say. Several of one point add up.",
                      "Strain", "1", "[0, 0.01, 0, 0]")};
}

std::vector<BoundKey<Step>> time_keys() {
  return {may(&Step::duration, "duration",
              number("Time from the beginning of the step to its end; inertia, friction that "
                     "depends on speed, and materials that creep or relax ask for it.")
                  .in("time")
                  .above(0)
                  .otherwise_as("no time")
                  .such_as("0.5")),
          may(&Step::at_once, "at_once",
              boolean("Materials respond at once: nothing creeps or relaxes in this step, however "
                      "long it lasts.")
                  .otherwise("false"))};
}

std::vector<BoundKey<Step>> body_change_keys() {
  return {remove_key(), add_key(), materials_change_key(), begun_equations_key(),
          free_equations_key()};
}

}  // namespace osculate::deck
