#pragma once
#include <algorithm>
#include <functional>
#include <new>
#include <optional>

#include "osculate/core/memory.hpp"
#include "osculate/solve/arc_length.hpp"
#include "osculate/solve/central_differences.hpp"
#include "osculate/solve/corrections.hpp"
#include "osculate/solve/extrapolation.hpp"
#include "osculate/solve/impacts.hpp"
#include "osculate/solve/newton.hpp"
#include "osculate/solve/time_steps.hpp"

namespace osculate::solve {

/// Step control: the nominal increments of a step are a grid that is always hit; an increment that
/// fails is halved (nothing to undo: the trial is dropped), and grows back after easy ones.
struct IncrementOptions {
  NewtonOptions newton;
  int max_cutbacks = 8;     ///< halvings of one nominal increment before giving up
  int easy_iterations = 8;  ///< at most this many: the next sub-increment doubles
  ArcLengthOptions arc_length;
  /// Steps in time are as long as their errors allow; nominal increments are the longest.
  std::optional<TimeAccuracy> time_steps;
};

/// One converged increment, or the last failed attempt.
struct IncrementRecord {
  double fraction = 0;  ///< of the step, at its end
  int cutbacks = 0;     ///< attempts dropped since the last converged increment
  std::vector<IterationRecord> iterations;
  int wasted_iterations = 0;  ///< iterations of the dropped attempts
  bool resisted = false;      ///< free motions were resisted on the way (see Resistance)
  bool on_path = false;       ///< found by arc length: the fraction may have fallen
  TimeSteps time_steps{};     ///< of explicit time integration; none: it is not
  TimeStepTaken time_step{};  ///< where lengths are chosen by errors
  Precision precision{};
};

/// Where the step control stands after a converged increment: with the committed state all that it
/// needs to go on as if it had never stopped.
struct StepPosition {
  int nominal = 0;  ///< running nominal increment, 0-based
  double at = 0;    ///< fraction of the step that has converged
  double size = 0;  ///< of the next sub-increment
  Extrapolation extrapolation;
  PathPosition path;
  TimePace pace{};
  /// Nothing but this and the state may show in what follows: a later run may go on from here.
  bool anew = false;
};

template <class State, class Trial = State>
struct StepResult {
  Outcome outcome = Outcome::converged;
  std::string reason;
  State state;                       ///< last converged
  NewtonResult<Trial> last_attempt;  ///< filled when the step failed
  std::vector<IncrementRecord> increments;
};

/// Called after each converged increment with the committed state; returns false to stop.
template <class State>
using IncrementObserver = std::function<bool(const State&, const IncrementRecord&)>;
/// Called after each failed attempt.
using CutbackObserver = std::function<void(const std::string& reason, double from, double to,
                                           const std::vector<IterationRecord>& iterations)>;

namespace detail {

/// How else the friction of the first iteration may be predicted; `as_before`: no other way.
///   sticking    the tangent was singular: perhaps only sliding points hold a body, as one that is
///               let go while it slides
///   sliding     points touch that have not been sheared: to begin with, nothing may hold them
template <System S>
Prediction another_prediction(const S& system, const typename S::State& committed,
                              const NewtonResult<typename S::Trial>& attempt) {
  if constexpr (PredictsFriction<S>) {
    if (attempt.outcome == Outcome::numerical_failure && attempt.evaluation.ok)
      return Prediction::sticking;
    if (attempt.outcome == Outcome::not_converged && system.touches_without_shear(committed))
      return Prediction::sliding;
  }
  return Prediction::as_before;
}

/// Nothing holds a body, or nothing else is left to try.
template <System S>
bool worth_resisting(const NewtonResult<typename S::Trial>& attempt, bool last) {
  if (!Resists<S> || attempt.outcome == Outcome::converged || attempt.outcome == Outcome::stopped)
    return false;
  return last || attempt.linear == la::SolveStatus::singular;
}

/// One increment with all that may help it: from the guess, by the tangent, with another
/// prediction of friction, with free motions resisted. Iterations of what did not help are
/// `wasted`.
template <System S>
NewtonResult<typename S::Trial> attempt_increment(S& system, const typename S::State& committed,
                                                  double target, const NewtonOptions& options,
                                                  la::LinearSolver& solver,
                                                  Condensation<S>& condensation, const Guess& guess,
                                                  bool last, int& wasted, bool& resisted) {
  using Result = NewtonResult<typename S::Trial>;
  const auto waste = [&](const Result& dropped) {
    wasted += static_cast<int>(dropped.iterations.size());
  };
  const auto solve = [&](const Guess& from) {
    return solve_increment(system, committed, target, options, solver, condensation, wasted, from);
  };
  Result attempt = solve(guess);
  if (attempt.outcome == Outcome::stopped) return attempt;
  if (attempt.outcome != Outcome::converged && attempt.extrapolated) {
    waste(attempt);
    attempt = solve({});
  }
  if (const Prediction other = another_prediction(system, committed, attempt);
      other != Prediction::as_before) {
    Result next = solve({{}, 0, 0, other});
    // One that slid for nothing says less of what is wrong than the one before.
    if (other == Prediction::sliding && next.outcome != Outcome::converged)
      std::swap(attempt, next);
    waste(attempt);
    attempt = std::move(next);
  }
  if (!worth_resisting<S>(attempt, last)) return attempt;
  Result held = solve({{}, 0, 0, Prediction::as_before, true});
  resisted = held.outcome == Outcome::converged;
  waste(resisted ? attempt : held);
  if (resisted) return held;
  // It moves and moves: in contact its state shows what is free, the first failure tells why.
  const StateCounts &before = attempt.evaluation.counts, &after = held.evaluation.counts;
  if (held.outcome == Outcome::not_converged && after.touching() > before.touching())
    attempt.trial = std::move(held.trial);
  return attempt;
}

/// One step on its way.
template <System S>
struct StepRun {
  using State = typename S::State;
  S& system;
  int nominal_increments;
  const IncrementOptions& options;
  la::LinearSolver& solver;
  const IncrementObserver<State>& on_increment;
  const CutbackObserver& on_cutback;
  StepPosition& position;
  StepResult<State, typename S::Trial>& result;
  int cutbacks = 0, wasted = 0;
  Condensation<S> condensation{};
  TimeStepTaken time_step{};  ///< the running one

