#pragma once
#include <algorithm>
#include <cmath>

namespace osculate::material {

/// What is left of von Mises' stress of an elastic predictor.
struct Left {
  double q, lost, slope;  ///< lost: c q^n ; slope: dq/dq_tr
};
/// The root q of q + c q^n = q_tr : both sides bound it from above, the function is convex and
/// rises, so Newton's method comes down to it.
[[nodiscard]] inline Left left_of(double predictor, double c, double n) {
  if (!(c > 0) || !(predictor > 0)) return {predictor, 0, 1};
  constexpr int most = 100;
  constexpr double rounding = 4e-16;
  double q = std::min(predictor, std::pow(predictor / c, 1 / n));
  for (int i = 0; i < most; ++i) {
    const double power = c * std::pow(q, n);
    const double step = (q + power - predictor) / (1 + n * power / q);
    q -= step;
    if (!(step > rounding * q)) break;
  }
  const double lost = c * std::pow(q, n);
  return {q, lost, 1 / (1 + n * lost / q)};
}

}  // namespace osculate::material
