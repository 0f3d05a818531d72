#include <fmt/format.h>

#include <numbers>

#include "osculate/deck/parse_parts.hpp"
#include "osculate/geometry/nurbs.hpp"

namespace osculate::deck {
namespace {

ArcShape arc_of(const Value& v) {
  ArcShape arc{point_of(v.at("center")), number_of(v.at("radius")), number_of(v.at("from")),
               number_of(v.at("to")), flag(v, "inside")};
  if (!(arc.to.value > arc.from.value && arc.to.value <= arc.from.value + 360))
    throw core::InputError(
        arc.to.mark, fmt::format("must be above `from` ({}) by at most 360, got {}", arc.from.value,
                                 arc.to.value));
  return arc;
}

PolylineShape polyline_of(const Value& v) {
  PolylineShape line{points_of(v.at("points")), flag(v, "closed")};
  const std::vector<Vec2>& points = line.points.value;
  if (line.closed && points.size() < 3)
    throw core::InputError(line.points.mark, "a closed polyline needs at least 3 points");
  if (line.closed && points.front() == points.back())
    throw core::InputError(line.points.mark,
                           "a closed polyline must not repeat its first point at the end");
  return line;
}

HalfPlaneShape half_plane_of(const Value& v) {
  const Vec2 normal = point_of(v.at("normal"));
  const double length = normal.stableNorm();
  if (!(length > 0)) throw core::InputError(v.at("normal").mark, "must not be zero");
  return {point_of(v.at("point")), normal / length};
}

/// A direction of length one.
Vec3 direction_of(const Value& v) {
  const Vec3 direction = place_of(v);
  const double length = direction.stableNorm();
  if (!(length > 0)) throw core::InputError(v.mark, "must not be zero");
  return direction / length;
}

geometry::Plane plane_of(const Value& v) {
  return {place_of(v.at("point")), direction_of(v.at("normal"))};
}

geometry::Sphere sphere_of(const Value& v) {
  geometry::Sphere s;
  s.center = place_of(v.at("center"));
  s.radius = v.at("radius").number;
  s.inside = flag(v, "inside");
  return s;
}

geometry::Cylinder cylinder_of(const Value& v) {
  geometry::Cylinder s;
  s.point = place_of(v.at("point"));
  s.axis = direction_of(v.at("axis"));
  s.radius = v.at("radius").number;
  if (const Value* const length = v.find("length")) s.length = length->number;
  s.inside = flag(v, "inside");
  return s;
}

geometry::Cone cone_of(const Value& v) {
  geometry::Cone s;
  s.apex = place_of(v.at("apex"));
  s.axis = direction_of(v.at("axis"));
  s.half_angle = v.at("half_angle").number * std::numbers::pi / 180.0;
  s.from = v.at("from").number;
  s.inside = flag(v, "inside");
  const Value* const to = v.find("to");
  if (!to) return s;
  s.to = to->number;
  if (!(s.to > s.from))
    throw core::InputError(to->mark,
                           fmt::format("must be above `from` ({}), got {}", s.from, s.to));
  return s;
}

geometry::Torus torus_of(const Value& v) {
  geometry::Torus s;
  s.center = place_of(v.at("center"));
  s.axis = direction_of(v.at("axis"));
  s.radius = v.at("radius").number;
  s.tube_radius = v.at("tube_radius").number;
  s.inside = flag(v, "inside");
  if (!(s.tube_radius < s.radius))
    throw core::InputError(
        v.at("tube_radius").mark,
        fmt::format("must be below `radius` ({}), got {}", s.radius, s.tube_radius));
  return s;
}

double weight_of(const Value& v) {
  if (!(v.number > 0)) throw core::InputError(v.mark, "a weight must be > 0, got " + v.text);
  return v.number;
}

geometry::NurbsPatch patch_of(const Value& v) {
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

NurbsShape nurbs_of(const Value& v) {
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

CircleShape circle_of(const Value& v) {
  return {point_of(v.at("center")), number_of(v.at("radius")), flag(v, "inside")};
}

/// One reader for each shape of the specification.
template <class Shape, Shape (*read)(const Value&)>
RigidShape shape_of(const Value& v) {
  return read(v);
}
struct Reader {
  const char* key;
  RigidShape (*read)(const Value&);
};
constexpr Reader readers[] = {{"circle", shape_of<CircleShape, circle_of>},
                              {"arc", shape_of<ArcShape, arc_of>},
                              {"polyline", shape_of<PolylineShape, polyline_of>},
                              {"line", shape_of<HalfPlaneShape, half_plane_of>},
                              {"nurbs", shape_of<NurbsShape, nurbs_of>},
                              {"composite", shape_of<CompositeShape, parse_composite>},
                              {"plane", shape_of<geometry::Plane, plane_of>},
                              {"sphere", shape_of<geometry::Sphere, sphere_of>},
                              {"cylinder", shape_of<geometry::Cylinder, cylinder_of>},
                              {"cone", shape_of<geometry::Cone, cone_of>},
                              {"torus", shape_of<geometry::Torus, torus_of>},
                              {"nurbs_patch", shape_of<geometry::NurbsPatch, patch_of>}};

}  // namespace

RigidShape parse_shape(const Value& v) {
  for (const Reader& reader : readers)
    if (const Value* const shape = v.find(reader.key)) return reader.read(*shape);
  return SetShape{name_of(v.at("set"))};
}

}  // namespace osculate::deck
