#pragma once
#include "osculate/solve/resistance.hpp"

namespace osculate::solve {

/// Systems in which negative pivots of the tangent mean that an equilibrium is unstable.
template <class S>
concept KnowsRest = Resists<S> && requires(const S s) {
  { s.at_rest() } -> std::same_as<bool>;  // nothing has inertia
};

/// Counts the motions that a converged equilibrium does not resist, but drives on: whatever touches
/// the bodies makes them leave it. Costs nothing where the last factors were those of a stable one.
///
/// Formula    negative pivots of K + c D at the converged state, which are negative eigenvalues of
///            it (Sylvester); c = 1e-12 of the bodies' own stiffness D: less may be round-off
/// Limits     an unsymmetric tangent or one with multipliers has pivots that say nothing of this,
///            and is not looked at; nor is a state on a path (arc length), which is free to be
///            unstable
/// Returns    whether it has factored: the solver has other factors then
/// Decision   docs/decisions/081-unstable-equilibria.md
/// Tested by  tests/unit/solve/test_stability.cpp
template <System S>
bool look_at_stability(S& system, const typename S::State& committed, double time,
                       la::LinearSolver& solver, NewtonResult<typename S::Trial>& result) {
  if constexpr (KnowsRest<S>) {
    constexpr double round_off = 1e-12;
    if (result.negative_pivots == 0 || !system.at_rest() || result.evaluation.saddle ||
        system.symmetry() == la::Symmetry::unsymmetric)
      return false;
    system.resist(round_off);
    system.evaluate(committed, result.trial, time, true, result.evaluation);
    const la::FactorReport report =
        solver.factor(system.matrix(), system.pattern_version(), system.symmetry());
    system.resist(0);
    result.precision.unstable = report.status == la::SolveStatus::ok ? report.negative_pivots : 0;
    return true;
  }
  return false;
}

}  // namespace osculate::solve
