#include "osculate/projection/piece_bend.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "osculate/projection/bernstein.hpp"

namespace osculate::projection {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A polynomial of degree m in s and n in t in Bernstein form; (i, j) stands at i (n + 1) + j.
template <class Value>
struct Form {
  int m = 0, n = 0;
  std::vector<Value> c;
};
template <int Dim>
using Vectors = Form<Vec<Dim>>;
using Numbers = Form<double>;

/// The product of two forms, by the product of two coefficients.
template <class Value, class A, class B, class Times>
Form<Value> product(const Form<A>& a, const Form<B>& b, const Value& zero, const Times& times) {
  Form<Value> out{a.m + b.m, a.n + b.n, {}};
  out.c.assign(static_cast<std::size_t>((out.m + 1) * (out.n + 1)), zero);
  std::size_t x = 0;
  for (int i = 0; i <= a.m; ++i)
    for (int j = 0; j <= a.n; ++j, ++x) {
      const double own = binomial(a.m, i) * binomial(a.n, j);
      std::size_t y = 0;
      for (int k = 0; k <= b.m; ++k)
        for (int l = 0; l <= b.n; ++l, ++y) {
          const double share = own * binomial(b.m, k) * binomial(b.n, l) /
                               (binomial(out.m, i + k) * binomial(out.n, j + l));
          out.c[static_cast<std::size_t>((i + k) * (out.n + 1) + j + l)] +=
              share * times(a.c[x], b.c[y]);
        }
    }
  return out;
}

template <int Dim>
Numbers dot(const Vectors<Dim>& a, const Vectors<Dim>& b) {
  return product<double>(a, b, 0.0, [](const Vec<Dim>& x, const Vec<Dim>& y) { return x.dot(y); });
}
template <int Dim>
Vectors<Dim> scaled(const Numbers& a, const Vectors<Dim>& b) {
  return product<Vec<Dim>>(a, b, Vec<Dim>(Vec<Dim>::Zero()),
                           [](double x, const Vec<Dim>& y) -> Vec<Dim> { return x * y; });
}
Numbers times(const Numbers& a, const Numbers& b) {
  return product<double>(a, b, 0.0, [](double x, double y) { return x * y; });
}

/// The same polynomial with higher degrees.
template <class Value>
Form<Value> raised(const Form<Value>& f, int m, int n, const Value& zero) {
  if (f.m == m && f.n == n) return f;
  Numbers one{m - f.m, n - f.n, {}};
  one.c.assign(static_cast<std::size_t>((one.m + 1) * (one.n + 1)), 1.0);
  return product<Value>(one, f, zero, [](double x, const Value& y) -> Value { return x * y; });
}

template <class Value>
void subtract(Form<Value>& a, double factor, const Form<Value>& b) {
  for (std::size_t k = 0; k < a.c.size(); ++k) a.c[k] -= factor * b.c[k];
}

/// Derivative along s (direction 0) or t; of degree zero it is zero.
template <class Value>
Form<Value> derivative(const Form<Value>& f, int direction, const Value& zero) {
  const int degree = direction == 0 ? f.m : f.n;
  Form<Value> out{f.m - (direction == 0 && degree > 0), f.n - (direction == 1 && degree > 0), {}};
  out.c.assign(static_cast<std::size_t>((out.m + 1) * (out.n + 1)), zero);
  if (degree == 0) return out;
  std::size_t k = 0;
  for (int i = 0; i <= out.m; ++i)
    for (int j = 0; j <= out.n; ++j, ++k) {
      const auto here = static_cast<std::size_t>(i * (f.n + 1) + j);
      const std::size_t next = here + (direction == 0 ? static_cast<std::size_t>(f.n + 1) : 1U);
      out.c[k] = degree * (f.c[next] - f.c[here]);
    }
  return out;
}

template <int Dim>
Vec<Dim> middle_of(const Vectors<Dim>& f) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  std::size_t k = 0;
  for (int i = 0; i <= f.m; ++i)
    for (int j = 0; j <= f.n; ++j, ++k)
      sum += std::ldexp(binomial(f.m, i) * binomial(f.n, j), -f.m - f.n) * f.c[k];
  return sum;
}