  [[nodiscard]] double begin() const {
    return static_cast<double>(position.nominal) / nominal_increments;
  }
  [[nodiscard]] double end() const {
    return static_cast<double>(position.nominal + 1) / nominal_increments;
  }

  /// Commits a converged increment that ends where `position` stands. False: stopped.
  bool accept(NewtonResult<typename S::Trial>& attempt, bool resisted, bool on_path) {
    return accept(system.commit(attempt.trial, position.at), attempt, resisted, on_path);
  }
  /// The same for one whose state has been committed.
  bool accept(State committed, NewtonResult<typename S::Trial>& attempt, bool resisted,
              bool on_path) {
    result.outcome = Outcome::converged;
    result.reason.clear();
    result.last_attempt = {};
    result.state = std::move(committed);
    result.increments.push_back({position.at,
                                 cutbacks,
                                 std::move(attempt.iterations),
                                 wasted,
                                 resisted,
                                 on_path,
                                 {},
                                 time_step,
                                 attempt.precision});
    cutbacks = wasted = 0;
    time_step = {};
    position.anew = false;
    const bool more = on_increment(result.state, result.increments.back());
    condensation.accepted();
    if (position.anew) condensation.begin_anew();
    if (more) return true;
    result.outcome = Outcome::stopped;
    result.reason = "stopped by the user";
    return false;
  }

  /// No more is wanted: the step ends with what has converged. False, for those who return it.
  bool stop(const NewtonResult<typename S::Trial>& attempt) {
    result.outcome = attempt.outcome;
    result.reason = attempt.reason;
    return false;
  }

