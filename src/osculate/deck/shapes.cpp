// The shapes that rigid bodies and surfaces may have: keys and readers.
#include <fmt/format.h>

#include <numbers>

#include "osculate/deck/model_spec.hpp"
#include "osculate/deck/shapes.hpp"
#include "osculate/geometry/nurbs.hpp"

namespace osculate::deck {
namespace {

template <class S, class... Check>
ShapeKey shape(const char* name, std::string doc, const BoundKeys<S>& keys, const Check&... check) {
  return one_of<RigidShape>(name, std::move(doc), keys, check...);
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

void check_nurbs(const Value& v, const NurbsShape& n) {
  const std::size_t expected =
      n.control.value.size() + static_cast<std::size_t>(n.degree.value) + 1;
  if (n.control.value.size() <= static_cast<std::size_t>(n.degree.value))
    throw core::InputError(n.control.mark,
                           fmt::format("degree {} needs at least {} control points, got {}",
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
}

ShapeKey nurbs_key() {
  using N = NurbsShape;
  return shape<N>(
      "nurbs", "A rational B-spline curve, body on the right of the direction of travel.",
      {{need(&N::degree, "degree",
             integer("Polynomial degree.").at_least(1).at_most(7).such_as("2")),
        need(&N::knots, "knots",
             list("Knots, non-decreasing, as many as control points + degree + 1.",
                  number("One knot."))
                 .count(4)
                 .such_as("[0, 0, 0, 1, 1, 1]")),
        {required("control",
                  list("Control points [x, y, w], coordinates not multiplied by the weight w > 0.",
                       list("One control point [x, y, w].", number("Coordinate or weight."))
                           .count(3, 3)
                           .such_as("[1, 0, 1]"))
                      .count(2)
                      .such_as("[[1, 0, 1], [1, 1, 0.7071067811865476], [0, 1, 1]]")),
         [](N& n, const Value& v) {
           n.control.mark = v.mark;
           for (const Value& item : v.items)
             n.control.value.emplace_back(item.items[0].number, item.items[1].number,
                                          weight_of(item.items[2]));
         }}}},
      check_nurbs);
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
      nurbs_key()};
}

void read_rows(geometry::NurbsPatch& patch, const Value& v) {
  patch.count = {static_cast<int>(v.items.size()), static_cast<int>(v.items.front().items.size())};
  for (const Value& row : v.items) {
    if (row.items.size() != static_cast<std::size_t>(patch.count[1]))
      throw core::InputError(row.mark, fmt::format("expected {} points as in the first row, got {}",
                                                   patch.count[1], row.items.size()));
    for (const Value& point : row.items) {
      patch.control.push_back(place_of(point));
      patch.weights.push_back(weight_of(point.items[3]));
    }
  }
}

void check_patch(const Value& v, const geometry::NurbsPatch& patch) {
  for (std::size_t d = 0; d < 2; ++d) {
    const std::string wrong = geometry::validate_knots(static_cast<std::size_t>(patch.count[d]),
                                                       patch.degree[d], patch.knots[d]);
    if (!wrong.empty()) throw core::InputError(v.at("knots").items[d].mark, wrong);
  }
}

ShapeKey patch_key() {
  using N = geometry::NurbsPatch;
  return shape<N>(
      "nurbs_patch",
      "A rational B-spline surface (models in space); its normal, out of the body, is that of the "
      "first direction crossed with the second.",
      {{{required("degree", list("Polynomial degrees of the two directions.",
                                 integer("One degree.").at_least(1).at_most(7))
                                .count(2, 2)
                                .such_as("[2, 1]")),
         [](N& n, const Value& v) {
           n.degree = {v.items[0].code, v.items[1].code};
         }},
        {required("knots", list("Knots of the two directions, non-decreasing, as many as control "
                                "points + degree + 1.",
                                list("Knots of one direction.", number("One knot.")).count(4))
                               .count(2, 2)
                               .such_as("[[0, 0, 0, 1, 1, 1], [0, 0, 1, 1]]")),
         [](N& n, const Value& v) {
           for (std::size_t d = 0; d < 2; ++d) store(n.knots[d], v.items[d]);
         }},
        {required("control",
                  list("Control points by rows: the first direction runs through the rows, the "
                       "second along each row; coordinates not multiplied by the weight w > 0.",
                       list("One row.",
                            list("One control point [x, y, z, w].", number("Coordinate or weight."))
                                .count(4, 4))
                           .count(2))
                      .count(2)
                      .such_as("[[[0, 0, 0, 1], [0, 1, 0, 1]], [[1, 0, 1, 1], [1, 1, 1, 1]], "
                               "[[2, 0, 0, 1], [2, 1, 0, 1]]]")),
         read_rows}}},
      check_patch);
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

BoundKey<geometry::Cone> half_angle_key() {
  return {required("half_angle", number("Angle between the axis and the surface.")
                                     .in("degrees")
                                     .above(0)
                                     .below(90)
                                     .such_as("30")),
          [](geometry::Cone& c, const Value& v) {
            c.half_angle = v.number * std::numbers::pi / 180.0;
          }};
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
            unit(&C::axis, "axis", axis), half_angle_key(),
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
      patch_key()};
}

}  // namespace

std::vector<ShapeKey> shape_keys(bool with_composite) {
  std::vector<ShapeKey> keys = plane_shapes();
  if (with_composite) keys.push_back(composite_key());
  for (ShapeKey& one : space_shapes()) keys.push_back(std::move(one));
  return keys;
}

}  // namespace osculate::deck
