#pragma once
#include <concepts>
#include <span>

#include "osculate/la/direct_solver.hpp"

namespace osculate::solve {

/// Systems with multipliers that the solver may eliminate before it factors (la::Condensation).
template <class S>
concept Condenses = requires(const S s) {
  { s.condensable() } -> std::convertible_to<std::span<const la::MultiplierGroup>>;
};

/// Factors the tangent of the last evaluation. Only the linear solution knows of the condensation:
/// residual, correction and all measures of convergence are those of the whole system.
template <class S>
[[nodiscard]] la::FactorReport factored(S& system, la::DirectSolver& solver) {
  if constexpr (Condenses<S>)
    return solver.factor(system.matrix(), system.pattern_version(), system.symmetry(),
                         system.condensable());
  else
    return solver.factor(system.matrix(), system.pattern_version(), system.symmetry());
}

}  // namespace osculate::solve
