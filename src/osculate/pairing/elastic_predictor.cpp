#include "osculate/pairing/elastic_predictor.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <optional>

#include "osculate/cell/shape.hpp"

namespace osculate::pairing {

using contact::Kinematics;
using contact::PointHistory;

namespace {

/// d(tau) = turn_back d(n)
Mat<2, 2> turn_back() {
  Mat<2, 2> back;
  back << 0, 1, -1, 0;
  return back;
}

/// Length of rho_xi at a place of a facet, and what its derivative needs.
struct Speed {
  cell::LineShape shape;
  double size = 0;  ///< sqrt(a11)
  Vec2 tangent;     ///< rho_xi / sqrt(a11)
  double growth;    ///< d(size) / d(xi)
};

Speed speed_at(const Facet& facet, double xi, std::span<const Vec2> x) {
  Speed s;
  s.shape = facet_shape(facet, xi);
  const geometry::CurveJet<2> jet = facet_jet(facet, s.shape, x);
  s.size = jet.r1.norm();
  s.tangent = jet.r1 / s.size;
  s.growth = s.tangent.dot(jet.r2);
  return s;
}

/// One trial in the plane: everything that the three rules share.
struct PlaneCase {
  const Chain& master;
  const PointHistory<2>& history;
  const ProjectedPoint<2>& projected;
  double stiffness;
  const ContactTimeFraction& time_fraction;
  std::span<const Vec2> x;
  PathBuffers<2>* path;

