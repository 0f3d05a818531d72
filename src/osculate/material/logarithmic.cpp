#include "osculate/material/logarithmic.hpp"

#include <algorithm>
#include <array>

#include "osculate/material/orientation.hpp"

namespace osculate::material {
namespace {

constexpr std::array<std::array<Eigen::Index, 2>, 6> pairs{
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
constexpr std::array<std::array<Eigen::Index, 3>, 3> place{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};

Mat<3, 3> tensor(const Vec<6>& v, double shear) {
  Mat<3, 3> t;
  t << v[0], shear * v[3], shear * v[5],  //
      shear * v[3], v[1], shear * v[4],   //
      shear * v[5], shear * v[4], v[2];
  return t;
}
Vec<6> components(const Mat<3, 3>& t, double shear) {
  return {t(0, 0), t(1, 1), t(2, 2), shear * t(0, 1), shear * t(1, 2), shear * t(0, 2)};
}

/// Turns the axes p and q so that a(p, q) vanishes. A zero stays one, so that what happens in a
/// plane stays there.
void turn_pair(Mat<3, 3>& a, Mat<3, 3>& axes, Eigen::Index p, Eigen::Index q) {
  constexpr double negligible = 1e-18;
  if (std::abs(a(p, q)) <= negligible * (std::abs(a(p, p)) + std::abs(a(q, q)))) {
    a(p, q) = a(q, p) = 0;
    return;
  }
  const double ratio = (a(q, q) - a(p, p)) / (2 * a(p, q));
  const double t = (ratio < 0 ? -1 : 1) / (std::abs(ratio) + std::sqrt(ratio * ratio + 1));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  const double moved = t * a(p, q);
  a(p, p) -= moved;
  a(q, q) += moved;
  a(p, q) = a(q, p) = 0;
  const Eigen::Index r = 3 - p - q;
  const double rp = a(r, p), rq = a(r, q);
  a(r, p) = a(p, r) = c * rp - s * rq;
  a(r, q) = a(q, r) = s * rp + c * rq;
  const Vec3 first = axes.col(p), second = axes.col(q);
  axes.col(p) = c * first - s * second;
  axes.col(q) = s * first + c * second;
}

/// ln[a, b] at the eigenvalues 1 + 2 a, 1 + 2 b.
double first_difference(double a, double b) {
  const double from = 1 + 2 * b, way = 2 * (a - b) / from;
  return (way == 0 ? 1.0 : std::log1p(way) / way) / from;
}

}  // namespace

double second_difference_of_log(double a, double b, double c) {
  std::array<double, 3> e{a, b, c};
  std::sort(e.begin(), e.end());
  const double mean = 1 + 2 * (a + b + c) / 3, spread = 2 * (e[2] - e[0]);
  constexpr double near = 1e-3;
  if (spread > near * mean)
    return (first_difference(e[2], e[1]) - first_difference(e[1], e[0])) / spread;
  // ln(1 + d) = sum (-1)^(k-1) d^k / k , whose differences are the complete symmetric polynomials
  // of what deviates from the mean; the first one vanishes
  const double shift = (a + b + c) / 3;
  const double x = 2 * (a - shift) / mean, y = 2 * (b - shift) / mean, z = 2 * (c - shift) / mean;
  const double two = x * y + y * z + z * x, three = x * y * z;
  return (-1.0 / 2 + two / 4 + three / 5 - two * two / 6) / (mean * mean);
}

LogarithmicStrain::LogarithmicStrain(const Strain3& strain) {
  Mat<3, 3> a = tensor(strain, 0.5);
  constexpr int most = 12;
  for (int sweep = 0; sweep < most && !(a(0, 1) == 0 && a(1, 2) == 0 && a(0, 2) == 0); ++sweep) {
    turn_pair(a, axes_, 0, 1);
    turn_pair(a, axes_, 1, 2);
    turn_pair(a, axes_, 0, 2);
  }
  strain_ = a.diagonal();
  ok_ = strain_.minCoeff() > -0.5 && a.allFinite();
  for (Eigen::Index i = 0; ok_ && i < 3; ++i)
    for (Eigen::Index j = 0; j <= i; ++j)
      first_(i, j) = first_(j, i) = first_difference(strain_[i], strain_[j]);
}

Strain3 LogarithmicStrain::strain() const {
  const Vec3 log = strain_.unaryExpr([](double e) { return 0.5 * std::log1p(2 * e); });
  return components(axes_ * log.asDiagonal() * axes_.transpose(), 2);
}

PrincipalStrain LogarithmicStrain::principal() const {
  PrincipalStrain out;
  out.value = strain_.unaryExpr([](double e) { return 0.5 * std::log1p(2 * e); });
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < 3; ++j)
      out.difference(i, j) = first_(i, j) * (strain_[i] - strain_[j]);
  out.mean_slope = first_;
  return out;
}

Stress3 LogarithmicStrain::stress(const Stress3& of_logarithm) const {
  const Mat<3, 3> t = axes_.transpose() * tensor(of_logarithm, 1) * axes_;
  return components(axes_ * first_.cwiseProduct(t) * axes_.transpose(), 1);
}

Response3 LogarithmicStrain::response(const Response3& of_logarithm) const {
  const Mat<3, 3> t = axes_.transpose() * tensor(of_logarithm.stress, 1) * axes_;
  Mat<6, 6> change = Mat<6, 6>::Zero();  // T : L in the axes
  std::array<std::array<std::array<double, 3>, 3>, 3> second{};
  for (std::size_t p = 0; p < 3; ++p)
    for (std::size_t q = 0; q <= p; ++q)
      for (std::size_t s = 0; s <= q; ++s)
        second[p][q][s] = second[p][s][q] = second[q][p][s] = second[q][s][p] = second[s][p][q] =
            second[s][q][p] = second_difference_of_log(strain_[static_cast<Eigen::Index>(p)],
                                                       strain_[static_cast<Eigen::Index>(q)],
                                                       strain_[static_cast<Eigen::Index>(s)]);
  for (std::size_t p = 0; p < 3; ++p)
    for (std::size_t q = 0; q < 3; ++q)
      for (std::size_t s = 0; s < 3; ++s) {
        const auto i = static_cast<Eigen::Index>(p), k = static_cast<Eigen::Index>(s);
        const double term = 2 * t(i, k) * (p == q ? 1 : 0.5) * (q == s ? 1 : 0.5) * second[p][q][s];
        change(place[p][q], place[q][s]) += term;
        change(place[q][s], place[p][q]) += term;
      }
  Vec<6> factor;
  for (std::size_t i = 0; i < 6; ++i)
    factor[static_cast<Eigen::Index>(i)] = first_(pairs[i][0], pairs[i][1]);
  const Mat<6, 6> in = into_axes(axes_), out = into_axes(axes_.transpose());
  const Mat<6, 6> p = out * factor.asDiagonal() * in;
  Response3 r;
  r.ok = of_logarithm.ok;
  r.stress = stress(of_logarithm.stress);
  const Mat<6, 6> tangent = p.transpose() * of_logarithm.tangent * p + in.transpose() * change * in;
  r.tangent = 0.5 * (tangent + tangent.transpose());
  return r;
}

}  // namespace osculate::material
