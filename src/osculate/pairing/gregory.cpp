#include "osculate/pairing/gregory.hpp"

#include <Eigen/Core>
#include <utility>

namespace osculate::pairing {
namespace {

/// How many derivatives there are up to an order.
constexpr std::size_t terms_of(int order) {
  return static_cast<std::size_t>((order + 1) * (order + 2) / 2);
}

using Four = Eigen::Array4d;

/// Polynomial of degree `Order` in the change of two coordinates: Taylor coefficients in the order
/// of cell::FacetShape; or four of them.
template <int Order, class Number = double>
struct Taylor {
  std::array<Number, terms_of(Order)> c;
};

/// Powers of the two changes, and the place of a pair of powers.
constexpr std::array<std::array<std::size_t, 2>, 10> powers{
    {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}, {3, 0}, {2, 1}, {1, 2}, {0, 3}}};
constexpr std::size_t place(std::size_t i, std::size_t j) {
  const std::size_t sum = i + j;
  return sum * (sum + 1) / 2 + j;
}

template <int Order>
Taylor<Order> linear(double value, double first, double second) {
  Taylor<Order> t{};
  t.c[0] = value;
  if constexpr (Order > 0) {
    t.c[1] = first;
    t.c[2] = second;
  }
  return t;
}

/// Places i and j of two factors that meet at place k of their product.
struct Meeting {
  std::size_t i, j, k;
};
template <int Order>
constexpr auto make_meetings() {
  constexpr std::array<std::size_t, 4> count{1, 5, 15, 35};
  std::array<Meeting, count[Order]> all{};
  std::size_t n = 0;
  for (std::size_t i = 0; i < terms_of(Order); ++i)
    for (std::size_t j = 0; j < terms_of(Order); ++j) {
      const std::size_t p = powers[i][0] + powers[j][0], q = powers[i][1] + powers[j][1];
      if (p + q <= static_cast<std::size_t>(Order)) all[n++] = {i, j, place(p, q)};
    }
  return all;
}
template <int Order>
constexpr auto meetings = make_meetings<Order>();

template <int Order, class Number, std::size_t... N>
void add_product(const Taylor<Order, Number>& a, const Taylor<Order, Number>& b,
                 Taylor<Order, Number>& out, std::index_sequence<N...>) {
  ((out.c[meetings<Order>[N].k] += a.c[meetings<Order>[N].i] * b.c[meetings<Order>[N].j]), ...);
}

template <int Order, class Number>
Taylor<Order, Number> operator*(const Taylor<Order, Number>& a, const Taylor<Order, Number>& b) {
  Taylor<Order, Number> out;
  out.c.fill(0.0 * a.c[0]);
  add_product(a, b, out, std::make_index_sequence<meetings<Order>.size()>{});
  return out;
}

template <int Order>
Taylor<Order> operator*(double factor, Taylor<Order> a) {
  for (double& c : a.c) c *= factor;
  return a;
}

template <int Order, class Number>
Taylor<Order, Number> operator-(Taylor<Order, Number> a, const Taylor<Order, Number>& b) {
  for (std::size_t k = 0; k < a.c.size(); ++k) a.c[k] -= b.c[k];
  return a;
}

/// f(s, t) of two linear functions, from its coefficients in their changes.
template <int Order, class Number>
Taylor<Order, Number> of_linear(const Taylor<Order, Number>& f, const Taylor<Order, Number>& s,
                                const Taylor<Order, Number>& t) {
  Taylor<Order, Number> out;
  const auto& c = f.c;
  out.c[0] = c[0];
  if constexpr (Order > 0) {
    const Number s1 = s.c[1], s2 = s.c[2], t1 = t.c[1], t2 = t.c[2];
    out.c[1] = c[1] * s1 + c[2] * t1;
    out.c[2] = c[1] * s2 + c[2] * t2;
    if constexpr (Order > 1) {
      out.c[3] = c[3] * s1 * s1 + c[4] * s1 * t1 + c[5] * t1 * t1;
      out.c[4] = 2 * c[3] * s1 * s2 + c[4] * (s1 * t2 + s2 * t1) + 2 * c[5] * t1 * t2;
      out.c[5] = c[3] * s2 * s2 + c[4] * s2 * t2 + c[5] * t2 * t2;
    }
    if constexpr (Order > 2) {
      out.c[6] = ((c[6] * s1 + c[7] * t1) * s1 + c[8] * t1 * t1) * s1 + c[9] * t1 * t1 * t1;
      out.c[7] = 3 * c[6] * s1 * s1 * s2 + c[7] * s1 * (s1 * t2 + 2 * s2 * t1) +
                 c[8] * t1 * (2 * s1 * t2 + s2 * t1) + 3 * c[9] * t1 * t1 * t2;
      out.c[8] = 3 * c[6] * s1 * s2 * s2 + c[7] * s2 * (2 * s1 * t2 + s2 * t1) +
                 c[8] * t2 * (s1 * t2 + 2 * s2 * t1) + 3 * c[9] * t1 * t2 * t2;
      out.c[9] = ((c[6] * s2 + c[7] * t2) * s2 + c[8] * t2 * t2) * s2 + c[9] * t2 * t2 * t2;
    }
  }
  return out;
}

/// What replaces d^-1 and s^2 / d where d = s^2 + t^2 vanishes: no derivatives, half of all.
double inverse(double d) { return d < 1e-18 ? 0 : 1 / d; }
Four inverse(const Four& d) { return (d < 1e-18).select(0, 1 / d); }
double half_where_zero(double e, double f) { return e == 0 ? 0.5 : f; }
Four half_where_zero(const Four& e, const Four& f) { return (e == 0).select(0.5, f); }

/// s^2 / (s^2 + t^2) by s and t; 1/2 where both vanish. With s and t exchanged it is what is left
/// of 1.
///
/// Formula    with D = s^2 + t^2:  f_s = 2 s t^2 / D^2,  f_ss = 2 t^2 (t^2 - 3 s^2) / D^3,
///            f_st = 4 s t (s^2 - t^2) / D^3,  f_sss = 24 s t^2 (s^2 - t^2) / D^4,
///            f_sst = -4 t (t^4 - 8 s^2 t^2 + 3 s^4) / D^4 ;  f(s, t) = 1 - f(t, s) has the others
template <int Order, class Number>
Taylor<Order, Number> share_of(const Number& s, const Number& t) {
  const Number s2 = s * s, t2 = t * t, e = inverse(Number(s2 + t2));
  Taylor<Order, Number> f;
  f.c[0] = half_where_zero(e, Number(s2 * e));
  if constexpr (Order > 0) {
    const Number e2 = e * e;
    f.c[1] = 2 * s * t2 * e2;
    f.c[2] = -2 * t * s2 * e2;
    if constexpr (Order > 1) {
      const Number e3 = e2 * e;
      f.c[3] = t2 * (t2 - 3 * s2) * e3;
      f.c[4] = 4 * s * t * (s2 - t2) * e3;
      f.c[5] = -s2 * (s2 - 3 * t2) * e3;
    }
    if constexpr (Order > 2) {
      const Number e4 = e2 * e2;
      f.c[6] = 4 * s * t2 * (s2 - t2) * e4;
      f.c[7] = -2 * t * (t2 * t2 - 8 * s2 * t2 + 3 * s2 * s2) * e4;
      f.c[8] = 2 * s * (s2 * s2 - 8 * s2 * t2 + 3 * t2 * t2) * e4;
      f.c[9] = -4 * t * s2 * (t2 - s2) * e4;
    }
  }
  return f;
}

/// The same of two linear functions, by the coordinates.
template <int Order>
Taylor<Order> share(const Taylor<Order>& s, const Taylor<Order>& t) {
  return of_linear(share_of<Order>(s.c[0], t.c[0]), s, t);
}

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
template <int Order>
Taylor<Order> outer(const Line& a, const Line& b) {
  Taylor<Order> out;
  for (std::size_t k = 0; k < out.c.size(); ++k) out.c[k] = a[powers[k][0]] * b[powers[k][1]];
  return out;
}

/// Of the four inner points of the quadrilateral, the first coordinate's number running first: the
/// share of the version for the borders of constant second coordinate, times the Bernstein
/// polynomials; and these.
template <int Order>
struct Inner {
  Taylor<Order, Four> all, part;

