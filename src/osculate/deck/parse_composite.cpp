#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/analytic_shape.hpp"
#include "osculate/deck/shapes.hpp"
#include "osculate/geometry/interpolation.hpp"

namespace osculate::deck {
namespace {

/// A graph y(x).
struct Graph {
  std::vector<double> x;
  Marked<std::vector<double>> y;
};

CompositeShape spline_of(const Value& v, const Graph& graph) {
  const auto& [x, y] = graph;
  if (x.size() != y.value.size())
    throw core::InputError(
        y.mark, fmt::format("expected {} values as in `x`, got {}", x.size(), y.value.size()));
  const double way = x.back() - x.front();
  for (std::size_t i = 1; i < x.size(); ++i)
    if (!((x[i] - x[i - 1]) * way > 0))
      throw core::InputError(
          v.at("x").items[i].mark,
          fmt::format("x must only increase or only decrease, got {} after {}", x[i], x[i - 1]));
  return {{geometry::graph_through(x, y.value)}, false};
}

/// Keys of the curves that may be a part.
std::vector<ShapeKey> curve_keys() {
  std::vector<ShapeKey> keys;
  for (ShapeKey& one : shape_keys(false))
    if (one.key.name == "arc" || one.key.name == "polyline" || one.key.name == "nurbs")
      keys.push_back(std::move(one));
  const Spec values =
      list("Coordinates in order of travel.", number("One coordinate.").in("length")).count(2);
  const BoundKeys<Graph> graph({need(&Graph::x, "x", values.such_as("[0, 1, 2, 3]")),
                                need(&Graph::y, "y", values.such_as("[0, 0.1, 0.4, 0.9]"))});
  keys.push_back(
      {optional("function", graph.spec("The graph y(x) of the cubic spline through given points "
                                       "(its first and second derivatives are continuous).")),
       [graph](const Value& v) { return spline_of(v, graph.read(v)); }});
  return keys;
}

std::vector<geometry::Curve> curves_of(const Value& v, const std::vector<ShapeKey>& keys) {
  const ShapeKey& kind = *given_key(keys, v);
  const RigidShape shape = kind.read(v.at(kind.key.name));
  if (const auto* const spline = std::get_if<CompositeShape>(&shape)) return spline->parts;
  const auto* const line = std::get_if<PolylineShape>(&shape);
  if (!line) return {analytic_shape<2>(shape, false).value().shape};
  std::vector<geometry::Curve> segments;
  if (line->closed)
    throw core::InputError(
        v.mark, "a part has two ends: leave out `closed` and repeat the first point at the end");
  for (std::size_t i = 0; i + 1 < line->points.value.size(); ++i)
    segments.emplace_back(geometry::lagrange_curve(
        std::array<Vec2, 2>{line->points.value[i], line->points.value[i + 1]}));
  return segments;
}

Vec2 begin_of(const geometry::Curve& c) { return geometry::jet(c, geometry::lo(c)).r; }
Vec2 end_of(const geometry::Curve& c) { return geometry::jet(c, geometry::hi(c)).r; }
double size_of(const geometry::Curve& c) { return (end_of(c) - begin_of(c)).norm(); }

/// Ends count as one point when a typed coordinate with seven digits would make them so.
bool joined(const geometry::Curve& before, const geometry::Curve& after) {
  constexpr double part = 1e-6;
  return (begin_of(after) - end_of(before)).norm() <=
         part * std::min(size_of(before), size_of(after));
}

void check_part(const geometry::Curve& curve, const core::SourceMark& mark) {
  const std::string wrong = geometry::validate(curve);
  if (!wrong.empty()) throw core::InputError(mark, wrong);
  if (geometry::closed(curve) || !(size_of(curve) > 0))
    throw core::InputError(mark, "a part needs two different ends");
}

CompositeShape parse_composite(const Value& v) {
  const std::vector<ShapeKey> keys = curve_keys();
  CompositeShape shape;
  for (const Value& item : v.items) {
    const std::vector<geometry::Curve> curves = curves_of(item, keys);
    for (const geometry::Curve& curve : curves) check_part(curve, item.mark);
    if (!shape.parts.empty() && !joined(shape.parts.back(), curves.front())) {
      const Vec2 to = begin_of(curves.front()), from = end_of(shape.parts.back());
      throw core::InputError(
          item.mark,
          fmt::format(
              "begins at ({:.10g}, {:.10g}), but the part before ends at ({:.10g}, {:.10g})",
              to.x(), to.y(), from.x(), from.y()));
    }
    shape.parts.insert(shape.parts.end(), curves.begin(), curves.end());
  }
  shape.closed = shape.parts.size() > 1 && joined(shape.parts.back(), shape.parts.front());
  return shape;
}

}  // namespace

ShapeKey composite_key() {
  const std::vector<Key> curves = keys_of(curve_keys());
  return {
      optional("composite", list("Curves of which each begins where the one before ends, smoothly "
                                 "or with a corner, body on the right of the direction of travel; "
                                 "closed when the last ends where the first begins (plane models).",
                                 map("One part: exactly one curve.", curves)
                                     .with(Group::Rule::exactly_one, names_of(curves)))
                                .count(1)
                                .such_as("[{polyline: {points: [[-2, 0], [0, 0]]}}, {function: {x: "
                                         "[0, 1, 2], y: [0, 0.1, 0.4]}}]")),
      parse_composite};
}

}  // namespace osculate::deck
