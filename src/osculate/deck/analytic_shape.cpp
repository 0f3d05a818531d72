#include "osculate/deck/analytic_shape.hpp"

#include <algorithm>
#include <numbers>

namespace osculate::deck {
namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

geometry::Curve nurbs_curve(const NurbsShape& shape, bool flip) {
  geometry::NurbsCurve curve;
  curve.degree = shape.degree.value;
  curve.knots = shape.knots.value;
  for (const Vec3& c : shape.control.value) {
    curve.control.emplace_back(c.x(), c.y());
    curve.weights.push_back(c.z());
  }
  if (flip) return geometry::reversed(curve);
  return curve;
}

/// Curves of the plane; nothing for the other shapes.
struct CurveOf {
  bool flip;
  using Result = std::optional<Analytic<2>>;

  Result operator()(const CircleShape& s) const {
    return {{geometry::Circle{s.center, s.radius.value, s.inside != flip}, s.center}};
  }
  Result operator()(const ArcShape& s) const {
    return {{geometry::Arc{s.center, s.radius.value, radians(s.from.value), radians(s.to.value),
                           s.inside != flip},
             s.center}};
  }
  Result operator()(const HalfPlaneShape& s) const {
    return {{geometry::InfiniteLine{s.point, (flip ? -1.0 : 1.0) * s.normal}, s.point}};
  }
  Result operator()(const NurbsShape& s) const {
    Vec2 sum = Vec2::Zero();
    for (const Vec3& c : s.control.value) sum += c.head<2>();
    return {{nurbs_curve(s, flip), Vec2(sum / static_cast<double>(s.control.value.size()))}};
  }
  template <class Other>
  Result operator()(const Other&) const {
    return std::nullopt;
  }
};

/// Surfaces in space; nothing for the other shapes. A new one is one more line here.
struct SurfaceOf {
  bool flip;
  using Result = std::optional<Analytic<3>>;

  Result operator()(const geometry::Plane& s) const {
    return {{geometry::Plane{s.point, (flip ? -1.0 : 1.0) * s.normal}, s.point}};
  }
  Result operator()(const geometry::Sphere& s) const { return turned(s, s.center); }
  Result operator()(const geometry::Cylinder& s) const { return turned(s, s.point); }
  Result operator()(const geometry::Cone& s) const { return turned(s, s.apex); }
  Result operator()(const geometry::Torus& s) const { return turned(s, s.center); }
  Result operator()(const geometry::NurbsPatch& s) const {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& c : s.control) sum += c;
    return {{flip ? geometry::reversed(s) : s, Vec3(sum / static_cast<double>(s.control.size()))}};
  }
  template <class Other>
  Result operator()(const Other&) const {
    return std::nullopt;
  }

 private:
  template <class Round>
  [[nodiscard]] Result turned(Round s, const Vec3& center) const {
    s.inside = s.inside != flip;
    return {{s, center}};
  }
};

}  // namespace

template <>
std::optional<Analytic<2>> analytic_shape(const RigidShape& shape, bool flip) {
  return std::visit(CurveOf{flip}, shape);
}
template <>
std::optional<Analytic<3>> analytic_shape(const RigidShape& shape, bool flip) {
  return std::visit(SurfaceOf{flip}, shape);
}

std::vector<geometry::Curve> composite_curves(const CompositeShape& shape, bool flip) {
  std::vector<geometry::Curve> curves = shape.parts;
  if (!flip) return curves;
  std::reverse(curves.begin(), curves.end());
  for (geometry::Curve& curve : curves) curve = geometry::reversed(curve);
  return curves;
}

}  // namespace osculate::deck
