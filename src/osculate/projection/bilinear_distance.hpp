#pragma once
#include <array>
#include <cmath>

#include "osculate/projection/surface_distance.hpp"

namespace osculate::projection {

/// Distance of a point from a facet with four corners, by scalar products that are found once.
///
/// Formula    r = c_0 + c_1 xi + c_2 eta + c_3 xi eta ,  d = p - c_0 ,  c_ij = c_i . c_j ,
///            b_i = d . c_i ,  a = c_13 xi + c_23 eta + c_33 xi eta - b_3 ;
///            F_1 = c_11 xi + c_12 eta + c_13 xi eta - b_1 + a eta ;
///            F_2 = c_12 xi + c_22 eta + c_23 xi eta - b_2 + a xi ;
///            F_11 = |c_1 + c_3 eta|^2 ;
///            F_22 = |c_2 + c_3 xi|^2 ;
///            F_12 = c_12 - b_3 + 2 (c_13 xi + c_23 eta + c_33 xi eta)
/// Source     KSVD:15, KSVD:16 and KSCPP:5, KSCPP:6 as in `distance_jet2`, for this r
/// Requires   corners in the order of `cell::area_node`
/// Tested by  tests/unit/projection/test_bilinear_distance.cpp
class BilinearDistance {
 public:
  BilinearDistance(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& point)
      : c1_(0.25 * ((b - a) + (c - d))),
        c2_(0.25 * ((d - a) + (c - b))),
        c3_(0.25 * ((a - b) + (c - d))),
        arm_(0.25 * (((point - a) + (point - b)) + ((point - c) + (point - d)))),
        c11_(product(c1_, c1_)),
        c22_(product(c2_, c2_)),
        c33_(product(c3_, c3_)),
        c12_(product(c1_, c2_)),
        c13_(product(c1_, c3_)),
        c23_(product(c2_, c3_)),
        b1_(product(arm_, c1_)),
        b2_(product(arm_, c2_)),
        b3_(product(arm_, c3_)) {}

  /// Whether the distance certainly bends upwards all over the facet, so that it has one minimum.
  [[nodiscard]] bool convex() const {
    const double first = c11_ - 2 * std::abs(c13_), second = c22_ - 2 * std::abs(c23_);
    const double mixed =
        std::abs(c12_ - b3_) + 2 * (std::abs(c13_) + std::abs(c23_) + std::abs(c33_));
    return first > 0 && second > 0 && first * second > (1 + 1e-9) * mixed * mixed;
  }
  /// F_1 and F_2.
  [[nodiscard]] Vec2 slope(const Vec2& xi) const {
    const double s = xi[0], t = xi[1];
    const double along = c13_ * s + c23_ * t + c33_ * s * t - b3_;
    return {c11_ * s + c12_ * t + c13_ * s * t - b1_ + t * along,
            c12_ * s + c22_ * t + c23_ * s * t - b2_ + s * along};
  }
  /// F_11, F_12, F_22.
  [[nodiscard]] std::array<double, 3> bend(const Vec2& xi) const {
    const double s = xi[0], t = xi[1];
    return {c11_ + t * (2 * c13_ + t * c33_), c12_ - b3_ + 2 * (c13_ * s + c23_ * t + c33_ * s * t),
            c22_ + s * (2 * c23_ + s * c33_)};
  }
  [[nodiscard]] DistanceJet2 jet(const Vec2& xi) const {
    const auto [f11, f12, f22] = bend(xi);
    const double a12 = c12_ + c13_ * xi[0] + c23_ * xi[1] + c33_ * xi[0] * xi[1];
    DistanceJet2 j;
    j.squared_distance = squared_distance(xi);
    j.slope = slope(xi);
    j.bend << f11, f12, f12, f22;
    j.metric << f11, a12, a12, f22;
    return j;
  }
  /// Newton's step, where the distance bends upwards.
  [[nodiscard]] Vec2 step(const Vec2& xi, const Vec2& slope) const {
    const auto [f11, f12, f22] = bend(xi);
    const double scale = 1 / (f12 * f12 - f11 * f22);
    return {scale * (f22 * slope[0] - f12 * slope[1]), scale * (f11 * slope[1] - f12 * slope[0])};
  }
  [[nodiscard]] double squared_distance(const Vec2& xi) const {
    const Vec3 gap = arm_ - xi[0] * c1_ - xi[1] * c2_ - xi[0] * xi[1] * c3_;
    return product(gap, gap);
  }
  /// Whether the nearest place of all edges is the nearest one of a convex facet: the way inwards
  /// is not downhill.
  [[nodiscard]] bool nothing_inwards(const Vec2& xi) const {
    constexpr double rounding = 1e-14;
    const Vec2 s = slope(xi);
    const double size = rounding * (c11_ + c22_ + std::abs(b1_) + std::abs(b2_) + std::abs(b3_));
    for (Eigen::Index i = 0; i < 2; ++i)
      if ((xi[i] >= 1 && s[i] > size) || (xi[i] <= -1 && s[i] < -size)) return false;
    return true;
  }

 private:
  /// Not Eigen's: where that is not inlined the linker takes one of any source, which may have been
  /// compiled in another way, with other last digits.
  [[nodiscard]] static double product(const Vec3& a, const Vec3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  Vec3 c1_, c2_, c3_, arm_;
  double c11_, c22_, c33_, c12_, c13_, c23_, b1_, b2_, b3_;
};

}  // namespace osculate::projection
