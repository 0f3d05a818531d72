#pragma once
// Pairs whose slave is sampled at points of its facets, which lie in the master over borders.
#include "osculate/pairing/sampling.hpp"
#include "pair_sample.hpp"

namespace osculate::testing {

struct SegmentOptions {
  int slave_nodes = 2;  ///< per facet
  double bend = 0;      ///< of the master
  double depth = 0.05;
  pairing::Sampling sampling{pairing::Sampling::Rule::gauss, 2, 1};
};

/// The master of `make_sample` with 3 facets; the slave has two facets over all of them.
inline PairSample segment_sample(const SegmentOptions& o) {
  PairSample s = make_sample({.nodes_per_facet = o.bend != 0 ? 3 : 2, .bend = o.bend});
  const auto first = static_cast<Index>(s.x.size());
  const int per = o.slave_nodes - 1, count = 2 * per + 1;
  for (int i = 0; i < count; ++i) {  // against the master's direction of travel
    const double t = 2.6 - 2.1 * i / (count - 1);
    const int f = static_cast<int>(t);
    const auto jet =
        pairing::facet_jet(s.pair.master.facets[static_cast<std::size_t>(f)], 2 * (t - f) - 1, s.x);
    s.x.push_back(jet.r - (o.depth + 0.01 * i) * turn(jet.r1.normalized()));
  }
  pairing::Chain slave;
  for (int f = 0; f < 2; ++f) {
    std::vector<Index> nodes{first + f * per, first + (f + 1) * per};
    for (int k = 1; k < per; ++k) nodes.push_back(first + f * per + k);
    slave.facets.push_back(pairing::lagrange_facet(nodes));
  }
  pairing::connect(slave);
  s.pair.slave = pairing::make_slave_side(slave);
  pairing::sample(s.pair.slave, o.sampling);
  pairing::prepare(s.pair, s.x);
  return s;
}

struct SegmentOptions3 {
  cell::CellType type = cell::CellType::quad4;  ///< of the slave's facet
  cell::CellType master = cell::CellType::quad4;
  double bend = 0;
  double depth = 0.05;
  pairing::Sampling sampling{pairing::Sampling::Rule::gauss, 2, 1};
};

/// The master of `make_sample3`; the slave is one facet (two triangles) over the border x = 1.
inline PairSample3 segment_sample3(const SegmentOptions3& o) {
  const SampleOptions3 master{.type = o.master, .bend = o.bend};
  PairSample3 s = make_sample3(master);
  PairSample3 slave;
  // Above the master and looking down: the second edge runs to the left of the first.
  const SampleOptions3 flat{.type = o.type};
  const Vec2 corner(0.3, -0.6), along(0.2, 1.1), across(1.6, -0.1);
  add_sample_facet(slave, flat, corner, along, across);
  if (cell::is_triangle(o.type))
    add_sample_facet(slave, flat, Vec2(corner + along + across), Vec2(-along), Vec2(-across));
  const auto first = static_cast<Index>(s.x.size());
  for (std::size_t n = 0; n < slave.x.size(); ++n) {
    const Vec3& p = slave.x[n];
    s.x.emplace_back(
        p.x(), p.y(),
        sample_height(master, p.x(), p.y()) - o.depth - 0.004 * static_cast<double>(n));
  }
  for (pairing::SurfaceFacet& facet : slave.pair.master.facets)
    for (int k = 0; k < facet.count; ++k) facet.nodes[static_cast<std::size_t>(k)] += first;
  pairing::connect(slave.pair.master);
  s.pair.slave = pairing::make_slave_side(slave.pair.master);
  pairing::sample(s.pair.slave, o.sampling);
  pairing::prepare(s.pair, s.x);
  return s;
}

/// History of the slave points in the configuration in which the slave is moved back by `by`, with
/// this traction along the first direction.
template <int Dim>
void remember_all(ContactSample<Dim>& s, const Vec<Dim>& by, double traction) {
  std::vector<Vec<Dim>> x = s.x;
  for (const Index node : s.pair.slave.nodes) x[static_cast<std::size_t>(node)] -= by;
  s.committed = pairing::initial_state<Dim>(s.pair, x);
  for (contact::PointHistory<Dim>& h : s.committed.points) h.traction[0] = traction;
}

}  // namespace osculate::testing
