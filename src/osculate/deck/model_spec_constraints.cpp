#include "osculate/deck/bind.hpp"
#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
namespace {

BoundKeys<Equation> equation_keys() {
  using E = Equation;
  const BoundKeys<EquationTerm> term = term_keys();
  return {
      {{required("terms",
                 list("Terms that are summed up.", term.spec("One term of an equation.")).count(1)),
        [term](E& e, const Value& v) { e.terms = term.read_all(v); }},
       may(&E::value, "value",
           number("Value of the sum, reached at the end of the first step; of an equation that a "
                  "step brings at once.")
               .in("length")
               .otherwise("0")
               .such_as("0.1")),
       may(&E::for_each_node, "for_each_node",
           boolean("One equation for each node of the first set instead of one of the sums: the "
                   "other sets have as many nodes, of which each equation takes that of the same "
                   "place in the order of the numbers, or one node (a rigid body), which is in "
                   "all of them.")
               .otherwise("false")
               .such_as("true"))}};
}

BoundKeys<Equal> equal_keys() {
  using E = Equal;
  return {{on_key<E>("Set of nodes.", "top"),
           need(&E::of, "of",
                choice("Which displacement.",
                       {word("ux", Component::ux, "displacement in x"),
                        word("uy", Component::uy, "displacement in y"),
                        word("uz", Component::uz, "displacement in z (models in space)")})
                    .such_as("uy"))}};
}

BoundKeys<LocalAxes> axes_keys() {
  std::vector<BoundKey<LocalAxes>> keys{on_key<LocalAxes>("Set of nodes.", "rim")};
  for (BoundKey<material::Orientation>& key : orientation_keys())
    keys.push_back(of(&LocalAxes::along, std::move(key)));
  return keys;
}

BoundKey<Description> condition_key(std::vector<NodeCondition> Description::*member,
                                    const char* name, std::string doc, std::string set,
                                    const std::string& example) {
  const BoundKeys<NodeCondition> keys(std::vector{on_key<NodeCondition>(std::move(set), example)});
  return {optional(name, list(std::move(doc), keys.spec("One set."))
                             .otherwise("[]")
                             .such_as("[{on: " + example + "}]")),
          [member, keys](Description& d, const Value& v) { d.*member = keys.read_all(v); }};
}

BoundKey<Description> coupling_key() {
  const BoundKeys<material::Orientation> axes = turned_orientation_keys();
  const BoundKeys<Coupling> keys(
      {on_key<Coupling>("Set of nodes or boundary facets, not on one line.", "rim"),
       need(&Coupling::rigid, "rigid", text("The rigid body.").such_as("hub")),
       {optional("of",
                 list("These displacements of each node are those of the body, and the others "
                      "are free (small displacements and rotations only).",
                      choice("Which displacement.",
                             {word("ux", Component::ux, "displacement in x"),
                              word("uy", Component::uy, "displacement in y"),
                              word("uz", Component::uz, "displacement in z (models in space)")}))
                     .count(1, 3)
                     .otherwise_as("the mean motion")
                     .such_as("[ux, uy]")),
        [](Coupling& coupling, const Value& v) {
          for (const Value& item : v.items) {
            bool& slot = coupling.of[static_cast<std::size_t>(item.code)];
            if (slot) throw core::InputError(item.mark, quoted(item.text) + " is given twice");
            slot = true;
          }
        }},
       {optional("axes",
                 axes.spec("Where the directions of `of` point, node by node; without, they "
                           "are x, y and z.")
                     .with(Group::Rule::exactly_one, {"rectangular", "cylindrical"})
                     .such_as("{cylindrical: {from: [0, 0, 0], to: [0, 0, 1]}}")),
        [axes](Coupling& coupling, const Value& v) {
          coupling.along.emplace();
          coupling.along->mark = v.mark;
          axes.read(v, coupling.along->value);
        }}});
  return {optional("coupling",
                   list("Sets whose mean motion (by least squares, of any rotation) is that of a "
                        "rigid body: forces and moments on the body are shared out over the nodes, "
                        "facets by their area, and leave the set free to deform. Or, with `of`, "
                        "sets of which each node follows the body in some directions.",
                        keys.spec("One coupling."))
                       .otherwise("[]")
                       .such_as("[{on: rim, rigid: hub}]")),
          [keys](Description& d, const Value& v) {
            d.coupling = keys.read_all(v, [](const Value&, const Coupling& one) {
              if (one.along && one.is_mean())
                throw core::InputError(one.along->mark, "`axes` are those of the directions `of`");
            });
          }};
}

BoundKey<Description> pretension_key() {
  using P = Pretension;
  const BoundKeys<P> keys(
      {on_key<P>("Set of facets inside of a body that cut it through.", "middle"),
       may(&P::node, "node",
           text("Set of one node of no cell that carries the shortening.")
               .otherwise_as("a new node in the middle of the section")
               .such_as("reference")),
       {optional("axis", list("Direction of the bolt.", number("One coordinate."))
                             .count(2, 3)
                             .otherwise_as("the mean normal of the facets")
                             .such_as("[0, 0, 1]")),
        [](P& p, const Value& v) {
          p.axis = Marked<Vec3>{place_of(v), v.mark};
        }}});
  return {optional("pretension",
                   names("Sections through bolts, by name: the bodies on both sides move towards "
                         "each other along the axis. The name is that of a set of one node, whose "
                         "ux is the shortening and whose fx is the force that pulls both sides "
                         "together: load it, and `hold` it in a later step.",
                         keys.spec("One section.").such_as("{on: middle}"))
                       .otherwise("{}")
                       .such_as("{bolt: {on: middle}}")),
          [keys](Description& d, const Value& v) { d.pretension = keys.read_all(v); }};
}

BoundKey<Description> cyclic_key() {
  using C = CyclicSymmetry;
  const auto place = [](std::string doc, std::string otherwise) {
    return list(std::move(doc), number("One coordinate.").in("length"))
        .count(2, 3)
        .otherwise(std::move(otherwise));
  };
  const BoundKeys<C> keys(
      {need(&C::dependent, "dependent",
            set_or_sets("Nodes of one face, which follow from the other.", "left")),
       need(&C::independent, "independent",
            set_or_sets("Facets or nodes of the other face; meshes need not match.", "right")),
       need(&C::sectors, "sectors",
            integer("Number of sectors in the whole circle.")
                .at_least(1)
                .at_most(1'000'000)
                .such_as("12")),
       may(&C::from, "from", place("A point of the axis.", "[0, 0, 0]")),
       may(&C::to, "to", place("Another one.", "[0, 0, 1]"))});
  return {
      optional(
          "cyclic_symmetry",
          list("Sectors of bodies whose loads and motions repeat round an axis; vibrations with "
               "`modes: diameters`.",
               keys.spec("One sector."))
              .otherwise("[]")
              .such_as("[{dependent: left, independent: right, sectors: 12}]")),
      [keys](Description& d, const Value& v) { d.cyclic_symmetry = keys.read_all(v); }};
}

BoundKey<Description> ties_key() {
  using T = Tie;
  const BoundKeys<T> keys(
      {need(&T::slave, "slave",
            set_or_sets("Facets or nodes that follow, of the finer mesh.", "left.end")),
       need(&T::master, "master",
            set_or_sets("Facets of deformable bodies that they follow.", "right.end")),
       may(&T::tolerance, "tolerance",
           number("Largest distance of a slave node from the master.")
               .in("length")
               .at_least(0)
               .otherwise_as("0.025 of the mean edge of the master's facets")
               .such_as("0.01")),
       may(&T::adjust, "adjust",
           boolean("Slave nodes are moved onto the master before the first step. A distance that "
                   "is kept does not turn with the master.")
               .otherwise("true"))});
  return {optional("ties",
                   list("Surfaces that move as one, by equations: nodes of the slave follow the "
                        "master's facets, without tractions. With those: `contact` with "
                        "`separation: tied`.",
                        keys.spec("One tie."))
                       .otherwise("[]")
                       .such_as("[{slave: left.end, master: right.end}]")),
          [keys](Description& d, const Value& v) { d.ties = keys.read_all(v); }};
}

}  // namespace

