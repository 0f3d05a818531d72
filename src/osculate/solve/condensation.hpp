#pragma once
#include <algorithm>
#include <limits>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "osculate/la/eliminated.hpp"
#include "osculate/solve/newton.hpp"

namespace osculate::solve {

/// Systems of which most unknowns feel forces that are linear in all of them, whatever the few
/// others do: bodies that are linear, and their contact.
///
/// stays_linear()            in the running step
/// changing_unknowns()       the few, sorted
/// leave_out_constant(on)    evaluations leave out the linear forces, and what `matrix` says of
///                           entries that are not between the few is of no use
/// assemble_constant(...)    a matrix of the linear forces alone, of entries between the few
/// constant_forces(...)      the linear forces on all unknowns
template <class S>
concept Condenses = System<S> &&
    requires(S s, const typename S::State& state, const typename S::Trial& trial, double time) {
  { s.unknowns() } -> std::convertible_to<Eigen::Index>;
  { s.stays_linear() } -> std::same_as<bool>;
  { s.changing_unknowns() } -> std::same_as<std::vector<Index>>;
  s.leave_out_constant(true);
  s.assemble_constant(state, time);
  { s.constant_forces(state, trial, time) } -> std::same_as<Eigen::VectorXd>;
};

namespace detail {

/// What the few unknowns C see of a system within one increment: the others, I, are where they are
/// in balance, and nobody looks where that is before the end.
///
/// Formula    R_C(u_C) = g_C(u_C) + p + S_CC (u_C - a_C) ,  p = l_C(a) - K_CI K_II^-1 (l_I(a) +
/// g_I)
///            with l the linear forces, g all others, a the committed state with what is prescribed
///            moved; S_CC, the reduction and the expansion: la::Eliminated
/// Requires   g_I does not change within the increment
template <System S>
class SeenByFew {
 public:
  using State = typename S::State;
  struct Trial {
    typename S::Trial whole;  ///< I as committed
    Eigen::VectorXd moved;    ///< u_C - a_C; empty: nothing
    Trial() = default;
    explicit Trial(const State& committed) : whole{committed} {}
    Trial(typename S::Trial at, Eigen::VectorXd by) : whole(std::move(at)), moved(std::move(by)) {}
  };

  SeenByFew(S& system, la::Eliminated& rest, const std::vector<Index>& few)
      : system_(system), rest_(rest), few_(few) {
    system_.leave_out_constant(true);
  }
  ~SeenByFew() { system_.leave_out_constant(false); }
  SeenByFew(const SeenByFew&) = delete;
  SeenByFew& operator=(const SeenByFew&) = delete;

  /// Size of the residual of all unknowns before the first correction, as far as `begin` knows it.
  [[nodiscard]] double first_residual() const { return first_residual_; }
  /// Finds p. False: it cannot be.
  bool begin(const State& committed, double time) {
    Evaluation others;
    system_.evaluate(committed, typename S::Trial{committed}, time, false, others);
    if (!others.ok || others.residual.size() == 0) return false;
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(others.residual.size());
    Eigen::VectorXd pull =
        system_.constant_forces(committed, system_.apply(committed, none, time, 1.0), time);
    const Eigen::VectorXd of_few = restricted(pull);
    pull += others.residual;
    for (Index a = 0; a < static_cast<Index>(few_.size()); ++a)
      pull[few_[static_cast<std::size_t>(a)]] = of_few[a];
    size_ = pull.size();
    first_residual_ = pull.norm();
    pull = -pull;
    if (!pull.allFinite() || !rest_.reduce(pull, pull_)) return false;
    pull_ = -pull_;
    return true;
  }
  /// All unknowns, where C has moved by this.
  bool expand(const Eigen::VectorXd& moved, Eigen::VectorXd& all) {
    return rest_.expand(moved, all);
  }
  [[nodiscard]] Eigen::VectorXd restricted(const Eigen::VectorXd& all) const {
    Eigen::VectorXd out(static_cast<Eigen::Index>(few_.size()));
    for (std::size_t a = 0; a < few_.size(); ++a) out[static_cast<Eigen::Index>(a)] = all[few_[a]];
    return out;
  }

