#pragma once
// A small contact pair with every branch within reach, for derivative and identity tests.
#include <Eigen/Core>
#include <random>

#include "osculate/contact/law/normal_penalty.hpp"
#include "osculate/pairing/pair.hpp"

namespace osculate::testing {

/// A pair and a configuration; `x` holds all node positions.
struct PairSample {
  pairing::PairDefinition<2> pair;
  std::vector<Vec2> x;
  pairing::PairState<2> committed;
};

inline Eigen::VectorXd flatten(const std::vector<Vec2>& x) {
  Eigen::VectorXd v(2 * static_cast<Eigen::Index>(x.size()));
  for (std::size_t n = 0; n < x.size(); ++n) v.segment<2>(2 * static_cast<Eigen::Index>(n)) = x[n];
  return v;
}

inline std::vector<Vec2> unflatten(const Eigen::VectorXd& v) {
  std::vector<Vec2> x(static_cast<std::size_t>(v.size() / 2));
  for (std::size_t n = 0; n < x.size(); ++n) x[n] = v.segment<2>(2 * static_cast<Eigen::Index>(n));
  return x;
}

/// A history by its scalars.
inline contact::PointHistory<2> remembered(bool active, Index facet, projection::Feature feature,
                                           double xi, double gap, double traction,
                                           bool slipping = false) {
  contact::PointHistory<2> h;
  h.active = active;
  h.facet = facet;
  h.feature = feature;
  h.xi[0] = xi;
  h.gap = gap;
  h.traction[0] = traction;
  h.slipping = slipping;
  return h;
}

/// Sum of the forces of all blocks over the nodes.
inline Eigen::VectorXd pair_residual(const PairSample& s, const Eigen::VectorXd& v) {
  const std::vector<Vec2> x = unflatten(v);
  pairing::PairEvaluation<2> e;
  pairing::evaluate(s.pair, x, s.committed, false, e);
  Eigen::VectorXd r = Eigen::VectorXd::Zero(v.size());
  for (const pairing::ContactBlock<2>& b : e.blocks)
    for (int k = 0; k < b.count; ++k)
      r.segment<2>(2 * b.nodes[static_cast<std::size_t>(k)]) += b.force.segment<2>(2 * k);
  return r;
}

/// Assembled dense tangent, rank-one terms included.
inline Eigen::MatrixXd pair_tangent(const PairSample& s, const Eigen::VectorXd& v) {
  const std::vector<Vec2> x = unflatten(v);
  pairing::PairEvaluation<2> e;
  pairing::evaluate(s.pair, x, s.committed, true, e);
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(v.size(), v.size());
  for (const pairing::ContactBlock<2>& b : e.blocks)
    for (int i = 0; i < 2 * b.count; ++i) {
      const Eigen::Index row = 2 * b.nodes[static_cast<std::size_t>(i / 2)] + i % 2;
      for (int j = 0; j < 2 * b.count; ++j)
        k(row, 2 * b.nodes[static_cast<std::size_t>(j / 2)] + j % 2) += b.tangent(i, j);
      for (const pairing::NodeMatrix<2>& g : b.path())
        k.block<1, 2>(row, 2 * g.node) += b.path_rows.row(i) * g.value;
      for (const pairing::NodeGradient<2>& g : b.area)
        k.block<1, 2>(row, 2 * g.node) += b.area_rows[i] * g.value.transpose();
    }
  return k;
}

inline std::vector<contact::Status> pair_status(const PairSample& s, const Eigen::VectorXd& v) {
  pairing::PairEvaluation<2> e;
  pairing::evaluate(s.pair, unflatten(v), s.committed, false, e);
  std::vector<contact::Status> status;
  for (const pairing::PointResult<2>& p : e.points) status.push_back(p.status);
  return status;
}

/// A chain of `facets` Lagrange facets with `nodes_per_facet` nodes from (0, 0) along +x, facet
/// lengths alternating 1 : 3, bent by `bend` and turned by `angle`; the slave is a short line2
/// facet whose first node lies `depth` (positive = penetration) under the facet `at`, xi = `xi`.
struct SampleOptions {
  int nodes_per_facet = 2;
  int facets = 3;
  double bend = 0.0;
  double angle = 0.3;
  int at = 1;
  double xi = 0.2;
  double depth = 0.05;
};

inline PairSample make_sample(const SampleOptions& o) {
  PairSample s;
  const int per = o.nodes_per_facet - 1;
  const auto place = [&](double t) {  // t in facets
    const int whole = std::min(static_cast<int>(t), o.facets - 1);
    double at = 0;
    for (int f = 0; f < whole; ++f) at += f % 2 == 0 ? 1.0 : 3.0;
    at += (t - whole) * (whole % 2 == 0 ? 1.0 : 3.0);
    return Vec2(at, o.bend * at * (2.0 * o.facets - at));
  };
  const double c = std::cos(o.angle), si = std::sin(o.angle);
  const auto turned = [&](const Vec2& p) {
    return Vec2(c * p.x() - si * p.y(), si * p.x() + c * p.y());
  };
  for (int i = 0; i <= o.facets * per; ++i)
    s.x.push_back(turned(place(static_cast<double>(i) / per)));
  for (int f = 0; f < o.facets; ++f) {
    std::vector<Index> nodes{f * per, (f + 1) * per};
    for (int k = 1; k < per; ++k) nodes.push_back(f * per + k);
    s.pair.master.facets.push_back(pairing::lagrange_facet(nodes));
  }
  pairing::connect(s.pair.master);
  const pairing::Facet& facet = s.pair.master.facets[static_cast<std::size_t>(o.at)];
  const auto jet = pairing::facet_jet(facet, o.xi, s.x);
  const Vec2 normal = turn(jet.r1.normalized());
  const auto first = static_cast<Index>(s.x.size());
  s.x.push_back(jet.r - o.depth * normal);
  s.x.push_back(jet.r + 2.0 * normal - 0.7 * jet.r1.normalized());  // far away: stays open
  pairing::Chain slave;
  slave.facets.push_back(pairing::lagrange_facet(std::array<Index, 2>{first, first + 1}));
  pairing::connect(slave);
  s.pair.slave = pairing::make_slave_side(slave);
  s.pair.normal = contact::NormalPenalty{1000.0};
  s.committed.points.resize(2);
  pairing::prepare(s.pair, s.x);
  return s;
}

}  // namespace osculate::testing
