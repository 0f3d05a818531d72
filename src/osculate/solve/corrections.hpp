#pragma once
#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "osculate/solve/arc_length.hpp"
#include "osculate/solve/condensation.hpp"
#include "osculate/solve/newton.hpp"

namespace osculate::solve::detail {

/// Near a solution, for corrections that do not wait for it.
inline NewtonOptions loosened(NewtonOptions options) {
  constexpr double near_solution = 1e-2;
  options.residual = std::max(options.residual, near_solution);
  options.energy = 0;
  return options;
}

/// Newton's method again around corrected multipliers, until the system is satisfied with a
/// solution. `attempt` keeps the iterations of all solutions.
///
/// In one loop (`often`) a correction follows as soon as the iterations are near a solution, which
/// around corrected multipliers takes one of them as a rule; the last solution is a whole one. It
/// is Newton's method that comes near, with its line search: iterations that each begin anew would
/// jump.
template <System S>
void augment(S& system, const typename S::State& committed, double time,
             const NewtonOptions& options, la::LinearSolver& solver, Condensation<S>& condensation,
             NewtonResult<typename S::Trial>& attempt, bool resisted = false) {
  const bool often = system.augments_often();
  const int most = often ? 200 : 60;
  bool whole = !often;
  for (int n = 0; n < most; ++n) {
    if (attempt.outcome != Outcome::converged) return;
    const std::optional<typename S::Trial> next = system.augment(attempt.trial);
    if (!next && whole) return;
    whole = !often || !next;
    const Guess guess{attempt.total, attempt.first_residual, attempt.first_energy,
                      Prediction::as_before, resisted};
    NewtonResult<typename S::Trial> more =
        condensation.of_all(system, committed, time, whole ? options : loosened(options), solver,
                            guess, next ? &*next : &attempt.trial);
    if (more.outcome != Outcome::converged && more.outcome != Outcome::stopped &&
        system.may_stay()) {
      // before those of the solution that stays: the last record is the converged one
      attempt.iterations.insert(attempt.iterations.begin(), more.iterations.begin(),
                                more.iterations.end());
      system.evaluate(committed, attempt.trial, time, true, attempt.evaluation);
      return;
    }
    more.iterations.insert(more.iterations.begin(), attempt.iterations.begin(),
                           attempt.iterations.end());
    more.extrapolated = attempt.extrapolated;
    attempt = std::move(more);
  }
  if (system.may_stay()) return;
  fail(attempt, Outcome::not_converged,
       "the penetration is above its target after " + std::to_string(most) +
           " corrections of the multipliers");
}

/// A solution that the system refuses has failed.
template <System S>
void refuse(const S& system, const typename S::State& committed,
            NewtonResult<typename S::Trial>& attempt) {
  if constexpr (Refuses<S>)
    if (attempt.outcome == Outcome::converged)
      if (std::string reason = system.refused(committed, attempt.trial); !reason.empty())
        fail(attempt, Outcome::not_converged, std::move(reason));
}

/// Newton's method with the corrections of `augment`. Iterations that were of no use are `wasted`.
template <System S>
[[nodiscard]] NewtonResult<typename S::Trial> solve_increment(
    S& system, const typename S::State& committed, double time, const NewtonOptions& options,
    la::LinearSolver& solver, Condensation<S>& condensation, int& wasted, const Guess& guess = {}) {
  NewtonOptions first = options;
  if constexpr (Augments<S>)
    if (system.augments_often()) first = loosened(options);
  NewtonResult<typename S::Trial> attempt =
      condensation.newton(system, committed, time, first, solver, guess, wasted);
  if constexpr (Augments<S>)
    augment(system, committed, time, options, solver, condensation, attempt, guess.resisted);
  refuse(system, committed, attempt);
  return attempt;
}

}  // namespace osculate::solve::detail
