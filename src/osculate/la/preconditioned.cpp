#include "osculate/la/preconditioned.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unsupported/Eigen/IterativeSolvers>
#include <utility>

namespace osculate::la {
namespace {

/// A M^-1, whose residual is the true one.
struct Preconditioned {
  const Multiply& a;
  const Precondition& precondition;
  Eigen::Index n;

  [[nodiscard]] Eigen::Index rows() const { return n; }
  /// Not a number where the preconditioner does not work.
  [[nodiscard]] Eigen::VectorXd solution(const Eigen::VectorXd& y) const {
    Eigen::VectorXd x = y;
    if (!precondition(x)) x = Eigen::VectorXd::Constant(n, std::nan(""));
    return x;
  }
  [[nodiscard]] Eigen::VectorXd operator*(const Eigen::VectorXd& y) const {
    Eigen::VectorXd product;
    a(solution(y), product);
    return product;
  }
};

/// What Eigen asks of a preconditioner on the left.
struct NothingOnTheLeft {
  [[nodiscard]] static const Eigen::VectorXd& solve(const Eigen::VectorXd& b) { return b; }
};

}  // namespace

Nearby solve_preconditioned(const Multiply& a, const Precondition& precondition,
                            const PreconditionedLimits& limits,
                            Eigen::VectorXd& rhs_in_solution_out) {
  const Eigen::VectorXd& b = rhs_in_solution_out;
  const Eigen::Index n = b.size();
  Nearby result;
  if (n == 0 || limits.iterations < 1 || !b.allFinite()) return result;
  constexpr double rounding = 1 + 1e-6;
  const Preconditioned by{a, precondition, n};
  const double size = b.stableNorm();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n), rest = b, product;
  double left = size;
  while (size > 0 && result.iterations < limits.iterations) {
    const Eigen::Index most =
        std::min<Eigen::Index>({limits.restart, limits.iterations - result.iterations, n});
    Eigen::Index iterations = most;
    double residual = limits.tolerance * size / left;
    Eigen::VectorXd y = Eigen::VectorXd::Zero(n);
    Eigen::internal::gmres(by, rest, y, NothingOnTheLeft{}, iterations, most, residual);
    result.iterations += static_cast<int>(std::max<Eigen::Index>(iterations, 1));
    const Eigen::VectorXd further = by.solution(y);
    if (!further.allFinite()) return result;
    a(further, product);
    const double then = Eigen::VectorXd(rest - product).stableNorm();
    const bool gains = then <= limits.enough * left;
    if (then < left) {
      x += further;
      rest -= product;
      left = then;
    }
    if (left <= rounding * limits.tolerance * size || !gains) break;
  }
  result.solved = left <= rounding * std::max(limits.tolerance, limits.good_enough) * size;
  if (result.solved) rhs_in_solution_out = std::move(x);
  return result;
}

Eigen::VectorXd noise(Eigen::Index n) {
  Eigen::VectorXd values(n);
  std::uint32_t bits = 1;
  for (double& value : values) {
    bits = 1664525U * bits + 1013904223U;
    value = static_cast<double>(bits >> 8U) / (1U << 23U) - 1;
  }
  return values;
}

}  // namespace osculate::la
