#include "osculate/projection/point_to_curve.hpp"

#include <numbers>

#include "osculate/geometry/line2.hpp"

namespace osculate::projection {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double two_pi = 2.0 * std::numbers::pi;

CurveFoot degenerate_foot(double lo, double squared_distance) {
  CurveFoot foot;
  foot.xi = lo;
  foot.at_end = true;
  if (squared_distance >= 0) foot.squared_distance = squared_distance;  // not NaN
  return foot;
}

/// Parameter of the ray from the centre through the point (any multiple of 2 pi may be added).
double ray_parameter(const Vec2& arm, bool inside) {
  const double angle = std::atan2(arm.y(), arm.x());
  return inside ? angle : -angle;
}

/// xi shifted by full turns to the smallest value that is >= lo.
double wrap_from(double xi, double lo) {
  double turns = std::floor((xi - lo) / two_pi);
  const double wrapped = xi - turns * two_pi;
  return wrapped < lo ? wrapped + two_pi : wrapped;
}

double squared(double x) { return x * x; }

CurveFoot full_circle_foot(const Vec2& arm, double radius, bool inside, double lo) {
  const double length = arm.norm();
  if (!(radius > 0) || !std::isfinite(radius) || !std::isfinite(length))
    return degenerate_foot(lo, squared(length));
  CurveFoot foot;
  foot.converged = true;
  foot.squared_distance = squared(length - radius);
  foot.xi = lo;
  if (length == 0) {
    foot.second_distance = radius;
    return foot;
  }
  foot.xi = wrap_from(ray_parameter(arm, inside), lo);
  return foot;
}

}  // namespace

double line2_step(const Vec2& x1, const Vec2& x2, const Vec2& point, double xi) {
  const Vec2 tangent = geometry::line2_tangent(x1, x2);
  const Vec2 rho = 0.5 * (x1 + x2) + xi * tangent;
  return (point - rho).dot(tangent) / geometry::line2_metric(x1, x2);  // @eq KS2D:71
}

CurveFoot closest_on_line2(const Vec2& x1, const Vec2& x2, const Vec2& point) {
  const double length2 = (x2 - x1).squaredNorm();
  const Vec2 arm = point - x1;
  if (!(length2 >= std::numeric_limits<double>::min()) || !std::isfinite(length2) ||
      !point.allFinite())
    return degenerate_foot(-1.0, arm.squaredNorm());
  const double xi = line2_step(x1, x2, point, 0.0);  // @eq KS2D:72 without its cancellation
  CurveFoot foot;
  foot.converged = true;
  foot.xi = std::clamp(xi, -1.0, 1.0);
  foot.at_end = std::abs(xi) > 1.0 + 2.0 * end_tolerance;
  if (std::abs(xi) <= 1.0)
    foot.squared_distance = squared(turn(x2 - x1).dot(arm)) / length2;
  else
    foot.squared_distance = (point - (xi < 0 ? x1 : x2)).squaredNorm();
  return foot;
}

CurveFoot closest_point(const geometry::InfiniteLine& line, const Vec2& point) {
  const Vec2 arm = point - line.point;
  const Vec2 normal = line.unit_normal();
  if (!arm.allFinite() || !(normal.squaredNorm() > 0))
    return degenerate_foot(0.0, arm.squaredNorm());
  CurveFoot foot;
  foot.converged = true;
  foot.xi = arm.dot(line.unit_tangent());
  foot.squared_distance = squared(arm.dot(normal));
  return foot;
}

CurveFoot closest_point(const geometry::Circle& circle, const Vec2& point) {
  return full_circle_foot(point - circle.center, circle.radius, circle.inside, circle.lo());
}

CurveFoot closest_point(const geometry::Arc& arc, const Vec2& point) {
  const Vec2 arm = point - arc.center;
  const double length = arm.norm();
  const double lo = arc.lo(), hi = arc.hi();
  if (arc.closed()) return full_circle_foot(arm, arc.radius, arc.inside, lo);
  if (!(arc.radius > 0) || !std::isfinite(arc.radius) || !std::isfinite(length) || !(lo < hi))
    return degenerate_foot(lo, squared(length));
  if (length == 0) return full_circle_foot(arm, arc.radius, arc.inside, lo);
  // d^2 = (|arm| - R)^2 + 4 |arm| R sin^2((xi - ray)/2)
  const double ray = wrap_from(ray_parameter(arm, arc.inside), lo);
  detail::FootCollector out{.lo = lo, .hi = hi, .largest_a11 = squared(arc.radius)};
  const double angle_noise =
      std::numeric_limits<double>::epsilon() * (std::abs(lo) + std::abs(hi) + two_pi);
  const auto candidate = [&](double xi) {
    DistanceJet d;
    d.xi = xi;
    d.a11 = squared(arc.radius);
    d.slope = length * arc.radius * std::sin(xi - ray);
    d.bend = length * arc.radius * std::cos(xi - ray);
    d.noise = angle_noise * length * arc.radius;
    d.squared_distance = squared(length - arc.radius) +
                         4 * length * arc.radius * squared(std::sin(0.5 * (xi - ray)));
    return d;
  };
  if (ray <= hi) out.add(candidate(ray), false, 0);
  out.add_ends(candidate(lo), candidate(hi));
  return out.result();
}

