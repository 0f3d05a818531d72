#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <string>
#include <vector>

#include "osculate/la/direct_solver.hpp"
#include "osculate/la/sparse_matrix.hpp"
#include "osculate/solve/factored.hpp"

namespace osculate::solve {

/// How an attempt ended.
enum class Outcome {
  converged,
  not_converged,      ///< iterations used up, or the residual grows without end: cut the increment
  numerical_failure,  ///< singular tangent, inverted element, not a number: cut, and tell where
  stopped             ///< the observer asked to stop
};

/// States of the contact points, for the log and for state-aware step control.
struct StateCounts {
  int open = 0, stick = 0, slip = 0;
  std::uint64_t signature = 0;  ///< hash of the state of every point
  double friction_work = 0;     ///< dissipated by all points since the beginning
};

/// What a system returns for one configuration. The matrix stays inside the system.
struct Evaluation {
  bool ok = true;
  std::string message;              ///< why not ok (element, material)
  Eigen::VectorXd residual;         ///< out-of-balance force of the unknowns [force]
  Eigen::VectorXd branch_residual;  ///< what to linearise from where it differs from `residual`
  double force_scale = 0;  ///< largest of the norms of internal, external and contact forces
  double round_off = 0;    ///< a residual below this is rounding of coordinates times stiffness
  StateCounts counts;
  bool saddle = false;  ///< some unknowns are multipliers: the residual has no potential
};

enum class LineSearch { automatic, off };

/// Where an increment starts from. tangent: from the committed state, linearised there.
/// automatic: the same, but where increments follow each other smoothly and Newton needs several
/// iterations, from the quadratic extrapolation of the last ones (see increments.hpp).
enum class Predictor { automatic, tangent };

/// Convergence is judged by the residual |R| <= residual * scale and by the energy
/// |du . R| <= energy * (value of the first iteration). A measure with tolerance 0 is not used.
/// A correction at round-off (1e-10 of the increment's largest) ends the iteration in any case.
/// Both used (default): after a solve, the energy is the work of the remaining residual on the last
/// correction. Energy alone: the papers' rule, which needs the solve it is measured with
/// ("counting the last solve").
///
/// Formula    scale = max(force_scale, 1e-3 |R_1|), R_1 the residual of the prediction: a body that
///            is carried along without resistance has no forces but round-off to compare with
struct NewtonOptions {
  double residual = 1e-9;
  double energy = 1e-12;
  int max_iterations = 25;
  LineSearch line_search = LineSearch::automatic;
  Predictor predictor = Predictor::automatic;
};

/// A first guess of an increment, and what its convergence is measured by: an extrapolated start
/// is so near that its own first iteration would be no measure.
struct Guess {
  Eigen::VectorXd du;     ///< correction of the unknowns; empty = none
  double residual = 0;    ///< |R| of the last increment that was started by the tangent
  double energy = 0;      ///< first energy of that increment
  bool sticking = false;  ///< without du: predict points that slid to stick
  bool resisted = false;  ///< without du: resist free motions (see Resistance)
};

struct IterationRecord {
  double residual = 0;  ///< |R| / scale after the correction
  double energy = 0;    ///< relative to the first iteration
  double step = 1;      ///< line search factor
  StateCounts counts;
};

template <class S>
concept System = requires(S s, const typename S::State& state, const Eigen::VectorXd& du,
                          Evaluation& out, double time) {
  {s.predict(state, time, out)};                // residual and tangent at the committed state
  {s.evaluate(state, state, time, true, out)};  // committed, trial
  { s.apply(state, du, time, 1.0) } -> std::same_as<typename S::State>;
  { s.remember(state) } -> std::same_as<typename S::State>;
  { s.matrix() } -> std::same_as<const la::SparseMatrix&>;
  { s.pattern_version() } -> std::convertible_to<std::uint64_t>;
  { s.symmetry() } -> std::same_as<la::Symmetry>;
};

template <class State>
struct NewtonResult {
  Outcome outcome = Outcome::not_converged;
  std::string reason;
  State state;  ///< last iterate (converged or not)
  Evaluation evaluation;
  std::vector<IterationRecord> iterations;
  Eigen::VectorXd total;      ///< sum of the corrections
  bool extrapolated = false;  ///< started from the guess
  double first_residual = 0, first_energy = 0;
  la::SolveStatus linear = la::SolveStatus::ok;
  Index bad_row = -1;
};

namespace detail {

inline double relative(double value, double scale) {
  return scale > 0 ? value / scale : (value > 0 ? 1.0 : 0.0);
}

/// Judges one iteration; see NewtonOptions.
struct Judge {
  const NewtonOptions& options;
  double first_energy = 0;
  double largest_correction = 0;

