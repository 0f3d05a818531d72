#pragma once
#include "osculate/evaluator.hpp"

namespace osculate {

/// How the error of a tangent falls with the step.
struct DerivativeCheck {
  double error = 0;         ///< relative, at half the step
  double order = 0;         ///< log2 of the ratio of both errors; 2: the tangent is the derivative
  bool exact = false;       ///< both errors are rounding: a linear contact
  bool same_states = true;  ///< false: a step has changed the state or facet of a point, and so no
                            ///< order is to be expected
  [[nodiscard]] bool passed() const {
    return same_states && (exact || (order > 1.75 && order < 2.25));
  }
};

/// Whether the tangent of an evaluation is the derivative of its forces: K d along a fixed random
/// direction d against central differences with `step` and half of it.
///
/// Requires   a consistent tangent, and no shape on a frame (which moves rigidly alone); with
/// `step`
///            a small part of a facet, and points well inside their states, the order is 2
/// Tested by  tests/unit/embed/test_public_door.cpp
template <int Dim>
[[nodiscard]] DerivativeCheck check_derivative(const Evaluator<Dim>& evaluator,
                                               std::span<const double> coordinates,
                                               const History<Dim>& committed,
                                               const ActiveSet<Dim>& active_set,
                                               const Multipliers<Dim>& multipliers, double step,
                                               const Increment& increment = {});

extern template DerivativeCheck check_derivative(const Evaluator<2>&, std::span<const double>,
                                                 const History<2>&, const ActiveSet<2>&,
                                                 const Multipliers<2>&, double, const Increment&);
extern template DerivativeCheck check_derivative(const Evaluator<3>&, std::span<const double>,
                                                 const History<3>&, const ActiveSet<3>&,
                                                 const Multipliers<3>&, double, const Increment&);

}  // namespace osculate
