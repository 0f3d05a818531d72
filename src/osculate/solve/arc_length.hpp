#pragma once
#include <algorithm>
#include <cmath>
#include <optional>

#include "osculate/solve/newton.hpp"

namespace osculate::solve {

/// When the path of equilibria is followed.
enum class PathControl {
  off,          ///< never, and snaps are not passed either: load control ends at a limit point
  last_resort,  ///< where load control fails for good, until what it failed at is reached
  always        ///< from the second increment of each step to its end
};

/// Where the path of equilibria turns back no larger load can be carried nearby (snap-through,
/// buckling), and load control ends or jumps to another branch. On the path the fraction of the
/// step is an unknown too: it may fall.
struct ArcLengthOptions {
  PathControl use = PathControl::last_resort;
  int max_increments = 400;  ///< of a step, on paths, before giving up
  int easy_iterations = 6;   ///< at most this many: the next arc is longer
  int max_cutbacks = 12;     ///< halvings of one arc before giving up
};

/// Where a path is followed: what the next arc needs.
struct PathPosition {
  bool on = false;
  Eigen::VectorXd before;  ///< correction of the last increment: says what forward is; empty: the
                           ///< fraction rises
  double length = 0;       ///< of the next arc; 0: that of the next load increment
  double until = 1;        ///< the path ends where this fraction is reached
  bool lost = false;       ///< one was given up: no other one in this step
  int increments = 0;      ///< on paths since the step began
  double mark = 0;         ///< fraction that the path came away from last
  int since_mark = 0;      ///< increments since then
};

/// One point of the path.
template <class Trial>
struct PathPoint {
  NewtonResult<Trial> result;  ///< `total` is the sum of the corrections
  double fraction = 0;
  double length = 0;  ///< of the arc
};

namespace detail {

inline const Eigen::VectorXd& linearised(const Evaluation& e) {
  return e.branch_residual.size() > 0 ? e.branch_residual : e.residual;
}

/// Systems whose multipliers are corrected around the solutions (augmented Lagrangian).
template <class S>
concept Augments = requires(const S s, const typename S::Trial& state) {
  { s.augment(state) } -> std::same_as<std::optional<typename S::Trial>>;
  { s.augments_often() } -> std::convertible_to<bool>;
  { s.may_stay() } -> std::convertible_to<bool>;
};

/// Systems that refuse some solutions: those of Newton's method that are not of this increment.
template <class S>
concept Refuses = requires(const S s, const typename S::State& committed,
                           const typename S::Trial& trial) {
  { s.refused(committed, trial) } -> std::same_as<std::string>;
};

/// Systems whose unknowns are displacements and, behind them, multipliers. Those are forces: in
/// other units the same path would have other lengths, and beside a stiff contact nothing else
/// would count.
template <class S>
concept CountsDisplacements = requires(const S s) {
  { s.displacements() } -> std::convertible_to<Index>;
};

/// What of a correction the length of an arc is measured on.
template <System S>
[[nodiscard]] Eigen::Ref<const Eigen::VectorXd> moved(const S& system, const Eigen::VectorXd& du) {
  if constexpr (CountsDisplacements<S>)
    return du.head(std::min<Eigen::Index>(du.size(), system.displacements()));
  else
    return du;
}

/// du with K du = -d(residual)/d(fraction): how the bodies move with the loads and prescriptions.
/// The matrix of the last evaluation is used; the derivative is a difference backwards.
template <System S>
[[nodiscard]] std::optional<Eigen::VectorXd> load_direction(S& system, la::LinearSolver& solver,
                                                            const typename S::State& committed,
                                                            const typename S::Trial& state,
                                                            double fraction,
                                                            const Eigen::VectorXd& residual) {
  constexpr double step = 1e-6;
  Evaluation before;
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(residual.size());
  const double lower = fraction - step;
  system.evaluate(committed, system.apply(state, none, lower, 1.0), lower, false, before);
  if (!before.ok) return std::nullopt;
  Eigen::VectorXd du = (linearised(before) - residual) / step;
  if (solver.solve(du) != la::SolveStatus::ok || !du.allFinite()) return std::nullopt;
  return du;
}

/// The change of the fraction with which the whole correction keeps its length, the root that goes
/// on in the direction of `total`.
///
/// Formula    |total + by_residual + d by_load| = length, all of them displacements
/// Source     Crisfield1981 (cylindrical arc length)
/// Returns    nothing where there is no root
[[nodiscard]] inline std::optional<double> keep_length(
    const Eigen::Ref<const Eigen::VectorXd>& total,
    const Eigen::Ref<const Eigen::VectorXd>& by_residual,
    const Eigen::Ref<const Eigen::VectorXd>& by_load, double length) {
  const Eigen::VectorXd there = total + by_residual;
  const double a = by_load.squaredNorm(), b = by_load.dot(there),
               c = there.squaredNorm() - length * length;
  const double root = b * b - a * c;
  if (!(a > 0) || root < 0) return std::nullopt;
  const double first = (-b + std::sqrt(root)) / a, second = (-b - std::sqrt(root)) / a;
  const double along = total.dot(by_load);
  return first * along >= second * along ? first : second;
}

/// The first point of an arc, along the tangent of the path at the committed state; points that
/// slid go on sliding. `size` is that of a load increment: the fraction changes by no more.
template <System S>
bool begin_arc(S& system, const typename S::State& committed, double start, double size,
               const PathPosition& path, la::LinearSolver& solver, Judge& judge,
               PathPoint<typename S::Trial>& point) {
  NewtonResult<typename S::Trial>& result = point.result;
  result.trial = typename S::Trial{committed};
  Evaluation rest;
  predict(system, committed, start, Prediction::as_before, rest);
  predict(system, committed, start + size, Prediction::as_before, result.evaluation);
  if (!rest.ok || !result.evaluation.ok)
    return fail(result, Outcome::numerical_failure, result.evaluation.message);
  const Eigen::VectorXd load = linearised(result.evaluation) - linearised(rest);
  Eigen::VectorXd du;
  result.trial = system.remember(typename S::Trial{committed});
  if (!solve_correction(system, solver, load, du, result)) return false;
  const double whole = moved(system, du).norm();
  if (!(whole > 0)) return fail(result, Outcome::not_converged, "nothing moves with the fraction");
  point.length = path.length > 0 ? std::min(path.length, whole) : whole;
  double share = point.length / whole;
  if (path.before.size() == du.size() && moved(system, path.before).dot(moved(system, du)) < 0)
    share = -share;
  du *= share;
  point.fraction = start + share * size;
  judge.first_energy = std::abs(share * du.dot(load));
  judge.largest_correction = du.lpNorm<Eigen::Infinity>();
  result.first_residual = std::abs(share) * load.norm();
  result.first_energy = judge.first_energy;
  result.total = du;
  judge.aim = point.fraction;
  result.trial = system.apply(result.trial, du, point.fraction, 1.0);
  system.evaluate(committed, result.trial, point.fraction, true, result.evaluation);
  return !conclude(judge, du, 1.0, judge.first_energy, result);
}

/// One correction at the length of the arc; false if it was the last one, converged or not.
template <System S>
bool correct_arc(S& system, const typename S::State& committed, la::LinearSolver& solver,
                 Judge& judge, PathPoint<typename S::Trial>& point) {
  NewtonResult<typename S::Trial>& result = point.result;
  const Eigen::VectorXd residual = linearised(result.evaluation);
  Eigen::VectorXd du;
  result.trial = system.remember(result.trial);
  if (!solve_correction(system, solver, residual, du, result)) return false;
  const std::optional<Eigen::VectorXd> load =
      load_direction(system, solver, committed, result.trial, point.fraction, residual);
  const std::optional<double> step =
      load ? keep_length(moved(system, result.total), moved(system, du), moved(system, *load),
                         point.length)
           : std::optional<double>{};
  if (!step || !std::isfinite(*step))
    return fail(result, Outcome::not_converged, "the path does not reach as far as the arc");
  du += *step * *load;
  judge.aim = point.fraction += *step;
  result.trial = system.apply(result.trial, du, point.fraction, 1.0);
  result.total += du;
  system.evaluate(committed, result.trial, point.fraction, true, result.evaluation);
  return !conclude(judge, du, 1.0, std::abs(du.dot(residual)), result);
}

/// One point of the path at the distance of the arc from the committed state. Multipliers that are
/// corrected around the solutions are corrected at the same distance.
///
/// Tested by  tests/unit/solve/test_arc_length.cpp
template <System S>
[[nodiscard]] PathPoint<typename S::Trial> follow_path(
    S& system, const typename S::State& committed, double start, double size,
    const PathPosition& path, const NewtonOptions& options, la::LinearSolver& solver) {
  PathPoint<typename S::Trial> point;
  NewtonResult<typename S::Trial>& result = point.result;
  Judge judge{options};
  bool more = begin_arc(system, committed, start, size, path, solver, judge, point);
  constexpr int most = 60;
  for (int n = 0; n < most; ++n) {
    for (int i = 1; more && i < options.max_iterations; ++i)
      more = correct_arc(system, committed, solver, judge, point);
    if (more || result.outcome != Outcome::converged) break;
    if constexpr (Augments<S>)
      if (const std::optional<typename S::Trial> next =
              system.may_stay() ? std::nullopt : system.augment(result.trial)) {
        result.trial = *next;
        result.outcome = Outcome::not_converged;
        system.evaluate(committed, result.trial, point.fraction, true, result.evaluation);
        more = true;
        continue;
      }
    return point;
  }
  if (more)
    fail(result, Outcome::not_converged,
         "not converged after " + std::to_string(options.max_iterations) +
             " iterations on the path");
  return point;
}

}  // namespace detail
}  // namespace osculate::solve
