#pragma once
// Derivative tests judged by convergence order, not by a tolerance.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>

namespace osculate::testing {

/// Components between -1 and 1; the same for the same seed.
inline Eigen::VectorXd random_direction(Eigen::Index n, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::VectorXd d(n);
  for (Eigen::Index i = 0; i < n; ++i) d[i] = uniform(generator);
  return d;
}

/// `order` is log2 of the ratio of the errors of central differences with steps h and h/2: 2 for a
/// right derivative, 0 for one that is wrong by any constant part. `exact`: both errors are
/// round-off.
struct DerivativeReport {
  double error, order;
  bool exact;
};

/// Compares the directional derivative `df` of `f` at `x` along `d` with central differences.
template <class F, class Vector>
DerivativeReport check_derivative(F&& f, const Eigen::VectorXd& df, const Vector& x,
                                  const Vector& d, double h = 1e-3) {
  const auto error = [&](double step) {
    const Eigen::VectorXd fd = (f(Vector(x + step * d)) - f(Vector(x - step * d))) / (2 * step);
    return (fd - df).norm() / std::max(df.norm(), 1e-30);
  };
  const double e1 = error(h), e2 = error(h / 2);
  return {e2, std::log2(e1 / e2), e1 < 1e-11 && e2 < 1e-11};
}

}  // namespace osculate::testing
