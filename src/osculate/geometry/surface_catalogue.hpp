#pragma once
#include <string>
#include <string_view>
#include <variant>

#include "osculate/geometry/nurbs_patch.hpp"
#include "osculate/geometry/surfaces.hpp"

namespace osculate::geometry {

/// The one list of smooth surfaces. Adding a surface: a struct with key, jet, lo, hi, closed, a
/// validate() overload, and its name here; then a `foot_on` in projection/point_to_surface.cpp. The
/// conformance loops of tests/unit/geometry and tests/unit/projection then run over it.
using Surface = std::variant<Plane, Sphere, Cylinder, Cone, Torus, LagrangeSurface, NurbsPatch>;

[[nodiscard]] inline SurfaceJet jet(const Surface& surface, const Vec2& xi) {
  return std::visit([&](const auto& s) { return s.jet(xi); }, surface);
}
/// Range of the parameters; infinite where the surface has no end.
[[nodiscard]] inline Vec2 lo(const Surface& surface) {
  return std::visit([](const auto& s) { return s.lo(); }, surface);
}
[[nodiscard]] inline Vec2 hi(const Surface& surface) {
  return std::visit([](const auto& s) { return s.hi(); }, surface);
}
[[nodiscard]] inline ClosedFlags closed(const Surface& surface) {
  return std::visit([](const auto& s) { return s.closed(); }, surface);
}
[[nodiscard]] inline std::string_view key(const Surface& surface) {
  return std::visit([](const auto& s) { return s.key; }, surface);
}
/// Empty, or a message naming the field and what was expected of it.
[[nodiscard]] inline std::string validate(const Surface& surface) {
  return std::visit([](const auto& s) { return validate(s); }, surface);
}

}  // namespace osculate::geometry
