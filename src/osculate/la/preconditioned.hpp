#pragma once
#include <Eigen/Core>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "osculate/core/crew.hpp"
#include "osculate/core/ranks.hpp"

namespace osculate::la {

/// r becomes M^-1 r, M near to the matrix; false: it cannot be.
using Precondition = std::function<bool(Eigen::VectorXd&)>;

/// y becomes A x.
using Multiply = std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& y)>;

struct PreconditionedLimits {
  double tolerance = 1e-8;    ///< of the residual beside the right-hand side
  int iterations = 300;       ///< at most
  int restart = 50;           ///< directions that are kept
  double enough = 0.3;        ///< of the residual may be left after each `restart` iterations
  double good_enough = 1e-8;  ///< where the tolerance is out of reach, as by rounding
};

/// How a solution by iterations went.
struct Nearby {
  bool solved = false;
  int iterations = 0;
};

/// Solutions of A x = b with M near to A. What was looked along for one right-hand side is not
/// looked along again for the next one.
///
/// Formula    z = M^-1 r , v = A z orthonormal to those before; x += (v . r) z , r -= (v . r) v :
///            the smallest residual over all z, as by GMRES, by one solution with M each. Where the
///            last step has left half of r, z = M^-1 v. Two vectors for each z that is kept
/// Shapes     vectors of several processes are each one's own part; without ranks they are whole
/// Source     P. Jiranek, M. Rozloznik, Numer. Algorithms 53 (2010) 93-112 (adaptive simpler
///            GMRES); Y. Saad, M. H. Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856-869;
///            L. Giraud, J. Langou, M. Rozloznik, Comput. Math. Appl. 50 (2005) 1069-1075 (all
///            parts at once, and once more)
/// Tested by  tests/unit/la/test_preconditioned.cpp, test_nearby.cpp, test_iterative.cpp
class PreconditionedSolutions {
 public:
  PreconditionedSolutions(Multiply a, Precondition precondition, const core::Ranks* ranks = nullptr,
                          core::Crew* crew = nullptr)
      : a_(std::move(a)), precondition_(std::move(precondition)), ranks_(ranks), crew_(crew) {}
  /// Returns    `solved` where |b - A x| <= tolerance |b|, or `good_enough` where no more is to be
  ///            had; else nothing is changed
  Nearby solve(const PreconditionedLimits& limits, Eigen::VectorXd& rhs_in_solution_out);

 private:
  struct Running;
  [[nodiscard]] double norm(const Eigen::VectorXd& v) const;
  [[nodiscard]] bool all_finite(const Eigen::VectorXd& v) const;
  void find_true_residual(Running& to) const;
  void take(std::size_t along, Running& to) const;
  bool look_along(Eigen::VectorXd z);
  [[nodiscard]] Eigen::VectorXd in_all(Eigen::VectorXd sums) const;
  bool step(Running& to, int& iterations);
  /// False: no more is to be had.
  [[nodiscard]] bool goes_on(const PreconditionedLimits& limits, Running& to);

  Multiply a_;
  Precondition precondition_;
  const core::Ranks* ranks_;
  core::Crew* crew_;
  std::vector<Eigen::VectorXd> along_, image_;  ///< A along = image
};

/// Numbers between -1 and 1, always the same ones.
[[nodiscard]] Eigen::VectorXd noise(Eigen::Index n);

}  // namespace osculate::la
