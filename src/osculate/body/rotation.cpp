#include "osculate/body/rotation.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

namespace osculate::body {
namespace {

/// The entire functions  c_m(s) = sum_k (-s)^k / (2k + m)!  of s = t^2 and their derivatives:
/// c_0 = cos t, c_1 = sin t / t, c_2 = (1 - cos t)/t^2, c_3 = (t - sin t)/t^3.
struct Coefficients {
  std::array<double, 4> c{}, d{}, dd{};
};

constexpr std::size_t terms = 12;

/// (-1)^k / (2k + m)! in row m.
constexpr std::array<std::array<double, terms>, 4> power_series() {
  std::array<std::array<double, terms>, 4> table{};
  double factor = 1;  // 1 / m!
  for (std::size_t m = 0; m < 4; ++m) {
    if (m > 1) factor /= static_cast<double>(m);
    double term = factor;
    for (std::size_t k = 0; k < terms; ++k) {
      table[m][k] = term;
      const auto n = static_cast<double>(2 * k + m);
      term /= -(n + 1) * (n + 2);
    }
  }
  return table;
}

constexpr std::array<std::array<double, terms>, 4> series = power_series();

/// Requires s <= 1: the terms left out are then below 1e-23.
constexpr Coefficients from_series(double s) {
  Coefficients out;
  for (std::size_t m = 0; m < 4; ++m)
    for (std::size_t k = terms; k-- > 0;) {  // Horner
      const auto n = static_cast<double>(k);
      out.c[m] = out.c[m] * s + series[m][k];
      if (k >= 1) out.d[m] = out.d[m] * s + n * series[m][k];
      if (k >= 2) out.dd[m] = out.dd[m] * s + n * (n - 1) * series[m][k];
    }
  return out;
}

/// By the recurrence c_(m+2) = (1/m! - c_m)/s and 2 s c_m' = c_(m-1) - m c_m.
Coefficients in_closed_form(double s) {
  const double t = std::sqrt(s);
  Coefficients out;
  std::array<double, 4>& c = out.c;
  c[0] = std::cos(t);
  c[1] = std::sin(t) / t;
  c[2] = (1 - c[0]) / s;
  c[3] = (1 - c[1]) / s;
  out.d[0] = -0.5 * c[1];
  for (std::size_t m = 1; m < 4; ++m)
    out.d[m] = (c[m - 1] - static_cast<double>(m) * c[m]) / (2 * s);
  out.dd[0] = -0.5 * out.d[1];
  for (std::size_t m = 1; m < 4; ++m)
    out.dd[m] = (out.d[m - 1] - static_cast<double>(m + 2) * out.d[m]) / (2 * s);
  return out;
}

Coefficients coefficients(const Vec3& theta) {
  constexpr Coefficients at_rest = from_series(0);  // of the many nodes of bodies that do not turn
  const double s = theta.squaredNorm();
  if (s == 0) return at_rest;
  return s <= 1 ? from_series(s) : in_closed_form(s);
}

}  // namespace

Mat<3, 3> cross_matrix(const Vec3& v) {
  Mat<3, 3> m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

Mat<3, 3> rotation_matrix(const Vec3& theta) {
  const Coefficients k = coefficients(theta);
  return k.c[0] * Mat<3, 3>::Identity() + k.c[1] * cross_matrix(theta) +
         k.c[2] * theta * theta.transpose();
}

Vec3 rotation_vector(const Mat<3, 3>& r) {
  const Eigen::Quaterniond q(r);
  const double sine = q.vec().norm(), cosine = std::abs(q.w());
  if (sine == 0) return Vec3::Zero();
  const double angle = 2 * std::atan2(sine, cosine);
  return std::copysign(angle / sine, q.w()) * q.vec();
}

Vec3 rotation_vector_near(const Mat<3, 3>& r, const Vec3& guess) {
  constexpr double turn = 2 * std::numbers::pi, hardly_turned = 1e-2, across_it = 1e-6;
  const Vec3 least = rotation_vector(r);
  if (guess.isZero(0)) return least;
  const Vec3 towards = guess.normalized();
  const double along = least.dot(towards), turns = std::round((guess.norm() - along) / turn);
  const double across = (least - along * towards).norm();
  if (turns != 0 && least.norm() < hardly_turned && across < across_it)
    return (along + turns * turn) * towards;
  if (least.isZero(0)) return turns * turn * towards;
  const Vec3 axis = least.normalized();
  return least + std::round(axis.dot(guess - least) / turn) * turn * axis;
}

Mat<3, 3> rotation_tangent(const Vec3& theta) {
  const Coefficients k = coefficients(theta);
  const Mat<3, 3> s = cross_matrix(theta);
  return Mat<3, 3>::Identity() + k.c[2] * s + k.c[3] * s * s;
}

Mat<3, 3> rotation_hessian(const Vec3& theta, const Vec3& f, const Vec3& a) {
  const Coefficients k = coefficients(theta);
  const Vec3 w = a.cross(f);
  const double fa = f.dot(a), p = theta.dot(f), q = theta.dot(a), tw = theta.dot(w);
  // f . R a = c_0 f.a + c_1 theta.(a x f) + c_2 (theta.f)(theta.a)
  const double first = k.d[0] * fa + k.d[1] * tw + k.d[2] * p * q;
  const double second = k.dd[0] * fa + k.dd[1] * tw + k.dd[2] * p * q;
  const Vec3 mixed = 2 * k.d[1] * w + 2 * k.d[2] * (q * f + p * a);
  return 2 * first * Mat<3, 3>::Identity() + 4 * second * theta * theta.transpose() +
         mixed * theta.transpose() + theta * mixed.transpose() +
         k.c[2] * (f * a.transpose() + a * f.transpose());
}

Mat<3, 3> moment_gradient(const Vec3& theta, const Vec3& m) {
  const Coefficients k = coefficients(theta);
  // T^T m = m - c_2 theta x m + c_3 theta x (theta x m)
  const Vec3 once = theta.cross(m);
  const Vec3 twice = theta.cross(once);
  return 2 * (k.d[3] * twice - k.d[2] * once) * theta.transpose() + k.c[2] * cross_matrix(m) +
         k.c[3] * (theta.dot(m) * Mat<3, 3>::Identity() + theta * m.transpose() -
                   2 * m * theta.transpose());
}

}  // namespace osculate::body
