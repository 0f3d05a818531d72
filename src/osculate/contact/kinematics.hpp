#pragma once
#include <array>

#include "osculate/core/types.hpp"
#include "osculate/geometry/curve_jet.hpp"
#include "osculate/geometry/surface_jet.hpp"
#include "osculate/projection/feature.hpp"

namespace osculate::contact {

/// Number of convective coordinates of a face in `Dim` dimensions.
template <int Dim>
inline constexpr std::size_t directions = Dim - 1;

/// The contact weights w_k (slave shape values, then minus the master shape values) come with
/// their derivatives with respect to the convective coordinates. A *slot* names one of them:
/// 0 the weights themselves; then the first derivatives w_,i; then the second ones w_,ij.
template <int Dim>
inline constexpr std::size_t slots = Dim == 2 ? 3 : 6;
[[nodiscard]] constexpr std::size_t first_slot(std::size_t i) { return 1 + i; }
template <int Dim>
[[nodiscard]] constexpr std::size_t second_slot(std::size_t i, std::size_t j) {
  return Dim == 2 ? 2 : 3 + i + j;
}

/// A linear form in the relative variations  v_s = sum_k w^(s)_k du_k  of a contact point:
/// value = sum_s form[s] . v_s . So v_0 = du_slave - du_master and v_,i = -d(rho_,i) at fixed xi.
/// `count`: slots that it depends on; of first derivatives at most, where nothing else is said.
template <int Dim, std::size_t count = std::size_t{Dim}>
struct Form {
  std::array<Vec<Dim>, count> v;
  Form() { v.fill(Vec<Dim>::Zero()); }

  Vec<Dim>& operator[](std::size_t s) { return v[s]; }
  const Vec<Dim>& operator[](std::size_t s) const { return v[s]; }
  template <std::size_t fewer>
  Form& operator+=(const Form<Dim, fewer>& o) {
    static_assert(fewer <= count);
    for (std::size_t s = 0; s < fewer; ++s) v[s] += o.v[s];
    return *this;
  }
  friend Form operator+(Form a, const Form& b) { return a += b; }
  friend Form operator*(double factor, Form a) {
    for (Vec<Dim>& part : a.v) part *= factor;
    return a;
  }
};

/// The same with values in space: value = sum_s form[s] v_s.
template <int Dim>
struct VectorForm {
  std::array<Mat<Dim, Dim>, Dim> m;
  VectorForm() { m.fill(Mat<Dim, Dim>::Zero()); }

  Mat<Dim, Dim>& operator[](std::size_t s) { return m[s]; }
  const Mat<Dim, Dim>& operator[](std::size_t s) const { return m[s]; }
  VectorForm& operator+=(const VectorForm& o) {
    for (std::size_t s = 0; s < m.size(); ++s) m[s] += o.m[s];
    return *this;
  }
  /// Adds vector * form.
  void add(const Vec<Dim>& vector, const Form<Dim>& form) {
    for (std::size_t s = 0; s < m.size(); ++s) m[s].noalias() += vector * form[s].transpose();
  }
  /// Adds matrix * form.
  void add(const Mat<Dim, Dim>& matrix, const VectorForm& form) {
    for (std::size_t s = 0; s < m.size(); ++s) m[s].noalias() += matrix * form[s];
  }
  friend VectorForm operator*(double factor, VectorForm a) {
    for (Mat<Dim, Dim>& part : a.m) part *= factor;
    return a;
  }
};

/// vector . form
template <int Dim>
[[nodiscard]] Form<Dim> dot(const Vec<Dim>& vector, const VectorForm<Dim>& form) {
  Form<Dim> out;
  for (std::size_t s = 0; s < out.v.size(); ++s) out[s].noalias() = form[s].transpose() * vector;
  return out;
}

template <int Dim>
using SurfaceMatrix = Mat<Dim - 1, Dim - 1>;

/// Everything the contact terms need to know of one slave point and its foot point, which lies
/// inside a face (as many convective coordinates as the face has: `moving` = Dim - 1), on an edge
/// between faces (3D: one) or at a corner (none).
///
/// Formula    gap = (r_s - rho) . n ,  g_ij = a_ij - gap h_ij ,  h_ij = rho_,ij . n ;
///            d(xi^i) = g^ij (rho_,j . v_0 - gap n . v_,j) ,  d(gap) = n . v_0 ,
///            d(n) = -a^ij rho_,i (n . d(rho_,j)) + (I - n n - a^ij rho_,i rho_,j) v_0 / gap
///            (the last part is zero on faces)
/// Source     KS2D:27, KS2D:28, KS2D:45 and KSVD:23, in their exact forms
/// Sign       gap < 0 is penetration; n points out of the master (2D: k x rho_xi; 3D: rho_,1 x
///            rho_,2; edges and corners: along the line to the slave point)
/// Frame      current configuration
/// Tested by  tests/unit/contact/test_kinematics.cpp
template <int Dim>
struct Kinematics {
  projection::Feature feature = projection::Feature::none;
  std::size_t moving = 0;  ///< convective coordinates that follow the slave point
  double gap = 0;
  Vec<Dim> normal = Vec<Dim>::UnitY();
  Mat<Dim, Dim - 1> frame;                      ///< orthonormal, perpendicular to the normal
  std::array<Vec<Dim>, directions<Dim>> rho1;   ///< rho_,i
  std::array<Vec<Dim>, Dim == 2 ? 1 : 3> rho2;  ///< rho_,ij
  std::array<Vec<Dim>, Dim == 2 ? 1 : 4> rho3;  ///< rho_,ijk
  SurfaceMatrix<Dim> metric, metric_inverse;    ///< a_ij, a^ij (zero beyond `moving`)
  SurfaceMatrix<Dim> curvature;                 ///< h_ij
  SurfaceMatrix<Dim> offset_metric, offset_metric_inverse;  ///< g_ij, g^ij; positive where the foot
                                                            ///< is a strict minimum of the distance
  std::array<Form<Dim>, directions<Dim>> d_xi;              ///< zero beyond `moving`
  std::array<VectorForm<Dim>, directions<Dim>> d_rho1;      ///< of the moving base vectors
  Form<Dim> d_gap;
  VectorForm<Dim> d_normal;