CurveFoot closest_point(const geometry::LagrangeCurve& curve, const Vec2& point) {
  if (curve.count == 2) return closest_on_line2(curve.nodes[0], curve.nodes[1], point);
  const auto jet = [&curve](double xi) { return curve.jet(xi); };
  return closest_on_interval(jet, curve.lo(), curve.hi(), 4 * (curve.count - 1), point);
}

CurveFoot closest_point(const geometry::NurbsCurve& curve, const Vec2& point) {
  detail::FootCollector out{.lo = curve.lo(), .hi = curve.hi(), .closed = curve.closed()};
  const Index last = curve.find_span(out.hi);
  detail::PieceEnds whole;
  bool started = false;
  for (Index span = curve.degree; span <= last; ++span) {
    const double from = curve.knots[static_cast<std::size_t>(span)];
    const double to = curve.knots[static_cast<std::size_t>(span) + 1];
    if (!(from < to)) continue;
    const auto eval = [&](double xi) {
      return distance_jet(curve.jet_in_span(span, xi), xi, point);
    };
    const detail::PieceEnds piece = detail::scan_piece(eval, from, to, 4 * curve.degree, out);
    if (started)
      out.add_joint(whole.last, piece.first);
    else
      whole.first = piece.first;
    started = true;
    whole.last = piece.last;
  }
  out.add_ends(whole.first, whole.last);
  return out.result();
}

CurveFoot closest_point(const geometry::Curve& curve, const Vec2& point) {
  return std::visit([&point](const auto& c) { return closest_point(c, point); }, curve);
}

namespace detail {
namespace {

/// A maximum whose slope has its sign from rounding only.
bool crest(const DistanceJet& d) { return std::abs(d.slope) <= d.noise && d.bend < 0; }

}  // namespace

void FootCollector::saw(const DistanceJet& sample) {
  largest_a11 = std::max(largest_a11, sample.a11);
  if (sample.squared_distance < nearest_sample.squared_distance) nearest_sample = sample;
}

bool FootCollector::orthogonal(const DistanceJet& d) const {
  // Where the bend (nearly) vanishes the metric stands in for it: no division by zero.
  const double scale = std::max(d.bend, 1e-3 * d.a11);
  return std::abs(d.slope) <= end_tolerance * (hi - lo) * scale || std::abs(d.slope) <= d.noise;
}

void FootCollector::add(const DistanceJet& foot, bool at_end, int iterations) {
  constexpr double same = 1e-7;  // of the parameter range
  double apart = std::abs(foot.xi - best.xi);
  if (closed) apart = std::min(apart, (hi - lo) - apart);
  const bool first = best.squared_distance == infinity;
  const bool better = foot.squared_distance < best.squared_distance;
  const bool distinct = !first && apart > same * (hi - lo);
  if (distinct)
    second_squared =
        std::min(second_squared, better ? best.squared_distance : foot.squared_distance);
  if (!better) return;
  best.xi = foot.xi;
  best.squared_distance = foot.squared_distance;
  best.at_end = at_end;
  best.iterations = iterations;
  best.converged = true;
}

void FootCollector::add_joint(const DistanceJet& before, const DistanceJet& after) {
  if (!(before.slope < 0) || !(after.slope >= 0) || crest(before) || crest(after)) return;
  add(after, !orthogonal(before) && !orthogonal(after), 0);
}

void FootCollector::add_ends(const DistanceJet& first, const DistanceJet& last) {
  if (closed) return add_joint(last, first);
  if (first.slope >= 0 && !descends_after(first) && !crest(first))
    add(first, !orthogonal(first), 0);
  if (last.slope < 0 && !crest(last)) add(last, !orthogonal(last), 0);
}

CurveFoot FootCollector::result() const {
  const bool has_length = largest_a11 >= std::numeric_limits<double>::min() && hi > lo;
  const double nearest = std::min(best.squared_distance, nearest_sample.squared_distance);
  if (!has_length || !std::isfinite(largest_a11) || nearest == infinity)
    return degenerate_foot(lo, nearest_sample.squared_distance);
  CurveFoot foot = best;
  foot.second_distance = std::sqrt(second_squared);
  // Rounding hid every sign change (all points are nearly as near): the nearest sample it is.
  if (best.squared_distance == infinity) {
    foot.xi = nearest_sample.xi;
    foot.squared_distance = nearest_sample.squared_distance;
    foot.converged = orthogonal(nearest_sample);
  }
  return foot;
}

}  // namespace detail
}  // namespace osculate::projection