BoundKeys<EquationTerm> term_keys() {
  using T = EquationTerm;
  return {{on_key<T>("Set of nodes, of which each gets the factor, or rigid body.", "corner"),
           need(&T::of, "of", component_spec("Which displacement.").such_as("ux")),
           checked(need(&T::factor, "factor", number("Factor of the displacement.").such_as("-1")),
                   [](const Value& v) {
                     if (v.number == 0) throw core::InputError(v.mark, "must not be zero");
                   })}};
}

BoundKey<Description> axes_key() {
  return {optional("axes",
                   list("Axes that ux, uy, uz and fx, fy, fz mean, in place of x, y and z, for the "
                        "nodes of a set: in `prescribe`, `hold`, `release`, `forces`, `equations` "
                        "and `equal`. Results are in global axes.",
                        axes_keys()
                            .spec("The axes of one set.")
                            .with(Group::Rule::exactly_one, {"rectangular", "cylindrical"}))
                       .otherwise("[]")
                       .such_as("[{on: rim, cylindrical: {from: [0, 0, 0], to: [0, 0, 1]}}]")),
          [](Description& d, const Value& v) { d.axes = axes_keys().read_all(v); }};
}

BoundKey<Description> equations_key() {
  return {optional(
              "equations",
              list("Linear equations between displacements.",
                   equation_keys().spec("One equation: the terms sum up to the value."))
                  .otherwise("[]")
                  .such_as("[{terms: [{on: A, of: ux, factor: 1}, {on: B, of: ux, factor: -1}]}]")),
          [](Description& d, const Value& v) { d.equations = equation_keys().read_all(v); }};
}

BoundKey<Step> begun_equations_key() {
  return {optional("equations",
                   list("Linear equations that hold from this step on, of the displacements in "
                        "all: what is apart by then closes at once, in its first increment.",
                        equation_keys().spec("One equation: the terms sum up to the value."))
                       .otherwise("[]")
                       .such_as("[{terms: [{on: A, of: ux, factor: 1}, {on: B, of: ux, factor: "
                                "-1}], for_each_node: true}]")),
          [](Step& s, const Value& v) { s.equations = equation_keys().read_all(v); }};
}

BoundKey<Description> equal_key() {
  return {optional("equal", list("Sets whose nodes all share one displacement.",
                                 equal_keys().spec("One shared displacement."))
                                .otherwise("[]")
                                .such_as("[{on: top, of: uy}]")),
          [](Description& d, const Value& v) { d.equal = equal_keys().read_all(v); }};
}

std::vector<BoundKey<Description>> constraint_keys() {
  using D = Description;
  return {condition_key(&D::coplanar, "coplanar",
                        "Sets whose nodes stay in one plane, which moves and turns with them.",
                        "Set of nodes (in space).", "flange"),
          condition_key(&D::collinear, "collinear",
                        "Sets whose nodes stay on one straight line, which moves and turns with "
                        "them.",
                        "Set of nodes.", "edge"),
          condition_key(&D::fixed_distance, "fixed_distance",
                        "Pairs of nodes that stay at their distance.", "Set of two nodes.", "rod"),
          coupling_key(),
          pretension_key(),
          cyclic_key(),
          ties_key()};
}

}  // namespace osculate::deck
