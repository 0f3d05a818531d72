#pragma once
// Graded spacing for the half-space models.
#include <cmath>

namespace osculate::verification {

/// Elements and bias (last length / first) of a geometric row that starts with `first` and covers
/// `length` with a growth of at most `growth` per element.
struct GradedRow {
  int elements;
  double bias;
};
inline GradedRow graded_row(double first, double length, double growth) {
  const int n =
      static_cast<int>(std::ceil(std::log(1 + length * (growth - 1) / first) / std::log(growth)));
  double lo = 1 + 1e-12, hi = growth;  // the growth that fits exactly
  for (int i = 0; i < 200; ++i) {
    const double q = 0.5 * (lo + hi);
    (first * (std::pow(q, n) - 1) / (q - 1) < length ? lo : hi) = q;
  }
  return {n, std::pow(0.5 * (lo + hi), n - 1)};
}

}  // namespace osculate::verification
