#include <fmt/format.h>

#include <algorithm>

#include "osculate/deck/analytic_shape.hpp"
#include "osculate/deck/parse_parts.hpp"
#include "osculate/geometry/interpolation.hpp"

namespace osculate::deck {
namespace {

geometry::Curve function_of(const Value& v) {
  const Marked<std::vector<double>> x = numbers_of(v.at("x")), y = numbers_of(v.at("y"));
  if (x.value.size() != y.value.size())
    throw core::InputError(y.mark, fmt::format("expected {} values as in `x`, got {}",
                                               x.value.size(), y.value.size()));
  const double way = x.value.back() - x.value.front();
  for (std::size_t i = 1; i < x.value.size(); ++i)
    if (!((x.value[i] - x.value[i - 1]) * way > 0))
      throw core::InputError(v.at("x").items[i].mark,
                             fmt::format("x must only increase or only decrease, got {} after {}",
                                         x.value[i], x.value[i - 1]));
  return geometry::graph_through(x.value, y.value);
}

std::vector<geometry::Curve> curves_of(const Value& v) {
  if (const Value* const function = v.find("function")) return {function_of(*function)};
  const RigidShape shape = parse_shape(v);
  const auto* const line = std::get_if<PolylineShape>(&shape);
  if (!line) return {analytic_shape<2>(shape, false).value().shape};
  std::vector<geometry::Curve> segments;
  if (line->closed)
    throw core::InputError(v.mark,
                           "a part has two ends: leave out `closed` and repeat the first "
                           "point at the end");
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

}  // namespace

CompositeShape parse_composite(const Value& v) {
  CompositeShape shape;
  for (const Value& item : v.items) {
    const std::vector<geometry::Curve> curves = curves_of(item);
    for (const geometry::Curve& curve : curves) check_part(curve, item.mark);
    if (!shape.parts.empty() && !joined(shape.parts.back(), curves.front())) {
      const Vec2 to = begin_of(curves.front()), from = end_of(shape.parts.back());
      throw core::InputError(
          item.mark, fmt::format("begins at ({:.10g}, {:.10g}), but the part before ends at "
                                 "({:.10g}, {:.10g})",
                                 to.x(), to.y(), from.x(), from.y()));
    }
    shape.parts.insert(shape.parts.end(), curves.begin(), curves.end());
  }
  shape.closed = shape.parts.size() > 1 && joined(shape.parts.back(), shape.parts.front());
  return shape;
}

}  // namespace osculate::deck
