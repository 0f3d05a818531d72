#include <algorithm>
#include <iterator>

#include "osculate/deck/model_spec.hpp"
#include "osculate/deck/shapes.hpp"

namespace osculate::deck {
namespace {

/// A meshed set, or a shape.
std::vector<ShapeKey> all_shapes() {
  std::vector<ShapeKey> keys{
      {optional(
           "set",
           set_or_sets(
               "Set of line cells or nodes, in space of area cells or nodes, that move as one.",
               "base_line")),
       [](const Value& v) { return SetShape{name_of(v)}; }}};
  for (ShapeKey& key : shape_keys(true)) keys.push_back(std::move(key));
  return keys;
}

/// Where it is in the model and in the files of CalculiX, and how it turns.
std::vector<BoundKey<Rigid>> place_keys() {
  using R = Rigid;
  const auto node = [](std::string doc, std::string example) {
    return text(std::move(doc)).otherwise_as("none").such_as(std::move(example));
  };
  return {may(&R::reference, "reference",
              list("Point that prescriptions, forces and moments refer to: two coordinates, in "
                   "space three.",
                   number("One coordinate.").in("length"))
                  .count(2, 3)
                  .otherwise_as("the centroid of the nodes, the centre of the shape; with a mass "
                                "that of the homogeneous body")
                  .such_as("[0, 1]")),
          may(&R::reference_node, "reference_node",
              node("Set of one node: its force (RF) in the files of CalculiX is the force on the "
                   "body, loads and reactions.",
                   "hub")),
          may(&R::rotation_node, "rotation_node",
              node("Set of one node: in the files of CalculiX its displacement is the rotation "
                   "vector of the body, its force the moment on it about the reference point.",
                   "hub_turns")),
          may(&R::kinematics, "kinematics",
              choice("Of its rotation, of a `set` without a mass.",
                     {word("finite", Kinematics::finite, "any rotation"),
                      word("small", Kinematics::small,
                           "u = u_ref + theta x (X - X_ref), as goes with cells of small strain, "
                           "which any other rotation strains")})
                  .otherwise("finite")
                  .such_as("small"))};
}

std::vector<BoundKey<Rigid>> mass_keys() {
  using R = Rigid;
  const Spec moment = number("Moment of inertia.").in("mass*length^2");
  return {
      may(&R::mass, "mass",
          number("Mass, with its centre at the reference point; in steps with inertia the body "
                 "then moves freely where nothing is prescribed.")
              .in("mass")
              .above(0)
              .otherwise_as("no mass: the body moves as prescribed")
              .such_as("2.5")),
      may(&R::density, "density",
          number("Instead of the mass: times the volume that the body encloses, in the plane the "
                 "area.")
              .above(0)
              .otherwise_as("no mass: the body moves as prescribed")
              .such_as("7.85e-9")),
      {optional(
           "inertia",
           either("Moments of inertia about the reference point.",
                  {number("About z (plane models).").in("mass*length^2").above(0),
                   list("In space: xx, yy, zz, or xx, yy, zz, xy, yz, zx.", moment).count(3, 6)})
               .otherwise_as("those of the homogeneous body that a shape, closed curve or closed "
                             "surface encloses")
               .such_as("0.4")),
       [](R& rigid, const Value& v) {
         rigid.inertia = numbers_of(v);
         if (v.alternative == 0) rigid.inertia->value = {v.number};
       }}};
}

BoundKeys<Rigid> rigid_keys() {
  std::vector<BoundKey<Rigid>> keys;
  for (const ShapeKey& one : all_shapes())
    keys.push_back({one.key, [one](Rigid& rigid, const Value& v) {
                      rigid.shape = one.read(v);
                      rigid.kind = one.key.name;
                    }});
  std::ranges::move(place_keys(), std::back_inserter(keys));
  std::ranges::move(mass_keys(), std::back_inserter(keys));
  keys.push_back(
      may(&Rigid::flip, "flip",
          boolean("Put the body on the other side of its surface: of a meshed one without cells "
                  "behind it, on the left of its lines, or where the normals of its areas point.")
              .otherwise_as("false; a meshed surface without cells behind it faces the side where "
                            "the slave starts")
              .such_as("true")));
  return keys;
}

void check_mass(const Value&, const Rigid& rigid) {
  if (rigid.mass && rigid.density)
    throw core::InputError(rigid.density->mark, "give the mass or the density, not both");
  if (rigid.kinematics && rigid.kinematics->value == Kinematics::small &&
      (!rigid.meshed() || rigid.mass || rigid.density))
    throw core::InputError(rigid.kinematics->mark,
                           "`small` goes with a `set` without a mass or a density");
  if (rigid.inertia && !rigid.mass && !rigid.density)
    throw core::InputError(rigid.inertia->mark, "inertia goes with a mass, which is missing");
}

}  // namespace

BoundKey<Description> rigid_key() {
  return {optional("rigid",
                   names("Rigid bodies, by name: a meshed set or one analytic shape each. All "
                         "motions of those "
                         "without a mass are held until a step prescribes, loads or releases them.",
                         rigid_keys()
                             .spec("One rigid body: exactly one shape.")
                             .with(Group::Rule::exactly_one, names_of(keys_of(all_shapes())))
                             .such_as("{circle: {center: [0, -5], radius: 5}}"))
                       .otherwise("{}")
                       .such_as("{base: {set: base_line}}")),
          [](Description& d, const Value& v) { d.rigid = rigid_keys().read_all(v, check_mass); }};
}

}  // namespace osculate::deck