/// X and w of a piece, seen from the middle of its box (T_i and Z_ij do not depend on that).
template <int Dim>
struct Homogeneous {
  Vectors<Dim> x;
  Numbers w;
  bool rational = false;

  Homogeneous(Control<Dim> control, int m, int n, bool is_rational) : rational(is_rational) {
    search::Box<Dim> box;
    for (const ControlPoint<Dim>& c : control) box.extend(c.template head<Dim>() / c[Dim]);
    const Vec<Dim> middle = 0.5 * (box.lo + box.hi);
    x.m = w.m = m;
    x.n = w.n = n;
    for (const ControlPoint<Dim>& c : control) {
      x.c.push_back(c.template head<Dim>() - c[Dim] * middle);
      w.c.push_back(c[Dim]);
    }
  }

  /// w D X - X D w for a derivative D; D X where w is constant.
  [[nodiscard]] Vectors<Dim> quotient(const Vectors<Dim>& dx, const Numbers& dw) const {
    if (!rational) return dx;
    const Vec<Dim> zero = Vec<Dim>::Zero();
    Vectors<Dim> a = scaled<Dim>(w, dx), b = scaled<Dim>(dw, x);
    const int m = std::max(a.m, b.m), n = std::max(a.n, b.n);
    a = raised<Vec<Dim>>(a, m, n, zero);
    subtract(a, 1.0, raised<Vec<Dim>>(b, m, n, zero));
    return a;
  }
};

/// How far Z . n may be from Z . axis for the normals of the cone.
template <int Dim>
double turned_away(const Vectors<Dim>& z, const Cone<Dim>& cone) {
  double most = 0;
  for (const Vec<Dim>& c : z.c) {
    const double up = c.dot(cone.axis);
    const double along = (c - up * cone.axis).norm();
    most = std::max(most, std::abs(up) * (1 - std::cos(cone.angle)) + along * std::sin(cone.angle));
  }
  return most;
}

double largest_eigenvalue(const Mat<1, 1>& symmetric) { return symmetric(0, 0); }
double largest_eigenvalue(const Mat<2, 2>& symmetric) {
  const double mean = 0.5 * (symmetric(0, 0) + symmetric(1, 1));
  return mean + std::hypot(0.5 * (symmetric(0, 0) - symmetric(1, 1)), symmetric(1, 0));
}

/// The largest ratio of b + extra against a over pairs of coefficients; infinite where an a is not
/// positive.
template <int M>
double largest_ratio(const std::vector<Mat<M, M>>& a, const std::vector<Mat<M, M>>& b,
                     const Mat<M, M>& back, double extra) {
  double most = -infinite;
  for (std::size_t c = 0; c < a.size(); ++c) {
    const Mat<M, M> own = back.transpose() * a[c] * back;
    const Mat<M, M> bent = back.transpose() * b[c] * back + extra * Mat<M, M>::Identity();
    const Eigen::LLT<Mat<M, M>> root(own);
    if (root.info() != Eigen::Success || !own.allFinite()) return infinite;
    const Mat<M, M> side = root.matrixL().solve(bent);
    const Mat<M, M> ratio = root.matrixL().solve(Mat<M, M>(side.transpose()));
    most = std::max(most, largest_eigenvalue(ratio));
  }
  return std::isfinite(most) ? most : infinite;
}

