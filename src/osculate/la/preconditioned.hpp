#pragma once
#include <Eigen/Core>
#include <functional>

#include "osculate/la/nearby.hpp"

namespace osculate::la {

/// r becomes M^-1 r, M near to the matrix; false: it cannot be.
using Precondition = std::function<bool(Eigen::VectorXd&)>;

/// y becomes A x.
using Multiply = std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& y)>;

struct PreconditionedLimits {
  double tolerance = 1e-8;    ///< of the residual beside the right-hand side
  int iterations = 300;       ///< at most
  int restart = 50;           ///< vectors that are kept
  double enough = 0.3;        ///< of the residual may be left after each `restart` iterations
  double good_enough = 1e-8;  ///< where the tolerance is out of reach, as by rounding
};

/// Solves A x = b by GMRES with a preconditioner on the right, so that its residual is the true
/// one.
///
/// Returns    `solved` where |b - A x| <= tolerance |b|, or `good_enough` where no more is to be
/// had;
///            else nothing is changed
/// Source     Y. Saad, M. H. Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856-869
/// Tested by  tests/unit/la/test_nearby.cpp, test_iterative.cpp
[[nodiscard]] Nearby solve_preconditioned(const Multiply& a, const Precondition& precondition,
                                          const PreconditionedLimits& limits,
                                          Eigen::VectorXd& rhs_in_solution_out);

/// Numbers between -1 and 1, always the same ones.
[[nodiscard]] Eigen::VectorXd noise(Eigen::Index n);

}  // namespace osculate::la
