#include "osculate/contact/point_terms.hpp"

#include <cmath>

namespace osculate::contact {
namespace {

using I = Eigen::Index;

/// Row `a` of the tangent gets the derivative of the force in that slot.
template <int Dim>
void add_row(PointTerms<Dim>& terms, std::size_t a, const VectorForm<Dim>& form) {
  for (std::size_t b = 0; b < form.m.size(); ++b) terms.m[a][b] += form[b];
}
template <int Dim, std::size_t count>
void add_row(PointTerms<Dim>& terms, std::size_t a, const Vec<Dim>& vector,
             const Form<Dim, count>& form) {
  for (std::size_t b = 0; b < count; ++b) terms.m[a][b].noalias() += vector * form[b].transpose();
}

/// A form that depends on second derivatives too.
template <int Dim>
using FullForm = Form<Dim, slots<Dim>>;

template <int Dim>
FullForm<Dim> full(const Form<Dim>& form) {
  FullForm<Dim> out;
  out += form;
  return out;
}

template <int Dim>
PointTerms<Dim> zero_terms(std::size_t used) {
  PointTerms<Dim> terms;
  terms.used = used;
  for (std::size_t a = 0; a < used; ++a)
    for (std::size_t b = 0; b < used; ++b) terms.m[a][b].setZero();
  terms.s.fill(Mat<Dim, Dim>::Zero());
  return terms;
}

/// Second derivatives of the weights matter for the full residual only.
template <int Dim>
std::size_t used_slots(ResidualForm form) {
  return form == ResidualForm::full ? slots<Dim> : static_cast<std::size_t>(Dim);
}

/// Work-conjugate contravariant traction T^j = g^ij (t . rho_,i): the force on d(xi^j).
template <int Dim>
struct Conjugate {
  Vec<Dim - 1> value = Vec<Dim - 1>::Zero();
  std::array<FullForm<Dim>, directions<Dim>> variation;  ///< without the traction's own change
  std::array<Vec<Dim>, directions<Dim>> of_traction;     ///< dT^j = of_traction . dt + variation
};

// @eq KS2D:39, KSVD:33 with the exact d(xi^i): t . rho_,i d(xi^i) = T^j (rho_,j . v_0 - gap n .
// v_,j).
template <int Dim>
Vec<Dim - 1> conjugate_traction(const Kinematics<Dim>& k, const Vec<Dim>& t) {
  Vec<Dim - 1> covariant = Vec<Dim - 1>::Zero();
  for (std::size_t i = 0; i < k.moving; ++i) covariant[static_cast<I>(i)] = t.dot(k.rho1[i]);
  return k.offset_metric_inverse * covariant;
}

/// d(h_ij) = n . d(rho_,ij) + rho_,ij . d(n)
template <int Dim>
FullForm<Dim> curvature_variation(const Kinematics<Dim>& k, std::size_t i, std::size_t j) {
  FullForm<Dim> form = full(dot(k.second(i, j), k.d_normal));
  form[second_slot<Dim>(i, j)] -= k.normal;
  for (std::size_t l = 0; l < k.moving; ++l) form += k.normal.dot(k.third(i, j, l)) * k.d_xi[l];
  return form;
}

/// d(a_ij - gap h_ij)
template <int Dim>
FullForm<Dim> offset_metric_variation(const Kinematics<Dim>& k, std::size_t i, std::size_t j) {
  FullForm<Dim> form = full(dot(k.rho1[i], k.d_rho1[j]) + dot(k.rho1[j], k.d_rho1[i]));
  form += -k.curvature(static_cast<I>(i), static_cast<I>(j)) * k.d_gap;
  form += -k.gap * curvature_variation(k, i, j);
  return form;
}

template <int Dim>
Conjugate<Dim> conjugate(const Kinematics<Dim>& k, const Vec<Dim>& t) {
  Conjugate<Dim> c;
  c.of_traction.fill(Vec<Dim>::Zero());
  c.value = conjugate_traction(k, t);
  std::array<FullForm<Dim>, directions<Dim>> covariant;  // t . d(rho_,i) - d(g_il) T^l
  for (std::size_t i = 0; i < k.moving; ++i) {
    covariant[i] = full(dot(t, k.d_rho1[i]));
    for (std::size_t l = 0; l < k.moving; ++l)
      covariant[i] += -c.value[static_cast<I>(l)] * offset_metric_variation(k, i, l);
  }
  for (std::size_t j = 0; j < k.moving; ++j)
    for (std::size_t i = 0; i < k.moving; ++i) {
      const double g = k.offset_metric_inverse(static_cast<I>(j), static_cast<I>(i));
      c.variation[j] += g * covariant[i];
      c.of_traction[j] += g * k.rho1[i];
    }
  return c;
}

template <int Dim>
void set_forces(PointTerms<Dim>& terms, const Kinematics<Dim>& k, const Traction<Dim>& t,
                ResidualForm form) {
  const Vec<Dim> shear = k.frame * t.tangential.traction;
  terms.f.fill(Vec<Dim>::Zero());
  if (form == ResidualForm::surface) {
    // @eq KS2D:31 with the sign of docs/errata.md: both tractions act on the slave point.
    terms.f[0] = t.normal.traction * k.normal + shear;
    return;
  }
  terms.f[0] = t.normal.traction * k.normal;
  const Vec<Dim - 1> contravariant = conjugate_traction(k, shear);
  for (std::size_t j = 0; j < k.moving; ++j) {
    terms.f[0] += contravariant[static_cast<I>(j)] * k.rho1[j];
    terms.f[first_slot(j)] = -k.gap * contravariant[static_cast<I>(j)] * k.normal;
  }
}

/// Adds the derivatives of the forces of the full residual's shear.
template <int Dim>
void add_full_shear(PointTerms<Dim>& terms, const Kinematics<Dim>& k, const ShearRate<Dim>& shear) {
  const Conjugate<Dim> c = conjugate(k, shear.value);
  for (std::size_t j = 0; j < k.moving; ++j) {
    const double traction = c.value[static_cast<I>(j)];
    FullForm<Dim> d_traction = c.variation[j];
    d_traction += dot(c.of_traction[j], shear.variation);
    const Vec<Dim> of_trial = shear.d_predictor.transpose() * c.of_traction[j];
    add_row(terms, 0, k.rho1[j], d_traction);
    add_row(terms, 0, traction * k.d_rho1[j]);
    terms.s[0] += k.rho1[j] * of_trial.transpose();
    const std::size_t a = first_slot(j);
    add_row(terms, a, k.normal, (-k.gap) * d_traction + full((-traction) * k.d_gap));
    add_row(terms, a, (-k.gap * traction) * k.d_normal);
    terms.s[a] -= k.gap * k.normal * of_trial.transpose();
  }
}

}  // namespace

template <int Dim>
PointTerms<Dim> point_forces(const Kinematics<Dim>& k, const Traction<Dim>& t, ResidualForm form) {
  PointTerms<Dim> terms;
  terms.used = used_slots<Dim>(form);
  set_forces(terms, k, t, form);
  return terms;
}

template <int Dim>
ShearRate<Dim> shear_rate(const Kinematics<Dim>& k, const Traction<Dim>& t) {
  ShearRate<Dim> s;
  s.value = k.frame * t.tangential.traction;
  s.d_predictor = k.frame * t.tangential.d_predictor * k.frame.transpose();
  s.d_push = k.frame * t.tangential.d_normal;
  s.variation.add(s.d_predictor, t.d_predictor);
  s.variation.add(s.d_push, t.normal.d_traction * k.d_gap);
  s.variation.add(Vec<Dim>(-k.normal), dot(s.value, k.d_normal));
  return s;
}

template <int Dim>
PointTerms<Dim> consistent_terms(const Kinematics<Dim>& k, const Traction<Dim>& t,
                                 ResidualForm form) {
  PointTerms<Dim> terms = zero_terms<Dim>(used_slots<Dim>(form));
  set_forces(terms, k, t, form);

  // 1. the normal force: dN n + N d(n)
  const Form<Dim> d_normal = t.normal.d_traction * k.d_gap;
  add_row(terms, 0, k.normal, d_normal);
  add_row(terms, 0, t.normal.traction * k.d_normal);

  // 2. the shear force
  if (t.tangential.status == Status::slip || t.tangential.d_predictor(0, 0) != 0.0) {
    const ShearRate<Dim> shear = shear_rate(k, t);
    if (form == ResidualForm::full) {
      add_full_shear(terms, k, shear);
    } else {
      add_row(terms, 0, shear.variation);
      terms.s[0] = shear.d_predictor;
    }
  }

  // 3. the weights move with the foot point: dR_k += w_k^(a,l) f[a] d(xi^l)
  for (std::size_t l = 0; l < k.moving; ++l) {
    add_row(terms, first_slot(l), terms.f[0], k.d_xi[l]);
    if (form == ResidualForm::surface) continue;
    for (std::size_t j = 0; j < k.moving; ++j)
      add_row(terms, second_slot<Dim>(j, l), terms.f[first_slot(j)], k.d_xi[l]);
  }
  return terms;
}

namespace {

/// Contravariant components of the shear and of the curvature, for the covariant tangents.
template <int Dim>
struct Covariant {
  Vec<Dim - 1> lower, upper;     ///< T_i, T^i
  SurfaceMatrix<Dim> curvature;  ///< h^ij
  Covariant(const Kinematics<Dim>& k, const Traction<Dim>& t) {
    lower.setZero();
    const Vec<Dim> shear = k.frame * t.tangential.traction;
    for (std::size_t i = 0; i < k.moving; ++i) lower[static_cast<I>(i)] = shear.dot(k.rho1[i]);
    upper = k.metric_inverse * lower;
    curvature = k.metric_inverse * k.curvature * k.metric_inverse;
  }
};

// @eq KS2D:54, KSVD:55, KSVD:56, KSVD:57, KSVD:58 normal part: main, rotational and curvature part
// of N A^T n.
template <int Dim>
void add_covariant_normal(PointTerms<Dim>& terms, const Kinematics<Dim>& k, const Traction<Dim>& t,
                          const Covariant<Dim>& c, const TangentForm& parts) {
  if (parts.main) terms.m[0][0] += t.normal.d_traction * k.normal * k.normal.transpose();
  for (std::size_t i = 0; i < k.moving; ++i)
    for (std::size_t j = 0; j < k.moving; ++j) {
      const double n_a = t.normal.traction * k.metric_inverse(static_cast<I>(i), static_cast<I>(j));
      const double n_h = t.normal.traction * c.curvature(static_cast<I>(i), static_cast<I>(j));
      if (parts.rotational) {
        terms.m[first_slot(i)][0] += n_a * k.normal * k.rho1[j].transpose();
        terms.m[0][first_slot(i)] += n_a * k.rho1[j] * k.normal.transpose();
      }
      if (parts.curvature) terms.m[0][0] -= n_h * k.rho1[i] * k.rho1[j].transpose();
    }
}

/// Rotational and curvature part common to stick and slip; `more` = 1 in stick and 2 in slip.
template <int Dim>
void add_covariant_shear(PointTerms<Dim>& terms, const Kinematics<Dim>& k, const Covariant<Dim>& c,
                         double more, const TangentForm& parts) {
  Vec<Dim> shear = Vec<Dim>::Zero();  // T^l rho_,l
  for (std::size_t l = 0; l < k.moving; ++l) shear += c.upper[static_cast<I>(l)] * k.rho1[l];
  for (std::size_t j = 0; j < k.moving; ++j) {
    Vec<Dim> contravariant = Vec<Dim>::Zero(), bent = Vec<Dim>::Zero();
    for (std::size_t i = 0; i < k.moving; ++i) {
      contravariant += k.metric_inverse(static_cast<I>(i), static_cast<I>(j)) * k.rho1[i];
      bent += c.curvature(static_cast<I>(i), static_cast<I>(j)) * k.rho1[i];
    }
    if (parts.rotational) {
      terms.m[first_slot(j)][0] += shear * contravariant.transpose();
      terms.m[0][first_slot(j)] += contravariant * shear.transpose();
    }
    if (parts.curvature)
      terms.m[0][0] += c.lower[static_cast<I>(j)] *
                       (more * bent * k.normal.transpose() + k.normal * bent.transpose());
  }
}

// @eq KS2D:56 stick with the sign and the factor T/a11^2 of docs/errata.md; exactly symmetric.
template <int Dim>
void add_covariant_stick(PointTerms<Dim>& terms, const Kinematics<Dim>& k, const Traction<Dim>& t,
                         const Covariant<Dim>& c, const TangentForm& parts) {
  const Mat<Dim, Dim> plane = k.frame * k.frame.transpose();
  if (parts.main) terms.m[0][0] += t.stiffness * plane;
  add_covariant_shear(terms, k, c, 1.0, parts);
}

// @eq KS2D:58 slip with the corrected sign; d_normal = -s mu for N < 0. In 3D the main part has
// also the turning of the slip direction.
template <int Dim>
void add_covariant_slip(PointTerms<Dim>& terms, const Kinematics<Dim>& k, const Traction<Dim>& t,
                        const Covariant<Dim>& c, const TangentForm& parts) {
  const Vec<Dim> direction = k.frame * t.tangential.d_normal;
  const Mat<Dim, Dim> turning = k.frame * t.tangential.d_predictor * k.frame.transpose();
  if (parts.main)
    terms.m[0][0] += t.normal.d_traction * direction * k.normal.transpose() + t.stiffness * turning;
  add_covariant_shear(terms, k, c, 2.0, parts);
}

}  // namespace

template <int Dim>
PointTerms<Dim> covariant_terms(const Kinematics<Dim>& k, const Traction<Dim>& t, ResidualForm form,
                                const TangentForm& parts) {
  PointTerms<Dim> terms = zero_terms<Dim>(Dim);
  set_forces(terms, k, t, form);
  const Covariant<Dim> c(k, t);
  add_covariant_normal(terms, k, t, c, parts);
  if (!(t.stiffness > 0)) return terms;
  if (t.tangential.status == Status::slip)
    add_covariant_slip(terms, k, t, c, parts);
  else
    add_covariant_stick(terms, k, t, c, parts);
  return terms;
}

template PointTerms<2> point_forces<2>(const Kinematics<2>&, const Traction<2>&, ResidualForm);
template PointTerms<3> point_forces<3>(const Kinematics<3>&, const Traction<3>&, ResidualForm);
template ShearRate<2> shear_rate<2>(const Kinematics<2>&, const Traction<2>&);
template ShearRate<3> shear_rate<3>(const Kinematics<3>&, const Traction<3>&);
template PointTerms<2> consistent_terms<2>(const Kinematics<2>&, const Traction<2>&, ResidualForm);
template PointTerms<3> consistent_terms<3>(const Kinematics<3>&, const Traction<3>&, ResidualForm);
template PointTerms<2> covariant_terms<2>(const Kinematics<2>&, const Traction<2>&, ResidualForm,
                                          const TangentForm&);
template PointTerms<3> covariant_terms<3>(const Kinematics<3>&, const Traction<3>&, ResidualForm,
                                          const TangentForm&);

}  // namespace osculate::contact
