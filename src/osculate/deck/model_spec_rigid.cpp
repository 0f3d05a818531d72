#include "osculate/deck/model_spec.hpp"

namespace osculate::deck {
namespace {

Spec nurbs_spec() {
  return map(
      "A rational B-spline curve, body on the right of the direction of travel.",
      {required("degree", integer("Polynomial degree.").at_least(1).at_most(7).such_as("2")),
       required("knots", list("Knots, non-decreasing, as many as control points + degree + 1.",
                              number("One knot."))
                             .count(4)
                             .such_as("[0, 0, 0, 1, 1, 1]")),
       required("control",
                list("Control points [x, y, w], coordinates not multiplied by the weight w > 0.",
                     list("One control point [x, y, w].", number("Coordinate or weight."))
                         .count(3, 3)
                         .such_as("[1, 0, 1]"))
                    .count(2)
                    .such_as("[[1, 0, 1], [1, 1, 0.7071067811865476], [0, 1, 1]]"))});
}

/// Shapes of plane models.
std::vector<Key> plane_shapes() {
  const Spec center = point_spec("Centre.").such_as("[0, -5]");
  const Spec radius = number("Radius.").in("length").above(0).such_as("5");
  const Spec inside =
      boolean("The body is outside the circle, so that its surface is a hole.").otherwise("false");
  const Spec circle =
      map("A full circle (plane models).",
          {required("center", center), required("radius", radius), optional("inside", inside)});
  const Spec arc = map(
      "Part of a circle (plane models).",
      {required("center", center), required("radius", radius),
       required("from", number("Angle where the arc begins, from the x-axis towards the y-axis.")
                            .in("degrees")
                            .such_as("0")),
       required("to", number("Angle where the arc ends, above `from` by at most 360.")
                          .in("degrees")
                          .such_as("180")),
       optional("inside", inside)});
  const Spec polyline =
      map("Straight segments, body on the right of the direction of travel (plane models).",
          {required("points", points_spec("Corners in order of travel.", 2)),
           optional("closed", boolean("Join the last corner with the first.").otherwise("false"))});
  const Spec line =
      map("A straight line without ends; the body is the half plane behind it (plane models).",
          {required("point", point_spec("A point of the line.")),
           required("normal", point_spec("Direction out of the body, of any length but zero."))});
  return {optional("circle", circle), optional("arc", arc), optional("polyline", polyline),
          optional("line", line), optional("nurbs", nurbs_spec())};
}

/// Curves joined to one surface, for rigid bodies.
Spec composite_spec() {
  const Spec values =
      list("Coordinates in order of travel.", number("One coordinate.").in("length")).count(2);
  const Spec function =
      map("The graph y(x) of the cubic spline through given points (its first and second "
          "derivatives are continuous).",
          {required("x", values.such_as("[0, 1, 2, 3]")),
           required("y", values.such_as("[0, 0.1, 0.4, 0.9]"))});
  std::vector<Key> keys;
  for (Key& key : plane_shapes())
    if (key.name == "arc" || key.name == "polyline" || key.name == "nurbs")
      keys.push_back(std::move(key));
  keys.push_back(optional("function", function));
  std::vector<std::string> kinds;
  for (const Key& key : keys) kinds.push_back(key.name);
  return list(
             "Curves of which each begins where the one before ends, smoothly or with a corner, "
             "body on the right of the direction of travel; closed when the last ends where the "
             "first begins (plane models).",
             map("One part: exactly one curve.", keys).with(Group::Rule::exactly_one, kinds))
      .count(1)
      .such_as(
          "[{polyline: {points: [[-2, 0], [0, 0]]}}, {function: {x: [0, 1, 2], y: [0, 0.1, "
          "0.4]}}]");
}

Spec nurbs_patch_spec() {
  return map(
      "A rational B-spline surface (models in space); its normal, out of the body, is that of the "
      "first direction crossed with the second.",
      {required("degree", list("Polynomial degrees of the two directions.",
                               integer("One degree.").at_least(1).at_most(7))
                              .count(2, 2)
                              .such_as("[2, 1]")),
       required("knots", list("Knots of the two directions, non-decreasing, as many as control "
                              "points + degree + 1.",
                              list("Knots of one direction.", number("One knot.")).count(4))
                             .count(2, 2)
                             .such_as("[[0, 0, 0, 1, 1, 1], [0, 0, 1, 1]]")),
       required("control",
                list("Control points by rows: the first direction runs through the rows, the "
                     "second along each row; coordinates not multiplied by the weight w > 0.",
                     list("One row.",
                          list("One control point [x, y, z, w].", number("Coordinate or weight."))
                              .count(4, 4))
                         .count(2))
                    .count(2)
                    .such_as("[[[0, 0, 0, 1], [0, 1, 0, 1]], [[1, 0, 1, 1], [1, 1, 1, 1]], "
                             "[[2, 0, 0, 1], [2, 1, 0, 1]]]"))});
}

/// Shapes of models in space that turn about an axis.
std::vector<Key> round_shapes() {
  const Spec axis =
      place_spec("Direction of the axis, of any length but zero.").such_as("[0, 1, 0]");
  const Spec center = place_spec("Centre.").such_as("[0, 0, -5]");
  const Spec radius = number("Radius.").in("length").above(0).such_as("5");
  const Key inside =
      optional("inside",
               boolean("The body is around the surface, so that it is a hole.").otherwise("false"));
  const Spec sphere = map("A full sphere (models in space).",
                          {required("center", center), required("radius", radius), inside});
  const Spec cylinder =
      map("A circular cylinder with open ends (models in space).",
          {required("point", place_spec("A point of the axis.").such_as("[12, 0, -2]")),
           required("axis", axis), required("radius", radius),
           optional("length", number("Length along the axis, from the point.")
                                  .in("length")
                                  .above(0)
                                  .otherwise_as("without ends on both sides")
                                  .such_as("3")),
           inside});
  const Spec cone =
      map("A circular cone that opens along its axis (models in space).",
          {required("apex", place_spec("The apex.").such_as("[0, 0, 1]")), required("axis", axis),
           required("half_angle", number("Angle between the axis and the surface.")
                                      .in("degrees")
                                      .above(0)
                                      .below(90)
                                      .such_as("30")),
           optional("from", number("Where the cone begins, along the axis from the apex.")
                                .in("length")
                                .at_least(0)
                                .otherwise("0")
                                .such_as("0.5")),
           optional("to",
                    number("Where it ends.").in("length").otherwise_as("without end").such_as("4")),
           inside});
  const Spec torus = map(
      "A ring torus (models in space).",
      {required("center", center), required("axis", axis),
       required(
           "radius",
           number("From the axis to the middle of the tube.").in("length").above(0).such_as("5")),
       required("tube_radius", number("Radius of the tube.").in("length").above(0).such_as("1")),
       inside});
  return {optional("sphere", sphere), optional("cylinder", cylinder), optional("cone", cone),
          optional("torus", torus)};
}

/// Shapes of models in space.
std::vector<Key> space_shapes() {
  const Spec plane = map(
      "A plane without borders; the body is the half space behind it (models in space).",
      {required("point", place_spec("A point of the plane.").such_as("[0, 0, 0]")),
       required(
           "normal",
           place_spec("Direction out of the body, of any length but zero.").such_as("[0, 0, 1]"))});
  std::vector<Key> keys{optional("plane", plane)};
  for (Key& key : round_shapes()) keys.push_back(std::move(key));
  keys.push_back(optional("nurbs_patch", nurbs_patch_spec()));
  return keys;
}

std::vector<Key> rigid_shape_keys() {
  std::vector<Key> keys{optional(
      "set",
      set_or_sets("Set of line cells or nodes, in space of area cells or nodes, that move as one.",
                  "base_line"))};
  for (Key& key : plane_shapes()) keys.push_back(std::move(key));
  keys.push_back(optional("composite", composite_spec()));
  for (Key& key : space_shapes()) keys.push_back(std::move(key));
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

std::vector<Key> shape_keys() {
  std::vector<Key> keys = plane_shapes();
  for (Key& key : space_shapes()) keys.push_back(std::move(key));
  return keys;
}

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
