#pragma once
// The one judgement of a tangent, as GoogleTest expectations.
#include <gtest/gtest.h>

#include "derivative_check.hpp"

namespace osculate::testing {

/// The matrix `df` is the derivative of `f` at `x`: its error falls with the square of the step `h`
/// along random directions (or is rounding), while `branch`, which names the smooth piece of `f`
/// that a point belongs to, is the same at both probes as at `x`.
template <class F, class Branch>
void expect_derivative(const F& f, const Eigen::MatrixXd& df, const Branch& branch,
                       const Eigen::VectorXd& x, double h, unsigned directions = 3) {
  const auto here = branch(x);
  for (unsigned seed = 1; seed <= directions; ++seed) {
    const Eigen::VectorXd d = random_direction(x.size(), seed);
    for (const double step : {h, -h}) {
      const Eigen::VectorXd probe = x + step * d;
      ASSERT_TRUE(branch(probe) == here) << "another branch at a probe, direction " << seed;
    }
    const DerivativeReport r = check_derivative(f, Eigen::VectorXd(df * d), x, d, h);
    EXPECT_TRUE(r.exact || std::abs(r.order - 2.0) < 0.15)
        << "order " << r.order << " error " << r.error << ", direction " << seed;
  }
}

}  // namespace osculate::testing