/// The largest h against a, M parameters (the first M directions).
template <int Dim, int M>
double largest_ratio(const Homogeneous<Dim>& h, const Cone<Dim>& cone) {
  const Vec<Dim> zero = Vec<Dim>::Zero();
  std::array<Vectors<Dim>, M> dx, t;
  std::array<Numbers, M> dw;
  Mat<Dim, M> tangents;
  for (int i = 0; i < M; ++i) {
    const auto k = static_cast<std::size_t>(i);
    dx[k] = derivative<Vec<Dim>>(h.x, i, zero);
    dw[k] = derivative<double>(h.w, i, 0.0);
    t[k] = h.quotient(dx[k], dw[k]);
    tangents.col(i) = middle_of<Dim>(t[k]);
  }
  const Mat<M, M> metric = tangents.transpose() * tangents;
  const Eigen::LLT<Mat<M, M>> llt(metric);
  if (llt.info() != Eigen::Success) return infinite;
  const Mat<M, M> lower = llt.matrixL();
  if (!(lower.diagonal().minCoeff() > 1e-12 * lower.diagonal().maxCoeff())) return infinite;
  const Mat<M, M> back = lower.inverse().transpose();  // to orthonormal tangents

  // Everything with the same degrees.
  const int m = h.rational ? 4 * h.x.m : 2 * h.x.m, n = h.rational ? 4 * h.x.n : 2 * h.x.n;
  std::vector<Mat<M, M>> a(static_cast<std::size_t>((m + 1) * (n + 1)), Mat<M, M>::Zero()), b = a;
  const Numbers square = h.rational ? times(h.w, h.w) : Numbers{0, 0, {1.0}};
  const double most_square = *std::max_element(square.c.begin(), square.c.end());
  const Mat<Dim, M> unit = tangents * back;  // orthonormal
  Mat<M, M> away;
  for (int i = 0; i < M; ++i)
    for (int j = 0; j <= i; ++j) {
      const auto p = static_cast<std::size_t>(i), q = static_cast<std::size_t>(j);
      const Numbers aij = raised<double>(dot<Dim>(t[p], t[q]), m, n, 0.0);
      Vectors<Dim> z =
          h.quotient(derivative<Vec<Dim>>(dx[p], j, zero), derivative<double>(dw[p], j, 0.0));
      const int zm = h.rational ? 2 * h.x.m : h.x.m, zn = h.rational ? 2 * h.x.n : h.x.n;
      z = raised<Vec<Dim>>(z, zm, zn, zero);
      const Vec<M> share = back * (unit.transpose() * middle_of<Dim>(z));
      for (std::size_t k = 0; k < t.size(); ++k)
        subtract(z, share[static_cast<Eigen::Index>(k)], raised<Vec<Dim>>(t[k], zm, zn, zero));
      away(i, j) = away(j, i) = most_square * turned_away<Dim>(z, cone);
      Numbers up{z.m, z.n, {}};
      for (const Vec<Dim>& c : z.c) up.c.push_back(c.dot(cone.axis));
      const Numbers bij = raised<double>(times(square, up), m, n, 0.0);
      for (std::size_t c = 0; c < a.size(); ++c) {
        a[c](i, j) = a[c](j, i) = aij.c[c];
        b[c](i, j) = b[c](j, i) = bij.c[c];
      }
    }
  const Mat<M, M> size = back.cwiseAbs();
  const Mat<M, M> spread = size.transpose() * away * size;
  return largest_ratio<M>(a, b, back, spread.norm());
}

}  // namespace

template <int Dim>
double largest_bend(const Piece<Dim>& piece, Control<Dim> control, const Cone<Dim>& normals) {
  if (piece.triangle) return 0;
  if (!normals.narrow()) return infinite;
  return largest_ratio<Dim, Dim - 1>(
      Homogeneous<Dim>(control, piece.degree[0], piece.degree[1], piece.rational), normals);
}

double largest_side_bend(const Piece<3>& piece, Control<3> control, std::size_t side,
                         const Cone<3>& directions) {
  if (piece.triangle) return 0;
  if (!directions.narrow()) return infinite;
  const std::vector<ControlPoint<3>> line = side_control<3>(piece, control, side);
  return largest_ratio<3, 1>(
      Homogeneous<3>(line, static_cast<int>(line.size()) - 1, 0, piece.rational), directions);
}

template double largest_bend(const Piece<2>&, Control<2>, const Cone<2>&);
template double largest_bend(const Piece<3>&, Control<3>, const Cone<3>&);

}  // namespace osculate::projection
