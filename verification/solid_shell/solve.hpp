#pragma once
// The problems as models of the product.
#include <string>
#include <vector>

#include "osculate/model/analysis.hpp"
#include "problems.hpp"

namespace osculate::verification::shell {

/// The bulk, its supports and its loads in one step. An end moment acts on the rotation of the edge
/// as a rigid body, which is free to move in the plane of bending.
[[nodiscard]] model::Model3 to_model(const ShellProblem& problem, int increments);

/// Equilibrium path of a problem.
struct ShellPath {
  bool converged = false;
  std::string message;
  int iterations = 0, cutbacks = 0;
  std::vector<double> fraction;
  std::vector<Eigen::VectorXd> u;  ///< at each converged increment

  /// The displacements at `fraction` of the loads, which must be the end of an increment.
  [[nodiscard]] const Eigen::VectorXd& at(double fraction) const;
};

/// Solves with the defaults of the product and `increments` load steps.
///
/// Errors     std::runtime_error with the message of the analysis where it does not converge
[[nodiscard]] ShellPath solve(const ShellProblem& problem, int increments, const Workers& workers);

}  // namespace osculate::verification::shell
