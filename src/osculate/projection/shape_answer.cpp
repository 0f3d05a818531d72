#include "osculate/projection/shape_answer.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "osculate/geometry/curve_frame.hpp"
#include "osculate/geometry/surface_frame.hpp"
#include "osculate/projection/local_domain.hpp"
#include "osculate/projection/point_to_curve.hpp"
#include "osculate/projection/point_to_surface.hpp"
#include "osculate/projection/surface_distance.hpp"

namespace osculate::projection {

double least_bend(const Vec3& gap, const std::array<Vec3, 2>& r1, const std::array<Vec3, 3>& r2) {
  const double a11 = r1[0].squaredNorm(), a22 = r1[1].squaredNorm(), a12 = r1[0].dot(r1[1]);
  const double det = a11 * a22 - a12 * a12;
  // Near a pole the one tangent is nothing but rounding.
  if (!(det > 1e-14 * a11 * a22) || std::min(a11, a22) < 1e-12 * std::max(a11, a22)) return 1;
  const DistanceJet2 j = distance_jet2<3>(gap, r1, r2);
  return least_ratio(j.bend, j.metric);
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Sets distance, margin and status of a foot point that is the only local minimum unless the point
/// is at its centre of curvature, where a whole curve is as near.
template <int Dim>
void finish(const Vec<Dim>& gap, const Vec<Dim>& normal, double bend, ClosestPoint<Dim>& out) {
  const double length = gap.norm();
  out.distance = gap.dot(normal) < 0 ? -length : length;
  const bool centre = bend <= least_bend_allowed;
  out.margin = centre ? 0 : infinity;
  out.unique = !centre;
  out.status = centre ? Status::outside_domain : Status::projected;
}

ClosestPoint<2> on_curve(const geometry::Curve& curve, double xi, const Vec2& point) {
  const geometry::CurveJet<2> j = geometry::jet(curve, xi);
  ClosestPoint<2> out;
  out.feature = Feature::face;
  out.facet = 0;
  out.xi[0] = xi;
  out.point = j.r;
  const geometry::CurveFrame frame = geometry::curve_frame(j);
  const Vec2 gap = point - j.r;
  finish<2>(gap, frame.normal, distance_bend(frame, gap.dot(frame.normal)), out);
  return out;
}

/// Inside the arc, and its ends where the distance grows into the arc.
ClosestPoint<2> on_arc(const geometry::Arc& arc, const Vec2& point) {
  const CurveFoot foot = closest_point(arc, point);
  ClosestPoint<2> best = on_curve(arc, foot.xi, point);
  if (arc.closed()) return best;
  if (foot.at_end) best.feature = Feature::corner;
  if (best.feature == Feature::face && best.status == Status::outside_domain) return best;
  best.status = Status::projected;
  best.margin = infinity;
  for (const bool high : {false, true}) {
    const double xi = high ? arc.hi() : arc.lo();
    const geometry::CurveJet<2> j = arc.jet(xi);
    const Vec2 gap = point - j.r;
    const bool minimum = gap.dot(high ? Vec2(-j.r1) : j.r1) <= 0;
    if (!minimum || (j.r - best.point).norm() <= 1e-8 * arc.radius) continue;
    const double margin = std::max(gap.norm() - std::abs(best.distance), 0.0);
    if (margin >= best.margin) continue;
    best.margin = margin;
    best.second = j.r;
  }
  const double size = 2 * arc.radius;
  best.unique = best.margin > least_margin * size;
  if (!best.unique) best.status = Status::ambiguous;
  return best;
}

}  // namespace

std::optional<ClosestPoint<2>> shape_answer(const geometry::Curve& curve, const Vec2& point) {
  if (std::holds_alternative<geometry::LagrangeCurve>(curve) ||
      std::holds_alternative<geometry::NurbsCurve>(curve))
    return std::nullopt;
  if (const auto* arc = std::get_if<geometry::Arc>(&curve)) return on_arc(*arc, point);
  return on_curve(curve, closest_point(curve, point).xi, point);
}

std::optional<ClosestPoint<3>> shape_answer(const geometry::Surface& surface, const Vec3& point) {
  if (std::holds_alternative<geometry::LagrangeSurface>(surface) ||
      std::holds_alternative<geometry::NurbsPatch>(surface))
    return std::nullopt;
  const SurfaceFoot foot = closest_point(surface, point);
  const geometry::SurfaceJet j = geometry::jet(surface, foot.xi);
  const Vec3 gap = point - j.r;
  const geometry::SurfaceFrame frame = geometry::surface_frame(j);
  ClosestPoint<3> out;
  out.facet = 0;
  out.xi = foot.xi;
  out.point = j.r;
  out.feature = !foot.at_border ? Feature::face : frame.valid ? Feature::edge : Feature::corner;
  double bend = 1;
  Vec3 normal = frame.normal;
  if (out.feature == Feature::face) bend = least_bend(gap, j.r1, j.r2);
  if (out.feature == Feature::edge)  // a circle
    bend = distance_bend(
        geometry::space_curve_frame(geometry::CurveJet<3>{j.r, j.r1[0], j.r2[0], Vec3::Zero()}),
        gap);
  if (out.feature == Feature::corner) {  // the apex of a cone: its axis is the mean normal
    const auto* cone = std::get_if<geometry::Cone>(&surface);
    if (cone != nullptr) normal = (cone->inside ? 1.0 : -1.0) * cone->axis.normalized();
  }
  finish<3>(gap, normal, bend, out);
  return out;
}

}  // namespace osculate::projection
