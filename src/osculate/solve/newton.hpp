#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "osculate/solve/line_search.hpp"
#include "osculate/solve/peeling.hpp"
#include "osculate/solve/resistance.hpp"
#include "osculate/solve/stability.hpp"

namespace osculate::solve {

namespace detail {

inline double relative(double value, double scale) {
  return scale > 0 ? value / scale : (value > 0 ? 1.0 : 0.0);
}

/// Judges one iteration; see NewtonOptions.
struct Judge {
  const NewtonOptions& options;
  double aim = 0;  ///< fraction of the step, for who watches
  double first_energy = 0;
  double largest_correction = 0;
  double least_residual = std::numeric_limits<double>::infinity();
  int stalled = 0;  ///< iterations that made the residual hardly smaller, one after the other
  int tiny_steps = 0, short_steps = 0;
  bool patient = true;  ///< motions that go far before they come to rest are expected
  int wild = 0;         ///< iterations that left more than there was at first, one after the other
  double last_residual = 0;

  /// Rounding of the coordinates times a stiff penalty can keep the residual above any tolerance.
  /// A Newton correction 1e-10 times the largest one of the increment cannot improve the answer.
  [[nodiscard]] bool at_round_off(double residual, double correction) const {
    constexpr double smallest = 1e-10, residual_limit = 1e-3;
    return correction <= smallest * largest_correction && residual <= residual_limit;
  }

  /// What the residual keeps is rounding, and the answer is none the worse for it: the work of the
  /// last correction says that it was the last one.
  [[nodiscard]] bool only_rounding(const Evaluation& e, double residual, double energy_before,
                                   double first_residual) const {
    constexpr double residual_limit = 1e-3, energy_limit = 1e-10, standing_limit = 1e-6,
                     far_below = 1e-3, below = 0.1;
    constexpr int standing = 3;
    const double size = e.residual.norm();
    // The increment began in balance: its first energy is none to be compared with.
    const bool nothing_new = first_residual <= below * options.residual * e.force_scale;
    if (stalled >= 2 && residual <= (nothing_new ? below : far_below) * options.residual)
      return true;
    if (stalled >= standing && options.energy > 0 && residual <= standing_limit &&
        energy_before <= options.energy * first_energy)
      return true;
    if (stalled == 0 || size > e.round_off) return false;
    if (size <= e.round_off_in_time) return true;
    if (!e.loaded && first_residual <= e.round_off) return true;  // nothing drives the system
    return residual <= residual_limit && energy_before <= energy_limit * first_energy;
  }

  /// A tangent without digits may leave a small residual far from the answer: only corrections that
  /// have become small beside the first ones say that it is near, or that do no work: forces of the
  /// size of rounding go on moving along what has no stiffness. Multipliers of constraints that say
  /// the same twice are free to move for ever: they say nothing.
  [[nodiscard]] bool settled(double condition, bool saddle, double correction,
                             double energy_before) const {
    constexpr double small = 1e-5, no_work = 1e-16, smaller = 1e-2;
    return condition == 0 || saddle || correction <= small * largest_correction ||
           (energy_before <= no_work * first_energy && correction <= smaller * largest_correction);
  }

  /// Three times in a row no part of the correction that can be told from none lessens what is out
  /// of balance (a force that jumps): the next iteration would find the same.
  [[nodiscard]] bool stuck() const { return tiny_steps >= 3; }

  /// Short steps that hardly help, one after the other and near a solution: there the norm of the
  /// residual is a poor guide, and the next correction is taken as a whole.
  [[nodiscard]] bool creeps() const { return short_steps >= 3; }

  /// Bodies were driven far through each other, and every correction drives them farther: what is
  /// left of the forces does more work on each than the first one had to do. An increment half as
  /// long ends sooner than this one.
  ///
  /// Decision   docs/decisions/062-attempts-that-diverge.md
  [[nodiscard]] bool diverges() const {
    constexpr int enough = 8;
    return !patient && wild >= enough;
  }
  void look_for_divergence(const IterationRecord& record) {
    constexpr double most_of_it = 0.5, far_more = 10;
    const bool worse = record.residual > most_of_it && record.energy > far_more;
    wild = worse ? wild + 1 : 0;
  }

  /// Another problem is solved from here on, on the way to the same solution.
  void begin_again() {
    least_residual = std::numeric_limits<double>::infinity();
    stalled = tiny_steps = short_steps = wild = 0;
  }

