#pragma once
// Two roofs whose ridges cross: contact that no node sees.
#include "pair_sample.hpp"

namespace osculate::testing {

struct RoofOptions {
  cell::CellType type = cell::CellType::quad4;
  double bend = 0.0;    ///< of the ridges, for quadratic facets
  double depth = 0.05;  ///< about how deep they cross
  double angle = 1.2;   ///< between them
  int pieces = 1;       ///< of the master along its ridge
};

/// Adds a roof: ridge along x through the origin, both sides falling by 45 degrees over a width
/// of 1. `pose` puts it in space.
template <class Pose>
pairing::FacetSurface add_roof(std::vector<Vec3>& x, const RoofOptions& o, int pieces,
                               const Pose& pose) {
  pairing::FacetSurface surface;
  std::vector<std::pair<Vec2, Index>> known;
  const auto node = [&](const Vec2& p) {
    for (const auto& entry : known)
      if ((entry.first - p).norm() < 1e-9) return entry.second;
    const double u = p.x(), v = p.y();
    const Vec3 at(u, v + 0.7 * o.bend * u * u, -std::abs(v) + o.bend * (0.4 * u - u * u));
    known.emplace_back(p, static_cast<Index>(x.size()));
    x.push_back(pose(at));
    return known.back().second;
  };
  const auto add = [&](const Vec2& origin, const Vec2& first, const Vec2& second) {
    std::vector<Index> nodes;
    for (int k = 0; k < cell::info(o.type).nodes; ++k) {
      Vec2 xi = cell::area_node(o.type, k);
      if (!cell::is_triangle(o.type)) xi = 0.5 * (xi + Vec2::Ones());
      nodes.push_back(node(origin + xi.x() * first + xi.y() * second));
    }
    surface.facets.push_back(pairing::surface_facet(o.type, nodes));
  };
  for (int i = 0; i < pieces; ++i)
    for (const double v : {-1.0, 0.0}) {
      const Vec2 low(-2 + 4.0 * i / pieces, v), along(4.0 / pieces, 0), up(0, 1);
      add(low, along, up);
      if (cell::is_triangle(o.type)) add(Vec2(low + along + up), Vec2(-along), Vec2(-up));
    }
  pairing::connect(surface);
  return surface;
}

/// The slave's roof is turned upside down, by `angle` about z, leans a little, and its ridge passes
/// `depth` below the master's at (0.3, 0).
inline PairSample3 make_roofs(const RoofOptions& o) {
  PairSample3 s;
  s.pair.master = add_roof(s.x, o, o.pieces, [](const Vec3& p) { return p; });
  const Mat<3, 3> turn =
      (Eigen::AngleAxisd(o.angle, Vec3::UnitZ()) * Eigen::AngleAxisd(0.06, Vec3::UnitY()) *
       Eigen::AngleAxisd(std::acos(-1.0) + 0.1, Vec3::UnitX()))
          .toRotationMatrix();
  const Vec3 offset = turn * Vec3(0.8, 0, 0);
  pairing::FacetSurface slave = add_roof(
      s.x, o, 1, [&](const Vec3& p) { return Vec3(turn * p + Vec3(0.3, 0, -o.depth) - offset); });
  s.pair.slave = pairing::make_slave_side(slave);
  s.pair.normal = contact::penalty(1000.0);
  s.pair.weight = pairing::Weight::node;
  s.pair.sampler = pairing::AtEdgesToo{};
  pairing::prepare(s.pair, s.x);
  s.committed.points.resize(s.pair.slave.nodes.size());
  return s;
}

/// Moves the slave's nodes.
inline void shift_slave(PairSample3& s, const Vec3& by) {
  for (const Index n : s.pair.slave.nodes) s.x[static_cast<std::size_t>(n)] += by;
}

inline pairing::PairEvaluation<3> evaluated(const PairSample3& s) {
  pairing::PairEvaluation<3> e;
  pairing::evaluate(s.pair, s.x, s.committed, true, e);
  return e;
}

/// Number of edge-edge contacts in an evaluation.
inline std::size_t edge_contacts(const PairSample3& s, const pairing::PairEvaluation<3>& e) {
  return e.points.size() - s.pair.slave.nodes.size();
}

}  // namespace osculate::testing
