#pragma once
#include <algorithm>
#include <functional>

#include "osculate/solve/newton.hpp"

namespace osculate::solve {

/// Step control: the nominal increments of a step are a grid that is always hit; an increment that
/// fails is halved (nothing to undo: the trial is dropped), and grows back after easy ones.
struct IncrementOptions {
  NewtonOptions newton;
  int max_cutbacks = 8;     ///< halvings of one nominal increment before giving up
  int easy_iterations = 8;  ///< at most this many: the next sub-increment doubles
};

/// One converged increment, or the last failed attempt.
struct IncrementRecord {
  double fraction = 0;  ///< of the step, at its end
  int cutbacks = 0;     ///< attempts dropped since the last converged increment
  std::vector<IterationRecord> iterations;
  int wasted_iterations = 0;  ///< iterations of the dropped attempts
};

template <class State>
struct StepResult {
  Outcome outcome = Outcome::converged;
  std::string reason;
  State state;                       ///< last converged
  NewtonResult<State> last_attempt;  ///< filled when the step failed
  std::vector<IncrementRecord> increments;
};

/// Called after each converged increment with the committed state; returns false to stop.
template <class State>
using IncrementObserver = std::function<bool(const State&, const IncrementRecord&)>;
/// Called after each failed attempt.
using CutbackObserver = std::function<void(const std::string& reason, double from, double to,
                                           const std::vector<IterationRecord>& iterations)>;

/// Runs one step from `start` (fraction 0) to its end.
template <System S>
[[nodiscard]] StepResult<typename S::State> run_step(
    S& system, const typename S::State& start, int nominal_increments,
    const IncrementOptions& options, la::DirectSolver& solver,
    const IncrementObserver<typename S::State>& on_increment, const CutbackObserver& on_cutback) {
  using State = typename S::State;
  StepResult<State> result;
  result.state = start;
  for (int n = 0; n < nominal_increments; ++n) {
    const double begin = static_cast<double>(n) / nominal_increments;
    const double end = static_cast<double>(n + 1) / nominal_increments;
    const double smallest = (end - begin) * std::ldexp(1.0, -options.max_cutbacks);
    double at = begin, size = end - begin;
    int cutbacks = 0, wasted = 0;
    while (at < end) {
      const double target = end - at <= size * (1 + 1e-9) ? end : at + size;
      NewtonResult<State> attempt = newton(system, result.state, target, options.newton, solver);
      if (attempt.outcome != Outcome::converged) {
        on_cutback(attempt.reason, at, target, attempt.iterations);
        ++cutbacks;
        wasted += static_cast<int>(attempt.iterations.size());
        size = 0.5 * (target - at);
        if (size < smallest * (1 - 1e-9)) {
          result.outcome = attempt.outcome;
          result.reason = attempt.reason;
          result.last_attempt = std::move(attempt);
          return result;
        }
        continue;
      }
      const int iterations = static_cast<int>(attempt.iterations.size());
      result.state = system.commit(attempt.state, target);
      result.increments.push_back({target, cutbacks, std::move(attempt.iterations), wasted});
      cutbacks = wasted = 0;
      at = target;
      if (!on_increment(result.state, result.increments.back())) {
        result.outcome = Outcome::stopped;
        result.reason = "stopped by the user";
        return result;
      }
      if (iterations <= options.easy_iterations) size = std::min(2 * size, end - begin);
    }
  }
  return result;
}

}  // namespace osculate::solve
