#pragma once
#include <algorithm>
#include <cstdint>

#include "osculate/la/nearby.hpp"
#include "osculate/solve/iteration.hpp"

namespace osculate::solve::detail {

/// The factors of a former iteration of the same increment, which solve for further corrections.
/// Where points have changed their states since, a thousandth of what is out of balance may be
/// left: the next iteration finds other states anyway. Once two iterations have the same states
/// these are factored, and no increment ends with factors of others (`of_other_states`): something
/// may have come loose that was held. Not where the energy alone says when iterations end.
///
/// Formula    |R + K du| <= a tenth of the residual that ends the iterations, and 1e-4 |R|: where
///            the rest of the way is linear it is the last correction, as by factors of its own;
///            1e-3 |R| where states have changed
/// Tested by  tests/unit/solve/test_former_factors.cpp
class FormerFactors {
 public:
  /// `wanted`: relative residual at which the iterations end.
  explicit FormerFactors(double wanted) : wanted_(wanted) {}
  /// The last correction took a factorisation.
  [[nodiscard]] bool fresh() const { return fresh_; }
  /// The last correction came by factors of other states.
  [[nodiscard]] bool of_other_states() const { return !fresh_ && last_ != states_; }
  /// Points have other states than at the last factorisation: what is there of it does not know
  /// what has come loose.
  template <class Trial>
  [[nodiscard]] bool changed(const NewtonResult<Trial>& result) const {
    return result.evaluation.counts.signature != states_;
  }
  /// Nothing has been factored yet.
  [[nodiscard]] bool first() const { return first_; }
  void forget() { affordable_ = 0; }
  /// Whether factors of the symmetric part of a tangent may stand in for its own.
  [[nodiscard]] bool symmetric_part_serves() const { return symmetric_part_serves_; }
  void refuse_symmetric_part() { symmetric_part_serves_ = false; }
  void keep(const la::FactorReport& report, const la::SparseMatrix& k, const StateCounts& counts) {
    const bool sound = report.status == la::SolveStatus::ok && report.condition == 0;
    affordable_ = sound ? la::affordable_iterations(report, k) : 0;
    states_ = last_ = counts.signature;
    fresh_ = true;
    first_ = false;
  }
  /// How much of the residual may be left by a correction.
  template <class Trial>
  [[nodiscard]] double aim(const NewtonResult<Trial>& result) const {
    return std::max(wanted(result), moved_ && wanted_ > 0 ? on_the_way : 0.0);
  }
  /// du = -K^-1 R ; false: the tangent of `system` is to be factored.
  template <System S>
  bool solve(S& system, la::LinearSolver& solver, const NewtonResult<typename S::Trial>& result,
             const Eigen::VectorXd& residual, Eigen::VectorXd& du) {
    const std::uint64_t states = result.evaluation.counts.signature;
    const bool changed = states != states_, settled = states == last_;
    moved_ = !first_ && !settled;
    last_ = states;
    constexpr double least = 1e-9, most = 1e-4;
    constexpr int tries = 2;
    if (affordable_ < 1) return false;
    if (changed && (settled || failures_ >= tries || wanted_ <= 0 || wanted(result) >= share))
      return false;
    const double tolerance = changed ? on_the_way : std::clamp(wanted(result), least, most);
    du = -residual;
    fresh_ =
        !la::solve_nearby(system.matrix(), system.symmetry(), solver, {affordable_, tolerance}, du)
             .solved;
    if (changed && fresh_) ++failures_;
    return !fresh_;
  }

 private:
  /// To be left of the residual where it is the last correction.
  template <class Trial>
  [[nodiscard]] double wanted(const NewtonResult<Trial>& result) const {
    const double now = result.iterations.empty() ? 1.0 : result.iterations.back().residual;
    return share * wanted_ / now;
  }
  static constexpr double share = 0.1, on_the_way = 1e-3;
  double wanted_;
  int affordable_ = 0;                   ///< iterations; none without factors
  std::uint64_t states_ = 0, last_ = 0;  ///< of the factors, and of the last correction
  bool fresh_ = true, first_ = true;
  bool symmetric_part_serves_ = true;
  bool moved_ = false;  ///< points have other states than at the last correction
  int failures_ = 0;    ///< where states had changed
};

}  // namespace osculate::solve::detail
