#include "osculate/pairing/trial.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <optional>

namespace osculate::pairing {

using contact::Kinematics;
using contact::PointHistory;

Trial<2> trial(const Chain& master, const PointHistory<2>& history, const Placed<2>& placed,
               double stiffness, const ContactShare& share, std::span<const Vec2> x,
               PathBuffers<2>* path) {
  Trial<2> out;
  const Kinematics<2>& k = placed.kinematics;
  if (path) path->scratch.clear();
  const Location from{history.facet, history.xi[0]};
  const Location to{placed.projection.facet, placed.projection.xi[0]};
  const std::optional<double> arc =
      path_length(master, x, from, to, path ? &path->scratch : nullptr);
  if (!arc) return out;
  out.known = true;
  const double carried = history.active ? history.traction[0] : 0.0;
  out.slip[0] = share.value * *arc;
  const double value = carried + stiffness * out.slip[0];  // @eq KS2D:89, KS2D:74
  out.value[0] = value;
  const Vec2 tau = k.frame;
  if (k.moving > 0)
    out.variation.add(Vec2(stiffness * share.value * k.rho1[0].norm() * tau), k.d_xi[0]);
  out.variation.add(Vec2(stiffness * share.d_gap * *arc * tau), k.d_gap);
  Mat<2, 2> back;  // tau = -turn(n)
  back << 0, 1, -1, 0;
  out.variation.add(Mat<2, 2>(value * back), k.d_normal);
  if (!path) return out;
  for (const NodeGradient<2>& g : path->scratch)
    path->path.push_back({g.node, stiffness * share.value * tau * g.value.transpose()});
  return out;
}

namespace {

Mat<3, 3> cross_matrix(const Vec3& v) {
  Mat<3, 3> m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// v - (n_o + n) (n . v) / (1 + n_o . n) and its derivatives with respect to v, n_o and n.
struct Carried {
  Vec3 value;
  Mat<3, 3> of_vector, of_old, of_new;
};

Carried carry(const Vec3& v, const Vec3& old_normal, const Vec3& normal) {
  const double scale = 1 / (1 + old_normal.dot(normal));
  const Vec3 w = scale * (old_normal + normal);
  const double along = normal.dot(v);
  const Mat<3, 3> unit = Mat<3, 3>::Identity();
  Carried c;
  c.value = v - along * w;
  c.of_vector = unit - w * normal.transpose();
  c.of_old = -along * scale * (unit - w * normal.transpose());
  c.of_new = -w * v.transpose() - along * scale * (unit - w * old_normal.transpose());
  return c;
}

/// The frame of a facet at one point and the derivative of E t with respect to rho_,1 and rho_,2.
struct FacetFrame {
  cell::FacetShape shape;
  geometry::SurfaceJet jet;
  Vec3 normal;
  Mat<3, 2> frame;
};

FacetFrame facet_frame(const SurfaceFacet& facet, const Vec2& xi, std::span<const Vec3> x) {
  FacetFrame f;
  f.shape = facet_shape(facet, xi);
  f.jet = facet_jet(facet, f.shape, x);
  f.normal = f.jet.r1[0].cross(f.jet.r1[1]).normalized();
  f.frame = contact::tangent_frame<3>(f.normal, f.jet.r1[0]);
  return f;
}

/// dn = sum_j turn[j] d(rho_,j) at a point that stays on its material.
std::array<Mat<3, 3>, 2> normal_gradient(const FacetFrame& f) {
  Mat<2, 2> metric;
  metric << f.jet.r1[0].squaredNorm(), f.jet.r1[0].dot(f.jet.r1[1]), f.jet.r1[0].dot(f.jet.r1[1]),
      f.jet.r1[1].squaredNorm();
  const Mat<2, 2> inverse = metric.inverse();
  std::array<Mat<3, 3>, 2> turning;
  for (std::size_t j = 0; j < 2; ++j) {
    const auto c = static_cast<Eigen::Index>(j);
    const Vec3 contravariant = inverse(0, c) * f.jet.r1[0] + inverse(1, c) * f.jet.r1[1];
    turning[j] = -contravariant * f.normal.transpose();
  }
  return turning;
}

/// d(E t) = sum_j result[j] d(rho_,j), E = (rho_,1 / |rho_,1|, n x rho_,1 / |rho_,1|).
std::array<Mat<3, 3>, 2> frame_gradient(const FacetFrame& f, const Vec2& t,
                                        const std::array<Mat<3, 3>, 2>& turning) {
  const Vec3 e1 = f.frame.col(0);
  const Mat<3, 3> of_first = (Mat<3, 3>::Identity() - e1 * e1.transpose()) / f.jet.r1[0].norm();
  std::array<Mat<3, 3>, 2> out;
  for (std::size_t j = 0; j < 2; ++j) out[j] = -t[1] * cross_matrix(e1) * turning[j];
  out[0] += t[0] * of_first + t[1] * cross_matrix(f.normal) * of_first;
  return out;
}

/// Derivative of the trial by the nodes of the old facet and, at fixed coordinates, of the present
/// one.
void add_path(const SurfaceFacet& old_facet, const FacetFrame& old, const SurfaceFacet& facet,
              const Placed<3>& placed, const Vec2& traction, double penalty, const Carried& c,
              std::vector<NodeMatrix<3>>& path) {
  const std::array<Mat<3, 3>, 2> turning = normal_gradient(old);
  const std::array<Mat<3, 3>, 2> framing = frame_gradient(old, traction, turning);
  std::array<Mat<3, 3>, 2> of_base;
  for (std::size_t j = 0; j < 2; ++j) of_base[j] = c.of_vector * framing[j] + c.of_old * turning[j];
  const bool same = &old_facet == &facet;
  for (std::size_t k = 0; k < static_cast<std::size_t>(old_facet.count); ++k) {
    const double moved = (same ? placed.shape[0][k] : 0.0) - old.shape.n[0][k];
    path.push_back({old_facet.nodes[k], penalty * moved * c.of_vector +
                                            old.shape.n[1][k] * of_base[0] +
                                            old.shape.n[2][k] * of_base[1]});
  }
  if (same) return;
  for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k)
    path.push_back({facet.nodes[k], penalty * placed.shape[0][k] * c.of_vector});
}

}  // namespace

Trial<3> trial(const FacetSurface& master, const PointHistory<3>& history, const Placed<3>& placed,
               double stiffness, const ContactShare& share, std::span<const Vec3> x,
               PathBuffers<3>* path) {
  Trial<3> out;
  const Kinematics<3>& k = placed.kinematics;
  if (history.facet < 0) return out;
  const SurfaceFacet& facet = master.facets[static_cast<std::size_t>(placed.projection.facet)];
  const SurfaceFacet& old_facet = master.facets[static_cast<std::size_t>(history.facet)];
  if (facet.piece != old_facet.piece) return out;
  const FacetFrame old = facet_frame(old_facet, history.xi, x);
  constexpr double opposite = -0.999;
  if (!(old.normal.dot(k.normal) > opposite)) return out;
  out.known = true;
  const Vec2 traction = history.active ? history.traction : Vec2(Vec2::Zero());
  const Vec3 chord = placed.foot - old.jet.r;
  const double penalty = stiffness * share.value;
  const Vec3 q = old.frame * traction + penalty * chord;
  const Carried c = carry(q, old.normal, k.normal);
  out.value = k.frame.transpose() * c.value;
  out.slip = share.value * k.frame.transpose() * carry(chord, old.normal, k.normal).value;
  for (std::size_t j = 0; j < k.moving; ++j)
    out.variation.add(Vec3(penalty * c.of_vector * k.rho1[j]), k.d_xi[j]);
  out.variation.add(Vec3(stiffness * share.d_gap * c.of_vector * chord), k.d_gap);
  out.variation.add(c.of_new, k.d_normal);
  if (path) add_path(old_facet, old, facet, placed, traction, penalty, c, path->path);
  return out;
}

Vec<1> stored_components(const Chain&, const Placed<2>&, const Vec<1>& t, std::span<const Vec2>) {
  return t;
}

Vec2 stored_components(const FacetSurface& master, const Placed<3>& placed, const Vec2& t,
                       std::span<const Vec3> x) {
  if (placed.projection.feature == projection::Feature::face) return t;
  const SurfaceFacet& facet = master.facets[static_cast<std::size_t>(placed.projection.facet)];
  const FacetFrame f = facet_frame(facet, placed.projection.xi, x);
  const Kinematics<3>& k = placed.kinematics;
  if (!(f.normal.dot(k.normal) > -0.999)) return Vec2::Zero();
  return f.frame.transpose() * carry(Vec3(k.frame * t), k.normal, f.normal).value;
}

Mat<2, 1> stored_frame(const Chain& master, Index facet, const Vec<1>& xi,
                       std::span<const Vec2> x) {
  return facet_jet(master.facets[static_cast<std::size_t>(facet)], xi[0], x).r1.normalized();
}

Mat<3, 2> stored_frame(const FacetSurface& master, Index facet, const Vec2& xi,
                       std::span<const Vec3> x) {
  return facet_frame(master.facets[static_cast<std::size_t>(facet)], xi, x).frame;
}

}  // namespace osculate::pairing
