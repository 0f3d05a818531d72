#pragma once
// Implementation of solve::newton; include newton.hpp.
#include <algorithm>

#include "osculate/solve/newton.hpp"

namespace osculate::solve {
namespace detail {

template <class State>
bool fail(NewtonResult<State>& result, Outcome outcome, std::string reason) {
  result.outcome = outcome;
  result.reason = std::move(reason);
  return false;
}

/// du = -K^-1 R. Returns false and fills the result when the tangent cannot be used.
template <System S>
bool solve_correction(S& system, la::DirectSolver& solver, const Eigen::VectorXd& residual,
                      Eigen::VectorXd& du, NewtonResult<typename S::State>& result) {
  const la::FactorReport report =
      solver.factor(system.matrix(), system.pattern_version(), system.symmetry());
  result.linear = report.status;
  result.bad_row = report.bad_row;
  if (report.status == la::SolveStatus::singular)
    return fail(result, Outcome::numerical_failure, "the tangent is singular");
  if (report.status != la::SolveStatus::ok)
    return fail(result, Outcome::numerical_failure, "the linear solver failed: " + report.message);
  du = -residual;
  const la::SolveStatus status = solver.solve(du);
  result.linear = status;
  if (status != la::SolveStatus::ok || !du.allFinite())
    return fail(result, Outcome::numerical_failure, "the tangent is singular");
  return true;
}

/// Backtracks when the full correction makes things worse: the work of the residual on the
/// correction must fall to 80 % or the residual norm must not grow. Contact states are part of
/// each evaluation, so a correction that flips many points is shortened, not trusted.
template <System S>
double line_search(S& system, const typename S::State& committed,
                   NewtonResult<typename S::State>& result, const Eigen::VectorXd& du,
                   const Eigen::VectorXd& old_residual, double time) {
  const double slope = std::abs(du.dot(old_residual));
  const double norm = old_residual.norm();
  const typename S::State start = result.state;
  double best_step = 0, best_norm = std::numeric_limits<double>::infinity();
  double step = 1.0;
  Evaluation trial;
  for (int attempt = 0; attempt < 6; ++attempt, step *= 0.5) {
    typename S::State state = system.apply(start, du, time, step);
    system.evaluate(committed, state, time, false, trial);
    if (!trial.ok) continue;
    const double trial_norm = trial.residual.norm();
    if (trial_norm < best_norm) best_norm = trial_norm, best_step = step;
    if (trial_norm <= norm || std::abs(du.dot(trial.residual)) <= 0.8 * slope) {
      best_step = step;
      break;
    }
  }
  if (best_step <= 0) best_step = step;
  result.state = system.apply(start, du, time, best_step);
  return best_step;
}

}  // namespace detail

template <System S>
NewtonResult<typename S::State> newton(S& system, const typename S::State& committed, double time,
                                       const NewtonOptions& options, la::DirectSolver& solver) {
  using detail::fail;
  NewtonResult<typename S::State> result;
  result.state = committed;
  detail::Judge judge{options};
  system.predict(committed, time, result.evaluation);
  for (int i = 1; i <= options.max_iterations; ++i) {
    if (!result.evaluation.ok) {
      fail(result, Outcome::numerical_failure, result.evaluation.message);
      return result;
    }
    const Eigen::VectorXd residual = result.evaluation.residual;
    Eigen::VectorXd du;
    if (!detail::solve_correction(system, solver, residual, du, result)) return result;
    const double energy_before = std::abs(du.dot(residual));
    if (i == 1) judge.first_energy = energy_before;

    IterationRecord record;
    if (i > 1 && options.line_search == LineSearch::automatic)
      record.step = detail::line_search(system, committed, result, du, residual, time);
    else
      result.state = system.apply(result.state, du, time, 1.0);
    system.evaluate(committed, result.state, time, true, result.evaluation);

    const Evaluation& e = result.evaluation;
    if (!e.ok) {
      fail(result, Outcome::numerical_failure, e.message);
      return result;
    }
    record.residual = detail::relative(e.residual.norm(), e.force_scale);
    const double energy_after = std::abs(du.dot(e.residual));
    record.energy = detail::relative(options.residual > 0 ? energy_after : energy_before,
                                     judge.first_energy);
    record.counts = e.counts;
    result.iterations.push_back(record);
    if (!std::isfinite(record.residual)) {
      fail(result, Outcome::numerical_failure, "the residual is not a number");
      return result;
    }
    if (judge.done(record.residual, energy_before, energy_after)) {
      result.outcome = Outcome::converged;
      return result;
    }
  }
  fail(result, Outcome::not_converged,
       "not converged after " + std::to_string(options.max_iterations) + " iterations");
  return result;
}

}  // namespace osculate::solve
