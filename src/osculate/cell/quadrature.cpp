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

namespace {

/// The three points (a, a), (1 - 2a, a), (a, 1 - 2a) with one weight.
void add_orbit(Quadrature2D& rule, double a, double weight) {
  const double c = 1 - 2 * a;
  for (const Vec2& xi : {Vec2(a, a), Vec2(c, a), Vec2(a, c)}) {
    rule.points.push_back(xi);
    rule.weights.push_back(weight);
  }
}

/// The six permutations of the area coordinates (a, b, 1 - a - b) with one weight.
void add_orbit(Quadrature2D& rule, double a, double b, double weight) {
  const double c = 1 - a - b;
  for (const Vec2& xi : {Vec2(a, b), Vec2(b, a), Vec2(a, c), Vec2(c, a), Vec2(b, c), Vec2(c, b)}) {
    rule.points.push_back(xi);
    rule.weights.push_back(weight);
  }
}

/// Six points, degree 4: closed form of the two orbits.
Quadrature2D six_points() {
  const double root10 = std::sqrt(10.0), inner = std::sqrt(38.0 - 44.0 * std::sqrt(0.4));
  const double spread = std::sqrt(213125.0 - 53320.0 * root10);
  Quadrature2D rule;
  add_orbit(rule, (8 - root10 + inner) / 18, (620 + spread) / 7440);
  add_orbit(rule, (8 - root10 - inner) / 18, (620 - spread) / 7440);
  return rule;
}

/// Seven points, degree 5: closed form (Radon).
Quadrature2D seven_points() {
  const double root15 = std::sqrt(15.0);
  Quadrature2D rule{{Vec2(1.0 / 3, 1.0 / 3)}, {9.0 / 80}};
  add_orbit(rule, (6 - root15) / 21, (155 - root15) / 2400);
  add_orbit(rule, (6 + root15) / 21, (155 + root15) / 2400);
  return rule;
}

/// Twelve points, degree 6: the moment equations of two orbits of three points and one of six,
/// solved with 40 digits.
Quadrature2D twelve_points() {
  Quadrature2D rule;
  add_orbit(rule, 0.2492867451709104212916, 0.05839313786318968301264);
  add_orbit(rule, 0.06308901449150222834033, 0.02542245318510340846047);
  add_orbit(rule, 0.05314504984481694735325, 0.3103524510337844054166, 0.04142553780918678759678);
  return rule;
}

}  // namespace

Quadrature2D gauss_triangle(int degree) {
  if (degree <= 1) return {{Vec2(1.0 / 3, 1.0 / 3)}, {0.5}};
  if (degree <= 2) {
    Quadrature2D rule;
    add_orbit(rule, 1.0 / 6, 1.0 / 6);
    return rule;
  }
  if (degree <= 4) return six_points();
  return degree <= 5 ? seven_points() : twelve_points();
}

namespace {

/// A rule of an area times one along zeta.
Quadrature3D product(const Quadrature2D& area, const Quadrature1D& line) {
  Quadrature3D rule;
  for (std::size_t j = 0; j < line.points.size(); ++j)
    for (std::size_t i = 0; i < area.points.size(); ++i) {
      rule.points.emplace_back(area.points[i].x(), area.points[i].y(), line.points[j]);
      rule.weights.push_back(area.weights[i] * line.weights[j]);
    }
  return rule;
}

/// The four points with the volume coordinates (a, a, a, 1 - 3a) with one weight.
void add_corner_orbit(Quadrature3D& rule, double a, double weight) {
  const double b = 1 - 3 * a;
  for (const Vec3& xi : {Vec3(a, a, a), Vec3(b, a, a), Vec3(a, b, a), Vec3(a, a, b)}) {
    rule.points.push_back(xi);
    rule.weights.push_back(weight);
  }
}

/// The six points with the volume coordinates (a, a, b, b), b = 1/2 - a, with one weight.
void add_edge_orbit(Quadrature3D& rule, double a, double weight) {
  const double b = 0.5 - a;
  for (const Vec3& xi :
       {Vec3(a, a, b), Vec3(a, b, a), Vec3(b, a, a), Vec3(a, b, b), Vec3(b, a, b), Vec3(b, b, a)}) {
    rule.points.push_back(xi);
    rule.weights.push_back(weight);
  }
}

}  // namespace

Quadrature3D gauss_hex(int n, int m) {
  return product(gauss_quad(n), gauss_legendre(m == 0 ? n : m));
}

Quadrature3D gauss_tetrahedron(int degree) {
  Quadrature3D rule;
  if (degree <= 1) return {{Vec3(0.25, 0.25, 0.25)}, {1.0 / 6}};
  if (degree <= 2) {
    add_corner_orbit(rule, (5 - std::sqrt(5.0)) / 20, 1.0 / 24);
    return rule;
  }
  // degree 5 in closed form, the sibling of the triangle's seven points (Keast 1986)
  const double root15 = std::sqrt(15.0);
  rule = {{Vec3(0.25, 0.25, 0.25)}, {8.0 / 405}};
  add_corner_orbit(rule, (7 - root15) / 34, (2665 + 14 * root15) / 226800);
  add_corner_orbit(rule, (7 + root15) / 34, (2665 - 14 * root15) / 226800);
  add_edge_orbit(rule, (5 - root15) / 20, 5.0 / 567);
  return rule;
}

Quadrature3D gauss_wedge(int degree, int n) {
  return product(gauss_triangle(degree), gauss_legendre(n));
}

}  // namespace osculate::cell
