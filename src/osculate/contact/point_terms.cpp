#include "osculate/contact/point_terms.hpp"

#include <cmath>

namespace osculate::contact {
namespace {

using Tensor = Mat<2, 2>;

/// Adds vector (x) form to the row of the a-th derivative of the weights.
void add(PointTerms& terms, int a, const Vec2& vector, const Form& form) {
  terms.m[a][0].noalias() += vector * form.p.transpose();
  terms.m[a][1].noalias() += vector * form.q.transpose();
  terms.m[a][2].noalias() += vector * form.r.transpose();
}

PointTerms zero_terms() {
  PointTerms terms;
  for (auto& row : terms.m)
    for (Tensor& tensor : row) tensor.setZero();
  return terms;
}

bool at_corner(const Kinematics& k) { return k.feature == projection::Feature::corner; }

/// Variation of a11: 2 rho_xi . d(rho_xi), convective part included.
Form metric_variation(const Kinematics& k) {
  const Vec2 tangent = k.sqrt_a11 * k.unit_tangent;
  Form form = 2 * tangent.dot(k.rho2) * k.d_xi;
  form.q -= 2 * tangent;
  return form;
}

/// Variation of h11 = rho_xixi . nu.
Form curvature_variation(const Kinematics& k) {
  Form form = k.normal.dot(k.rho3) * k.d_xi + (-k.rho2.dot(k.unit_tangent)) * k.d_angle;
  form.r -= k.normal;
  return form;
}

/// Lever of the tangential force in the full residual: F0 gets lever * t tau, F1 gets -arm * t nu.
struct Levers {
  double lever = 1, arm = 0;
  Form d_lever, d_arm;
};

// @eq KS2D:39 with the exact d(xi): T d(xi) = t sqrt(a11) (rho_xi . p - zeta nu . q) / g.
Levers work_conjugate_levers(const Kinematics& k) {
  Levers v;
  v.lever = k.a11 / k.g;
  v.arm = k.sqrt_a11 * k.gap / k.g;
  const Form da = metric_variation(k);
  const Form dg = da + (-k.gap) * curvature_variation(k) + (-k.h11) * k.d_gap;
  v.d_lever = (1 / k.g) * da + (-k.a11 / (k.g * k.g)) * dg;
  v.d_arm =
      (k.gap / (2 * k.sqrt_a11 * k.g)) * da + (k.sqrt_a11 / k.g) * k.d_gap + (-v.arm / k.g) * dg;
  return v;
}

Levers levers(const Kinematics& k, ResidualForm form) {
  if (form == ResidualForm::surface) return {};
  if (at_corner(k)) return {0, 0, {}, {}};  // no slip along the master, so no conjugate force
  return work_conjugate_levers(k);
}

void set_forces(PointTerms& terms, const Kinematics& k, const Traction& t, const Levers& v) {
  const double normal = t.normal.traction;
  const double shear = t.tangential.traction;
  // @eq KS2D:31 with the sign of docs/errata.md: both tractions act on the slave point.
  terms.f0 = normal * k.normal + v.lever * shear * k.unit_tangent;
  terms.f1 = -v.arm * shear * k.normal;
}

}  // namespace

PointTerms point_forces(const Kinematics& k, const Traction& t, ResidualForm form) {
  PointTerms terms;
  set_forces(terms, k, t, levers(k, form));
  return terms;
}

PointTerms consistent_terms(const Kinematics& k, const Traction& t, ResidualForm form) {
  PointTerms terms = zero_terms();
  const Levers v = levers(k, form);
  set_forces(terms, k, t, v);
  const double normal = t.normal.traction;
  const double shear = t.tangential.traction;

  // 1. tractions: dN = N' d(zeta); dt = dt/dt_tr (dt_tr/ds ds + dt_tr/dzeta dzeta) + dt/dN dN
  const Form d_normal = t.normal.d_traction * k.d_gap;
  const Form d_slip = k.sqrt_a11 * k.d_xi;
  const Form d_shear =
      t.tangential.d_trial * (t.d_trial_d_slip * d_slip + t.d_trial_d_gap * k.d_gap) +
      t.tangential.d_normal * d_normal;

  // 2. dF0 = dN nu - N tau d(angle) + d(lever t) tau + lever t nu d(angle)
  add(terms, 0, k.normal, d_normal + v.lever * shear * k.d_angle);
  add(terms, 0, k.unit_tangent, (-normal) * k.d_angle + v.lever * d_shear + shear * v.d_lever);

  // 3. dF1 = -d(arm t) nu + arm t tau d(angle)
  add(terms, 1, k.normal, (-v.arm) * d_shear + (-shear) * v.d_arm);
  add(terms, 1, k.unit_tangent, v.arm * shear * k.d_angle);

  // 4. the weights move with the foot point: dR_k += w'_k F0 d(xi) + w''_k F1 d(xi)
  add(terms, 1, terms.f0, k.d_xi);
  add(terms, 2, terms.f1, k.d_xi);

  // 5. the path behind the point
  const double d_path = t.tangential.d_trial * t.d_trial_d_slip;
  terms.s0 = v.lever * d_path * k.unit_tangent;
  terms.s1 = -v.arm * d_path * k.normal;
  return terms;
}

namespace {

// @eq KS2D:54 normal part: main, rotational and curvature part of N A^T nu.
void add_covariant_normal(PointTerms& terms, const Kinematics& k, const Traction& t,
                          const TangentForm& parts) {
  const Vec2 rho = k.sqrt_a11 * k.unit_tangent;
  const double n_over_a = t.normal.traction / k.a11;
  if (parts.main) terms.m[0][0] += t.normal.d_traction * k.normal * k.normal.transpose();
  if (parts.rotational) {
    terms.m[1][0] += n_over_a * k.normal * rho.transpose();
    terms.m[0][1] += n_over_a * rho * k.normal.transpose();
  }
  if (parts.curvature) terms.m[0][0] -= n_over_a * k.kappa * rho * rho.transpose();
}

// @eq KS2D:56 stick with the sign and the factor T/a11^2 of docs/errata.md; exactly symmetric.
void add_covariant_stick(PointTerms& terms, const Kinematics& k, const Traction& t,
                         const TangentForm& parts) {
  const Vec2 rho = k.sqrt_a11 * k.unit_tangent;
  const Tensor rr = rho * rho.transpose();
  const double scale = t.tangential.traction * k.sqrt_a11 / (k.a11 * k.a11);  // Tbar / a11^2
  if (parts.main) terms.m[0][0] += t.tangential_stiffness / k.a11 * rr;
  if (parts.rotational) {
    terms.m[1][0] += scale * rr;
    terms.m[0][1] += scale * rr;
  }
  if (parts.curvature)
    terms.m[0][0] += scale * k.h11 * (rho * k.normal.transpose() + k.normal * rho.transpose());
}

// @eq KS2D:58 slip with the corrected sign; d_normal = -s mu for N < 0.
void add_covariant_slip(PointTerms& terms, const Kinematics& k, const Traction& t,
                        const TangentForm& parts) {
  const Vec2 rho = k.sqrt_a11 * k.unit_tangent;
  const Tensor rr = rho * rho.transpose();
  const double scale = t.tangential.traction / (k.a11 * k.sqrt_a11);  // s mu |N| / a11^(3/2)
  if (parts.main)
    terms.m[0][0] +=
        t.tangential.d_normal * t.normal.d_traction / k.sqrt_a11 * rho * k.normal.transpose();
  if (parts.rotational) {
    terms.m[1][0] += scale * rr;
    terms.m[0][1] += scale * rr;
  }
  if (parts.curvature)
    terms.m[0][0] += scale * k.h11 * (2 * rho * k.normal.transpose() + k.normal * rho.transpose());
}

}  // namespace

PointTerms covariant_terms(const Kinematics& k, const Traction& t, ResidualForm form,
                           const TangentForm& parts) {
  PointTerms terms = zero_terms();
  set_forces(terms, k, t, levers(k, form));
  add_covariant_normal(terms, k, t, parts);
  if (t.tangential.status == Status::slip)
    add_covariant_slip(terms, k, t, parts);
  else
    add_covariant_stick(terms, k, t, parts);
  return terms;
}

PointTerms point_terms(const Kinematics& k, const Traction& t, ResidualForm form,
                       const TangentForm& tangent) {
  return tangent.consistent ? consistent_terms(k, t, form) : covariant_terms(k, t, form, tangent);
}

}  // namespace osculate::contact