  Inner(const Vec2& xi, const std::array<Line, 4>& bu, const std::array<Line, 4>& bv) {
    const double u = 0.5 * (1 + xi.x()), v = 0.5 * (1 + xi.y());
    Taylor<Order, Four> f = share_of<Order>(Four(u, 1 - u, u, 1 - u), Four(v, v, 1 - v, 1 - v));
    const Four a(0.5, -0.5, 0.5, -0.5), b(0.5, 0.5, -0.5, -0.5);  // slopes of both
    const std::array<Four, 4> of_u{Four::Ones(), a, a * a, a * a * a},
        of_v{Four::Ones(), b, b * b, b * b * b};
    for (std::size_t k = 0; k < f.c.size(); ++k) {
      const auto [i, j] = powers[k];
      f.c[k] *= of_u[i] * of_v[j];
      all.c[k] = Four(bu[1][i], bu[2][i], bu[1][i], bu[2][i]) *
                 Four(bv[1][j], bv[1][j], bv[2][j], bv[2][j]);
    }
    part = all * f;
  }
};

/// put(j, B_j) for each point.
template <int Order, class Put>
void quad_basis(const Vec2& xi, const Put& put) {
  const std::array<Line, 4> bu = cubics(xi.x()), bv = cubics(xi.y());
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i)
      if (i % 3 == 0 || j % 3 == 0) put(quad_point(i, j), outer<Order>(bu[i], bv[j]));
  const Inner<Order> inner(xi, bu, bv);
  const Taylor<Order, Four> rest = inner.all - inner.part;
  for (std::size_t n = 0; n < 4; ++n) {
    const auto of = [n](const Taylor<Order, Four>& four) {
      Taylor<Order> one;
      for (std::size_t k = 0; k < one.c.size(); ++k)
        one.c[k] = four.c[k][static_cast<Eigen::Index>(n)];
      return one;
    };
    put(quad_point(1 + n % 2, 1 + n / 2), of(inner.part));
    put(quad_point(1 + n % 2, 1 + n / 2, true), of(rest));
  }
}