  /// Rounding of the coordinates times a stiff penalty can keep the residual above any tolerance.
  /// A Newton correction 1e-10 times the largest one of the increment cannot improve the answer.
  [[nodiscard]] bool at_round_off(double residual, double correction) const {
    constexpr double smallest = 1e-10, residual_limit = 1e-3;
    return correction <= smallest * largest_correction && residual <= residual_limit;
  }

  [[nodiscard]] bool done(double residual, double energy_before, double energy_after) const {
    constexpr double round_off = 1e-14;
    const bool residual_ok = options.residual <= 0 || residual <= options.residual;
    if (options.energy <= 0) return residual_ok;
    const double energy = options.residual > 0 ? energy_after : energy_before;
    const bool energy_ok = energy <= options.energy * first_energy || residual <= round_off;
    return residual_ok && energy_ok;
  }
};

}  // namespace detail

/// Systems that can put a small artificial stiffness on the diagonal of their tangent.
template <class S>
concept Resists = requires(S s, const Eigen::VectorXd& du, double share) {
  s.resist(share);                                  // of the bodies' own stiffness; 0 removes it
  { s.stride(du) } -> std::convertible_to<double>;  // largest motion over the size of an element
};

/// Systems with multipliers whose constraints may say the same thing twice, as two nodes of a rigid
/// face that stick do: their tangent is singular, although the motion is not in doubt.
///
/// Formula    the rows G du - D dlambda = -g of the multipliers get D = 1e-8 diag(G diag(K)^-1
/// G^T):
///            a step of the proximal point method. The residual stays what it is, so that the
///            constraints hold exactly where the iterations end; multipliers share what they cannot
///            tell apart
/// Tested by  tests/unit/deck/test_redundant_multipliers.cpp
template <class S>
concept Softens = requires(S s) {
  { s.soften() } -> std::same_as<bool>;  // false: it has no multipliers
};

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
  la::FactorReport report = factored(system, solver);
  if constexpr (Softens<S>)
    if (report.status == la::SolveStatus::singular && system.soften())
      report = factored(system, solver);
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

/// Resistance against free motions, for bodies that nothing holds until contact closes, and against
/// motions of negative stiffness, as of a strip that snaps: these it slows down until they come to
/// rest. It is put on the tangent alone: the residual is the true one, so that nothing artificial
/// is left in a converged increment, and its work is zero.
///
/// Formula    (K + c D) du = -R, c such that nothing moves farther than an element in one
///            iteration and that the work du . R is not positive; ten times smaller after each
///            iteration that did not ask for more, half after a motion of negative stiffness, which
///            is fastest just above its own
/// Limits     with multipliers the work has no sign that means anything, and is not looked at
/// Tested by  tests/unit/solve/test_resistance.cpp
template <System S>
class Resistance {
 public:
  Resistance(S& system, bool on) : system_(system), on_(on && Resists<S>) {}
  ~Resistance() { set(0); }
  Resistance(const Resistance&) = delete;
  Resistance& operator=(const Resistance&) = delete;
  [[nodiscard]] bool on() const { return on_; }
  /// A motion of negative stiffness was met.
  [[nodiscard]] bool unstable() const { return unstable_; }

