#pragma once
#include <array>

#include "osculate/contact/kinematics.hpp"
#include "osculate/contact/law/normal_response.hpp"
#include "osculate/contact/law/tangential.hpp"

namespace osculate::contact {

/// Which residual the tractions enter.
///   surface : N n + t on the contact weights            (the papers: zero gap on the tangent
///   plane) full    : work-conjugate to the exact d(xi^i); moments balance for every penetration
enum class ResidualForm : std::uint8_t { surface, full };

/// Tangent to use. `consistent` is the exact derivative of the residual; otherwise the papers'
/// covariant tangent in its three switchable parts.
struct TangentForm {
  bool consistent = true;
  bool main = true, rotational = true, curvature = true;
};

/// Traction of one contact point with everything its linearisation needs.
template <int Dim>
struct Traction {
  NormalResponse normal;
  TangentialResponse<Dim> tangential;  ///< components in `Kinematics::frame`
  VectorForm<Dim> d_predictor;         ///< of the trial traction as a vector in space
  double stiffness = 0;                ///< eps_T (for the covariant tangent)
};

/// Residual and tangent of one contact point before the weights are applied:
///   R_k  = sum_a w^(a)_k f[a]                              (a: slots of values, first derivatives)
///   K_kl = sum_ab w^(a)_k m[a][b] w^(b)_l                  (a, b < used; beyond that all zero)
/// plus  dR_k = sum_a w^(a)_k s[a] d(t_trial)  for the part of the trial traction that depends on
/// nodes by other ways than the point's own motion (the path behind it, KS2D:86-89).
template <int Dim>
struct PointTerms {
  std::array<Vec<Dim>, Dim> f;
  std::size_t used = slots<Dim>;
  std::array<std::array<Mat<Dim, Dim>, slots<Dim>>, slots<Dim>> m;
  std::array<Mat<Dim, Dim>, Dim> s;
};

/// Forces of a contact point (f only).
template <int Dim>
[[nodiscard]] PointTerms<Dim> point_forces(const Kinematics<Dim>& k, const Traction<Dim>& t,
                                           ResidualForm form);

/// Exact consistent tangent: every formula is the derivative of `point_forces`.
///
/// Formula    frictionless, surface: eps [A^T A - (W_i - gap D_i) g^ij (W_j - gap D_j)^T], W_i =
///            A^T rho_,i, D_i = A_,i^T n (docs/errata.md)
/// Source     docs/errata.md (exact form of KS2D:54, 56, 58 and KSVD:55-58); `full` from KS2D:39
///            and KSVD:33
/// Tested by  tests/unit/pairing/test_pair_tangent.cpp, test_pair3_tangent.cpp (order 2 in every
///            branch)
template <int Dim>
[[nodiscard]] PointTerms<Dim> consistent_terms(const Kinematics<Dim>& k, const Traction<Dim>& t,
                                               ResidualForm form);

/// The shear traction as a vector in space and its derivatives,
///   dt = d_predictor d(t_trial) + d_push dN + variation  (the last with the point's own motion, dN
///   and d(t_trial) by it included).
template <int Dim>
struct ShearRate {
  Vec<Dim> value;
  Mat<Dim, Dim> d_predictor;  ///< E D E^T
  Vec<Dim> d_push;
  VectorForm<Dim> variation;
};
template <int Dim>
[[nodiscard]] ShearRate<Dim> shear_rate(const Kinematics<Dim>& k, const Traction<Dim>& t);

/// The papers' covariant tangent with the corrections of docs/errata.md, part by part.
/// Symmetric in stick; not the derivative of the residual, so Newton's rate is linear.
template <int Dim>
[[nodiscard]] PointTerms<Dim> covariant_terms(const Kinematics<Dim>& k, const Traction<Dim>& t,
                                              ResidualForm form, const TangentForm& parts);

template <int Dim>
[[nodiscard]] PointTerms<Dim> point_terms(const Kinematics<Dim>& k, const Traction<Dim>& t,
                                          ResidualForm form, const TangentForm& tangent) {
  return tangent.consistent ? consistent_terms(k, t, form) : covariant_terms(k, t, form, tangent);
}

}  // namespace osculate::contact
