// Keys of axes: of displacements at nodes, and of materials.
#include <numbers>

#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {

std::vector<BoundKey<material::Orientation>> orientation_keys() {
  using A = material::Orientation;
  const auto place = [](std::string doc) {
    return list(std::move(doc), number("One coordinate.")).count(2, 3);
  };
  const BoundKeys<A> rectangular({need(&A::a, "x", place("Direction of the first axis.")),
                                  need(&A::b, "xy",
                                       place("A direction in the plane of the first "
                                             "and the second axis."))});
  const BoundKeys<A> cylinder(
      {need(&A::a, "from", place("A point of the cylinder's axis.")),
       {optional("to", place("Another one, in models in space.").such_as("[0, 0, 1]")),
        [](A& axes, const Value& v) { axes.b = place_of(v); }}});
  return {{optional("rectangular", rectangular.spec("Three directions, the same everywhere.")
                                       .such_as("{x: [1, 1, 0], xy: [0, 1, 0]}")),
           [rectangular](A& axes, const Value& v) {
             axes.kind = A::Kind::rectangular;
             rectangular.read(v, axes);
           }},
          {optional("cylindrical", cylinder.spec("Radial, around the axis and along it.")
                                       .such_as("{from: [0, 0, 0], to: [0, 0, 1]}")),
           [cylinder](A& axes, const Value& v) {
             axes.kind = A::Kind::cylindrical;
             cylinder.read(v, axes);
             if (!v.find("to")) axes.b = axes.a + Vec3::UnitZ();
           }}};
}

std::vector<BoundKey<material::Orientation>> turned_orientation_keys() {
  using A = material::Orientation;
  const BoundKeys<A> turn(
      {{required("about", integer("Which of them: 1, 2 or 3.").at_least(1).at_most(3).such_as("3")),
        [](A& axes, const Value& v) { axes.about = v.code - 1; }},
       {required("angle", number("Counter-clockwise.").in("degrees").such_as("30")),
        [](A& axes, const Value& v) { axes.angle = v.number * std::numbers::pi / 180; }}});
  std::vector<BoundKey<A>> all = orientation_keys();
  all.push_back(
      below(turn, optional("turn", turn.spec("The three axes are turned about one of them.")
                                       .such_as("{about: 3, angle: 30}"))));
  return all;
}

BoundKey<Section> orientation_key() {
  std::vector<BoundKey<material::Orientation>> all = turned_orientation_keys();
  all.push_back(
      may(&material::Orientation::on_shell, "shell",
          boolean("The third axis is the normal of the shell that the cells are a layer of (across "
                  "the first two of their local directions), and the first one lies in the shell, "
                  "as near to the one given as it can.")
              .otherwise("false")
              .such_as("true")));
  const BoundKeys<material::Orientation> keys(std::move(all));
  return {optional("orientation",
                   keys.spec("Where the axes 1, 2 and 3 of an orthotropic or anisotropic material "
                             "point, in the undeformed body; without, they are x, y and z.")
                       .with(Group::Rule::exactly_one, {"rectangular", "cylindrical"})
                       .such_as("{rectangular: {x: [1, 1, 0], xy: [0, 1, 0]}}")),
          [keys](Section& s, const Value& v) {
            s.orientation.mark = v.mark;
            keys.read(v, s.orientation.value);
          }};
}

}  // namespace osculate::deck