  /// As solve_correction, with as much resistance as it takes.
  bool solve(la::DirectSolver& solver, const Eigen::VectorXd& residual, Eigen::VectorXd& du,
             NewtonResult<typename S::State>& result) {
    if (!on_) return solve_correction(system_, solver, residual, du, result);
    constexpr double most = 1.0, stiffer = 100, spare = 2;
    for (bool first = true; share_ <= most; first = false) {
      set(share_);
      if (!solve_correction(system_, solver, residual, du, result)) {
        if (result.linear != la::SolveStatus::singular) return false;
        share_ *= stiffer;
        continue;
      }
      if (!result.evaluation.saddle && du.dot(residual) > 0) {
        share_ *= unstable_ ? nearly : stiffer;
        unstable_ = true;
        since_ = 0;
        continue;
      }
      const double stride = motion(du);
      if (stride <= 1) {
        ++since_;
        const double less = unstable_ && since_ <= patience ? 0.5 : 0.1;
        if (first) share_ = std::max(less * share_, least);
        return true;
      }
      share_ *= std::clamp(spare * stride, spare, stiffer * stiffer);
    }
    return fail(result, Outcome::numerical_failure, "free motions cannot be resisted");
  }

 private:
  static constexpr double least = 1e-9, usual = 1e-6, nearly = 4;
  static constexpr int patience = 4;
  void set(double share) {
    if constexpr (Resists<S>)
      if (on_) system_.resist(share);
  }
  double motion(const Eigen::VectorXd& du) {
    if constexpr (Resists<S>)
      return system_.stride(du);
    else
      return 0;
  }

  S& system_;
  bool on_, unstable_ = false;
  double share_ = usual;
  int since_ = 0;  ///< solutions since the last motion of negative stiffness
};

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
template <System S>
double line_search(S& system, const typename S::State& committed,
                   NewtonResult<typename S::State>& result, const Eigen::VectorXd& du,
                   const Eigen::VectorXd& old_residual, double time, bool falling = false) {
  constexpr int most = 10;
  constexpr double close_enough = 0.05;
  const typename S::State start = result.state;
  Evaluation trial;
  const auto at = [&](double step) {
    LinePoint<S> point{step};
    system.evaluate(committed, system.apply(start, du, time, step), time, false, trial);
    point.ok = trial.ok && trial.residual.allFinite();
    if (!point.ok) return point;
    point.work = du.dot(trial.residual);
    point.norm = trial.residual.norm();
    return point;
  };
  LinePoint<S> low{0, du.dot(old_residual), old_residual.norm(), true};
  LinePoint<S> high = at(1.0);
  if (high.ok &&
      trial.branch_residual.size() > 0) {  // points that jumped over: the active set decides
    result.state = system.apply(start, du, time, 1.0);
    return 1.0;
  }
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
  }
  result.state = system.apply(start, du, time, best.step);
  return best.step;
}

}  // namespace detail

namespace detail {

/// Systems with points that slide can predict the first iteration with all of them sticking.
template <class S>
concept PredictsSticking = requires(S s, const typename S::State& state, Evaluation& out) {
  s.predict(state, 0.0, out, true);
};

template <System S>
void predict(S& system, const typename S::State& committed, double time, bool sticking,
             Evaluation& out) {
  if constexpr (PredictsSticking<S>)
    system.predict(committed, time, out, sticking);
  else
    system.predict(committed, time, out);
}

/// Moves to the guess. False (and nothing changed but the evaluation) if it is no good start.
template <System S>
bool start_from_guess(S& system, const typename S::State& committed, double time,
                      const Guess& guess, NewtonResult<typename S::State>& result) {
  if (guess.du.size() == 0) return false;
  typename S::State state = system.apply(committed, guess.du, time, 1.0);
  system.evaluate(committed, state, time, true, result.evaluation);
  const Evaluation& e = result.evaluation;
  if (!e.ok || e.branch_residual.size() > 0 || !(e.residual.norm() < 0.5 * guess.residual))
    return false;
  result.state = std::move(state);
  result.total = guess.du;
  result.extrapolated = true;
  return true;
}

/// Starts from `warm`, from the guess, or at the committed state with the tangent's prediction.
template <System S>
void begin(S& system, const typename S::State& committed, double time, const Guess& guess,
           const typename S::State* warm, Judge& judge, NewtonResult<typename S::State>& result) {
  result.state = committed;
  if (warm) {
    result.state = *warm;
    system.evaluate(committed, *warm, time, true, result.evaluation);
    judge.first_energy = guess.energy;
    result.first_residual = guess.residual;
    result.total = guess.du;
    result.extrapolated = true;
    return;
  }
  if (start_from_guess(system, committed, time, guess, result)) {
    judge.first_energy = guess.energy;
    result.first_residual = guess.residual;
    judge.largest_correction = guess.du.lpNorm<Eigen::Infinity>();
    return;
  }
  predict(system, committed, time, guess.sticking, result.evaluation);
  if (result.evaluation.ok) result.first_residual = result.evaluation.residual.norm();
}

/// Writes down the iteration with correction `du`; true if it was the last one, converged or not.
template <class State>
bool conclude(Judge& judge, const Eigen::VectorXd& du, double step, double energy_before,
              NewtonResult<State>& result) {
  const Evaluation& e = result.evaluation;
  if (!e.ok) return !fail(result, Outcome::numerical_failure, e.message);
  const double least_scale = 1e-3 * result.first_residual;
  const double energy_after = std::abs(du.dot(e.residual));
  const bool by_residual = judge.options.residual > 0;
  IterationRecord record;
  record.step = step;
  const double size = e.residual.norm();
  record.residual = relative(size, std::max(e.force_scale, least_scale));
  record.energy = relative(by_residual ? energy_after : energy_before, judge.first_energy);
  record.counts = e.counts;
  result.iterations.push_back(record);
  if (!std::isfinite(record.residual))
    return !fail(result, Outcome::numerical_failure, "the residual is not a number");
  const double correction = du.lpNorm<Eigen::Infinity>();
  judge.largest_correction = std::max(judge.largest_correction, correction);
  const double counted = size <= e.round_off ? 0.0 : record.residual;
  if (!judge.done(counted, energy_before, energy_after) &&
      !(result.iterations.size() > 1 && judge.at_round_off(record.residual, correction)))
    return false;
  result.outcome = Outcome::converged;
  return true;
}

}  // namespace detail

