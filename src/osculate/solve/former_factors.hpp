#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "osculate/la/nearby.hpp"
#include "osculate/solve/iteration.hpp"

namespace osculate::solve::detail {

/// The factors of a former iteration, which solve for further corrections, also of the increments
/// that follow. Where points have changed their states since, a hundred-millionth of what is out of
/// balance may be left: the next iteration finds other states anyway. Once two iterations have the
/// same states, something may have come loose that was held: a solution for noise says whether all
/// is held, and of symmetric kinds whether the equilibrium is stable. No increment ends before that
/// (`doubtful`), nor does one with factors of an earlier one. Where the energy alone says when
/// iterations end, factors serve for their own states only.
///
/// Formula    |R + K du| <= a tenth of the residual that ends the iterations, and 1e-8 |R|: where
///            the rest of the way is linear it is the last correction, as by factors of its own;
///            1e-8 |R| where states have changed
/// Decision   docs/decisions/059-former-factors.md, 091-noise-instead-of-factors.md,
///            099-stable-by-conjugate-gradients.md, 101-factors-that-pass-increments.md
/// Tested by  tests/unit/solve/test_former_factors.cpp
class FormerFactors {
 public:
  /// `wanted`: relative residual at which the iterations end.
  explicit FormerFactors(double wanted) : wanted_(wanted) {}
  /// Another attempt begins, which the factors of the last one may serve.
  void pass(double wanted) {
    wanted_ = wanted;
    earlier_ = symmetric_part_serves_ = true;
    fresh_ = moved_ = false;
    tried_.reset();
    failures_ = 0;
  }
  /// The last correction took a factorisation.
  [[nodiscard]] bool fresh() const { return fresh_; }
  /// Points have other states than at the last factorisation, or it was of an earlier increment:
  /// what is there of it does not know what has come loose.
  template <class Trial>
  [[nodiscard]] bool changed(const NewtonResult<Trial>& result) const {
    return earlier_ || result.evaluation.counts.signature != states_;
  }
  /// Nothing has been factored yet.
  [[nodiscard]] bool first() const { return first_; }
  void forget() { affordable_ = 0; }
  /// There are factors that may serve.
  [[nodiscard]] bool serve() const { return affordable_ > 0; }
  /// Whether factors of the symmetric part of a tangent may stand in for its own.
  [[nodiscard]] bool symmetric_part_serves() const { return symmetric_part_serves_; }
  void refuse_symmetric_part() { symmetric_part_serves_ = false; }
  void keep(const la::FactorReport& report, const la::SparseMatrix& k, const StateCounts& counts) {
    const bool sound = report.status == la::SolveStatus::ok && report.condition == 0;
    affordable_ = sound ? la::affordable_iterations(report, k) : 0;
    positive_ = report.negative_pivots == 0;
    states_ = last_ = counts.signature;
    fresh_ = true;
    first_ = earlier_ = false;
  }
  /// How much of the residual may be left by a correction of a solver that iterates.
  template <class Trial>
  [[nodiscard]] double aim(const NewtonResult<Trial>& result) const {
    constexpr double by_multigrid = 1e-3;
    return std::max(wanted(result), moved_ && wanted_ > 0 ? by_multigrid : 0.0);
  }
  /// du = -K^-1 R ; false: the tangent of `system` is to be factored.
  template <System S>
  bool solve(S& system, la::LinearSolver& solver, const NewtonResult<typename S::Trial>& result,
             const Eigen::VectorXd& residual, Eigen::VectorXd& du) {
    const std::uint64_t states = result.evaluation.counts.signature;
    const bool changed = this->changed(result), settled = states == last_;
    moved_ = !first_ && !earlier_ && !settled;
    last_ = states;
    constexpr double least = 1e-9;
    constexpr int tries = 2;
    if (affordable_ < 1) return false;
    if (changed && failures_ >= tries) return false;
    if (states != states_ && wanted_ <= 0) return false;
    if (!fresh_ && settled && !gains(result)) return false;
    // Never at rest; or pivots have to be counted.
    if (changed && (settled ? !can_be_tried(system, result) : wanted(result) >= share))
      return false;
    const bool moving = changed && !settled, begins = earlier_ && result.iterations.empty();
    const double tolerance = moving ? most_left : std::clamp(wanted(result), least, most_left);
    la::NearbySolutions by(system.matrix(), system.symmetry(), solver);
    du = -residual;
    fresh_ = !(moving || begins || resists_all(system, by)) ||
             !by.solve({affordable_, tolerance}, du).solved;
    if (changed && fresh_) ++failures_;
    return !fresh_;
  }

