#pragma once
#include <algorithm>

#include "osculate/la/linear_solver.hpp"
#include "osculate/solve/former_factors.hpp"
#include "osculate/solve/iteration.hpp"

namespace osculate::solve {

/// Systems that can put a small artificial stiffness on the diagonal of their tangent.
template <class S>
concept Resists = requires(S s, const Eigen::VectorXd& du, double share) {
  s.resist(share);                                  // of the bodies' own stiffness; 0 removes it
  { s.stride(du) } -> std::convertible_to<double>;  // largest motion over the size of an element
};

/// Systems that can tell a body that is free to move from one that is hardly stiff, as a thin
/// strip: to working precision both have singular tangents. The second's is used, and the
/// iterations correct what it lacks in digits.
template <class S>
concept KnowsFreeMotions = requires(const S s, const typename S::Trial& trial,
                                    const Eigen::VectorXd& mode) {
  { s.is_free_motion(trial, mode) } -> std::same_as<bool>;  // over the unknowns of the matrix
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

/// Systems whose tangents are symmetric but for little, as those with pressures that follow a
/// surface, of which only the rim is not.
template <class S>
concept NearlySymmetric = requires(const S s) {
  { s.nearly_symmetric() } -> std::same_as<bool>;
};

namespace detail {

/// Systems that are told between two iterations that no more are wanted.
template <class S>
concept Interruptible = requires(const S s) {
  { s.interrupted() } -> std::same_as<bool>;
};

/// False, and the result says why, where the tangent is not to be used.
template <System S>
bool factor_tangent(S& system, la::LinearSolver& solver, NewtonResult<typename S::Trial>& result,
                    la::FactorReport& report) {
  report = solver.factor(system.matrix(), system.pattern_version(), system.symmetry());
  result.precision.condition = std::max(result.precision.condition, report.condition);
  if constexpr (KnowsFreeMotions<S>)
    if (report.weakest.size() > 0 && !system.is_free_motion(result.trial, report.weakest))
      report.status = la::SolveStatus::ok;
  if constexpr (Softens<S>)
    if (report.status == la::SolveStatus::singular && system.soften())
      report = solver.factor(system.matrix(), system.pattern_version(), system.symmetry());
  result.linear = report.status;
  result.whole_factors = report.whole;
  result.negative_pivots = report.negative_pivots;
  result.bad_row = report.bad_row;
  if (report.status == la::SolveStatus::singular)
    return fail(result, Outcome::numerical_failure, "the tangent is singular");
  if (report.status != la::SolveStatus::ok)
    return fail(result, Outcome::numerical_failure, "the linear solver failed: " + report.message);
  return true;
}

/// du = -K^-1 R by factors of the symmetric part of K. False: K is to be factored, now and for the
/// rest of the increment.
///
/// Formula    |R + K du| <= 1e-11 |R|, about what factors of K leave
/// Decision   docs/decisions/069-the-symmetric-part.md
template <System S>
bool solve_by_symmetric_part(S& system, la::LinearSolver& solver, const Eigen::VectorXd& residual,
                             Eigen::VectorXd& du, NewtonResult<typename S::Trial>& result,
                             FormerFactors& former) {
  if constexpr (NearlySymmetric<S>) {
    constexpr Index worth_it = 1000;
    constexpr int at_least = 8;
    constexpr double tolerance = 1e-11;
    const la::SparseMatrix& k = system.matrix();
    if (!system.nearly_symmetric() || !former.symmetric_part_serves() || k.n < worth_it ||
        solver.asks_for_places())
      return false;
    const la::FactorReport report = la::factor_symmetric_part(k, system.pattern_version(), solver);
    du = -residual;
    const la::NearbyLimits limits{std::max(at_least, la::affordable_iterations(report, k)),
                                  tolerance};
    if (report.status != la::SolveStatus::ok || report.condition > 0 ||
        !la::solve_nearby(k, system.symmetry(), solver, limits, du).solved) {
      former.refuse_symmetric_part();
      return false;
    }
    result.whole_factors = report.whole;
    result.bad_row = -1;
    former.keep(report, k, result.evaluation.counts);
    return true;
  }
  return false;
}

/// du = -K^-1 R. Returns false and fills the result when the tangent cannot be used.
template <System S>
bool solve_correction(S& system, la::LinearSolver& solver, const Eigen::VectorXd& residual,
                      Eigen::VectorXd& du, NewtonResult<typename S::Trial>& result,
                      FormerFactors* former = nullptr) {
  result.linear = la::SolveStatus::ok;
  if constexpr (Interruptible<S>)
    if (system.interrupted()) return fail(result, Outcome::stopped, "stopped by the user");
  if (former && former->solve(system, solver, result, residual, du)) return true;
  if (former) former->forget();
  if (!former || former->first())
    solver.begin_anew();
  else if (former->changed(result))
    solver.may_come_loose();
  if (former && solve_by_symmetric_part(system, solver, residual, du, result, *former)) return true;
  // A solver that iterates knows after an attempt that the matrix is to be factored.
  const int attempts = solver.asks_for_places() ? 2 : 1;
  const int factored = solver.work().factored;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    la::FactorReport report;
    if (!factor_tangent(system, solver, result, report)) return false;
    du = -residual;
    if (former) solver.aim(former->aim(result));
    result.linear = solver.solve(du);
    if (result.linear != la::SolveStatus::ok || !du.allFinite()) continue;
    if (former) former->keep(report, system.matrix(), result.evaluation.counts);
    result.kept_factors = solver.asks_for_places() && solver.work().factored == factored;
    return true;
  }
  return fail(result, Outcome::numerical_failure, "the tangent is singular");
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
  bool solve(la::LinearSolver& solver, const Eigen::VectorXd& residual, Eigen::VectorXd& du,
             NewtonResult<typename S::Trial>& result, FormerFactors& former) {
    if (!on_) return solve_correction(system_, solver, residual, du, result, &former);
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

}  // namespace detail

}  // namespace osculate::solve
