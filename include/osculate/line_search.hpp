#pragma once
#include <algorithm>
#include <cmath>

namespace osculate {

/// The residual at a part of a correction.
struct LinePoint {
  double work = 0;        ///< of the residual along the whole correction, du . R
  double norm = 0;        ///< |R|
  bool branched = false;  ///< Result::branched: points have jumped over a border of their states
  bool ok = true;         ///< false: no residual there (a cell has turned over), as where `work` or
                          ///< `norm` is not finite
};

/// How much of a correction to take: the rule of `osculate run`. Friction and facets make the work
/// of the residual along a correction a piecewise smooth function, whose zero whole corrections may
/// jump over for ever. `at(step)` is the residual at that part of the correction.
///
/// Formula    1 where the residual is halved, or the work has fallen to a twentieth, or kept its
///            sign while the residual has not grown; else the zero of the work by Illinois' rule
///            where it has changed its sign, and halves until the residual has fallen where not: 1
///            if it falls by less than a thousandth. 1 where points are branched: the active set
///            decides. Where there is no residual the step is halved first, up to ten times
/// Limits     no residual at any of these steps: 2^-10, where there is none either; the increment
///            has to be shorter. A start that is zero or not finite: 1 if there is a residual there
/// Call       from the second iteration of an increment on, and not where the residual that the
///            correction was computed from was branched
/// Tested by  tests/unit/embed/test_line_search.cpp (the same steps as the program's)
template <class At>
[[nodiscard]] double line_search(const LinePoint& start, const At& at) {
  constexpr int most = 10, most_in_bracket = 20;
  struct Found {
    double step, work, norm;
    bool branched, ok;
  };
  const auto look = [&](double step) {
    const LinePoint p = at(step);
    if (!p.ok || !std::isfinite(p.work) || !std::isfinite(p.norm))
      return Found{step, 0, 0, false, false};
    return Found{step, p.work, p.norm, p.branched, true};
  };
  Found low{0, start.work, start.norm, false, true}, high = look(1);
  if (high.ok && high.branched) return 1;
  for (int i = 0; i < most && !high.ok; ++i) high = look(0.5 * high.step);
  const double enough = 0.05 * std::abs(start.work);
  const bool crossed = high.ok && low.work * high.work < 0;
  Found best = high;
  if (high.ok && (high.norm <= 0.5 * low.norm || std::abs(high.work) <= enough ||
                  (!crossed && high.norm <= low.norm)))
    return high.step;
  if (crossed) {
    double low_work = low.work, high_work = high.work;
    for (int i = 0; i < most_in_bracket && std::abs(best.work) > enough; ++i) {
      const Found now =
          look((low.step * high_work - high.step * low_work) / (high_work - low_work));
      if (!now.ok) break;
      if (std::abs(now.work) < std::abs(best.work)) best = now;
      const bool nearer = now.work * low.work > 0;  // to the end, not to the start
      (nearer ? low : high) = now;
      low_work = nearer ? now.work : 0.5 * low_work;
      high_work = nearer ? 0.5 * high_work : now.work;
    }
    return best.step;
  }
  Found now = high;
  for (int i = 0; i < most && now.norm > low.norm; ++i) {
    now = look(0.5 * now.step);
    if (now.ok && now.norm < best.norm) best = now;
  }
  return high.step == 1 && best.norm > 0.999 * low.norm ? 1 : best.step;
}

}  // namespace osculate