/// One increment by Newton's method from a committed state to `time`.
///
/// The first iteration linearises at the committed state with the loads and prescribed increments
/// of `time` applied through the tangent (residual includes K du_prescribed), so the boundary
/// never moves ahead of the body. The committed state is never written: a failed increment has
/// nothing to undo. With `warm` the iteration goes on from that trial state, and `guess` has the
/// sum of the corrections so far and the measures of the first iteration.
template <System S>
[[nodiscard]] NewtonResult<typename S::State> newton(S& system, const typename S::State& committed,
                                                     double time, const NewtonOptions& options,
                                                     la::DirectSolver& solver,
                                                     const Guess& guess = {},
                                                     const typename S::State* warm = nullptr) {
  NewtonResult<typename S::State> result;
  detail::Judge judge{options};
  detail::begin(system, committed, time, guess, warm, judge, result);
  if (!result.evaluation.ok) {
    detail::fail(result, Outcome::numerical_failure, result.evaluation.message);
    return result;
  }
  detail::Resistance<S> resistance(system, guess.resisted);
  int most = (resistance.on() ? 2 : 1) * options.max_iterations;
  for (int i = 1; i <= most; ++i) {
    const Eigen::VectorXd residual = result.evaluation.residual;
    const bool branched = result.evaluation.branch_residual.size() > 0;
    const Eigen::VectorXd linearised = branched ? result.evaluation.branch_residual : residual;
    Eigen::VectorXd du;
    result.state = system.remember(result.state);
    if (!resistance.solve(solver, linearised, du, result)) return result;
    if (resistance.unstable()) most = 10 * options.max_iterations;  // a snap takes its time
    const double energy_before = std::abs(du.dot(residual));
    if (i == 1 && !result.extrapolated) judge.first_energy = energy_before;
    result.first_energy = judge.first_energy;

    double step = 1;
    const bool search = options.line_search == LineSearch::automatic;
    const bool smooth = !branched && !result.evaluation.saddle;
    if (search && smooth && (i > 1 || result.extrapolated || resistance.on()))
      step = detail::line_search(system, committed, result, du, residual, time, resistance.on());
    else
      result.state = system.apply(result.state, du, time, 1.0);
    system.evaluate(committed, result.state, time, true, result.evaluation);
    if (result.total.size() == 0) result.total.setZero(du.size());
    result.total += step * du;
    if (detail::conclude(judge, du, step, energy_before, result)) return result;
  }
  detail::fail(result, Outcome::not_converged,
               "not converged after " + std::to_string(most) + " iterations");
  return result;
}

}  // namespace osculate::solve
