// The shapes that rigid bodies and surfaces may have: keys and readers.
#include <fmt/format.h>

#include <numbers>

#include "osculate/deck/bind.hpp"
#include "osculate/deck/model_spec.hpp"
#include "osculate/geometry/nurbs.hpp"

namespace osculate::deck {
namespace {

/// A key whose value is a shape.
struct ShapeKey {
  Key key;
  std::function<RigidShape(const Value&)> read;
};

/// A map of a shape's members, and what else must be so.
template <class Shape, class Check>
ShapeKey shape(const char* name, std::string doc, const BoundKeys<Shape>& keys,
               const Check& check) {
  return {optional(name, keys.spec(std::move(doc))), [keys, check](const Value& v) {
            const Shape shape = keys.read(v);
            check(v, shape);
            return RigidShape(shape);
          }};
}
template <class Shape>
ShapeKey shape(const char* name, std::string doc, const BoundKeys<Shape>& keys) {
  return shape(name, std::move(doc), keys, [](const Value&, const Shape&) {});
}

/// A direction out of the file, of length one in the object.
template <class T, int Dim>
BoundKey<T> unit(Vec<Dim> T::*member, const char* name, Spec spec) {
  return {required(name, std::move(spec)), [member](T& object, const Value& v) {
            store(object.*member, v);
            const double length = (object.*member).stableNorm();
            if (!(length > 0)) throw core::InputError(v.mark, "must not be zero");
            object.*member /= length;
          }};
}

double weight_of(const Value& v) {
  if (!(v.number > 0)) throw core::InputError(v.mark, "a weight must be > 0, got " + v.text);
  return v.number;
}

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

RigidShape nurbs_of(const Value& v) {
  NurbsShape n;
  n.degree = integer_of(v.at("degree"));
  n.knots = numbers_of(v.at("knots"));
  n.control.mark = v.at("control").mark;
  for (const Value& item : v.at("control").items) {
    n.control.value.emplace_back(item.items[0].number, item.items[1].number,
                                 weight_of(item.items[2]));
  }
  const std::size_t expected =
      n.control.value.size() + static_cast<std::size_t>(n.degree.value) + 1;
  if (n.control.value.size() <= static_cast<std::size_t>(n.degree.value))
    throw core::InputError(n.control.mark,
                           fmt::format("degree {} needs at least {} control points, "
                                       "got {}",
                                       n.degree.value, n.degree.value + 1, n.control.value.size()));
  if (n.knots.value.size() != expected)
    throw core::InputError(n.knots.mark,
                           fmt::format("expected {} knots (control points + degree + 1), got {}",
                                       expected, n.knots.value.size()));
  const std::vector<Value>& knots = v.at("knots").items;
  for (std::size_t i = 1; i < knots.size(); ++i)
    if (knots[i].number < knots[i - 1].number)
      throw core::InputError(knots[i].mark, fmt::format("knots must not decrease, got {} after {}",
                                                        knots[i].text, knots[i - 1].text));
  return n;
}

void check_arc(const Value&, const ArcShape& arc) {
  if (!(arc.to.value > arc.from.value && arc.to.value <= arc.from.value + 360))
    throw core::InputError(
        arc.to.mark, fmt::format("must be above `from` ({}) by at most 360, got {}", arc.from.value,
                                 arc.to.value));
}

void check_polyline(const Value&, const PolylineShape& line) {
  const std::vector<Vec2>& points = line.points.value;
  if (line.closed && points.size() < 3)
    throw core::InputError(line.points.mark, "a closed polyline needs at least 3 points");
  if (line.closed && points.front() == points.back())
    throw core::InputError(line.points.mark,
                           "a closed polyline must not repeat its first point at the end");
}

/// Shapes of plane models.
std::vector<ShapeKey> plane_shapes() {
  using C = CircleShape;
  using A = ArcShape;
  using P = PolylineShape;
  using H = HalfPlaneShape;
  const Spec center = point_spec("Centre.").such_as("[0, -5]");
  const Spec radius = number("Radius.").in("length").above(0).such_as("5");
  const Spec inside =
      boolean("The body is outside the circle, so that its surface is a hole.").otherwise("false");
  return {
      shape<C>("circle", "A full circle (plane models).",
               {{need(&C::center, "center", center), need(&C::radius, "radius", radius),
                 may(&C::inside, "inside", inside)}}),
      shape<A>("arc", "Part of a circle (plane models).",
               {{need(&A::center, "center", center), need(&A::radius, "radius", radius),
                 need(&A::from, "from",
                      number("Angle where the arc begins, from the x-axis towards the y-axis.")
                          .in("degrees")
                          .such_as("0")),
                 need(&A::to, "to",
                      number("Angle where the arc ends, above `from` by at most 360.")
                          .in("degrees")
                          .such_as("180")),
                 may(&A::inside, "inside", inside)}},
               check_arc),
      shape<P>("polyline",
               "Straight segments, body on the right of the direction of travel (plane models).",
               {{need(&P::points, "points", points_spec("Corners in order of travel.", 2)),
                 may(&P::closed, "closed",
                     boolean("Join the last corner with the first.").otherwise("false"))}},
               check_polyline),
      shape<H>("line",
               "A straight line without ends; the body is the half plane behind it (plane models).",
               {{need(&H::point, "point", point_spec("A point of the line.")),
                 unit(&H::normal, "normal",
                      point_spec("Direction out of the body, of any length but zero."))}}),
      {optional("nurbs", nurbs_spec()), nurbs_of}};
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
  for (ShapeKey& one : plane_shapes())
    if (one.key.name == "arc" || one.key.name == "polyline" || one.key.name == "nurbs")
      keys.push_back(std::move(one.key));
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

RigidShape patch_of(const Value& v) {
  geometry::NurbsPatch patch;
  const Value& control = v.at("control");
  patch.count = {static_cast<int>(control.items.size()),
                 static_cast<int>(control.items.front().items.size())};
  for (const Value& row : control.items) {
    if (row.items.size() != static_cast<std::size_t>(patch.count[1]))
      throw core::InputError(row.mark, fmt::format("expected {} points as in the first row, got {}",
                                                   patch.count[1], row.items.size()));
    for (const Value& point : row.items) {
      patch.control.emplace_back(point.items[0].number, point.items[1].number,
                                 point.items[2].number);
      patch.weights.push_back(weight_of(point.items[3]));
    }
  }
  for (std::size_t d = 0; d < 2; ++d) {
    patch.degree[d] = v.at("degree").items[d].code;
    const Marked<std::vector<double>> knots = numbers_of(v.at("knots").items[d]);
    patch.knots[d] = knots.value;
    const std::string wrong = geometry::validate_knots(static_cast<std::size_t>(patch.count[d]),
                                                       patch.degree[d], patch.knots[d]);
    if (!wrong.empty()) throw core::InputError(knots.mark, wrong);
  }
  return patch;
}

void check_cone(const Value& v, const geometry::Cone& s) {
  if (!(s.to > s.from))
    throw core::InputError(v.at("to").mark,
                           fmt::format("must be above `from` ({}), got {}", s.from, s.to));
}

void check_torus(const Value& v, const geometry::Torus& s) {
  if (!(s.tube_radius < s.radius))
    throw core::InputError(
        v.at("tube_radius").mark,
        fmt::format("must be below `radius` ({}), got {}", s.radius, s.tube_radius));
}

/// Shapes of models in space.
std::vector<ShapeKey> space_shapes() {
  using P = geometry::Plane;
  using S = geometry::Sphere;
  using Y = geometry::Cylinder;
  using C = geometry::Cone;
  using T = geometry::Torus;
  const auto length = [](std::string doc) { return number(std::move(doc)).in("length"); };
  const Spec axis =
      place_spec("Direction of the axis, of any length but zero.").such_as("[0, 1, 0]");
  const Spec center = place_spec("Centre.").such_as("[0, 0, -5]");
  const Spec radius = length("Radius.").above(0).such_as("5");
  const Spec inside =
      boolean("The body is around the surface, so that it is a hole.").otherwise("false");
  const Spec half_angle = number("Angle between the axis and the surface.")
                              .in("degrees")
                              .above(0)
                              .below(90)
                              .such_as("30");
  return {
      shape<P>("plane",
               "A plane without borders; the body is the half space behind it (models in space).",
               {{need(&P::point, "point", place_spec("A point of the plane.").such_as("[0, 0, 0]")),
                 unit(&P::normal, "normal",
                      place_spec("Direction out of the body, of any length but zero.")
                          .such_as("[0, 0, 1]"))}}),
      shape<S>("sphere", "A full sphere (models in space).",
               {{need(&S::center, "center", center), need(&S::radius, "radius", radius),
                 may(&S::inside, "inside", inside)}}),
      shape<Y>(
          "cylinder", "A circular cylinder with open ends (models in space).",
          {{need(&Y::point, "point", place_spec("A point of the axis.").such_as("[12, 0, -2]")),
            unit(&Y::axis, "axis", axis), need(&Y::radius, "radius", radius),
            may(&Y::length, "length",
                length("Length along the axis, from the point.")
                    .above(0)
                    .otherwise_as("without ends on both sides")
                    .such_as("3")),
            may(&Y::inside, "inside", inside)}}),
      shape<C>(
          "cone", "A circular cone that opens along its axis (models in space).",
          {{need(&C::apex, "apex", place_spec("The apex.").such_as("[0, 0, 1]")),
            unit(&C::axis, "axis", axis),
            {required("half_angle", half_angle),
             [](C& c, const Value& v) { c.half_angle = v.number * std::numbers::pi / 180.0; }},
            may(&C::from, "from",
                length("Where the cone begins, along the axis from the apex.")
                    .at_least(0)
                    .otherwise("0")
                    .such_as("0.5")),
            may(&C::to, "to", length("Where it ends.").otherwise_as("without end").such_as("4")),
            may(&C::inside, "inside", inside)}},
          check_cone),
      shape<T>("torus", "A ring torus (models in space).",
               {{need(&T::center, "center", center), unit(&T::axis, "axis", axis),
                 need(&T::radius, "radius",
                      length("From the axis to the middle of the tube.").above(0).such_as("5")),
                 need(&T::tube_radius, "tube_radius",
                      length("Radius of the tube.").above(0).such_as("1")),
                 may(&T::inside, "inside", inside)}},
               check_torus),
      {optional("nurbs_patch", nurbs_patch_spec()), patch_of}};
}

/// All that a rigid body may be but a set of the mesh.
std::vector<ShapeKey> all_shapes() {
  std::vector<ShapeKey> shapes = plane_shapes();
  shapes.push_back({optional("composite", composite_spec()), parse_composite});
  for (ShapeKey& one : space_shapes()) shapes.push_back(std::move(one));
  return shapes;
}

}  // namespace

std::vector<Key> shape_keys(bool with_composite) {
  std::vector<Key> keys;
  for (ShapeKey& one : all_shapes())
    if (with_composite || one.key.name != "composite") keys.push_back(std::move(one.key));
  return keys;
}

RigidShape parse_shape(const Value& v) {
  for (const ShapeKey& one : all_shapes())
    if (const Value* const shape = v.find(one.key.name)) return one.read(*shape);
  return SetShape{name_of(v.at("set"))};
}

}  // namespace osculate::deck