template <int Order, class Put>
void triangle_basis(const Vec2& xi, const Put& put) {
  const std::array<Taylor<Order>, 3> l{linear<Order>(1 - xi.x() - xi.y(), -1, -1),
                                       linear<Order>(xi.x(), 1, 0), linear<Order>(xi.y(), 0, 1)};
  for (std::size_t k = 0; k < 3; ++k) {
    const Taylor<Order>&a = l[k], &b = l[(k + 1) % 3], &c = l[(k + 2) % 3];
    const Taylor<Order> aa = a * a, ab = a * b;
    put(k, aa * aa);
    put(triangle_border(k, 1), 4.0 * (aa * ab));
    put(triangle_border(k, 2), 6.0 * (ab * ab));
    put(triangle_border(k, 3), 4.0 * (ab * b * b));
    const Taylor<Order> inner = 12.0 * (aa * b * c);
    const Taylor<Order> part = inner * share(b, c);
    put(triangle_inner(k, false), part);
    put(triangle_inner(k, true), inner - part);
  }
}

template <int Order>
void set_basis(bool triangle, const Vec2& xi, GregoryBasis& out) {
  constexpr std::array<double, 10> factorial{1, 1, 1, 2, 1, 2, 6, 2, 2, 6};
  const auto put = [&](std::size_t j, const Taylor<Order>& b) {
    for (std::size_t d = 0; d < b.c.size(); ++d) out[d][j] = factorial[d] * b.c[d];
  };
  if (!triangle) return quad_basis<Order>(xi, put);
  triangle_basis<Order>(xi, put);
  for (std::size_t d = 0; d < terms_of(Order); ++d)
    for (std::size_t j = triangle_points; j < gregory_points; ++j) out[d][j] = 0;
}