  [[nodiscard]] const Facet& facet() const {
    return master.facets[static_cast<std::size_t>(projected.projection.facet)];
  }
  [[nodiscard]] const Facet& old_facet() const {
    return master.facets[static_cast<std::size_t>(history.facet)];
  }
  [[nodiscard]] Location from() const { return {history.facet, history.xi[0]}; }
  [[nodiscard]] Location to() const {
    return {projected.projection.facet, projected.projection.xi[0]};
  }
  [[nodiscard]] double carried() const { return history.active ? history.traction[0] : 0.0; }
};

ElasticPredictor<2> by_path(const PlaneCase& c) {
  ElasticPredictor<2> out;
  const Kinematics<2>& k = c.projected.kinematics;
  if (c.path) c.path->scratch.clear();
  const std::optional<double> arc =
      path_length(c.master, c.x, c.from(), c.to(), c.path ? &c.path->scratch : nullptr);
  if (!arc) return out;
  out.known = true;
  out.slip[0] = c.time_fraction.value * *arc;
  const double value = c.carried() + c.stiffness * out.slip[0];  // @eq KS2D:89, KS2D:74
  out.value[0] = value;
  const Vec2 tau = k.frame;
  if (k.moving > 0)
    out.variation.add(Vec2(c.stiffness * c.time_fraction.value * k.rho1[0].norm() * tau),
                      k.d_xi[0]);
  out.variation.add(Vec2(c.stiffness * c.time_fraction.d_gap * *arc * tau), k.d_gap);
  out.variation.add(Mat<2, 2>(value * turn_back()), k.d_normal);
  if (!c.path) return out;
  for (const NodeGradient<2>& g : c.path->scratch)
    c.path->path.push_back(
        {g.node, c.stiffness * c.time_fraction.value * tau * g.value.transpose()});
  return out;
}

ElasticPredictor<2> by_chord(const PlaneCase& c) {
  ElasticPredictor<2> out;
  const Kinematics<2>& k = c.projected.kinematics;
  if (!path_length(c.master, c.x, c.from(), c.to(), nullptr)) return out;
  out.known = true;
  const Speed here = speed_at(c.facet(), c.projected.projection.xi[0], c.x);
  const cell::LineShape old = facet_shape(c.old_facet(), c.history.xi[0]);
  const Vec2 chord = c.projected.foot - facet_jet(c.old_facet(), old, c.x).r;
  const Vec2 tau = k.frame;
  const double along = chord.dot(tau);  // @eq KS2D:88 times sqrt(a11)
  const double penalty = c.stiffness * c.time_fraction.value;
  const double thinning = -c.carried() / (here.size * here.size);  // of T / sqrt(a11)
  out.slip[0] = c.time_fraction.value * along;
  out.value[0] = c.carried() / here.size + penalty * along;
  if (k.moving > 0)
    out.variation.add(Vec2((penalty * here.size + thinning * here.growth) * tau), k.d_xi[0]);
  out.variation.add(Vec2(c.stiffness * c.time_fraction.d_gap * along * tau), k.d_gap);
  const Mat<2, 2> turned = turn_back();
  out.variation.add(Mat<2, 2>(out.value[0] * turned + penalty * tau * chord.transpose() * turned),
                    k.d_normal);
  if (!c.path) return out;
  const Mat<2, 2> project = penalty * tau * tau.transpose(),
                  thin = thinning * tau * here.tangent.transpose();
  for (std::size_t i = 0; i < static_cast<std::size_t>(old.count); ++i)
    c.path->path.push_back({c.old_facet().nodes[i], -old.n[0][i] * project});
  for (std::size_t i = 0; i < static_cast<std::size_t>(here.shape.count); ++i)
    c.path->path.push_back(
        {c.facet().nodes[i], here.shape.n[0][i] * project + here.shape.n[1][i] * thin});
  return out;
}

ElasticPredictor<2> by_coordinate(const PlaneCase& c) {
  if (c.history.facet < 0 || c.history.facet == c.projected.projection.facet) return by_path(c);
  ElasticPredictor<2> out;
  out.known = true;
  const Kinematics<2>& k = c.projected.kinematics;
  const Speed here = speed_at(c.facet(), c.projected.projection.xi[0], c.x);
  const double step = c.projected.projection.xi[0] - c.history.xi[0];
  const double way = here.size * step;  // @eq KS2D:84, KS2D:85 with their factor a11, by sqrt(a11)
  const double penalty = c.stiffness * c.time_fraction.value;
  const Vec2 tau = k.frame;
  out.slip[0] = c.time_fraction.value * way;
  out.value[0] = c.carried() + penalty * way;
  if (k.moving > 0)
    out.variation.add(Vec2(penalty * (here.size + step * here.growth) * tau), k.d_xi[0]);
  out.variation.add(Vec2(c.stiffness * c.time_fraction.d_gap * way * tau), k.d_gap);
  out.variation.add(Mat<2, 2>(out.value[0] * turn_back()), k.d_normal);
  if (!c.path) return out;
  const Mat<2, 2> stretch = penalty * step * tau * here.tangent.transpose();
  for (std::size_t i = 0; i < static_cast<std::size_t>(here.shape.count); ++i)
    c.path->path.push_back({c.facet().nodes[i], here.shape.n[1][i] * stretch});
  return out;
}

}  // namespace

ElasticPredictor<2> elastic_predictor(const Chain& master, const PointHistory<2>& history,
                                      const ProjectedPoint<2>& projected, double stiffness,
                                      const ContactTimeFraction& time_fraction,
                                      std::span<const Vec2> x, PathBuffers<2>* path,
                                      HistoryRule rule) {
  const PlaneCase c{master, history, projected, stiffness, time_fraction, x, path};
  switch (rule) {
    case HistoryRule::continuous:
      return by_path(c);
    case HistoryRule::chord:
      return by_chord(c);
    case HistoryRule::per_facet:
      return by_coordinate(c);
  }
  return {};
}

namespace {

Mat<3, 3> cross_matrix(const Vec3& v) {
  Mat<3, 3> m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// v - (n_o + n) (n . v) / (1 + n_o . n), and its derivatives with respect to v, n_o and n.
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

/// v - n (n . v), in the same form.
Carried project(const Vec3& v, const Vec3& normal) {
  const double along = normal.dot(v);
  Carried c;
  c.value = v - along * normal;
  c.of_vector = Mat<3, 3>::Identity() - normal * normal.transpose();
  c.of_old.setZero();
  c.of_new = -normal * v.transpose() - along * Mat<3, 3>::Identity();
  return c;
}

/// The frame of a facet at one point and the derivative of E t with respect to rho_,1 and rho_,2.
struct FacetFrame {
  cell::FacetShape shape;
  geometry::SurfaceJet jet;
  Vec3 normal;
  Mat<3, 2> frame;
};

/// Of a smooth patch with the first derivatives of the shape functions, or none of these.
FacetFrame facet_frame(const FacetSurface& surface, const SurfaceFacet& facet, const Vec2& xi,
                       std::span<const Vec3> x, PatchPoints patches, bool with_shape) {
  FacetFrame f;
  if (facet.patch) {
    GregoryPoints room;
    f.jet = patch_jet(facet.type, points_of(surface, facet, x, patches, room), xi);
    if (with_shape) f.shape = facet_shape(facet, xi, 1);
  } else {
    f.shape = facet_shape(facet, xi, 2);
    f.jet = facet_jet(facet, f.shape, x);
  }
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
              const ProjectedPoint<3>& projected, const Vec2& traction, double penalty,
              const Carried& c, std::vector<NodeMatrix<3>>& path) {
  const std::array<Mat<3, 3>, 2> turning = normal_gradient(old);
  const std::array<Mat<3, 3>, 2> framing = frame_gradient(old, traction, turning);
  std::array<Mat<3, 3>, 2> of_base;
  for (std::size_t j = 0; j < 2; ++j) of_base[j] = c.of_vector * framing[j] + c.of_old * turning[j];
  const bool same = &old_facet == &facet;
  for (std::size_t k = 0; k < static_cast<std::size_t>(old_facet.count); ++k) {
    const double moved = (same ? projected.shape[0][k] : 0.0) - old.shape.n[0][k];
    path.push_back({old_facet.nodes[k], penalty * moved * c.of_vector +
                                            old.shape.n[1][k] * of_base[0] +
                                            old.shape.n[2][k] * of_base[1]});
  }
  if (same) return;
  for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k)
    path.push_back({facet.nodes[k], penalty * projected.shape[0][k] * c.of_vector});
}

}  // namespace

namespace {

/// Motion of the convective coordinates of the facet with those that follow the slave point: an
/// edge has one, along it.
Mat<2, 2> coordinate_motion(const SurfaceFacet& facet, const ProjectedPoint<3>& projected) {
  Mat<2, 2> motion = Mat<2, 2>::Identity();
  if (projected.projection.feature != projection::Feature::edge || projected.projection.local < 0)
    return motion;
  const std::array<int, 2> ends = edge_corners(facet, projected.projection.local);
  motion.col(0) =
      0.5 * (cell::area_node(facet.type, ends[1]) - cell::area_node(facet.type, ends[0]));
  return motion;
}

/// By the difference of the coordinates of two facets, for HistoryRule::per_facet.
ElasticPredictor<3> by_coordinates(const FacetSurface& master, const SurfaceFacet& facet,
                                   const PointHistory<3>& history,
                                   const ProjectedPoint<3>& projected, double stiffness,
                                   const ContactTimeFraction& time_fraction,
                                   std::span<const Vec3> x, PathBuffers<3>* path) {
  ElasticPredictor<3> out;
  out.known = true;
  const Kinematics<3>& k = projected.kinematics;
  const FacetFrame here =
      facet_frame(master, facet, projected.projection.xi, x, projected.patches, path != nullptr);
  const Vec2 step = projected.projection.xi - history.xi;
  const Vec2 traction = history.active ? history.traction : Vec2(Vec2::Zero());
  const Vec3 way = step[0] * here.jet.r1[0] + step[1] * here.jet.r1[1];
  const double penalty = stiffness * time_fraction.value;
  const Carried c = project(here.frame * traction + penalty * way, k.normal);
  out.value = k.frame.transpose() * c.value;
  out.slip = time_fraction.value * k.frame.transpose() * way;
  std::array<Mat<3, 3>, 2> of_base = frame_gradient(here, traction, normal_gradient(here));
  for (std::size_t j = 0; j < 2; ++j) {
    of_base[j] += penalty * step[static_cast<Eigen::Index>(j)] * Mat<3, 3>::Identity();
    of_base[j] = Mat<3, 3>(c.of_vector * of_base[j]);
  }
  const Mat<2, 2> motion = coordinate_motion(facet, projected);
  for (std::size_t m = 0; m < k.moving; ++m) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t l = 0; l < 2; ++l) {
      const Vec3 along = penalty * (c.of_vector * here.jet.r1[l]) + of_base[0] * here.jet.r2[l] +
                         of_base[1] * here.jet.r2[l + 1];
      sum += motion(static_cast<Eigen::Index>(l), static_cast<Eigen::Index>(m)) * along;
    }
    out.variation.add(sum, k.d_xi[m]);
  }
  out.variation.add(Vec3(stiffness * time_fraction.d_gap * c.of_vector * way), k.d_gap);
  out.variation.add(c.of_new, k.d_normal);
  if (!path) return out;
  for (std::size_t i = 0; i < static_cast<std::size_t>(facet.count); ++i)
    path->path.push_back(
        {facet.nodes[i], here.shape.n[1][i] * of_base[0] + here.shape.n[2][i] * of_base[1]});
  return out;
}

}  // namespace