  void predict(const State& state, double time, Evaluation& out, Prediction friction) {
    detail::predict(system_, state, time, friction, out);
    see(Eigen::VectorXd{}, out);
    out.force_scale = std::max(out.force_scale, out.residual.norm());
  }
  void predict(const State& state, double time, Evaluation& out) {
    predict(state, time, out, Prediction::as_before);
  }
  [[nodiscard]] bool touches_without_shear(const State& /*state*/) const { return false; }
  void evaluate(const State& committed, const Trial& trial, double time, bool with_tangent,
                Evaluation& out) {
    system_.evaluate(committed, trial.whole, time, with_tangent, out);
    see(trial.moved, out);
  }
  [[nodiscard]] Trial apply(const Trial& trial, const Eigen::VectorXd& du, double time,
                            double factor) const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(size_);
    for (std::size_t a = 0; a < few_.size(); ++a) all[few_[a]] = du[static_cast<Eigen::Index>(a)];
    Eigen::VectorXd moved = factor * du;
    if (trial.moved.size() > 0) moved += trial.moved;
    return {system_.apply(trial.whole, all, time, factor), std::move(moved)};
  }
  [[nodiscard]] Trial apply(const State& committed, const Eigen::VectorXd& du, double time,
                            double factor) const {
    return apply(Trial(committed), du, time, factor);
  }
  [[nodiscard]] Trial remember(const Trial& trial) const {
    return {system_.remember(trial.whole), trial.moved};
  }
  [[nodiscard]] std::optional<Trial> relaxed(const Trial& trial) const requires Relaxes<S> {
    std::optional<typename S::Trial> softer = system_.relaxed(trial.whole);
    if (!softer) return std::nullopt;
    return Trial(std::move(*softer), trial.moved);
  }
  [[nodiscard]] Trial restored(const Trial& trial, const Trial& before,
                               double part) const requires Relaxes<S> {
    return {system_.restored(trial.whole, before.whole, part), trial.moved};
  }
  [[nodiscard]] bool interrupted() const {
    if constexpr (Interruptible<S>) return system_.interrupted();
    return false;
  }
  [[nodiscard]] const la::SparseMatrix& matrix() {
    la::take_out(system_.matrix(), few_, matrix_);
    return matrix_;
  }
  [[nodiscard]] std::uint64_t pattern_version() const { return system_.pattern_version(); }
  [[nodiscard]] la::Symmetry symmetry() const { return system_.symmetry(); }
  /// Motion of a correction over the size of a cell, as the system has it.
  [[nodiscard]] double stride(const Eigen::VectorXd& du) const {
    if constexpr (Resists<S>) {
      Eigen::VectorXd all = Eigen::VectorXd::Zero(size_);
      for (std::size_t a = 0; a < few_.size(); ++a) all[few_[a]] = du[static_cast<Eigen::Index>(a)];
      return system_.stride(all);
    }
    return 2;
  }

 private:
  /// The residual of the few from that of the others of all unknowns.
  void see(const Eigen::VectorXd& moved, Evaluation& out) const {
    if (!out.ok) return;
    Eigen::VectorXd pull = pull_;
    if (moved.size() > 0) pull.noalias() += rest_.constant() * moved;
    out.residual = restricted(out.residual) + pull;
    if (out.branch_residual.size() > 0)
      out.branch_residual = restricted(out.branch_residual) + pull;
  }

  S& system_;
  la::Eliminated& rest_;
  const std::vector<Index>& few_;
  Eigen::VectorXd pull_;  ///< p
  Eigen::Index size_ = 0;
  double first_residual_ = 0;
  la::SparseMatrix matrix_;
};

}  // namespace detail

