#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>

#include "osculate/geometry/catalogue.hpp"

namespace osculate::projection {

/// Nearest point of one curve.
///
/// Errors     converged = false, at_end = true, xi = lo: the curve has no length, or the point or
///            the curve is not finite (squared_distance is then infinite); never NaN
struct CurveFoot {
  double xi = 0;
  double squared_distance = std::numeric_limits<double>::infinity();
  bool at_end = false;  ///< on an end (or a kink of a NURBS curve) and not orthogonal there
  int iterations = 0;   ///< Newton and bisection steps of this foot point; 0 = closed form
  bool converged = false;
  double second_distance =  ///< distance of the second-best distinct local minimum
      std::numeric_limits<double>::infinity();
};

/// A point that misses an end by less than this part of the parameter range still belongs to the
/// curve, so that no gap opens between neighbours.
inline constexpr double end_tolerance = 1e-8;

/// Half the squared distance of a point from the curve point xi, and its derivatives in xi.
///
/// Formula    d^2 = |r_s - rho|^2 ; slope = -(r_s - rho) . rho_xi ;
///            bend = a11 - (r_s - rho) . rho_xixi = a11 - zeta h11 at the foot point
/// Source     KS2D:1-3 with the sign of (3) corrected: `bend` > 0 at a minimum (docs/errata.md)
struct DistanceJet {
  double xi = 0;
  double squared_distance = 0;
  double slope = 0;
  double bend = 0;
  double twist = 0;  ///< third derivative, 3 rho_xi . rho_xixi - (r_s - rho) . rho_xixixi
  double a11 = 0;
  double noise = 0;  ///< rounding error to expect in `slope`
};

[[nodiscard]] inline DistanceJet distance_jet(const geometry::CurveJet<2>& jet, double xi,
                                              const Vec2& point) {
  const Vec2 gap = point - jet.r;
  DistanceJet d;
  d.xi = xi;
  d.squared_distance = gap.squaredNorm();  // @eq KS2D:1, KSCPP:27
  d.slope = -gap.dot(jet.r1);              // @eq KS2D:2
  d.a11 = jet.r1.squaredNorm();
  d.bend = d.a11 - gap.dot(jet.r2);  // @eq KS2D:3, KSCPP:29 minus KS2D's F'', > 0 at minima
  d.twist = 3.0 * jet.r1.dot(jet.r2) - gap.dot(jet.r3);
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  d.noise = 2.0 * epsilon * (gap.lpNorm<1>() + jet.r.lpNorm<1>()) * jet.r1.lpNorm<1>();
  return d;
}

/// Newton step towards the nearest point; needs bend > 0. The sign is that of KS2D:4; the same
/// step with a minus, as printed in KSCPP:43, walks away from the foot point (docs/errata.md).
[[nodiscard]] inline double newton_step(const DistanceJet& d) {
  return -d.slope / d.bend;  // @eq KS2D:4, KSCPP:43
}

/// Position with coordinates (xi, zeta): r = rho + zeta nu.
[[nodiscard]] inline Vec2 offset_point(const geometry::CurveJet<2>& jet, const Vec2& normal,
                                       double zeta) {
  return jet.r + zeta * normal;  // @eq KS2D:5, KSCPP:28
}

/// Step of xi on the straight segment x1 -> x2; from any xi it ends at the foot point.
[[nodiscard]] double line2_step(const Vec2& x1, const Vec2& x2, const Vec2& point, double xi);

/// Closest points in closed form. Tested by tests/unit/projection/test_point_to_curve.cpp.
[[nodiscard]] CurveFoot closest_on_line2(const Vec2& x1, const Vec2& x2, const Vec2& point);
[[nodiscard]] CurveFoot closest_point(const geometry::InfiniteLine& line, const Vec2& point);
/// At the centre every point is as near: xi = lo and second_distance equals the distance.
[[nodiscard]] CurveFoot closest_point(const geometry::Circle& circle, const Vec2& point);
[[nodiscard]] CurveFoot closest_point(const geometry::Arc& arc, const Vec2& point);
/// 4 samples per order; the closed form for two nodes.
[[nodiscard]] CurveFoot closest_point(const geometry::LagrangeCurve& curve, const Vec2& point);
/// 4 samples per degree and knot span; minima at kinks are ends (`at_end`).
[[nodiscard]] CurveFoot closest_point(const geometry::NurbsCurve& curve, const Vec2& point);
[[nodiscard]] CurveFoot closest_point(const geometry::Curve& curve, const Vec2& point);

namespace detail {

/// Collects local minima of one query: the best of them and the distance of the runner-up.
struct FootCollector {
  double lo = 0, hi = 0;
  bool closed = false;
  CurveFoot best{};
  double second_squared = std::numeric_limits<double>::infinity();
  double largest_a11 = 0;
  DistanceJet nearest_sample{.squared_distance = std::numeric_limits<double>::infinity()};