/// Shape functions of the nodes from number `first` on.
template <int Order>
void add_points(const GregoryWeights& patch, const GregoryBasis& basis, std::size_t first,
                cell::FacetShape& shape) {
  std::array<Four, terms_of(Order)> sum;
  sum.fill(Four::Zero());
  for (std::size_t j = 0; j < gregory_points; ++j) {
    const Four weight = Eigen::Map<const Four>(patch.weight[j].data() + first);
    for (std::size_t d = 0; d < sum.size(); ++d) sum[d] += basis[d][j] * weight;
  }
  for (std::size_t d = 0; d < sum.size(); ++d) Eigen::Map<Four>(shape.n[d].data() + first) = sum[d];
}

template <int Order>
void set_shape(const GregoryWeights& patch, const Vec2& xi, cell::FacetShape& shape) {
  static_assert(cell::max_shape_nodes % 4 == 0);
  GregoryBasis basis;
  set_basis<Order>(patch.triangle, xi, basis);
  for (std::size_t k = 0; k < static_cast<std::size_t>(shape.count); k += 4)
    add_points<Order>(patch, basis, k, shape);
}

/// The sum over the points line by line, with one version of the inner ones; then what the other
/// version adds by its share.
GregoryJet quad_jet(const GregoryPoints& points, const Vec2& xi) {
  const std::array<Line, 4> bu = cubics(xi.x()), bv = cubics(xi.y());
  Four r = Four::Zero(), r1 = r, r2 = r, r11 = r, r12 = r, r22 = r;  // Taylor coefficients
  for (std::size_t j = 0; j < 4; ++j) {
    const bool inner = j % 3 != 0;
    const Four a = points[quad_point(0, j)], b = points[quad_point(1, j, inner)],
               c = points[quad_point(2, j, inner)], d = points[quad_point(3, j)];
    const auto line = [&](std::size_t k) -> Four {
      return bu[0][k] * a + bu[1][k] * b + bu[2][k] * c + bu[3][k] * d;
    };
    const Four l = line(0), l1 = line(1), l11 = line(2);
    r += bv[j][0] * l;
    r1 += bv[j][0] * l1;
    r2 += bv[j][1] * l;
    r11 += bv[j][0] * l11;
    r12 += bv[j][1] * l1;
    r22 += bv[j][2] * l;
  }
  const Inner<2> inner(xi, bu, bv);
  for (std::size_t n = 0; n < 4; ++n) {
    const std::size_t i = 1 + n % 2, j = 1 + n / 2;
    const Four apart = points[quad_point(i, j)] - points[quad_point(i, j, true)];
    const auto part = [&](std::size_t k) { return inner.part.c[k][static_cast<Eigen::Index>(n)]; };
    r += part(0) * apart;
    r1 += part(1) * apart;
    r2 += part(2) * apart;
    r11 += part(3) * apart;
    r12 += part(4) * apart;
    r22 += part(5) * apart;
  }
  return {r, r1, r2, 2 * r11, r12, 2 * r22};
}

}  // namespace

GregoryBasis gregory_basis(bool triangle, const Vec2& xi) {
  GregoryBasis out;
  set_basis<3>(triangle, xi, out);
  return out;
}

GregoryJet gregory_jet(bool triangle, const GregoryPoints& points, const Vec2& xi) {
  if (!triangle) return quad_jet(points, xi);
  GregoryBasis basis;
  set_basis<2>(triangle, xi, basis);
  GregoryJet jet;
  jet.fill(Four::Zero());
  for (std::size_t j = 0; j < gregory_points; ++j)
    for (std::size_t d = 0; d < jet.size(); ++d) jet[d] += basis[d][j] * points[j];
  return jet;
}

cell::FacetShape gregory_shape(const GregoryWeights& patch, int count, const Vec2& xi, int order) {
  cell::FacetShape shape;
  shape.count = count;
  if (order == 0) set_shape<0>(patch, xi, shape);
  if (order == 1) set_shape<1>(patch, xi, shape);
  if (order == 2) set_shape<2>(patch, xi, shape);
  if (order > 2) set_shape<3>(patch, xi, shape);
  return shape;
}

}  // namespace osculate::pairing
