#pragma once
// What Newmark's method and its relatives do to a linear oscillator d'' + 2 xi w d' + w^2 d = 0 in
// steps of h: one matrix a step.
#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <limits>

#include "osculate/core/types.hpp"

namespace osculate::verification {

/// Formula    d_1 = d + h v + h^2 ((1/2 - beta) a + beta a_1) , v_1 = v + h ((1 - gamma) a + gamma
/// a_1)
///            m [(1 - alpha_m) a_1 + alpha_m a] + c [(1 - alpha_f) v_1 + alpha_f v]
///                + k [(1 - alpha_f) d_1 + alpha_f d] = 0
/// Source     ChungHulbert1993; alpha_m = alpha_f = 0: Newmark1959; alpha_m = 0: Hilber1977, whose
///            alpha is -alpha_f
struct TimeScheme {
  double alpha_m = 0, alpha_f = 0;
  double beta = 0.25, gamma = 0.5;
};

inline TimeScheme newmark(double beta, double gamma) { return {0, 0, beta, gamma}; }

/// 0 <= alpha <= 1/3: beta = (1 + alpha)^2 / 4, gamma = 1/2 + alpha
inline TimeScheme hht(double alpha) {
  return {0, alpha, 0.25 * (1 + alpha) * (1 + alpha), 0.5 + alpha};
}

/// `radius`: the spectral radius for h -> infinity, 0 to 1.
inline TimeScheme generalized_alpha(double radius) {
  const double m = (2 * radius - 1) / (radius + 1), f = radius / (radius + 1);
  return {m, f, 0.25 * (1 - m + f) * (1 - m + f), 0.5 - m + f};
}

/// gamma = 1/2 - alpha_m + alpha_f
inline bool second_order(const TimeScheme& s) {
  return std::abs(s.gamma - 0.5 + s.alpha_m - s.alpha_f) < 1e-14;
}

/// (d, h v, h^2 a) of one step to those of the next; W = w h.
inline Mat<3, 3> amplification(const TimeScheme& s, double W, double damping = 0) {
  const double c = 2 * damping * W, k = W * W, now = 1 - s.alpha_f;
  const double mass = 1 - s.alpha_m + now * (c * s.gamma + k * s.beta);
  const Vec3 last(-k / mass, -(c + k * now) / mass,
                  -(s.alpha_m + now * (c * (1 - s.gamma) + k * (0.5 - s.beta))) / mass);
  Mat<3, 3> out;
  out.row(0) = Vec3(1, 1, 0.5 - s.beta) + s.beta * last;
  out.row(1) = Vec3(0, 1, 1 - s.gamma) + s.gamma * last;
  out.row(2) = last;
  return out;
}

/// After n steps from d and h v, a from the equation of motion.
inline Vec3 after_steps(const TimeScheme& s, double W, double d, double hv, int n,
                        double damping = 0) {
  const Mat<3, 3> step = amplification(s, W, damping);
  Vec3 x(d, hv, -2 * damping * W * hv - W * W * d);
  for (int i = 0; i < n; ++i) x = Vec3(step * x);
  return x;
}

inline double spectral_radius(const TimeScheme& s, double W, double damping = 0) {
  const Mat<3, 3> step = amplification(s, W, damping);
  return Eigen::EigenSolver<Mat<3, 3>>(step, false).eigenvalues().cwiseAbs().maxCoeff();
}

/// The root of the amplification that belongs to the motion: of the pair, that above the real axis
/// (W small enough for a pair).
inline std::complex<double> principal_root(const TimeScheme& s, double W, double damping = 0) {
  const Mat<3, 3> step = amplification(s, W, damping);
  const Eigen::Matrix<std::complex<double>, 3, 1> roots =
      Eigen::EigenSolver<Mat<3, 3>>(step, false).eigenvalues();
  int top = 0;
  for (int i = 1; i < 3; ++i)
    if (roots[i].imag() > roots[top].imag()) top = i;
  return roots[top];
}

/// (T_h - T) / T of the undamped oscillator: W / arg(root) - 1.
inline double period_error(const TimeScheme& s, double W) {
  return W / std::arg(principal_root(s, W)) - 1;
}

/// Algorithmic damping ratio of the undamped oscillator: -ln(abs(root)) / arg(root).
inline double algorithmic_damping(const TimeScheme& s, double W) {
  const std::complex<double> root = principal_root(s, W);
  return -std::log(std::abs(root)) / std::arg(root);
}

/// The leading term of `period_error` of a scheme of second order; the next one is of order W^4.
/// Formula    W^2 / 2 (beta - (gamma - 1/2) alpha_f - 1/12)
inline double leading_period_error(const TimeScheme& s, double W) {
  return 0.5 * W * W * (s.beta - (s.gamma - 0.5) * s.alpha_f - 1.0 / 12);
}

/// Newmark's method without damping: the pair z^2 - 2 A z + B = 0,
/// A = 1 - W^2 (gamma + 1/2) / (2 D), B = 1 - W^2 (gamma - 1/2) / D, D = 1 + beta W^2.
inline std::complex<double> newmark_root(double beta, double gamma, double W) {
  const double D = 1 + beta * W * W;
  const double A = 1 - 0.5 * W * W * (gamma + 0.5) / D, B = 1 - W * W * (gamma - 0.5) / D;
  return A + std::sqrt(std::complex<double>(A * A - B));
}

/// Largest W of Newmark's method without damping that does not grow: 1 / sqrt(gamma / 2 - beta);
/// infinite for 2 beta >= gamma. Requires gamma >= 1/2.
inline double newmark_stability_limit(double beta, double gamma) {
  return gamma <= 2 * beta ? std::numeric_limits<double>::infinity()
                           : 1 / std::sqrt(0.5 * gamma - beta);
}

}  // namespace osculate::verification
