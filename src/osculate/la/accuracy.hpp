#pragma once
#include <Eigen/Core>
#include <functional>

#include "osculate/core/types.hpp"

namespace osculate::la {

/// Replaces a right-hand side by the solution; false: there is none.
using Solve = std::function<bool(Eigen::VectorXd&)>;

/// Relative error of the solution for a known vector: about eps times the condition number of the
/// matrix scaled by its rows, so of order one for a singular one.
///
/// Input      scale: square roots of the largest entries of the rows
[[nodiscard]] double lost_accuracy(
    const Eigen::VectorXd& scale,
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& multiply, const Solve& solve);

/// What a matrix resists least, by inverse iterations on the matrix scaled by its rows.
struct WeakestMode {
  Eigen::VectorXd values{};  ///< empty: the iterations gave no numbers
  Index row = -1;            ///< that moves most
};
[[nodiscard]] WeakestMode weakest_mode(const Eigen::VectorXd& scale, const Solve& solve);

}  // namespace osculate::la