  void saw(const DistanceJet& sample);
  void add(const DistanceJet& foot, bool at_end, int iterations);
  /// slope is zero within `end_tolerance` of the parameter range
  [[nodiscard]] bool orthogonal(const DistanceJet& d) const;
  /// The candidates where the curve begins and ends, or the seam of a closed one.
  void add_ends(const DistanceJet& first, const DistanceJet& last);
  /// The joint between two smooth pieces.
  void add_joint(const DistanceJet& before, const DistanceJet& after);
  [[nodiscard]] CurveFoot result() const;
};

/// First and last sample of a smooth piece.
struct PieceEnds {
  DistanceJet first, last;
};

[[nodiscard]] inline bool descends_after(const DistanceJet& d) {
  return d.slope < 0 || (d.slope == 0 && d.bend < 0);
}

/// The slope is rounding error: below the noise, or near it and no longer falling from step to
/// step.
[[nodiscard]] inline bool settled(const DistanceJet& d, double slope_before) {
  const double slope = std::abs(d.slope);
  return slope <= d.noise || (slope <= 30 * d.noise && slope >= 0.25 * std::abs(slope_before));
}

/// The minimum between a (slope < 0) and b (slope >= 0): Newton's step while it stays inside and
/// at least halves every second bracket, bisection otherwise.
template <class Eval>
void solve_bracket(const Eval& eval, DistanceJet a, DistanceJet b, FootCollector& out) {
  if (b.slope == 0 && b.bend >= 0) return out.add(b, false, 0);
  constexpr int most = 200;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const double smallest = 4e-16 * std::max(std::abs(a.xi), std::abs(b.xi));
  double width_before = 2.0 * (b.xi - a.xi);
  DistanceJet d = eval(0.5 * (a.xi + b.xi));
  double slope_before = infinite;
  int i = 1;
  for (; i <= most; ++i) {
    if (d.bend > 0 && settled(d, slope_before)) return out.add(d, false, i);
    slope_before = d.slope;
    (d.slope < 0 ? a : b) = d;
    const double width = b.xi - a.xi;
    if (!(width > smallest)) break;
    double next = d.bend > 0 ? d.xi + newton_step(d) : a.xi;
    const bool slow = i % 3 == 0 && 2.0 * width > width_before;
    if (i % 3 == 0) width_before = width;
    if (!(next > a.xi && next < b.xi) || slow) next = a.xi + 0.5 * width;
    if (std::abs(next - d.xi) <= smallest) return out.add(d, false, i);
    d = eval(next);
  }
  out.add(a.squared_distance < b.squared_distance ? a : b, false, i);
}

/// Between two samples with slopes of the same sign a pair of extrema may hide. Looks where the
/// slope is extremal (bend = 0) and returns true with a point of the other sign.
template <class Eval>
bool find_hidden(const Eval& eval, DistanceJet a, DistanceJet b, DistanceJet& found) {
  const bool descending = a.slope < 0;
  const double smallest = 1e-10 * (b.xi - a.xi);
  const double rising = a.bend < 0 ? 1.0 : -1.0;  // of bend, from a to b
  double next = 0.5 * (a.xi + b.xi);
  for (int i = 0; i < 40; ++i) {
    found = eval(next);
    if ((found.slope < 0) != descending) return true;
    (found.bend * rising < 0 ? a : b) = found;
    const double step = found.twist * rising > 0 ? -found.bend / found.twist : b.xi - a.xi;
    next = found.xi + step;
    if (!(next > a.xi && next < b.xi)) next = 0.5 * (a.xi + b.xi);
    if (std::abs(next - found.xi) <= smallest) return false;
  }
  return false;
}

/// Finds the local minima inside a smooth piece.
template <class Eval>
PieceEnds scan_piece(const Eval& eval, double lo, double hi, int samples, FootCollector& out) {
  PieceEnds ends;
  ends.first = eval(lo);
  out.saw(ends.first);
  DistanceJet a = ends.first;
  const int count = std::max(samples, 1);
  for (int i = 1; i <= count; ++i) {
    const DistanceJet b = eval(i == count ? hi : lo + (hi - lo) * i / count);
    out.saw(b);
    DistanceJet between;
    if (descends_after(a)) {
      if (b.slope >= 0)
        solve_bracket(eval, a, b, out);
      else if (a.bend > 0 && b.bend < 0 && find_hidden(eval, a, b, between))
        solve_bracket(eval, a, between, out);
    } else if (b.slope >= 0 && a.bend < 0 && b.bend > 0 && find_hidden(eval, a, b, between)) {
      solve_bracket(eval, between, b, out);
    }
    a = b;
  }
  ends.last = a;
  return ends;
}

}  // namespace detail

/// Closest point of a smooth curve given by its jet, xi in lo..hi (finite).
///
/// Method     brackets of all sign changes of the slope on `samples` equal sub-intervals (pairs of
///            extrema between two samples are looked for where the slope is extremal), then
///            safeguarded Newton; ends count where the distance grows into the curve
/// Returns    the best minimum with the distance of the second-best distinct one
/// Errors     see CurveFoot
template <std::invocable<double> Jet>
[[nodiscard]] CurveFoot closest_on_interval(const Jet& jet, double lo, double hi, int samples,
                                            const Vec2& point) {
  detail::FootCollector out{.lo = lo, .hi = hi};
  const auto eval = [&](double xi) { return distance_jet(jet(xi), xi, point); };
  const detail::PieceEnds ends = detail::scan_piece(eval, lo, hi, samples, out);
  out.add_ends(ends.first, ends.last);
  return out.result();
}

/// Local minimum reached from `guess` (the last known foot point): Newton's step, or the one
/// without the curvature term where that does not descend; steps that climb are halved.
///
/// Returns    second_distance is infinite (not looked for); converged = false after 30 steps or at
///            a maximum: ask closest_on_interval() then. The seam of a closed curve is an end here
template <std::invocable<double> Jet>
[[nodiscard]] CurveFoot closest_from_guess(const Jet& jet, double lo, double hi, double guess,
                                           const Vec2& point) {
  detail::FootCollector out{.lo = lo, .hi = hi};
  const auto eval = [&](double xi) { return distance_jet(jet(xi), xi, point); };
  constexpr int most = 30;
  const double smallest = 4e-16 * std::max(std::abs(lo), std::abs(hi));
  DistanceJet d = eval(std::clamp(guess, lo, hi));
  out.saw(d);
  double slope_before = std::numeric_limits<double>::infinity();
  for (int i = 1; i <= most; ++i) {
    const bool pressed = (d.xi == lo && d.slope > 0) || (d.xi == hi && d.slope < 0);
    const bool level = detail::settled(d, slope_before);
    slope_before = d.slope;
    if (level && d.bend < 0 && !pressed) break;  // on top of a maximum
    if (pressed || level) {
      out.add(d, pressed && !out.orthogonal(d), i - 1);
      return out.result();
    }
    double step = d.bend > 0.1 * d.a11 ? newton_step(d) : -d.slope / d.a11;
    DistanceJet next = eval(std::clamp(d.xi + step, lo, hi));
    while (!(next.squared_distance <= d.squared_distance * (1 + 1e-14)) &&
           std::abs(step) > smallest) {
      step *= 0.5;
      next = eval(std::clamp(d.xi + step, lo, hi));
    }
    const bool still = std::abs(next.xi - d.xi) <= smallest;
    d = next;
    out.saw(d);
    if (!still) continue;
    out.add(d, false, i);
    return out.result();
  }
  CurveFoot foot = out.result();
  foot.converged = false;
  foot.iterations = most;
  return foot;
}

}  // namespace osculate::projection
