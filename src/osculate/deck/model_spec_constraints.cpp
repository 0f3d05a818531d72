#include "osculate/deck/bind.hpp"
#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
namespace {

template <class T>
BoundKey<T> on_key(std::string doc, const std::string& example) {
  return need(&T::on, "on", set_or_sets(std::move(doc), example));
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
  const BoundKeys<Coupling> keys(
      {on_key<Coupling>("Set of nodes or boundary facets, not on one line.", "rim"),
       need(&Coupling::rigid, "rigid", text("The rigid body.").such_as("hub"))});
  return {optional("coupling",
                   list("Sets whose mean motion (by least squares, of any rotation) is that of a "
                        "rigid body: forces and moments on the body are shared out over the nodes, "
                        "facets by their area, and leave the set free to deform.",
                        keys.spec("One coupling."))
                       .otherwise("[]")
                       .such_as("[{on: rim, rigid: hub}]")),
          [keys](Description& d, const Value& v) { d.coupling = keys.read_all(v); }};
}

BoundKey<Description> pretension_key() {
  using P = Pretension;
  const BoundKeys<P> keys(
      {on_key<P>("Set of facets inside of a body that cut it through.", "middle"),
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
  return {optional("cyclic_symmetry",
                   list("Sectors of bodies whose loads and motions repeat round an axis (not for "
                        "eigenmodes).",
                        keys.spec("One sector."))
                       .otherwise("[]")
                       .such_as("[{dependent: left, independent: right, sectors: 12}]")),
          [keys](Description& d, const Value& v) { d.cyclic_symmetry = keys.read_all(v); }};
}

}  // namespace

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
          cyclic_key()};
}

}  // namespace osculate::deck
