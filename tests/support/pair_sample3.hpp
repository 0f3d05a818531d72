#pragma once
// A small contact pair in space with every branch within reach.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <random>
#include <string>

#include "osculate/cell/shape.hpp"
#include "osculate/contact/law/normal_penalty.hpp"
#include "osculate/pairing/pair.hpp"

namespace osculate::testing {

struct PairSample3 {
  pairing::PairDefinition<3> pair;
  std::vector<Vec3> x;
  pairing::PairState<3> committed;
};

inline Eigen::VectorXd flatten3(const std::vector<Vec3>& x) {
  Eigen::VectorXd v(3 * static_cast<Eigen::Index>(x.size()));
  for (std::size_t n = 0; n < x.size(); ++n) v.segment<3>(3 * static_cast<Eigen::Index>(n)) = x[n];
  return v;
}

inline std::vector<Vec3> unflatten3(const Eigen::VectorXd& v) {
  std::vector<Vec3> x(static_cast<std::size_t>(v.size() / 3));
  for (std::size_t n = 0; n < x.size(); ++n) x[n] = v.segment<3>(3 * static_cast<Eigen::Index>(n));
  return x;
}

inline Eigen::VectorXd pair_residual(const PairSample3& s, const Eigen::VectorXd& v) {
  pairing::PairEvaluation<3> e;
  pairing::evaluate(s.pair, unflatten3(v), s.committed, false, e);
  Eigen::VectorXd r = Eigen::VectorXd::Zero(v.size());
  for (const pairing::ContactBlock<3>& b : e.blocks)
    for (int k = 0; k < b.count; ++k)
      r.segment<3>(3 * b.nodes[static_cast<std::size_t>(k)]) += b.force.segment<3>(3 * k);
  return r;
}

inline Eigen::MatrixXd pair_tangent(const PairSample3& s, const Eigen::VectorXd& v) {
  pairing::PairEvaluation<3> e;
  pairing::evaluate(s.pair, unflatten3(v), s.committed, true, e);
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(v.size(), v.size());
  for (const pairing::ContactBlock<3>& b : e.blocks)
    for (int i = 0; i < 3 * b.count; ++i) {
      const Eigen::Index row = 3 * b.nodes[static_cast<std::size_t>(i / 3)] + i % 3;
      for (int j = 0; j < 3 * b.count; ++j)
        k(row, 3 * b.nodes[static_cast<std::size_t>(j / 3)] + j % 3) += b.tangent(i, j);
      for (const pairing::NodeMatrix<3>& g : b.path())
        k.block<1, 3>(row, 3 * g.node) += b.path_rows.row(i) * g.value;
      for (const pairing::NodeGradient<3>& g : b.area)
        k.block<1, 3>(row, 3 * g.node) += b.area_rows[i] * g.value.transpose();
    }
  return k;
}

struct Facts3 {
  contact::Status status;
  projection::Feature feature;
  Index facet;
  bool operator==(const Facts3&) const = default;
};

inline Facts3 pair_facts(const PairSample3& s, const Eigen::VectorXd& v) {
  pairing::PairEvaluation<3> e;
  pairing::evaluate(s.pair, unflatten3(v), s.committed, false, e);
  return {e.points[0].status, e.points[0].history.feature, e.points[0].history.facet};
}

/// A strip of facets from x = 0 along +x, lengths 1 : 3 : 1 (two triangles each for triangles),
/// width 2, pushed out of the plane by `height`. Slave: one quad4 facet whose first node lies
/// `depth` under the place `at`, `xi`.
struct SampleOptions3 {
  cell::CellType type = cell::CellType::quad4;
  double bend = 0.0;  ///< curvature and warp of the surface
  Index at = 1;
  Vec2 xi{0.2, -0.3};
  double depth = 0.05;
  double kink = 0.0;  ///< slope that starts at x = 4
};

inline double sample_height(const SampleOptions3& o, double x, double y) {
  return o.bend * (x * (5 - x) + 0.7 * x * y + 0.5 * y * y) + (x > 4 ? o.kink * (x - 4) : 0.0);
}

inline Index sample_node(PairSample3& s, const SampleOptions3& o, double x, double y) {
  for (std::size_t n = 0; n < s.x.size(); ++n)
    if (std::abs(s.x[n].x() - x) + std::abs(s.x[n].y() - y) < 1e-9) return static_cast<Index>(n);
  s.x.emplace_back(x, y, sample_height(o, x, y));
  return static_cast<Index>(s.x.size()) - 1;
}

/// Adds a facet over the parallelogram (or triangle) origin + xi edge_1 + eta edge_2.
inline void add_sample_facet(PairSample3& s, const SampleOptions3& o, const Vec2& origin,
                             const Vec2& first, const Vec2& second) {
  std::vector<Index> nodes;
  for (int k = 0; k < cell::info(o.type).nodes; ++k) {
    Vec2 xi = cell::area_node(o.type, k);
    if (!cell::is_triangle(o.type)) xi = 0.5 * (xi + Vec2::Ones());
    const Vec2 p = origin + xi.x() * first + xi.y() * second;
    nodes.push_back(sample_node(s, o, p.x(), p.y()));
  }
  s.pair.master.facets.push_back(pairing::surface_facet(o.type, nodes));
}

inline PairSample3 make_sample3(const SampleOptions3& o) {
  PairSample3 s;
  const std::array<double, 4> borders{0, 1, 4, 5};
  for (std::size_t i = 0; i < 3; ++i) {
    const double length = borders[i + 1] - borders[i];
    const Vec2 low(borders[i], -1), along(length, 0), up(0, 2);
    add_sample_facet(s, o, low, along, up);
    if (cell::is_triangle(o.type))
      add_sample_facet(s, o, Vec2(low + along + up), Vec2(-along), Vec2(-up));
  }
  pairing::connect(s.pair.master);
  const pairing::SurfaceFacet& facet = s.pair.master.facets[static_cast<std::size_t>(o.at)];
  const geometry::SurfaceJet jet = pairing::facet_jet(facet, o.xi, s.x);
  const Vec3 n = pairing::facet_normal(facet, o.xi, s.x);
  const auto first = static_cast<Index>(s.x.size());
  s.x.push_back(jet.r - o.depth * n);
  s.x.push_back(jet.r + Vec3(0, 0.4, 2));
  s.x.push_back(jet.r + Vec3(0.5, 0.5, 2.1));
  s.x.push_back(jet.r + Vec3(0.4, 0, 2));
  pairing::FacetSurface slave;
  slave.facets.push_back(pairing::surface_facet(
      cell::CellType::quad4, std::array<Index, 4>{first, first + 1, first + 2, first + 3}));
  pairing::connect(slave);
  s.pair.slave = pairing::make_slave_side(slave);
  s.pair.normal = contact::NormalPenalty{1000.0};
  s.committed.points.resize(4);
  pairing::prepare(s.pair, s.x);
  return s;
}

inline contact::PointHistory<3> remembered(Index facet, const Vec2& xi, double gap,
                                           const Vec2& traction, bool active = true) {
  contact::PointHistory<3> h;
  h.active = active;
  h.facet = facet;
  h.feature = projection::Feature::face;
  h.xi = xi;
  h.gap = gap;
  h.traction = traction;
  return h;
}

}  // namespace osculate::testing
