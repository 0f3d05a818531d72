#pragma once
#include <algorithm>
#include <cstdint>

#include "osculate/la/nearby.hpp"
#include "osculate/solve/iteration.hpp"

namespace osculate::solve::detail {

/// The factors of a former iteration of the same increment. They solve for a further correction
/// where no point has changed its state, so that nothing can have come loose that was held.
///
/// Formula    |R + K du| <= a tenth of the residual that ends the iterations, and 1e-4 |R|: where
///            the rest of the way is linear it is the last correction, as by factors of its own
/// Tested by  tests/unit/solve/test_former_factors.cpp
class FormerFactors {
 public:
  /// `wanted`: relative residual at which the iterations end.
  explicit FormerFactors(double wanted) : wanted_(wanted) {}
  /// The last correction took a factorisation.
  [[nodiscard]] bool fresh() const { return fresh_; }
  /// The increment has just begun.
  [[nodiscard]] bool first() const { return first_; }
  void forget() { affordable_ = 0; }
  void keep(const la::FactorReport& report, const la::SparseMatrix& k, const StateCounts& counts) {
    const bool sound = report.status == la::SolveStatus::ok && report.condition == 0;
    affordable_ = sound ? la::affordable_iterations(report, k) : 0;
    states_ = counts.signature;
    fresh_ = true;
    first_ = false;
  }
  /// How much of the residual may be left by a correction.
  template <class Trial>
  [[nodiscard]] double aim(const NewtonResult<Trial>& result) const {
    constexpr double share = 0.1;
    const double now = result.iterations.empty() ? 1.0 : result.iterations.back().residual;
    return share * wanted_ / now;
  }
  /// du = -K^-1 R ; false: the tangent of `system` is to be factored.
  template <System S>
  bool solve(S& system, la::LinearSolver& solver, const NewtonResult<typename S::Trial>& result,
             const Eigen::VectorXd& residual, Eigen::VectorXd& du) {
    if (affordable_ < 1 || result.evaluation.counts.signature != states_) return false;
    constexpr double least = 1e-9, most = 1e-4;
    du = -residual;
    const la::NearbyLimits limits{affordable_, std::clamp(aim(result), least, most)};
    fresh_ = !la::solve_nearby(system.matrix(), system.symmetry(), solver, limits, du).solved;
    return !fresh_;
  }

 private:
  double wanted_;
  int affordable_ = 0;  ///< iterations; none without factors
  std::uint64_t states_ = 0;
  bool fresh_ = true, first_ = true;
};

}  // namespace osculate::solve::detail
