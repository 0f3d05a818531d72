#pragma once
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "osculate/core/types.hpp"

namespace osculate::projection {

/// Squared distance of a point from a surface point, and the derivatives of its half.
///
/// Formula    F = |r_s - r|^2/2 ,  F_i = -(r_s - r) . r_i ,  F_ij = a_ij - (r_s - r) . r_ij
/// Source     KSVD:13 to KSVD:16 without the factor 2; r_ij in full, since F_ij = a_ij - g h_ij
///            holds at the foot point only, and the last line of (16) is misprinted
struct DistanceJet2 {
  double squared_distance = 0;
  Vec2 slope{0, 0};                      ///< F_i
  Mat<2, 2> bend = Mat<2, 2>::Zero();    ///< F_ij
  Mat<2, 2> metric = Mat<2, 2>::Zero();  ///< a_ij
};

/// From r_s - r and the derivatives r_1, r_2; r_11, r_12, r_22 (a curve has r_2 = 0).
template <int Dim>
[[nodiscard]] DistanceJet2 distance_jet2(const Vec<Dim>& gap, const std::array<Vec<Dim>, 2>& r1,
                                         const std::array<Vec<Dim>, 3>& r2) {
  DistanceJet2 j;
  j.squared_distance = gap.squaredNorm();
  j.slope = {-gap.dot(r1[0]), -gap.dot(r1[1])};  // @eq KSVD:15, KSCPP:5
  const double a12 = r1[0].dot(r1[1]), b12 = gap.dot(r2[1]);
  j.metric << r1[0].squaredNorm(), a12, a12, r1[1].squaredNorm();
  Mat<2, 2> second;
  second << gap.dot(r2[0]), b12, b12, gap.dot(r2[2]);
  j.bend = j.metric - second;  // @eq KSVD:16, KSCPP:6
  return j;
}

[[nodiscard]] inline bool positive(const Mat<2, 2>& m) {
  return m(0, 0) > 0 && m.determinant() > 0;
}

/// Smallest lambda with det(f - lambda a) = 0; f symmetric, a symmetric and positive. With f = F_ij
/// at a foot point it is the smaller 1 - zeta k.
///
/// Formula    lambda of the symmetric L^-1 f L^-T with a = L L^T: exact to rounding for equal
///            lambdas too, where trace and determinant leave half the digits
[[nodiscard]] inline double least_ratio(const Mat<2, 2>& f, const Mat<2, 2>& a) {
  const double slant = a(0, 1) / a(0, 0), rest = a(1, 1) - slant * a(0, 1);
  const double m11 = f(0, 0) / a(0, 0);
  const double mixed = f(0, 1) - slant * f(0, 0);
  const double m12 = mixed / std::sqrt(a(0, 0) * rest);
  const double m22 = (f(1, 1) - slant * f(0, 1) - slant * mixed) / rest;
  return 0.5 * (m11 + m22) - std::hypot(0.5 * (m11 - m22), m12);
}

/// Downhill step: Newton's where the distance bends upwards, else Gauss-Newton's.
[[nodiscard]] inline Vec2 descent(const DistanceJet2& j) {
  if (positive(j.bend)) return -j.bend.inverse() * j.slope;  // @eq KSVD:14, KSCPP:4
  if (positive(j.metric)) return -j.metric.inverse() * j.slope;
  return -j.slope / std::max(j.metric.trace(), 1e-300);
}

}  // namespace osculate::projection