  void drop(const NewtonResult<typename S::Trial>& attempt, double target) {
    on_cutback(attempt.reason, position.at, target, attempt.iterations);
    ++cutbacks;
    wasted += static_cast<int>(attempt.iterations.size());
  }
};

/// Load control has failed for good: a path begins there, unless none is wanted or one was given up
/// before.
template <System S>
bool begin_path(StepRun<S>& run, double size) {
  StepPosition& position = run.position;
  PathPosition& path = position.path;
  const ArcLengthOptions& options = run.options.arc_length;
  if (options.use == PathControl::off || path.lost) return false;
  path.on = true;
  path.before.resize(0);
  path.length = 0;
  path.until = options.use == PathControl::always ? 1.0 : run.end();
  position.size = size;
  return true;
}

/// One attempt at an increment from where the position stands to `target`, which an impact on the
/// way brings forward. `unit`: length that times of impacts are measured by; shorter increments
/// than `smallest` are not tried.
template <System S>
NewtonResult<typename S::Trial> attempt_load(StepRun<S>& run, double& target, double unit,
                                             double smallest, bool& resisted) {
  StepPosition& position = run.position;
  const IncrementOptions& options = run.options;
  const double at = position.at;
  const bool may_guess = options.newton.predictor == Predictor::automatic;
  const auto reach = [&](double until) {
    const Guess guess = may_guess ? position.extrapolation.guess(until - at) : Guess{};
    const bool last = 0.5 * (until - at) < smallest && options.arc_length.use != PathControl::off;
    return attempt_increment(run.system, run.result.state, until, options.newton, run.solver,
                             run.condensation, guess, last, run.wasted, resisted);
  };
  if constexpr (MeetsImpacts<S>)
    return up_to_impact(run.system, run.result.state, at, target, unit, run.wasted, reach);
  else
    return reach(target);
}

/// Half of a failed increment comes next. False: it would be too small, the step ends here.
template <System S>
bool halve(StepRun<S>& run, NewtonResult<typename S::Trial>& attempt, double target,
           double smallest) {
  StepPosition& position = run.position;
  if (attempt.outcome == Outcome::stopped) return run.stop(attempt);
  position.extrapolation.reset();
  run.drop(attempt, target);
  position.size = 0.5 * (target - position.at);
  if (position.size >= smallest * (1 - 1e-9)) return true;
  run.result.outcome = attempt.outcome;
  run.result.reason = attempt.reason;
  run.result.last_attempt = std::move(attempt);
  return begin_path(run, position.size);
}

/// One increment by load control: the nominal increments are a grid that is hit. False: the step
/// ends here.
template <System S>
bool load_increment(StepRun<S>& run) {
  StepPosition& position = run.position;
  const IncrementOptions& options = run.options;
  const double begin = run.begin(), end = run.end();
  double &at = position.at, &size = position.size;
  at = std::max(at, begin);
  if (!(size > 0)) size = end - begin;
  const double smallest = (end - begin) * std::ldexp(1.0, -options.max_cutbacks);
  constexpr double sliver = 1e-6;  // not worth an increment, and too short for one in time
  double target = end - at <= size * (1 + sliver) ? end : at + size;
  bool resisted = false;
  NewtonResult<typename S::Trial> attempt =
      attempt_load(run, target, end - begin, smallest, resisted);
  if (attempt.outcome != Outcome::converged) return halve(run, attempt, target, smallest);
  position.extrapolation.add(attempt, target - at);
  at = target;
  if (static_cast<int>(attempt.iterations.size()) <= options.easy_iterations)
    size = std::min(2 * size, end - begin);
  PathPosition& path = position.path;
  if (options.arc_length.use == PathControl::always && path.increments == 0 && !path.lost &&
      at < 1) {
    path.on = true;
    path.before = attempt.total;
    path.until = 1;
  }
  return run.accept(attempt, resisted, false);
}

/// One increment in time whose length its error has chosen. One that is off by too much is dropped
/// as one that has failed, and a shorter one comes next. False: the step ends here.
template <System S>
bool time_increment(StepRun<S>& run, const TimeAccuracy& accuracy) {
  StepPosition& position = run.position;
  const double begin = run.begin(), end = run.end(), nominal = end - begin;
  double &at = position.at, &size = position.size;
  at = std::max(at, begin);
  if (!(size > 0)) size = nominal;
  const double least = std::min(accuracy.smallest, nominal);
  const double smallest =
      (least > 0 ? least : nominal) * std::ldexp(1.0, -run.options.max_cutbacks);
  double target = time_target(at, size, end, accuracy.corners);
  bool resisted = false;
  NewtonResult<typename S::Trial> attempt =
      attempt_load(run, target, std::min(size, nominal), smallest, resisted);
  if (attempt.outcome != Outcome::converged) return halve(run, attempt, target, smallest);
  typename S::State next = run.system.commit(attempt.trial, target);
  const TimeError error = run.system.time_error(run.result.state, next);
  const double relative = relative_error(error, position.pace), length = target - at;
  const double share = relative / accuracy.error;
  const int iterations = static_cast<int>(attempt.iterations.size());
  if (refuses(length, share, least)) {
    position.pace = after_refusal(position.pace, error, target);
    size = shorter(length, share, least);
    ++run.time_step.refused;
    run.wasted += iterations;
    return true;
  }
  position.extrapolation.add(attempt, length);
  position.pace = after_step(position.pace, error, target);
  size =
      next_length(size, length, share, iterations <= run.options.easy_iterations, least, nominal);
  at = target;
  run.time_step.length = error.length;
  run.time_step.error = relative;
  return run.accept(std::move(next), attempt, resisted, false);
}

/// The next increment off the path.
template <System S>
bool free_increment(StepRun<S>& run) {
  if constexpr (EstimatesTimeErrors<S>)
    if (run.options.time_steps) return time_increment(run, *run.options.time_steps);
  return load_increment(run);
}

/// The path has passed the fraction where it ends: the increment that ends there.
template <System S>
void end_path(StepRun<S>& run, PathPoint<typename S::Trial>& point) {
  const double until = run.position.path.until, at = run.position.at;
  const double share = (until - at) / (point.fraction - at);
  const Eigen::VectorXd total = share * point.result.total;
  const typename S::Trial near_end = run.system.apply(run.result.state, total, until, 1.0);
  std::vector<IterationRecord> iterations = std::move(point.result.iterations);
  point.result = run.condensation.of_all(
      run.system, run.result.state, until, run.options.newton, run.solver,
      {total, point.result.first_residual, point.result.first_energy}, &near_end);
  if constexpr (Augments<S>)
    augment(run.system, run.result.state, until, run.options.newton, run.solver, run.condensation,
            point.result);
  point.result.iterations.insert(point.result.iterations.begin(), iterations.begin(),
                                 iterations.end());
  point.fraction = until;
}

/// Load control goes on from where the path ended, or was given up.
template <System S>
void leave_path(StepRun<S>& run) {
  StepPosition& position = run.position;
  position.path.on = false;
  position.extrapolation.reset();
  const double n = run.nominal_increments;
  position.nominal = std::max(0, static_cast<int>(std::floor(position.at * n * (1 + 1e-12))));
  position.size = std::min(1 / n, position.size);
}

/// Whether many increments of a path together have moved the fraction by next to nothing.
inline bool leads_nowhere(PathPosition& path, double at, double nominal) {
  constexpr int many = 25;
  constexpr double nothing = 1e-4;
  if (std::abs(at - path.mark) > nothing * nominal) {
    path.mark = at;
    path.since_mark = 0;
  }
  return ++path.since_mark >= many;
}

/// One increment on the path. False: the step ends here, the path has led nowhere.
template <System S>
bool path_increment(StepRun<S>& run) {
  StepPosition& position = run.position;
  PathPosition& path = position.path;
  const ArcLengthOptions& options = run.options.arc_length;
  const double nominal = 1.0 / run.nominal_increments;
  const double size = path.length > 0 ? nominal : position.size;
  run.condensation.begin_anew();  // corrections of a path have factors of their own
  PathPoint<typename S::Trial> point = follow_path(run.system, run.result.state, position.at, size,
                                                   path, run.options.newton, run.solver);
  const auto found = [&] { return point.result.outcome == Outcome::converged; };
  const bool ends = found() && point.fraction >= path.until;
  const int iterations = static_cast<int>(point.result.iterations.size());
  if (ends) end_path(run, point);
  refuse(run.system, run.result.state, point.result);
  if (point.result.outcome == Outcome::stopped) return run.stop(point.result);
  if (!found()) {
    run.drop(point.result, point.fraction);
    path.length = 0.5 * point.length;
    path.lost = run.cutbacks > options.max_cutbacks || !(path.length > 0);
    if (path.lost) leave_path(run);
    return !path.lost || run.result.outcome == Outcome::converged;
  }
  path.before = point.result.total;
  path.length = (iterations <= options.easy_iterations ? 1.5 : 1.0) * point.length;
  position.at = point.fraction;
  ++path.increments;
  path.lost = !ends && (path.increments >= options.max_increments ||
                        leads_nowhere(path, position.at, nominal));
  if (ends || path.lost) leave_path(run);
  return run.accept(point.result, false, true);
}

}  // namespace detail

/// Runs one step from `start` to its end: from its beginning, or from where `position` stands,
/// which is kept up to date (and may be read by the observers).
template <System S>
[[nodiscard]] StepResult<typename S::State, typename S::Trial> run_step(
    S& system, const typename S::State& start, int nominal_increments,
    const IncrementOptions& options, la::LinearSolver& solver,
    const IncrementObserver<typename S::State>& on_increment, const CutbackObserver& on_cutback,
    StepPosition& position) {
  StepResult<typename S::State, typename S::Trial> result;
  result.state = start;
  detail::StepRun<S> run{system,       nominal_increments, options,  solver,
                         on_increment, on_cutback,         position, result};
  try {
    while (position.nominal < nominal_increments) {
      if (!position.path.on && position.at >= run.end()) {
        ++position.nominal;
        if (!options.time_steps) position.size = 0;
        continue;
      }
      if (!(position.path.on ? detail::path_increment(run) : detail::free_increment(run))) break;
    }
  } catch (const std::bad_alloc& error) {
    result.outcome = Outcome::out_of_memory;
    result.reason = core::out_of_memory_text(error);
  }
  return result;
}

/// The same from the beginning of the step.
template <System S>
[[nodiscard]] StepResult<typename S::State, typename S::Trial> run_step(
    S& system, const typename S::State& start, int nominal_increments,
    const IncrementOptions& options, la::LinearSolver& solver,
    const IncrementObserver<typename S::State>& on_increment, const CutbackObserver& on_cutback) {
  StepPosition position;
  return run_step(system, start, nominal_increments, options, solver, on_increment, on_cutback,
                  position);
}

}  // namespace osculate::solve
