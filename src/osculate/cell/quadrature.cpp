#include "osculate/cell/quadrature.hpp"

#include <cmath>
#include <numbers>

namespace osculate::cell {
namespace {

/// Legendre polynomial of degree n at x, and its derivative.
struct Legendre {
  double value, slope;
};

Legendre legendre(int n, double x) {
  double before = 1, value = x;
  if (n == 0) return {1, 0};
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
    before = value;
    value = next;
  }
  return {value, n * (x * value - before) / (x * x - 1)};
}

}  // namespace

Quadrature1D gauss_legendre(int n) {
  Quadrature1D rule;
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    if (2 * i + 1 == n) x = 0.0;
    for (int it = 0; it < 50; ++it) {
      const Legendre p = legendre(n, x);
      const double step = p.value / p.slope;
      x -= step;
      if (std::abs(step) < 1e-16) break;
    }
    const double slope = legendre(n, x).slope;
    rule.points.push_back(x);
    rule.weights.push_back(2 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

Quadrature1D gauss_lobatto(int n) {
  Quadrature1D rule;
  const int m = n - 1;
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(std::numbers::pi * i / m);
    if (i > 0 && i < m) {
      for (int it = 0; it < 50; ++it) {  // zeros of P_m': use P_m'' from Legendre's equation
        const Legendre p = legendre(m, x);
        const double bend = (2 * x * p.slope - m * (m + 1) * p.value) / (1 - x * x);
        const double step = p.slope / bend;
        x -= step;
        if (std::abs(step) < 1e-16) break;
      }
    } else {
      x = i == 0 ? -1.0 : 1.0;
    }
    const double value = i == 0 ? (m % 2 ? -1.0 : 1.0) : i == m ? 1.0 : legendre(m, x).value;
    rule.points.push_back(x);
    rule.weights.push_back(2 / (m * n * value * value));
  }
  return rule;
}

Quadrature2D gauss_quad(int n) {
  const Quadrature1D line = gauss_legendre(n);
  Quadrature2D rule;
  for (std::size_t j = 0; j < line.points.size(); ++j)
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      rule.points.emplace_back(line.points[i], line.points[j]);
      rule.weights.push_back(line.weights[i] * line.weights[j]);
    }
  return rule;
}

Quadrature2D gauss_triangle(int degree) {
  if (degree <= 1) return {{Vec2(1.0 / 3, 1.0 / 3)}, {0.5}};
  if (degree == 2)
    return {{Vec2(1.0 / 6, 1.0 / 6), Vec2(2.0 / 3, 1.0 / 6), Vec2(1.0 / 6, 2.0 / 3)},
            {1.0 / 6, 1.0 / 6, 1.0 / 6}};
  // Degree 4, six points: closed form of the two symmetric orbits.
  const double root10 = std::sqrt(10.0), inner = std::sqrt(38.0 - 44.0 * std::sqrt(0.4));
  const double a = (8 - root10 + inner) / 18, b = (8 - root10 - inner) / 18;
  const double spread = std::sqrt(213125.0 - 53320.0 * root10);
  const double wa = (620 + spread) / 7440, wb = (620 - spread) / 7440;
  return {{Vec2(a, a), Vec2(1 - 2 * a, a), Vec2(a, 1 - 2 * a), Vec2(b, b), Vec2(1 - 2 * b, b),
           Vec2(b, 1 - 2 * b)},
          {wa, wa, wa, wb, wb, wb}};
}

}  // namespace osculate::cell