/// Newton's method on the few unknowns that may change, where a system is linear but for them: no
/// iteration evaluates, assembles or solves for anything else. The others follow at the end of the
/// increment, which is then evaluated in whole: what does not meet the tolerance there goes on with
/// all unknowns.
///
/// Decision   docs/decisions/088-iterations-of-the-few.md
/// Tested by  tests/unit/solve/test_condensation.cpp, tests/unit/deck/test_changing_unknowns.cpp
template <System S>
class Condensation {
 public:
  using Result = NewtonResult<typename S::Trial>;

  /// Systems of fewer unknowns than that are not looked at: to look costs an evaluation of a step.
  explicit Condensation(Eigen::Index worth_it = 3000) : worth_it_(worth_it) {}

  /// As `newton`, without a warm start. `dropped`: iterations that were of no use.
  Result newton(S& system, const typename S::State& committed, double time,
                const NewtonOptions& options, la::LinearSolver& solver, const Guess& guess,
                int& dropped) {
    if constexpr (Condenses<S>)
      if (!guess.resisted && options.residual > 0 && time != given_up_)
        if (std::optional<Result> found =
                where_it_fits(system, committed, time, options, solver, guess, dropped)) {
          begin_anew();
          return std::move(*found);
        }
    return of_all(system, committed, time, options, solver, guess);
  }

  /// With all unknowns, and by the factors of the last attempt where that has converged, or by the
  /// coarser models of a solver that iterates.
  Result of_all(S& system, const typename S::State& committed, double time,
                const NewtonOptions& options, la::LinearSolver& solver, const Guess& guess,
                const typename S::Trial* warm = nullptr) {
    if (passes_ && !guess.resisted)
      former_.pass(options.residual);
    else
      former_ = detail::FormerFactors(options.residual);
    Result result = solve::newton(system, committed, time, options, solver, guess, warm, &former_);
    passes_ = result.outcome == Outcome::converged && !guess.resisted &&
              (solver.asks_for_places() ? solver.passes() : former_.serve());
    return result;
  }

  /// An increment has converged: the few are asked again.
  void accepted() { given_up_ = std::numeric_limits<double>::quiet_NaN(); }
  /// The solver is, or was, used for something else; or nothing but the state may show in what
  /// follows.
  void begin_anew() { passes_ = false; }

 private:
  Eigen::Index worth_it_;
  la::Eliminated* rest_ = nullptr;
  bool looked_ = false;  ///< whether it pays in the running step
  bool passes_ = false;  ///< the solver has the factors that are told of by:
  detail::FormerFactors former_{0};
  double given_up_ = std::numeric_limits<double>::quiet_NaN();  ///< where the few found no end
  std::vector<Index> few_;

  /// As among_few; nothing also where memory is short of it: all unknowns may do with less.
  std::optional<Result> where_it_fits(S& system, const typename S::State& committed, double time,
                                      const NewtonOptions& options, la::LinearSolver& solver,
                                      const Guess& guess, int& dropped) {
    try {
      if (!prepare(system, committed, time, solver)) return std::nullopt;
      std::optional<Result> found =
          among_few(system, committed, time, options, solver, guess, dropped);
      if (!found) given_up_ = time;
      return found;
    } catch (const std::bad_alloc&) {
      if (rest_) rest_->forget();
      rest_ = nullptr;
      return std::nullopt;
    }
  }