  Kinematics();
  [[nodiscard]] const Vec<Dim>& second(std::size_t i, std::size_t j) const {
    return rho2[Dim == 2 ? 0 : i + j];
  }
  [[nodiscard]] const Vec<Dim>& third(std::size_t i, std::size_t j, std::size_t l) const {
    return rho3[Dim == 2 ? 0 : i + j + l];
  }
};

/// Smallest of 1 - gap k over the principal curvatures k of a face at the foot point; on an edge
/// 1 - gap k cos(phi), with phi between the curve's principal normal and the contact normal; 1 at a
/// corner. Positive where the foot is a strict minimum of the distance.
///
/// Source     the conditions of projection/local_domain.hpp for a contact point (KSCPP:20, 41, 42)
/// Tested by  tests/unit/contact/test_projection_domain.cpp
template <int Dim>
[[nodiscard]] double domain_margin(const Kinematics<Dim>& k);

/// Whether the slave point lies in the projection domain of its foot, by more than round-off: at a
/// centre of curvature every direction is as near and no normal is right.
template <int Dim>
[[nodiscard]] bool inside_domain(const Kinematics<Dim>& k) {
  constexpr double round_off = 1e-9;
  return domain_margin(k) > round_off;
}

/// Kinematics at a foot point inside a facet: closest point condition satisfied by `jet`. Not
/// `varied`: its forms are left zero, for who asks for no derivatives.
[[nodiscard]] Kinematics<2> face_kinematics(const geometry::CurveJet<2>& jet, const Vec2& slave);
[[nodiscard]] Kinematics<3> face_kinematics(const geometry::SurfaceJet& jet, const Vec3& slave,
                                            bool varied = true);

/// Kinematics at a foot point inside an edge between faces. `outward` (the averaged normal of the
/// faces) fixes the sign of the gap and is the normal when the slave point lies on the edge.
[[nodiscard]] Kinematics<3> edge_kinematics(const geometry::CurveJet<3>& jet, const Vec3& slave,
                                            const Vec3& outward);

/// Kinematics at a vertex of the master where no neighbouring facet or edge holds the projection.
template <int Dim>
[[nodiscard]] Kinematics<Dim> corner_kinematics(const Vec<Dim>& vertex, const Vec<Dim>& slave,
                                                const Vec<Dim>& outward);

/// Unit vectors perpendicular to the unit vector `normal`, the first one along the part of `along`
/// that is (3D; `along` may be parallel to the normal). 2D: the direction of travel.
template <int Dim>
[[nodiscard]] Mat<Dim, Dim - 1> tangent_frame(const Vec<Dim>& normal, const Vec<Dim>& along);

}  // namespace osculate::contact
