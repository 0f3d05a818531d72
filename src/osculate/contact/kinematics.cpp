#include "osculate/contact/kinematics.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "osculate/projection/surface_distance.hpp"

namespace osculate::contact {

template <int Dim>
Kinematics<Dim>::Kinematics() {
  frame = tangent_frame<Dim>(normal, Vec<Dim>::UnitX());
  rho1.fill(Vec<Dim>::Zero());
  rho2.fill(Vec<Dim>::Zero());
  rho3.fill(Vec<Dim>::Zero());
  metric.setZero();
  metric_inverse.setZero();
  curvature.setZero();
  offset_metric.setZero();
  offset_metric_inverse.setZero();
}

template <int Dim>
Mat<Dim, Dim - 1> tangent_frame(const Vec<Dim>& normal, const Vec<Dim>& along) {
  Mat<Dim, Dim - 1> frame;
  if constexpr (Dim == 2) {
    (void)along;
    frame = -turn(normal);
  } else {
    Vec3 first = along - normal * normal.dot(along);
    if (!(first.norm() > 1e-8 * along.norm())) first = normal.unitOrthogonal();
    frame.col(0) = first.normalized();
    frame.col(1) = normal.cross(frame.col(0));
  }
  return frame;
}

namespace {

// @eq KS2D:27 exact for every gap: the rate of penetration is the relative velocity along n.
template <int Dim>
Form<Dim> gap_variation(const Vec<Dim>& normal) {
  Form<Dim> form;
  form[0] = normal;
  return form;
}

// @eq KS2D:28, KSVD:23 in its exact form: the one printed first holds only for zero gap.
template <int Dim>
Form<Dim> convective_variation(const Kinematics<Dim>& k, std::size_t i) {
  Form<Dim> form;
  for (std::size_t j = 0; j < k.moving; ++j) {
    const double g =
        k.offset_metric_inverse(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    form[0] += g * k.rho1[j];
    form[first_slot(j)] += -k.gap * g * k.normal;
  }
  return form;
}

/// d(rho_,i) = -v_,i + rho_,ij d(xi^j)
template <int Dim>
VectorForm<Dim> base_variation(const Kinematics<Dim>& k, std::size_t i) {
  VectorForm<Dim> form;
  form[first_slot(i)] = -Mat<Dim, Dim>::Identity();
  for (std::size_t j = 0; j < k.moving; ++j) form.add(k.second(i, j), k.d_xi[j]);
  return form;
}

// @eq KS2D:45 rotation of the normal, the convective part included.
template <int Dim>
VectorForm<Dim> normal_variation(const Kinematics<Dim>& k) {
  VectorForm<Dim> form;
  for (std::size_t j = 0; j < k.moving; ++j) {
    Vec<Dim> contravariant = Vec<Dim>::Zero();
    for (std::size_t i = 0; i < k.moving; ++i)
      contravariant +=
          k.metric_inverse(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * k.rho1[i];
    form.add(Vec<Dim>(-contravariant), dot(k.normal, k.d_rho1[j]));
  }
  return form;
}

/// Directions the foot point cannot follow: there the normal turns with the slave point.
template <int Dim>
void add_fixed_directions(Kinematics<Dim>& k) {
  if (k.moving == directions<Dim>) return;
  Mat<Dim, Dim> fixed = Mat<Dim, Dim>::Identity() - k.normal * k.normal.transpose();
  for (std::size_t i = 0; i < k.moving; ++i)
    fixed -= k.rho1[i] * k.rho1[i].transpose() / k.rho1[i].squaredNorm();
  k.d_normal[0] += fixed / k.gap;
}

/// Fills what follows from the base vectors, the normal and the gap; the forms only if `varied`.
template <int Dim>
void complete(Kinematics<Dim>& k, bool varied = true) {
  using I = Eigen::Index;
  for (std::size_t i = 0; i < k.moving; ++i)
    for (std::size_t j = 0; j < k.moving; ++j) {
      k.metric(static_cast<I>(i), static_cast<I>(j)) = k.rho1[i].dot(k.rho1[j]);
      k.curvature(static_cast<I>(i), static_cast<I>(j)) = k.second(i, j).dot(k.normal);
    }
  k.offset_metric = k.metric - k.gap * k.curvature;
  if (k.moving == directions<Dim>) {
    k.metric_inverse = k.metric.inverse();
    k.offset_metric_inverse = k.offset_metric.inverse();
  } else if (k.moving == 1) {
    k.metric_inverse(0, 0) = 1 / k.metric(0, 0);
    k.offset_metric_inverse(0, 0) = 1 / k.offset_metric(0, 0);
  }
  k.frame = tangent_frame<Dim>(k.normal, k.moving > 0 ? k.rho1[0] : Vec<Dim>(Vec<Dim>::UnitX()));
  if (!varied) return;
  for (std::size_t i = 0; i < k.moving; ++i) k.d_xi[i] = convective_variation(k, i);
  for (std::size_t i = 0; i < k.moving; ++i) k.d_rho1[i] = base_variation(k, i);
  k.d_gap = gap_variation<Dim>(k.normal);
  k.d_normal = normal_variation(k);
  add_fixed_directions(k);
}

constexpr double coincident = 1e-150;  // keeps d(normal) finite where the points coincide

/// Sets the normal towards (or away from) the slave point and the gap along it.
template <int Dim>
void point_at_slave(Kinematics<Dim>& k, const Vec<Dim>& offset, const Vec<Dim>& outward) {
  const double distance = offset.norm();
  const double sign = offset.dot(outward) > 0 ? 1.0 : -1.0;
  k.normal = distance > coincident ? Vec<Dim>(sign / distance * offset) : outward;
  k.gap = sign * std::max(distance, coincident);
}

}  // namespace

Kinematics<2> face_kinematics(const geometry::CurveJet<2>& jet, const Vec2& slave) {
  Kinematics<2> k;
  k.feature = projection::Feature::face;
  k.moving = 1;
  k.rho1 = {jet.r1};
  k.rho2 = {jet.r2};
  k.rho3 = {jet.r3};
  k.normal = turn(jet.r1) / jet.r1.norm();
  k.gap = (slave - jet.r).dot(k.normal);
  complete(k);
  return k;
}

Kinematics<3> face_kinematics(const geometry::SurfaceJet& jet, const Vec3& slave, bool varied) {
  Kinematics<3> k;
  k.feature = projection::Feature::face;
  k.moving = 2;
  k.rho1 = jet.r1;
  k.rho2 = jet.r2;
  k.rho3 = jet.r3;
  k.normal = jet.r1[0].cross(jet.r1[1]).normalized();
  k.gap = (slave - jet.r).dot(k.normal);
  complete(k, varied);
  return k;
}

Kinematics<3> edge_kinematics(const geometry::CurveJet<3>& jet, const Vec3& slave,
                              const Vec3& outward) {
  Kinematics<3> k;
  k.feature = projection::Feature::edge;
  k.moving = 1;
  k.rho1[0] = jet.r1;
  k.rho2[0] = jet.r2;
  k.rho3[0] = jet.r3;
  const Vec3 along = jet.r1.normalized();
  const Vec3 offset = slave - jet.r;
  const Vec3 across = outward - along * along.dot(outward);
  point_at_slave<3>(k, offset - along * along.dot(offset), across.normalized());
  complete(k);
  return k;
}

template <int Dim>
Kinematics<Dim> corner_kinematics(const Vec<Dim>& vertex, const Vec<Dim>& slave,
                                  const Vec<Dim>& outward) {
  Kinematics<Dim> k;
  k.feature = projection::Feature::corner;
  point_at_slave<Dim>(k, slave - vertex, outward);
  complete(k);
  return k;
}

template <int Dim>
double domain_margin(const Kinematics<Dim>& k) {
  if (k.moving == 0) return 1;
  if (Dim == 2 || k.moving == 1) {
    const double along = k.metric_inverse(0, 0) * k.offset_metric(0, 0);
    return along;
  }
  if constexpr (Dim == 3) return projection::least_ratio(k.offset_metric, k.metric);
  return 1;
}

template double domain_margin<2>(const Kinematics<2>&);
template double domain_margin<3>(const Kinematics<3>&);
template struct Kinematics<2>;
template struct Kinematics<3>;
template Mat<2, 1> tangent_frame<2>(const Vec2&, const Vec2&);
template Mat<3, 2> tangent_frame<3>(const Vec3&, const Vec3&);
template Kinematics<2> corner_kinematics<2>(const Vec2&, const Vec2&, const Vec2&);
template Kinematics<3> corner_kinematics<3>(const Vec3&, const Vec3&, const Vec3&);

}  // namespace osculate::contact
