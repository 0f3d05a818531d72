#pragma once
#include <algorithm>
#include <cmath>

#include "osculate/solve/iteration.hpp"

namespace osculate::solve {

namespace detail {

/// Work of the residual on the correction at `step`, with the state and evaluation that belong to
/// it.
template <System S>
struct LinePoint {
  double step = 0, work = 0, norm = 0;
  bool ok = false;
};

/// The zero of the work between `low` and `high`, which have different signs of it: the best point
/// found, by Illinois' rule. With `falling`: by halves, and the far end if it is not found.
template <System S, class At>
LinePoint<S> bracketed(const At& at, LinePoint<S> low, LinePoint<S> high, double enough,
                       bool falling) {
  const int most = falling ? 10 : 20;
  LinePoint<S> best = high;
  double low_work = low.work, high_work = high.work;
  for (int i = 0; i < most && std::abs(best.work) > enough; ++i) {
    const double secant = (low.step * high_work - high.step * low_work) / (high_work - low_work);
    const LinePoint<S> next = at(falling ? 0.5 * (low.step + high.step) : secant);
    if (!next.ok) break;
    if (std::abs(next.work) < std::abs(best.work)) best = next;
    if (next.work * low.work > 0) {
      low = next;
      low_work = next.work;
      high_work *= 0.5;
    } else {
      high = next;
      high_work = next.work;
      low_work *= 0.5;
    }
  }
  return falling && std::abs(best.work) > enough ? high : best;
}

/// How much of a correction is taken, and whether the result has the evaluation there, and the
/// system its tangent.
struct Searched {
  double step = 1;
  bool evaluated = false, with_tangent = false;
};

/// Finds how much of a correction to take. Friction and contact make the residual along the
/// correction a piecewise smooth function: a point that slips one way before and the other way
/// after the full correction has jumped over its narrow sticking range, and plain Newton jumps back
/// and forth for ever. The zero of the work du . R(step) lies inside that range.
///
/// The full correction is taken when it halves the residual, or when the work has not changed its
/// sign and the residual has not grown; otherwise the zero is bracketed (Illinois' rule). Where the
/// work keeps its sign and no part of the correction makes the residual smaller, the start lies on
/// a border between states and the tangent is that of the wrong side: the full correction goes on,
/// into the states that the next tangent is of.
///
/// With `falling` bodies (see Resistance) the work is small and constant up to the contact and then
/// large: the bracket is halved, and its far end is taken, where the tangent knows the contact. As
/// long as the work keeps its sign they go on, though the residual of a snap grows at first.
///
/// A tangent that has lost nearly all digits (`weak`) corrects part of the error alone: more than
/// the full correction is taken, up to the zero of the work.
///
/// `ahead`: the full correction, which is taken as a rule, is evaluated with its tangent.
template <System S>
Searched line_search(S& system, const typename S::State& committed,
                     NewtonResult<typename S::Trial>& result, const Eigen::VectorXd& du,
                     const Eigen::VectorXd& old_residual, double time, bool falling = false,
                     bool weak = false, bool ahead = false) {
  constexpr int most = 10;
  constexpr double close_enough = 0.05, farthest = 100;
  const typename S::Trial start = result.trial;
  Evaluation trial;
  double evaluated = 0;  // the step of `trial`
  const auto at = [&](double step) {
    LinePoint<S> point{step};
    evaluated = step;
    system.evaluate(committed, system.apply(start, du, time, step), time, ahead && step == 1.0,
                    trial);
    point.ok = trial.ok && trial.residual.allFinite();
    if (!point.ok) return point;
    point.work = du.dot(trial.residual);
    point.norm = trial.residual.norm();
    return point;
  };
  const auto taken = [&](double step) {
    result.trial = system.apply(start, du, time, step);
    if (evaluated == step) result.evaluation = std::move(trial);
    return Searched{step, evaluated == step, evaluated == step && ahead && step == 1.0};
  };
  LinePoint<S> low{0, du.dot(old_residual), old_residual.norm(), true};
  LinePoint<S> high = at(1.0);
  if (high.ok && trial.branch_residual.size() > 0)
    return taken(1.0);  // points that jumped over: the active set decides
  for (int i = 0; i < most && !high.ok; ++i) high = at(0.5 * high.step);
  const double reference = std::abs(low.work);
  LinePoint<S> best = high;
  const bool crossed = high.ok && low.work * high.work < 0;
  const bool good =
      high.ok && (high.norm <= 0.5 * low.norm || std::abs(high.work) <= close_enough * reference ||
                  (!crossed && (falling || high.norm <= low.norm)));
  if (!good && crossed) {
    best = bracketed<S>(at, low, high, close_enough * reference, falling);
  } else if (!good) {
    LinePoint<S> next = high;
    for (int i = 0; i < most && next.norm > low.norm; ++i) {
      next = at(0.5 * next.step);
      if (next.ok && next.norm < best.norm) best = next;
    }
    if (high.step == 1 && best.norm > 0.999 * low.norm) best = high;
  } else if (weak && !crossed && std::abs(high.work) > close_enough * reference &&
             std::abs(high.work) < reference) {
    const double zero = std::min(farthest, low.work / (low.work - high.work));
    const LinePoint<S> next = at(zero);
    if (next.ok && std::abs(next.work) < std::abs(high.work)) best = next;
  }
  return taken(best.step);
}

}  // namespace detail

}  // namespace osculate::solve