  /// Whether the tangent where the iterations would end is to be looked at: the last correction
  /// came by former factors, and nothing has said of its states that all is held, or pivots tell of
  /// unstable equilibria.
  template <System S>
  [[nodiscard]] bool doubtful(const S& system,
                              const NewtonResult<typename S::Trial>& result) const {
    if (fresh_) return false;
    if constexpr (requires { system.at_rest(); })
      if (system.symmetry() != la::Symmetry::unsymmetric && !result.evaluation.saddle &&
          system.at_rest())
        return true;
    return changed(result) && result.evaluation.counts.signature != tried_;
  }
  /// Whether an increment may end here: a doubtful tangent, which the system has at hand, is tried
  /// by noise, or factored. False: what is not held is for the next iteration to find.
  template <System S>
  bool holds_all(S& system, la::LinearSolver& solver, NewtonResult<typename S::Trial>& result) {
    if (!doubtful(system, result)) return true;
    last_ = result.evaluation.counts.signature;
    const la::SparseMatrix& k = system.matrix();
    la::NearbySolutions by(k, system.symmetry(), solver);
    if (can_be_tried(system, result) && noise_is_resisted(system, by)) return true;
    const la::FactorReport report = solver.factor(k, system.pattern_version(), system.symmetry());
    forget();
    if (report.status != la::SolveStatus::ok || report.condition > 0) return false;
    keep(report, k, result.evaluation.counts);
    result.iterations.back().factored = true;
    result.whole_factors = report.whole;
    result.negative_pivots = report.negative_pivots;
    return true;
  }

 private:
  /// Whether noise can say that a tangent holds everything.
  template <System S>
  [[nodiscard]] bool can_be_tried(const S& system,
                                  const NewtonResult<typename S::Trial>& result) const {
    return system.symmetry() == la::Symmetry::unsymmetric ||
           (positive_ && !result.evaluation.saddle);
  }
  template <System S>
  bool noise_is_resisted(const S& system, la::NearbySolutions& by) const {
    return (system.symmetry() == la::Symmetry::unsymmetric ? by.resists_all(affordable_)
                                                           : by.is_positive(affordable_))
        .solved;
  }
  /// Whether the tangent holds everything, where its states are not those of the factors.
  template <System S>
  bool resists_all(const S& system, la::NearbySolutions& by) {
    if ((!earlier_ && last_ == states_) || last_ == tried_) return true;
    if (!noise_is_resisted(system, by)) return false;
    tried_ = last_;
    return true;
  }
  /// Whether the last correction has left no more than half of the residual: else its digits may
  /// not do.
  template <class Trial>
  static bool gains(const NewtonResult<Trial>& result) {
    const std::vector<IterationRecord>& i = result.iterations;
    return i.size() < 2 || i.back().residual < 0.5 * i[i.size() - 2].residual;
  }
  /// To be left of the residual where it is the last correction.
  template <class Trial>
  [[nodiscard]] double wanted(const NewtonResult<Trial>& result) const {
    const double now = result.iterations.empty() ? 1.0 : result.iterations.back().residual;
    return share * wanted_ / now;
  }
  static constexpr double share = 0.1, most_left = 1e-8;
  double wanted_;
  int affordable_ = 0;                   ///< iterations; none without factors
  std::uint64_t states_ = 0, last_ = 0;  ///< of the factors, and of the last correction
  std::optional<std::uint64_t> tried_;   ///< of a tangent that resists all motions
  bool positive_ = true;                 ///< no negative pivots in the factors
  bool fresh_ = true, first_ = true;
  bool earlier_ = false;  ///< the factors are of an earlier increment
  bool symmetric_part_serves_ = true;
  bool moved_ = false;  ///< points have other states than at the last correction
  int failures_ = 0;    ///< where states had changed
};

}  // namespace osculate::solve::detail
