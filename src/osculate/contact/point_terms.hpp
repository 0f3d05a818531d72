#pragma once
#include <array>

#include "osculate/contact/kinematics.hpp"
#include "osculate/contact/law/coulomb.hpp"
#include "osculate/contact/law/normal_penalty.hpp"

namespace osculate::contact {

/// Which residual the tractions enter.
///   surface : R = N A^T nu + t A^T tau                   (the papers, zeta = 0 on the tangent
///   plane) full    : work-conjugate to the exact d(xi); moments balance for every penetration
enum class ResidualForm : std::uint8_t { surface, full };

/// Tangent to use. `consistent` is the exact derivative of the residual; otherwise the papers'
/// covariant tangent in its three switchable parts.
struct TangentForm {
  bool consistent = true;
  bool main = true, rotational = true, curvature = true;
};

/// Traction of one contact point with everything its linearisation needs.
struct Traction {
  NormalResponse normal;
  TangentialResponse tangential;
  double d_trial_d_slip = 0;        ///< eps_T times the part of the increment spent in contact
  double d_trial_d_gap = 0;         ///< from the moment of first contact inside the increment
  double tangential_stiffness = 0;  ///< eps_T (for the covariant tangent)
};

/// Residual and tangent of one contact point before the weights are applied:
///   R_k  = w_k F0 + w'_k F1
///   K_kl = sum_ab w^(a)_k M[a][b] w^(b)_l         (a, b = order of the derivative of w)
/// plus the rank-one term  dR_k = (w_k S0 + w'_k S1) d(path)  for the part of the slip increment
/// that depends on nodes behind the point (KS2D:86-89, exact along the arc).
struct PointTerms {
  Vec2 f0 = Vec2::Zero(), f1 = Vec2::Zero();
  std::array<std::array<Mat<2, 2>, 3>, 3> m;
  Vec2 s0 = Vec2::Zero(), s1 = Vec2::Zero();
};

/// Forces of a contact point (F0, F1 only).
[[nodiscard]] PointTerms point_forces(const Kinematics& k, const Traction& t, ResidualForm form);

/// Exact consistent tangent: every formula is the derivative of `point_forces`.
///
/// Source     docs/errata.md (exact form of KS2D:54, 56, 58); with `full` from KS2D:39
/// Tested by  tests/unit/pairing/test_pair_tangent.cpp (order 2 in every branch)
[[nodiscard]] PointTerms consistent_terms(const Kinematics& k, const Traction& t,
                                          ResidualForm form);

/// The papers' covariant tangent with the corrections of docs/errata.md, part by part.
/// Symmetric in stick; not the derivative of the residual, so Newton's rate is linear.
[[nodiscard]] PointTerms covariant_terms(const Kinematics& k, const Traction& t, ResidualForm form,
                                         const TangentForm& parts);

[[nodiscard]] PointTerms point_terms(const Kinematics& k, const Traction& t, ResidualForm form,
                                     const TangentForm& tangent);

}  // namespace osculate::contact
