#pragma once
#include <string_view>
#include <variant>

#include "osculate/geometry/surface_jet.hpp"

namespace osculate::geometry {

/// Plane without borders; xi are lengths from `point`. The body is the half space that `normal`
/// (any length but zero) points away from.
struct Plane {
  static constexpr std::string_view key = "plane";
  Vec3 point{0, 0, 0};
  Vec3 normal{0, 0, 1};

  [[nodiscard]] Mat<3, 3> frame() const;  ///< columns e1, e2, unit normal
  [[nodiscard]] SurfaceJet jet(const Vec2& xi) const;
};

/// The one list of smooth surfaces.
using Surface = std::variant<Plane>;

[[nodiscard]] inline SurfaceJet jet(const Surface& surface, const Vec2& xi) {
  return std::visit([&](const auto& s) { return s.jet(xi); }, surface);
}

}  // namespace osculate::geometry