  /// Looks once in a step whether the solver eliminates the others.
  bool prepare(S& system, const typename S::State& committed, double time,
               la::LinearSolver& solver) {
    if (looked_ && (!rest_ || rest_->stands())) return rest_ != nullptr;
    looked_ = true;
    rest_ = nullptr;
    if (system.unknowns() < worth_it_ || !system.stays_linear() || solver.asks_for_places())
      return false;
    few_ = system.changing_unknowns();
    if (few_.empty()) return false;
    Evaluation first;
    system.predict(committed, time, first);
    if (!first.ok) return false;
    begin_anew();
    rest_ = solver.eliminate(system.matrix(), system.symmetry());
    if (!rest_) return false;
    system.assemble_constant(committed, time);
    rest_->keep(system.matrix(), system.symmetry(), few_);
    if (!rest_->stands()) rest_ = nullptr;
    return rest_ != nullptr;
  }

  /// Nothing: all unknowns are to be iterated on from the beginning.
  std::optional<Result> among_few(S& system, const typename S::State& committed, double time,
                                  const NewtonOptions& options, la::LinearSolver& solver,
                                  const Guess& guess, int& dropped) {
    using Few = detail::SeenByFew<S>;
    NewtonResult<typename Few::Trial> found;
    Result result;
    {
      Few few(system, *rest_, few_);
      if (!few.begin(committed, time)) return std::nullopt;
      Guess of_few = guess;
      if (guess.du.size() > 0) of_few.du = few.restricted(guess.du);
      found = solve::newton(few, committed, time, options, *rest_, of_few);
      const bool stopped = found.outcome == Outcome::stopped;
      if (!stopped &&
          (found.outcome != Outcome::converged || !few.expand(found.trial.moved, result.total))) {
        dropped += static_cast<int>(found.iterations.size());
        return std::nullopt;
      }
      if (stopped) result.total.setZero(0);
      if (!found.extrapolated)
        found.first_residual = std::max(found.first_residual, few.first_residual());
    }
    result.iterations = std::move(found.iterations);
    result.extrapolated = found.extrapolated;
    result.first_residual = found.first_residual;
    result.first_energy = found.first_energy;
    result.precision = found.precision;
    result.whole_factors = false;
    result.trial = std::move(found.trial.whole);
    if (found.outcome == Outcome::stopped) {
      detail::fail(result, Outcome::stopped, found.reason);
      return result;
    }
    Eigen::VectorXd rest = result.total;
    for (const Index i : few_) rest[i] = 0;
    result.trial = system.apply(result.trial, rest, time, 1.0);
    system.evaluate(committed, result.trial, time, false, result.evaluation);
    if (!ends(options, found.evaluation.residual.norm(), result)) {
      begin_anew();
      go_on(system, committed, time, options, solver, result);
      if (result.outcome != Outcome::converged && result.outcome != Outcome::stopped) {
        dropped += static_cast<int>(result.iterations.size());
        return std::nullopt;
      }
    }
    return result;
  }

  /// Whether what all unknowns say of a solution of the few ends the increment: the tolerance is
  /// met, or the few have ended at rounding, and the others hardly add to that.
  static bool ends(const NewtonOptions& options, double of_few, Result& result) {
    constexpr double hardly = 2, limit = 1e-3;
    if (!result.evaluation.ok) return false;
    const double residual = detail::relative_residual(result);
    const bool met = residual <= options.residual;
    const bool rounded = result.precision.round_off && residual <= limit &&
                         result.evaluation.residual.norm() <= hardly * of_few;
    if (!met && !rounded) return false;
    result.outcome = Outcome::converged;
    result.precision.round_off = !met;
    if (!result.iterations.empty()) result.iterations.back().residual = residual;
    return true;
  }

  /// With all unknowns from where a solution of the few has led.
  static void go_on(S& system, const typename S::State& committed, double time,
                    const NewtonOptions& options, la::LinearSolver& solver, Result& result) {
    const Guess so_far{result.total, result.first_residual, result.first_energy};
    Result more = solve::newton(system, committed, time, options, solver, so_far, &result.trial);
    more.iterations.insert(more.iterations.begin(), result.iterations.begin(),
                           result.iterations.end());
    more.extrapolated = result.extrapolated;
    result = std::move(more);
  }
};

}  // namespace osculate::solve