  void look_at(double residual_norm, double step, bool near) {
    constexpr double better = 0.5, tiny = 1e-6, brief = 0.3, hardly = 0.9;
    const bool crept =
        near && step < brief && step > tiny && residual_norm > hardly * last_residual;
    short_steps = crept ? short_steps + 1 : 0;
    last_residual = residual_norm;
    tiny_steps = step < tiny ? tiny_steps + 1 : 0;
    stalled = residual_norm > better * least_residual ? stalled + 1 : 0;
    least_residual = std::min(least_residual, residual_norm);
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

namespace detail {

/// Systems with friction can predict the first iteration in other ways.
template <class S>
concept PredictsFriction = requires(S s, const typename S::State& state, Evaluation& out) {
  s.predict(state, 0.0, out, Prediction::sticking);
  { s.touches_without_shear(state) } -> std::same_as<bool>;
};

template <System S>
void predict(S& system, const typename S::State& committed, double time, Prediction friction,
             Evaluation& out) {
  if constexpr (PredictsFriction<S>)
    system.predict(committed, time, out, friction);
  else
    system.predict(committed, time, out);
}

/// Moves to the guess. False (and nothing changed but the evaluation) if it is no good start.
template <System S>
bool start_from_guess(S& system, const typename S::State& committed, double time,
                      const Guess& guess, NewtonResult<typename S::Trial>& result) {
  if (guess.du.size() == 0) return false;
  typename S::Trial trial = system.apply(committed, guess.du, time, 1.0);
  system.evaluate(committed, trial, time, true, result.evaluation);
  const Evaluation& e = result.evaluation;
  if (!e.ok || e.branch_residual.size() > 0 || !(e.residual.norm() < 0.5 * guess.residual))
    return false;
  result.trial = std::move(trial);
  result.total = guess.du;
  result.extrapolated = true;
  return true;
}

/// Starts from `warm`, from the guess, or at the committed state with the tangent's prediction.
template <System S>
void begin(S& system, const typename S::State& committed, double time, const Guess& guess,
           const typename S::Trial* warm, Judge& judge, NewtonResult<typename S::Trial>& result) {
  result.trial = typename S::Trial{committed};
  if (warm) {
    result.trial = *warm;
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
  predict(system, committed, time, guess.friction, result.evaluation);
  if (result.evaluation.ok) result.first_residual = result.evaluation.residual.norm();
}

/// The residual of an iteration beside the forces.
template <class Trial>
double relative_residual(const NewtonResult<Trial>& result) {
  const double least_scale = 1e-3 * result.first_residual;
  const Evaluation& e = result.evaluation;
  return relative(e.residual.norm(), std::max(e.force_scale, least_scale));
}

/// Bodies that come free of their first penetrations, facet by facet, and the like: what is out of
/// balance still falls, and an increment half as long would begin with the same.
inline bool gains(const std::vector<IterationRecord>& iterations) {
  constexpr std::size_t window = 10;
  constexpr double enough = 0.5;
  const std::size_t n = iterations.size();
  return n > window && iterations[n - 1].residual < enough * iterations[n - 1 - window].residual;
}

/// Whether the tolerances are met, so that no tangent is needed any more.
template <class Trial>
bool meets(const Judge& judge, const Eigen::VectorXd& du, double energy_before,
           const NewtonResult<Trial>& result) {
  const Evaluation& e = result.evaluation;
  return e.ok && judge.done(relative_residual(result), energy_before, std::abs(du.dot(e.residual)));
}

/// Writes down the iteration with correction `du`; true if it was the last one, converged or not.
template <class Trial>
bool conclude(Judge& judge, const Eigen::VectorXd& du, double step, double energy_before,
              NewtonResult<Trial>& result, const FormerFactors& former = FormerFactors{0}) {
  const Evaluation& e = result.evaluation;
  if (!e.ok) return !fail(result, Outcome::numerical_failure, e.message);
  const double energy_after = std::abs(du.dot(e.residual));
  const bool by_residual = judge.options.residual > 0;
  IterationRecord record;
  record.step = step;
  record.factored = former.fresh() && !result.kept_factors;
  record.whole = result.whole_factors;
  const double size = e.residual.norm();
  record.residual = relative_residual(result);
  record.energy = relative(by_residual ? energy_after : energy_before, judge.first_energy);
  record.counts = e.counts;
  result.iterations.push_back(record);
  if (judge.options.iterated)
    judge.options.iterated({judge.aim, static_cast<int>(result.iterations.size()), record});
  if (!std::isfinite(record.residual))
    return !fail(result, Outcome::numerical_failure, "the residual is not a number");
  const double correction = du.lpNorm<Eigen::Infinity>();
  judge.largest_correction = std::max(judge.largest_correction, correction);
  judge.look_at(size, step, record.residual < 1e-3);
  judge.look_for_divergence(record);
  result.precision.round_off = false;
  if (!judge.settled(result.precision.condition, e.saddle, correction, energy_before)) return false;
  if (!judge.done(record.residual, energy_before, energy_after)) {
    const bool rounding =
        judge.only_rounding(e, record.residual, energy_before, result.first_residual) ||
        (result.iterations.size() > 1 && judge.at_round_off(record.residual, correction));
    if (!rounding && judge.stuck())
      return !fail(result, Outcome::not_converged,
                   "no part of the correction lessens the forces out of balance");
    if (!rounding && judge.diverges())
      return !fail(result, Outcome::not_converged,
                   "the iterations diverge: every correction leaves more out of balance");
    if (!rounding) return false;
    result.precision.round_off = by_residual && record.residual > judge.options.residual;
  }
  result.outcome = Outcome::converged;
  return true;
}

/// False where the iterations would end with a tangent that leaves something free to move: the next
/// one finds out what.
template <System S>
bool is_sound(S& system, la::LinearSolver& solver, FormerFactors& former,
              NewtonResult<typename S::Trial>& result) {
  if (result.outcome != Outcome::converged) return true;
  if (solver.sound() && former.holds_all(system, solver, result)) return true;
  result.outcome = Outcome::not_converged;
  return false;
}

/// Whether the iterations end with the last correction. Its state gets its tangent, which `known`
/// states lack, where that is asked whether it holds everything, or another iteration follows.
template <System S>
bool ends(S& system, const typename S::State& committed, double time, la::LinearSolver& solver,
          FormerFactors& former, bool known, bool last, NewtonResult<typename S::Trial>& result) {
  const auto with_tangent = [&] {
    system.evaluate(committed, result.trial, time, true, result.evaluation);
  };
  const bool look = known && last && former.doubtful(system, result);
  if (look) with_tangent();
  const bool ended = last && is_sound(system, solver, former, result);
  if (known && !look && !ended) with_tangent();
  return ended;
}

/// A correction of the trial, and from where it began.
struct Correction {
  const Eigen::VectorXd &du, &residual;  ///< residual before it
  double time;
  double energy;  ///< |du . residual|
  bool first;     ///< of the increment
  bool resisted;
};

/// Whether the first correction of an increment went far too far: by more than a cell, and into
/// something it knew nothing of, which pushes back with a thousand times the work that the loads
/// did. (Contact that closes over less is found in fewer iterations from there.)
template <System S>
bool overshot(const S& system, const Correction& by, int touching,
              const NewtonResult<typename S::Trial>& result) {
  constexpr double far_too_far = 1e3;
  const Evaluation& e = result.evaluation;
  if (!e.ok || e.counts.touching() <= touching) return false;
  const double work = by.du.dot(e.residual);
  if (work * by.du.dot(by.residual) >= 0 || std::abs(work) <= far_too_far * by.energy) return false;
  if constexpr (requires { system.stride(by.du); }) return system.stride(by.du) > 1;
  return true;
}

/// Moves the trial along a correction, by a line search where the residual is smooth, and evaluates
/// it there with its tangent. `known`: what is converged needs no tangent, and is not evaluated
/// twice; where that is far ahead the search evaluates the full correction with it. The first
/// correction of an increment is searched where it went too far, and only if nothing is prescribed
/// to move: bodies would lag behind that.
///
/// Decision   docs/decisions/084-first-corrections.md
template <System S>
Searched move_along(S& system, const typename S::State& committed, const Correction& by, bool whole,
                    const Judge& judge, NewtonResult<typename S::Trial>& result, bool& known) {
  const Evaluation& e = result.evaluation;
  const bool search = judge.options.line_search == LineSearch::automatic && !whole &&
                      e.branch_residual.size() == 0 && !e.saddle;
  const bool weak = result.precision.condition > 0;
  const bool doubtful = !by.first || result.extrapolated || by.resisted || weak;
  constexpr double far = 1e-5;  // of the scale: the next iterate may be the last one below
  const bool ahead = !by.resisted && by.residual.norm() > far * e.force_scale;
  const bool led = e.led;
  const int touching = e.counts.touching();
  Searched searched;
  const auto look = [&] {
    searched = line_search(system, committed, result, by.du, by.residual, by.time, by.resisted,
                           weak, ahead && doubtful);
  };
  const typename S::Trial start = result.trial;
  if (search && doubtful)
    look();
  else
    result.trial = system.apply(start, by.du, by.time, 1.0);
  known = searched.evaluated && !searched.with_tangent && !by.resisted &&
          meets(judge, by.du, by.energy, result);
  if (!known && !searched.with_tangent)
    system.evaluate(committed, result.trial, by.time, true, result.evaluation);
  if (!search || doubtful || led || !overshot(system, by, touching, result)) return searched;
  result.trial = start;
  look();
  if (!searched.with_tangent)
    system.evaluate(committed, result.trial, by.time, true, result.evaluation);
  return searched;
}

/// How many iterations there may be at the last one of `most`: one more where the solver of that
/// one has told at its end that it was none, others where they gain.
template <class Trial>
int allowed(int most, int more, int limit, bool unsound, const NewtonResult<Trial>& result) {
  if (unsound) return most + 1;
  return most < limit && gains(result.iterations) ? std::min(most + more, limit) : most;
}

}  // namespace detail

/// One increment by Newton's method from a committed state to `time`.
///
/// The first iteration linearises at the committed state with the loads and prescribed increments
/// of `time` applied through the tangent (residual includes K du_prescribed), so the boundary
/// never moves ahead of the body. The committed state is never written: a failed increment has
/// nothing to undo. With `warm` the iteration goes on from that trial state, and `guess` has the
/// sum of the corrections so far and the measures of the first iteration. `kept`: factors that
/// `solver` may still have, and those of this increment afterwards.
template <System S>
[[nodiscard]] NewtonResult<typename S::Trial> newton(S& system, const typename S::State& committed,
                                                     double time, const NewtonOptions& options,
                                                     la::LinearSolver& solver,
                                                     const Guess& guess = {},
                                                     const typename S::Trial* warm = nullptr,
                                                     detail::FormerFactors* kept = nullptr) {
  NewtonResult<typename S::Trial> result;
  detail::Judge judge{options, time};
  detail::begin(system, committed, time, guess, warm, judge, result);
  if (!result.evaluation.ok) {
    detail::fail(result, Outcome::numerical_failure, result.evaluation.message);
    return result;
  }
  detail::Resistance<S> resistance(system, guess.resisted);
  judge.patient = resistance.on();
  detail::Peeling<S> peeling;
  detail::FormerFactors own(options.residual);
  detail::FormerFactors& former = kept ? *kept : own;
  int most = (resistance.on() ? 2 : 1) * options.max_iterations;
  const int more = options.max_iterations / 2, limit = 4 * most;
  for (int i = 1; i <= most + peeling.iterations(); ++i) {
    const Eigen::VectorXd residual = result.evaluation.residual;
    const bool branched = result.evaluation.branch_residual.size() > 0;
    const Eigen::VectorXd linearised = branched ? result.evaluation.branch_residual : residual;
    Eigen::VectorXd du;
    result.trial = system.remember(result.trial);
    if (!resistance.solve(solver, linearised, du, result, former)) {
      if (!peeling.gives_up(system, committed, time, result)) return result;
      judge.begin_again();
      continue;
    }
    if (resistance.unstable()) most = 10 * options.max_iterations;  // a snap takes its time
    const double energy_before = std::abs(du.dot(residual));
    if (i == 1 && !result.extrapolated) judge.first_energy = energy_before;
    result.first_energy = judge.first_energy;
    const bool whole = judge.creeps() || peeling.turned();
    bool known = false;
    const detail::Correction correction{du, residual, time, energy_before, i == 1, resistance.on()};
    const detail::Searched searched =
        detail::move_along(system, committed, correction, whole, judge, result, known);
    if (result.total.size() == 0) result.total.setZero(du.size());
    result.total += searched.step * du;
    const bool last = detail::conclude(judge, du, searched.step, energy_before, result, former);
    const bool ended = detail::ends(system, committed, time, solver, former, known, last, result);
    if (peeling.turns(system, committed, time, ended, result))
      judge.begin_again();
    else if (ended) {
      if (look_at_stability(system, committed, time, solver, result)) former.forget();
      return result;
    }
    if (i == most + peeling.iterations())
      most = detail::allowed(most, more, limit, last && !ended, result);
  }
  detail::fail(result, Outcome::not_converged,
               "not converged after " + std::to_string(most) + " iterations");
  return result;
}

}  // namespace osculate::solve