ElasticPredictor<3> elastic_predictor(const FacetSurface& master, const PointHistory<3>& history,
                                      const ProjectedPoint<3>& projected, double stiffness,
                                      const ContactTimeFraction& time_fraction,
                                      std::span<const Vec3> x, PathBuffers<3>* path,
                                      HistoryRule rule) {
  ElasticPredictor<3> out;
  const Kinematics<3>& k = projected.kinematics;
  if (history.facet < 0) return out;
  const SurfaceFacet& facet = master.facets[static_cast<std::size_t>(projected.projection.facet)];
  const SurfaceFacet& old_facet = master.facets[static_cast<std::size_t>(history.facet)];
  if (facet.piece != old_facet.piece) return out;
  if (rule == HistoryRule::per_facet && &facet != &old_facet)
    return by_coordinates(master, facet, history, projected, stiffness, time_fraction, x, path);
  const FacetFrame old =
      facet_frame(master, old_facet, history.xi, x, projected.patches, path != nullptr);
  constexpr double opposite = -0.999;
  if (!(old.normal.dot(k.normal) > opposite)) return out;
  out.known = true;
  const auto brought = [&](const Vec3& v) {
    return rule == HistoryRule::chord ? project(v, k.normal) : carry(v, old.normal, k.normal);
  };
  const Vec2 traction = history.active ? history.traction : Vec2(Vec2::Zero());
  const Vec3 chord = projected.foot - old.jet.r;
  const double penalty = stiffness * time_fraction.value;
  const Carried c = brought(old.frame * traction + penalty * chord);
  out.value = k.frame.transpose() * c.value;
  out.slip = time_fraction.value * k.frame.transpose() * brought(chord).value;
  for (std::size_t j = 0; j < k.moving; ++j)
    out.variation.add(Vec3(penalty * c.of_vector * k.rho1[j]), k.d_xi[j]);
  out.variation.add(Vec3(stiffness * time_fraction.d_gap * c.of_vector * chord), k.d_gap);
  out.variation.add(c.of_new, k.d_normal);
  if (path) add_path(old_facet, old, facet, projected, traction, penalty, c, path->path);
  return out;
}

