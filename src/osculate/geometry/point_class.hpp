#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "osculate/geometry/surface_frame.hpp"

namespace osculate::geometry {

/// What a surface looks like near one of its points.
enum class PointClass : std::uint8_t {
  singular,    ///< the tangents are parallel or vanish: no normal
  planar,      ///< k1 = k2 = 0: see flat_point()
  parabolic,   ///< one of them is zero: a cylinder
  hyperbolic,  ///< k1 > 0 > k2: a saddle
  elliptic     ///< both of one sign: a dome or a bowl
};
inline constexpr std::array<std::string_view, 5> point_class_names{
    "singular", "planar", "parabolic", "hyperbolic", "elliptic"};
[[nodiscard]] inline std::string_view name(PointClass c) {
  return point_class_names[static_cast<std::size_t>(c)];
}

/// A curvature counts as zero below this part of the larger one, and below this part of 1/size.
inline constexpr double flat_tolerance = 1e-9;

/// Class by the signs of the principal curvatures, the same for a surface of any size.
///
/// Formula    K = k1 k2 > 0 elliptic, < 0 hyperbolic; |k| <= tolerance max(|k1|, |k2|, 1/size) is 0
/// Source     KSCPP 2.1, cases (1) to (4)
/// Units      size: length; of the whole surface, its diagonal say
/// Tested by  tests/unit/geometry/test_point_class.cpp
[[nodiscard]] inline PointClass point_class(const std::array<double, 2>& k, double size,
                                            double tolerance = flat_tolerance) {
  const double larger = std::max(std::abs(k[0]), std::abs(k[1]));
  const double zero = tolerance * std::max(larger, 1 / size);
  if (!std::isfinite(larger)) return PointClass::singular;
  if (larger <= zero) return PointClass::planar;
  if (std::min(std::abs(k[0]), std::abs(k[1])) <= zero) return PointClass::parabolic;
  const double sign = std::copysign(1.0, k[0]) * k[1];  // @eq KSCPP:15
  return sign > 0 ? PointClass::elliptic : PointClass::hyperbolic;
}

/// How a surface leaves its tangent plane at a planar point, by the lines along which it does not
/// at third order.
enum class CubicForm : std::uint8_t {
  zero,         ///< no terms of third order: contact with the tangent plane of order 3 or higher
  one_line,     ///< up on one side of a line, down on the other
  triple_line,  ///< the same, flatter: u^3
  two_lines,    ///< u^2 v: as one_line, and touching the plane along a second line
  three_lines   ///< a monkey saddle: three sectors up, three down
};
inline constexpr std::array<std::string_view, 5> cubic_form_names{"zero", "one line", "triple line",
                                                                  "two lines", "three lines"};
[[nodiscard]] inline std::string_view name(CubicForm form) {
  return cubic_form_names[static_cast<std::size_t>(form)];
}

/// The surface near a planar point: its height over the tangent plane is c(u)/6 + O(|u|^4).
struct FlatPoint {
  std::array<double, 4> cubic{0, 0, 0, 0};  ///< c of (e1 e1 e1, e1 e1 e2, e1 e2 e2, e2 e2 e2)
  std::array<Vec3, 2> basis{Vec3::Zero(), Vec3::Zero()};  ///< e1, e2: orthonormal tangents
  CubicForm form = CubicForm::zero;
  int contact_order = 3;  ///< of the tangent plane: 2, or 3 meaning at least 3
};

/// Terms of third order and their sign structure.
///
/// Formula    c(u) = n . r_ijk u^i u^j u^k in an orthonormal basis; with the Hessian
///            H0 = c0 c2 - c1^2, H1 = c0 c3 - c1 c2, H2 = c1 c3 - c2^2 the form has three real
///            lines if 4 H0 H2 - H1^2 > 0, one if < 0, a multiple one if = 0, a triple one if H = 0
/// Source     KSCPP 3.4 asks for it and gives nothing; discriminant of a binary cubic
/// Units      c: 1/length^2;  size as for point_class
/// Requires   a valid frame of that jet with h_ij = 0; else c also has terms Gamma h
/// Tested by  tests/unit/geometry/test_point_class.cpp
[[nodiscard]] inline FlatPoint flat_point(const SurfaceJet& jet, const SurfaceFrame& f, double size,
                                          double tolerance = flat_tolerance) {
  FlatPoint out;
  if (!f.valid) return out;
  const Vec3 e1 = f.tangent[0].normalized(), e2 = f.normal.cross(e1);
  out.basis = {e1, e2};
  const std::array<Vec3, 2> dual = contravariant_basis(f);
  const std::array<Vec2, 2> e{Vec2(e1.dot(dual[0]), e1.dot(dual[1])),
                              Vec2(e2.dot(dual[0]), e2.dot(dual[1]))};
  const auto form = [&](const Vec2& a, const Vec2& b, const Vec2& c) {
    double sum = 0;
    for (std::size_t k = 0; k < 8; ++k) {
      const std::size_t i = k & 1, j = (k >> 1) & 1, l = k >> 2;
      sum += f.normal.dot(jet.r3[i + j + l]) * a[static_cast<Eigen::Index>(i)] *
             b[static_cast<Eigen::Index>(j)] * c[static_cast<Eigen::Index>(l)];
    }
    return sum;
  };
  const auto& c = out.cubic = {form(e[0], e[0], e[0]), form(e[0], e[0], e[1]),
                               form(e[0], e[1], e[1]), form(e[1], e[1], e[1])};
  const double square = c[0] * c[0] + 3 * c[1] * c[1] + 3 * c[2] * c[2] + c[3] * c[3];
  if (!(std::sqrt(square) * size * size > tolerance)) return out;
  out.contact_order = 2;
  const double h0 = c[0] * c[2] - c[1] * c[1], h1 = c[0] * c[3] - c[1] * c[2],
               h2 = c[1] * c[3] - c[2] * c[2];
  const double discriminant = 4 * h0 * h2 - h1 * h1;
  if (std::abs(discriminant) > tolerance * square * square)
    out.form = discriminant > 0 ? CubicForm::three_lines : CubicForm::one_line;
  else if (std::hypot(h0, h1, h2) > std::sqrt(tolerance) * square)
    out.form = CubicForm::two_lines;
  else
    out.form = CubicForm::triple_line;
  return out;
}

/// Sine of the angle between the coordinate lines: near zero the parameterisation is about to fold.
///
/// Formula    sqrt(det a/(a11 a22)), 0 where the tangents are parallel or vanish
/// Source     KSCPP 3.4: det a > 0 is what a projection onto a plane needs
[[nodiscard]] inline double coordinate_sine(const SurfaceFrame& f) {
  if (!f.valid) return 0;
  return f.area / (f.tangent[0].norm() * f.tangent[1].norm());  // @eq KSCPP:26
}

}  // namespace osculate::geometry
