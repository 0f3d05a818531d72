#pragma once
#include <string>
#include <string_view>
#include <variant>

#include "osculate/geometry/curves.hpp"
#include "osculate/geometry/nurbs.hpp"

namespace osculate::geometry {

/// The one list of smooth plane curves. Adding a curve: a struct with key, jet, lo, hi, closed, a
/// validate() overload, and its name here; the conformance loop of tests/unit/geometry then runs
/// over it.
using Curve = std::variant<LagrangeCurve, NurbsCurve, Circle, Arc, InfiniteLine>;

[[nodiscard]] inline CurveJet<2> jet(const Curve& curve, double xi) {
  return std::visit([xi](const auto& c) { return c.jet(xi); }, curve);
}
[[nodiscard]] inline double lo(const Curve& curve) {
  return std::visit([](const auto& c) { return c.lo(); }, curve);
}
[[nodiscard]] inline double hi(const Curve& curve) {
  return std::visit([](const auto& c) { return c.hi(); }, curve);
}
[[nodiscard]] inline bool closed(const Curve& curve) {
  return std::visit([](const auto& c) { return c.closed(); }, curve);
}
[[nodiscard]] inline std::string_view key(const Curve& curve) {
  return std::visit([](const auto& c) { return c.key; }, curve);
}
/// The same points travelled the other way: the body changes sides.
[[nodiscard]] inline Curve reversed(const Curve& curve) {
  return std::visit([](const auto& c) { return Curve(reversed(c)); }, curve);
}
/// Empty, or a message naming the field and what was expected of it.
[[nodiscard]] inline std::string validate(const Curve& curve) {
  return std::visit([](const auto& c) { return validate(c); }, curve);
}

}  // namespace osculate::geometry
