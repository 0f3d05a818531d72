#pragma once
#include <cmath>

#include "osculate/core/types.hpp"

namespace osculate::core {

/// A number with its derivatives by N variables (forward differentiation), for formulas whose
/// closed derivatives would be longer than they are worth.
///
/// Tested by  tests/unit/core/test_dual.cpp
template <int N>
struct Dual {
  double v = 0;
  Vec<N> d = Vec<N>::Zero();

  Dual() = default;
  Dual(double value) : v(value) {}  // NOLINT(google-explicit-constructor): constants are numbers
  Dual(double value, const Vec<N>& derivatives) : v(value), d(derivatives) {}
  /// The variable number `index`.
  static Dual variable(double value, int index) {
    Dual x(value);
    x.d[index] = 1;
    return x;
  }

  Dual& operator+=(const Dual& b) {
    v += b.v;
    d += b.d;
    return *this;
  }
  friend Dual operator+(const Dual& a, const Dual& b) { return {a.v + b.v, Vec<N>(a.d + b.d)}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.v - b.v, Vec<N>(a.d - b.d)}; }
  friend Dual operator-(const Dual& a) { return {-a.v, Vec<N>(-a.d)}; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.v * b.v, Vec<N>(b.v * a.d + a.v * b.d)};
  }
  friend Dual operator*(double a, const Dual& b) { return {a * b.v, Vec<N>(a * b.d)}; }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double q = a.v / b.v;
    return {q, Vec<N>((a.d - q * b.d) / b.v)};
  }
  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.v);
    return {root, Vec<N>(a.d / (2 * root))};
  }
};

[[nodiscard]] inline double value(double x) { return x; }
template <int N>
[[nodiscard]] double value(const Dual<N>& x) {
  return x.v;
}

/// A function of x with this value and derivative there.
[[nodiscard]] inline double chain(double, double value, double) { return value; }
template <int N>
[[nodiscard]] Dual<N> chain(const Dual<N>& x, double value, double derivative) {
  return {value, Vec<N>(derivative * x.d)};
}

/// The root xi of r(xi, variables) = 0: `root` is its value, `residual` r at that fixed value with
/// its derivatives by the variables, `slope` dr/dxi.
///
/// Formula    dxi = -dr / (dr/dxi)  (implicit function)
[[nodiscard]] inline double implicit_root(double root, double, double) { return root; }
template <int N>
[[nodiscard]] Dual<N> implicit_root(double root, const Dual<N>& residual, double slope) {
  return {root, Vec<N>(-residual.d / slope)};
}

}  // namespace osculate::core
