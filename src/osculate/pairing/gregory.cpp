#include "osculate/pairing/gregory.hpp"

#include <Eigen/Core>
#include <utility>

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

template <std::size_t... N>
void add_product(const Taylor& a, const Taylor& b, Taylor& out, std::index_sequence<N...>) {
  ((out.c[meetings[N].k] += a.c[meetings[N].i] * b.c[meetings[N].j]), ...);
}

Taylor operator*(const Taylor& a, const Taylor& b) {
  Taylor out;
  add_product(a, b, out, std::make_index_sequence<meetings.size()>{});
  return out;
}

Taylor operator*(double factor, Taylor a) {
  for (double& c : a.c) c *= factor;
  return a;
}

/// f(s, t) of two linear functions, from its coefficients in their changes.
Taylor of_linear(const Taylor& f, const Taylor& s, const Taylor& t) {
  const double s1 = s.c[1], s2 = s.c[2], t1 = t.c[1], t2 = t.c[2];
  const std::array<double, 10>& c = f.c;
  Taylor out;
  out.c[0] = c[0];
  out.c[1] = c[1] * s1 + c[2] * t1;
  out.c[2] = c[1] * s2 + c[2] * t2;
  out.c[3] = c[3] * s1 * s1 + c[4] * s1 * t1 + c[5] * t1 * t1;
  out.c[4] = 2 * c[3] * s1 * s2 + c[4] * (s1 * t2 + s2 * t1) + 2 * c[5] * t1 * t2;
  out.c[5] = c[3] * s2 * s2 + c[4] * s2 * t2 + c[5] * t2 * t2;
  out.c[6] = ((c[6] * s1 + c[7] * t1) * s1 + c[8] * t1 * t1) * s1 + c[9] * t1 * t1 * t1;
  out.c[7] = 3 * c[6] * s1 * s1 * s2 + c[7] * s1 * (s1 * t2 + 2 * s2 * t1) +
             c[8] * t1 * (2 * s1 * t2 + s2 * t1) + 3 * c[9] * t1 * t1 * t2;
  out.c[8] = 3 * c[6] * s1 * s2 * s2 + c[7] * s2 * (2 * s1 * t2 + s2 * t1) +
             c[8] * t2 * (s1 * t2 + 2 * s2 * t1) + 3 * c[9] * t1 * t2 * t2;
  out.c[9] = ((c[6] * s2 + c[7] * t2) * s2 + c[8] * t2 * t2) * s2 + c[9] * t2 * t2 * t2;
  return out;
}

/// s^2 / (s^2 + t^2) of two linear functions; 1/2 where both vanish. With s and t exchanged it is
/// what is left of 1.
///
/// Formula    with D = s^2 + t^2:  f_s = 2 s t^2 / D^2,  f_ss = 2 t^2 (t^2 - 3 s^2) / D^3,
///            f_st = 4 s t (s^2 - t^2) / D^3,  f_sss = 24 s t^2 (s^2 - t^2) / D^4,
///            f_sst = -4 t (t^4 - 8 s^2 t^2 + 3 s^4) / D^4 ;  f(s, t) = 1 - f(t, s) has the others
Taylor share(const Taylor& first, const Taylor& second) {
  const double s = first.c[0], t = second.c[0], s2 = s * s, t2 = t * t, d = s2 + t2;
  constexpr double corner = 1e-18;
  if (d < corner) return linear(0.5, 0, 0);
  const double e = 1 / d, e2 = e * e, e3 = e2 * e, e4 = e2 * e2;
  Taylor f;
  f.c[0] = s2 * e;
  f.c[1] = 2 * s * t2 * e2;
  f.c[2] = -2 * t * s2 * e2;
  f.c[3] = t2 * (t2 - 3 * s2) * e3;
  f.c[4] = 4 * s * t * (s2 - t2) * e3;
  f.c[5] = -s2 * (s2 - 3 * t2) * e3;
  f.c[6] = 4 * s * t2 * (s2 - t2) * e4;
  f.c[7] = -2 * t * (t2 * t2 - 8 * s2 * t2 + 3 * s2 * s2) * e4;
  f.c[8] = 2 * s * (s2 * s2 - 8 * s2 * t2 + 3 * t2 * t2) * e4;
  f.c[9] = -4 * t * s2 * (t2 - s2) * e4;
  return of_linear(f, first, second);
}

Taylor rest_of(Taylor part) {
  for (double& c : part.c) c = -c;
  part.c[0] += 1;
  return part;
}

struct Basis {
  std::array<Taylor, gregory_points> b;
};

/// Taylor coefficients of a function of one coordinate.
using Line = std::array<double, 4>;

/// Bernstein polynomials of degree 3 of u, which is (1 + x) / 2.
std::array<Line, 4> cubics(double x) {
  constexpr double h = 0.5;  // du/dx
  const double u = h * (1 + x), r = h * (1 - x);
  return {{{r * r * r, -3 * h * r * r, 3 * h * h * r, -h * h * h},
           {3 * u * r * r, 3 * h * r * (r - 2 * u), 3 * h * h * (u - 2 * r), 3 * h * h * h},
           {3 * u * u * r, 3 * h * u * (2 * r - u), 3 * h * h * (r - 2 * u), -3 * h * h * h},
           {u * u * u, 3 * h * u * u, 3 * h * h * u, h * h * h}}};
}

/// a of the first coordinate times b of the second one.
Taylor outer(const Line& a, const Line& b) {
  Taylor out;
  for (std::size_t k = 0; k < powers.size(); ++k) out.c[k] = a[powers[k][0]] * b[powers[k][1]];
  return out;
}

Basis quad_basis(const Vec2& xi) {
  const std::array<Taylor, 2> u{linear(0.5 * (1 + xi.x()), 0.5, 0),
                                linear(0.5 * (1 - xi.x()), -0.5, 0)},
      v{linear(0.5 * (1 + xi.y()), 0, 0.5), linear(0.5 * (1 - xi.y()), 0, -0.5)};
  const std::array<Line, 4> bu = cubics(xi.x()), bv = cubics(xi.y());
  Basis out;
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i) {
      const Taylor b = outer(bu[i], bv[j]);
      out.b[quad_point(i, j)] = b;
      if (i % 3 == 0 || j % 3 == 0) continue;
      const Taylor part = share(u[i - 1], v[j - 1]);
      out.b[quad_point(i, j)] = b * part;
      out.b[quad_point(i, j, true)] = b * rest_of(part);
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
    const Taylor part = share(b, c);
    out.b[triangle_inner(k, false)] = inner * part;
    out.b[triangle_inner(k, true)] = inner * rest_of(part);
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
  using Four = Eigen::Array4d;  // nodes at a time
  static_assert(cell::max_shape_nodes % 4 == 0);
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); k += 4) {
    std::array<Four, 10> sum;
    sum.fill(Four::Zero());
    for (std::size_t j = 0; j < gregory_points; ++j) {
      const Four weight = Eigen::Map<const Four>(patch.weight[j].data() + k);
      for (std::size_t d = 0; d < 10; ++d) sum[d] += basis[d][j] * weight;
    }
    for (std::size_t d = 0; d < 10; ++d) Eigen::Map<Four>(shape.n[d].data() + k) = sum[d];
  }
  return shape;
}

}  // namespace osculate::pairing
