#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
namespace {

std::vector<Key> rigid_shape_keys() {
  std::vector<Key> keys{optional(
      "set",
      set_or_sets("Set of line cells or nodes, in space of area cells or nodes, that move as one.",
                  "base_line"))};
  for (Key& key : shape_keys(true)) keys.push_back(std::move(key));
  return keys;
}

std::vector<std::string> shape_names() {
  std::vector<std::string> out;
  for (const Key& key : rigid_shape_keys()) out.push_back(key.name);
  return out;
}

std::vector<Key> rigid_keys() {
  std::vector<Key> keys = rigid_shape_keys();
  keys.push_back(optional(
      "reference",
      list(
          "Point that prescriptions, forces and moments refer to: two coordinates, in space three.",
          number("One coordinate.").in("length"))
          .count(2, 3)
          .otherwise_as(
              "the centroid of the nodes, the centre of the shape; with a mass that of the "
              "homogeneous body")
          .such_as("[0, 1]")));
  keys.push_back(optional(
      "mass",
      number("Mass, with its centre at the reference point; in steps with inertia the body then "
             "moves freely where nothing is prescribed.")
          .in("mass")
          .above(0)
          .otherwise_as("no mass: the body moves as prescribed")
          .such_as("2.5")));
  keys.push_back(optional(
      "density",
      number("Instead of the mass: times the volume that the body encloses, in the plane the area.")
          .above(0)
          .otherwise_as("no mass: the body moves as prescribed")
          .such_as("7.85e-9")));
  const Spec moment = number("Moment of inertia.").in("mass*length^2");
  keys.push_back(optional(
      "inertia",
      either("Moments of inertia about the reference point.",
             {number("About z (plane models).").in("mass*length^2").above(0),
              list("In space: xx, yy, zz, or xx, yy, zz, xy, yz, zx.", moment).count(3, 6)})
          .otherwise_as(
              "those of the homogeneous body that a shape, closed curve or closed surface encloses")
          .such_as("0.4")));
  keys.push_back(optional(
      "flip",
      boolean("Put the body on the other side of its surface: of a meshed one without cells behind "
              "it, on the left of its lines, or where the normals of its areas point.")
          .otherwise_as("false; a meshed surface without cells behind it faces the side where the "
                        "slave starts")
          .such_as("true")));
  return keys;
}

}  // namespace

Spec rigid_spec() {
  return names(
             "Rigid bodies, by name: a meshed set or one analytic shape each. All motions of those "
             "without a mass are held until a step prescribes, loads or releases them.",
             map("One rigid body: exactly one shape.", rigid_keys())
                 .with(Group::Rule::exactly_one, shape_names())
                 .such_as("{circle: {center: [0, -5], radius: 5}}"))
      .otherwise("{}")
      .such_as("{base: {set: base_line}}");
}

}  // namespace osculate::deck
