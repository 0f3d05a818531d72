#include "osculate/pairing/gregory.hpp"

namespace osculate::pairing {
namespace {

/// Polynomial of degree 3 in the change of two coordinates: Taylor coefficients in the order of
/// cell::FacetShape.
struct Taylor {
  std::array<double, 10> c{};
};

/// Powers of the two changes, and the place of a pair of powers.
constexpr std::array<std::array<std::size_t, 2>, 10> powers{
    {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}, {3, 0}, {2, 1}, {1, 2}, {0, 3}}};
constexpr std::size_t place(std::size_t i, std::size_t j) {
  const std::size_t sum = i + j;
  return sum * (sum + 1) / 2 + j;
}

Taylor linear(double value, double first, double second) {
  Taylor t;
  t.c[0] = value;
  t.c[1] = first;
  t.c[2] = second;
  return t;
}

/// Places i and j of two factors that meet at place k of their product.
struct Meeting {
  std::size_t i, j, k;
};
constexpr std::array<Meeting, 35> make_meetings() {
  std::array<Meeting, 35> all{};
  std::size_t n = 0;
  for (std::size_t i = 0; i < 10; ++i)
    for (std::size_t j = 0; j < 10; ++j) {
      const std::size_t p = powers[i][0] + powers[j][0], q = powers[i][1] + powers[j][1];
      if (p + q <= 3) all[n++] = {i, j, place(p, q)};
    }
  return all;
}
constexpr std::array<Meeting, 35> meetings = make_meetings();

Taylor operator*(const Taylor& a, const Taylor& b) {
  Taylor out;
  for (const Meeting& m : meetings) out.c[m.k] += a.c[m.i] * b.c[m.j];
  return out;
}

Taylor operator*(double factor, Taylor a) {
  for (double& c : a.c) c *= factor;
  return a;
}

Taylor operator+(Taylor a, const Taylor& b) {
  for (std::size_t i = 0; i < 10; ++i) a.c[i] += b.c[i];
  return a;
}

/// 1 / a by the series of 1 / (1 + e) with e = a / a_0 - 1.
Taylor inverse(const Taylor& a) {
  Taylor e = (1 / a.c[0]) * a;
  e.c[0] = 0;
  Taylor sum = linear(1, 0, 0), power = sum;
  for (int k = 0; k < 3; ++k) {
    power = -1.0 * (power * e);
    sum = sum + power;
  }
  return (1 / a.c[0]) * sum;
}

/// s^2 / (s^2 + t^2); 1/2 where both vanish.
Taylor share(const Taylor& s, const Taylor& t) {
  const Taylor a = s * s, sum = a + t * t;
  constexpr double corner = 1e-18;
  return sum.c[0] < corner ? linear(0.5, 0, 0) : a * inverse(sum);
}

struct Basis {
  std::array<Taylor, gregory_points> b;
};

std::array<Taylor, 4> cubic(const Taylor& u, const Taylor& rest) {
  return {rest * rest * rest, 3.0 * (u * rest * rest), 3.0 * (u * u * rest), u * u * u};
}

Basis quad_basis(const Vec2& xi) {
  const std::array<Taylor, 2> u{linear(0.5 * (1 + xi.x()), 0.5, 0),
                                linear(0.5 * (1 - xi.x()), -0.5, 0)},
      v{linear(0.5 * (1 + xi.y()), 0, 0.5), linear(0.5 * (1 - xi.y()), 0, -0.5)};
  const std::array<Taylor, 4> bu = cubic(u[0], u[1]), bv = cubic(v[0], v[1]);
  Basis out;
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i) {
      const Taylor b = bu[i] * bv[j];
      out.b[quad_point(i, j)] = b;
      if (i % 3 == 0 || j % 3 == 0) continue;
      const Taylor &s = u[i - 1], &t = v[j - 1];
      out.b[quad_point(i, j)] = b * share(s, t);
      out.b[quad_point(i, j, true)] = b * share(t, s);
    }
  return out;
}

Basis triangle_basis(const Vec2& xi) {
  const std::array<Taylor, 3> l{linear(1 - xi.x() - xi.y(), -1, -1), linear(xi.x(), 1, 0),
                                linear(xi.y(), 0, 1)};
  Basis out;
  for (std::size_t k = 0; k < 3; ++k) {
    const Taylor &a = l[k], &b = l[(k + 1) % 3], &c = l[(k + 2) % 3];
    const Taylor aa = a * a, ab = a * b;
    out.b[k] = aa * aa;
    out.b[triangle_border(k, 1)] = 4.0 * (aa * ab);
    out.b[triangle_border(k, 2)] = 6.0 * (ab * ab);
    out.b[triangle_border(k, 3)] = 4.0 * (ab * b * b);
    const Taylor inner = 12.0 * (aa * b * c);
    out.b[triangle_inner(k, false)] = inner * share(b, c);
    out.b[triangle_inner(k, true)] = inner * share(c, b);
  }
  return out;
}

}  // namespace

GregoryBasis gregory_basis(bool triangle, const Vec2& xi) {
  constexpr std::array<double, 10> factorial{1, 1, 1, 2, 1, 2, 6, 2, 2, 6};
  const Basis basis = triangle ? triangle_basis(xi) : quad_basis(xi);
  GregoryBasis out;
  for (std::size_t d = 0; d < 10; ++d)
    for (std::size_t j = 0; j < gregory_points; ++j) out[d][j] = factorial[d] * basis.b[j].c[d];
  return out;
}

cell::FacetShape gregory_shape(const GregoryWeights& patch, int count, const Vec2& xi) {
  const GregoryBasis basis = gregory_basis(patch.triangle, xi);
  cell::FacetShape shape;
  shape.count = count;
  for (std::size_t d = 0; d < 10; ++d)
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      double sum = 0;
      for (std::size_t j = 0; j < gregory_points; ++j) sum += patch.weight[k][j] * basis[d][j];
      shape.n[d][k] = sum;
    }
  return shape;
}

}  // namespace osculate::pairing
