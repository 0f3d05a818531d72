#pragma once
// A groove in space and one point with unknown tractions in it.
#include <Eigen/Geometry>

#include "multiplier_sample.hpp"

namespace osculate::testing {

struct GrooveOptions {
  cell::CellType type = cell::CellType::quad4;
  std::array<double, 2> tilt{0.6, 0.6};  ///< of both sides against the horizontal
  int pieces = 2;                        ///< along the groove, which runs in x from -2 to 2
  double bend = 0;                       ///< of the edge and the sides, for quadratic facets
  double turn = 0;                       ///< of the second half of the groove, about its middle
  Vec3 at{0.3, 0, 0};                    ///< of the point, before it is posed
  Mat<3, 3> pose = Mat<3, 3>::Identity();
};

/// Unit normal of side k: 0 lies at y < 0.
inline Vec3 groove_normal(const GrooveOptions& o, int k) {
  const double a = o.tilt[static_cast<std::size_t>(k)];
  return o.pose * Vec3(0, k == 0 ? std::sin(a) : -std::sin(a), std::cos(a));
}

inline Vec3 groove_point(const GrooveOptions& o, double u, double v) {
  const double slope = std::tan(o.tilt[v < 0 ? 0 : 1]);
  const double along = u > 0 ? u * std::cos(o.turn) : u, aside = u > 0 ? u * std::sin(o.turn) : 0;
  return o.pose * Vec3(along, v + aside + 0.7 * o.bend * u * u,
                       slope * std::abs(v) + o.bend * (0.4 * u - u * u));
}

inline pairing::FacetSurface add_groove(const GrooveOptions& o, std::vector<Vec3>& x) {
  pairing::FacetSurface surface;
  std::vector<std::pair<Vec2, Index>> known;
  const auto node = [&](const Vec2& p) {
    for (const auto& entry : known)
      if ((entry.first - p).norm() < 1e-9) return entry.second;
    known.emplace_back(p, static_cast<Index>(x.size()));
    x.push_back(groove_point(o, p.x(), p.y()));
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
  for (int i = 0; i < o.pieces; ++i)
    for (const double v : {-1.0, 0.0}) {
      const Vec2 low(-2 + 4.0 * i / o.pieces, v), along(4.0 / o.pieces, 0), up(0, 1);
      add(low, along, up);
      if (cell::is_triangle(o.type)) add(Vec2(low + along + up), Vec2(-along), Vec2(-up));
    }
  pairing::connect(surface);
  return surface;
}

/// The point has the penalty 1000 and weight 1.
inline MultiplierSample<3> make_groove(const GrooveOptions& o) {
  MultiplierSample<3> s;
  s.pair.master = add_groove(o, s.x);
  const auto slave = static_cast<Index>(s.x.size());
  s.x.push_back(o.pose * o.at);
  s.pair.slave = pairing::make_slave_side(pairing::FacetSurface{}, std::array<Index, 1>{slave});
  s.pair.normal = contact::penalty(1000);
  s.pair.weight = pairing::Weight::node;
  s.pair.enforcement = pairing::ByMultipliers{};
  s.committed.points.resize(1);
  s.multipliers.resize(1);
  pairing::prepare(s.pair, s.x);
  return s;
}

}  // namespace osculate::testing
