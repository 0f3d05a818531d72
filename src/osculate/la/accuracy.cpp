#include "osculate/la/accuracy.hpp"

#include <cmath>
#include <cstdint>

namespace osculate::la {
namespace {

/// Signs without a pattern.
Eigen::VectorXd noise_of(Eigen::Index n) {
  Eigen::VectorXd signs(n);
  std::uint32_t noise = 1;
  for (double& sign : signs) {
    noise = noise * 1664525U + 1013904223U;
    sign = (noise >> 31U) != 0 ? 1.0 : -1.0;
  }
  return signs;
}

}  // namespace

double lost_accuracy(const Eigen::VectorXd& scale,
                     const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& multiply,
                     const Solve& solve) {
  const Eigen::VectorXd known = noise_of(scale.size()).cwiseQuotient(scale);
  Eigen::VectorXd x = multiply(known);
  if (!solve(x)) return 1;
  double worst = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double error = std::abs(x[i] / known[i] - 1);
    if (!(error <= worst)) worst = std::isfinite(error) ? error : 1;
  }
  return worst;
}

WeakestMode weakest_mode(const Eigen::VectorXd& scale, const Solve& solve) {
  constexpr int rounds = 3;
  Eigen::VectorXd scaled = noise_of(scale.size());
  for (int i = 0; i < rounds; ++i) {
    Eigen::VectorXd x = scaled.cwiseProduct(scale);
    if (!solve(x) || !x.allFinite()) return {};
    scaled = x.cwiseProduct(scale);
    scaled /= scaled.stableNorm();
  }
  Eigen::Index most = 0;
  scaled.cwiseAbs().maxCoeff(&most);
  return {scaled.cwiseQuotient(scale), static_cast<Index>(most)};
}

}  // namespace osculate::la