Vec<1> stored_components(const Chain& master, const ProjectedPoint<2>& projected, const Vec<1>& t,
                         std::span<const Vec2> x, HistoryRule rule) {
  if (rule != HistoryRule::chord) return t;
  const Facet& facet = master.facets[static_cast<std::size_t>(projected.projection.facet)];
  return speed_at(facet, projected.projection.xi[0], x).size * t;
}

Vec2 stored_components(const FacetSurface& master, const ProjectedPoint<3>& projected,
                       const Vec2& t, std::span<const Vec3> x, HistoryRule) {
  if (projected.projection.feature == projection::Feature::face) return t;
  const SurfaceFacet& facet = master.facets[static_cast<std::size_t>(projected.projection.facet)];
  const FacetFrame f =
      facet_frame(master, facet, projected.projection.xi, x, projected.patches, false);
  const Kinematics<3>& k = projected.kinematics;
  if (!(f.normal.dot(k.normal) > -0.999)) return Vec2::Zero();
  return f.frame.transpose() * carry(Vec3(k.frame * t), k.normal, f.normal).value;
}

Mat<2, 1> stored_frame(const Chain& master, Index facet, const Vec<1>& xi,
                       std::span<const Vec2> x) {
  return facet_jet(master.facets[static_cast<std::size_t>(facet)], xi[0], x).r1.normalized();
}

Mat<3, 2> stored_frame(const FacetSurface& master, Index facet, const Vec2& xi,
                       std::span<const Vec3> x) {
  const SurfaceFacet& of = master.facets[static_cast<std::size_t>(facet)];
  return facet_frame(master, of, xi, x, {}, false).frame;
}

}  // namespace osculate::pairing
