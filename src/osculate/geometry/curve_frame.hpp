#pragma once
#include <cmath>
#include <limits>

#include "osculate/core/types.hpp"
#include "osculate/geometry/curve_jet.hpp"

namespace osculate::geometry {

/// Moving frame, metric and curvature of a plane curve at one point.
///
/// Formula    a11 = rho_xi . rho_xi ,  nu = k x rho_xi / sqrt(a11) ,  h11 = rho_xixi . nu ,
///            Gamma = rho_xixi . rho_xi / a11 ,  kappa = h11 / a11
/// Source     KS2D:6, 8, 12, 21; the sign of KS2D:7 and :67 is opposite (docs/errata.md)
/// Units      a11, h11: length^2/xi^2 and length/xi^2;  kappa: 1/length;  Gamma: 1/xi
/// Frame      the configuration of the jet; lower indices = covariant
/// Sign       nu points out of the master body, which lies on the right of the direction of
///            travel; kappa > 0 where the curve bends towards nu (a solid disc has kappa = -1/R)
/// Errors     `valid` is false where rho_xi vanishes or is not finite; everything else is then
///            zero: no NaN, nothing thrown
/// Tested by  tests/unit/geometry/test_curve_frame.cpp
struct CurveFrame {
  Vec2 tangent = Vec2::Zero();  ///< rho_xi (not a unit vector)
  Vec2 normal = Vec2::Zero();   ///< nu
  double a11 = 0, sqrt_a11 = 0;
  double h11 = 0;
  double kappa = 0;
  double gamma = 0;  ///< Christoffel symbol Gamma
  bool valid = false;
};

[[nodiscard]] inline CurveFrame curve_frame(const CurveJet<2>& jet) {
  CurveFrame frame;
  const double a11 = jet.r1.squaredNorm();  // @eq KS2D:8 the one entry of the metric that varies
  if (!(a11 >= std::numeric_limits<double>::min()) || !std::isfinite(a11)) return frame;
  frame.valid = true;
  frame.a11 = a11;
  frame.sqrt_a11 = std::sqrt(a11);
  frame.tangent = jet.r1;
  frame.normal = turn(jet.r1) / frame.sqrt_a11;  // @eq KS2D:6
  frame.h11 = jet.r2.dot(frame.normal);          // @eq KS2D:12 (with Gamma below)
  frame.gamma = jet.r2.dot(jet.r1) / a11;
  frame.kappa = frame.h11 / a11;  // @eq KS2D:21
  return frame;
}

[[nodiscard]] inline Vec2 unit_tangent(const CurveFrame& frame) {
  return frame.valid ? Vec2(frame.tangent / frame.sqrt_a11) : Vec2(Vec2::Zero());
}

/// Contravariant basis rho^1, rho^2 on the curve: rho_i . rho^j = delta_i^j.
struct ContravariantBasis {
  Vec2 rho1 = Vec2::Zero(), rho2 = Vec2::Zero();
};

[[nodiscard]] inline ContravariantBasis contravariant_basis(const CurveFrame& frame) {
  if (!frame.valid) return {};
  return {frame.tangent / frame.a11, frame.normal};  // @eq KS2D:9
}

/// rho_xixi from the frame (Gauss).
[[nodiscard]] inline Vec2 gauss_formula(const CurveFrame& frame) {
  return frame.gamma * frame.tangent + frame.h11 * frame.normal;  // @eq KS2D:11
}

/// d(nu)/d(xi) (Weingarten).
[[nodiscard]] inline Vec2 weingarten_formula(const CurveFrame& frame) {
  return -frame.kappa * frame.tangent;  // @eq KS2D:16
}

/// Derivatives of tau and nu with respect to arc length.
struct SerretFrenet {
  Vec2 dtau_ds, dnu_ds;
};

/// Sign       kappa is signed and nu is the outward normal, not Frenet's principal normal
[[nodiscard]] inline SerretFrenet serret_frenet(const CurveFrame& frame) {
  return {frame.kappa * frame.normal, -frame.kappa * unit_tangent(frame)};  // @eq KS2D:20
}

/// Tangent of the coordinate line zeta = const: r_1 = (1 - kappa zeta) rho_xi. It vanishes at the
/// centre of curvature, where the coordinates (xi, zeta) end.
[[nodiscard]] inline Vec2 offset_tangent(const CurveFrame& frame, double zeta) {
  return (1.0 - frame.kappa * zeta) * frame.tangent;  // @eq KS2D:17
}

/// The tangent vector with covariant component T.
[[nodiscard]] inline Vec2 covariant_vector(const CurveFrame& frame, double component) {
  return component * contravariant_basis(frame).rho1;  // @eq KS2D:22
}

/// Length of the tangent vector with covariant component T (zero on an invalid frame).
[[nodiscard]] inline double covariant_length(const CurveFrame& frame, double component) {
  return frame.valid ? std::abs(component) / frame.sqrt_a11 : 0.0;  // @eq KS2D:23
}

/// Rates of a point moving over a curve.
struct ConvectiveRates {
  double xi = 0, zeta = 0;
};

/// Covariant time derivative of a covariant tangent component.
///
/// Formula    D1T/dt = dT/dt - T (Gamma dxi/dt - (h11/a11) dzeta/dt)
/// Source     KS2D:100; KS2D:25 as printed lacks the factor T and has one sign wrong
///            (docs/errata.md)
/// Returns    rho_xi . d/dt (T r^1) at zeta = 0; zero when the vector is carried along unchanged
[[nodiscard]] inline double covariant_rate(const CurveFrame& frame, double component,
                                           double component_rate, const ConvectiveRates& rates) {
  // @eq KS2D:100 (its other place, eq. 25, is misprinted)
  return component_rate - component * (frame.gamma * rates.xi - frame.kappa * rates.zeta);
}

/// The same curve in another parameter eta, by the chain rule.
///
/// Formula    r_eta = r_xi xi' ;  r_etaeta = r_xixi xi'^2 + r_xi xi'' ;
///            r_etaetaeta = r_xixixi xi'^3 + 3 r_xixi xi' xi'' + r_xi xi'''
/// Source     chain rule (Faa di Bruno)
template <int Dim>
[[nodiscard]] CurveJet<Dim> reparameterise(const CurveJet<Dim>& jet, double dxi, double d2xi = 0,
                                           double d3xi = 0) {
  CurveJet<Dim> out;
  out.r = jet.r;
  out.r1 = dxi * jet.r1;
  out.r2 = dxi * dxi * jet.r2 + d2xi * jet.r1;
  out.r3 = dxi * dxi * dxi * jet.r3 + 3.0 * dxi * d2xi * jet.r2 + d3xi * jet.r1;
  return out;
}

/// The jet in arc length, exact through the third derivative (needs a valid frame).
///
/// Formula    xi' = 1/sqrt(a11) ,  xi'' = -Gamma/a11 ,  xi''' from d(xi'')/ds
[[nodiscard]] inline CurveJet<2> natural_jet(const CurveJet<2>& jet) {
  const CurveFrame f = curve_frame(jet);
  if (!f.valid) return {jet.r, Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
  const double d1 = 1.0 / f.sqrt_a11;
  const double d2 = -f.gamma / f.a11;
  const double gamma_xi =
      (jet.r3.dot(jet.r1) + jet.r2.squaredNorm()) / f.a11 - 2.0 * f.gamma * f.gamma;
  const double d3 = (2.0 * f.gamma * f.gamma - gamma_xi) / f.a11 * d1;
  return reparameterise(jet, d1, d2, d3);
}

}  // namespace osculate::geometry
