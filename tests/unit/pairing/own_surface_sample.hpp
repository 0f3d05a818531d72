#pragma once
// Bodies whose surface can touch itself: closed outlines in the plane, and their walls in space.
#include <functional>
#include <map>
#include <tuple>

#include "pair_sample.hpp"

namespace osculate::testing {

/// Corners of a body in the clockwise sense (body on the right of the direction of travel), each
/// side cut into pieces of about `size`.
inline std::vector<Vec2> outline(const std::vector<Vec2>& corners, double size) {
  std::vector<Vec2> points;
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const Vec2 from = corners[c], to = corners[(c + 1) % corners.size()];
    const int pieces = std::max(1, static_cast<int>(std::lround((to - from).norm() / size)));
    for (int i = 0; i < pieces; ++i)
      points.push_back(from + static_cast<double>(i) / pieces * (to - from));
  }
  return points;
}

/// Two arms of thickness 1 with a slot of 0.2 between them, joined on the left.
inline std::vector<Vec2> hairpin(double size = 0.5) {
  return outline({{0, 0}, {0, 2.2}, {5, 2.2}, {5, 1.2}, {1, 1.2}, {1, 1}, {5, 1}, {5, 0}}, size);
}

/// Bends the upper arm down by `drop` at its end.
inline Vec2 closed_hairpin(const Vec2& p, double drop) {
  if (p.x() <= 1 || p.y() < 1.1) return p;
  const double t = (p.x() - 1) / 4;
  return {p.x() + 0.03 * t, p.y() - drop * t * t};
}

/// Makes the sample's master its slave too; prepared where it is.
template <int Dim>
void touch_itself(ContactSample<Dim>& s, double reach) {
  pairing::connect(s.pair.master);
  s.pair.slave = pairing::make_slave_side(s.pair.master);
  s.pair.filter.own = true;
  s.pair.filter.distance = reach;
  s.pair.normal = contact::penalty(1000);
  pairing::prepare(s.pair, s.x);
  s.committed = pairing::initial_state<Dim>(s.pair, s.x);
}

/// A surface of `points` that is master and slave at once; prepared where it is.
inline PairSample own_surface(const std::vector<Vec2>& points, int nodes_per_facet = 2,
                              double reach = 4) {
  PairSample s;
  s.x = points;
  const auto n = static_cast<Index>(points.size());
  for (Index i = 0; i < n; ++i) {
    const Index next = (i + 1) % n;
    std::vector<Index> nodes{i, next};
    for (int k = 1; k + 1 < nodes_per_facet; ++k) {
      const double t = static_cast<double>(k) / (nodes_per_facet - 1);
      nodes.push_back(static_cast<Index>(s.x.size()));
      s.x.push_back((1 - t) * points[static_cast<std::size_t>(i)] +
                    t * points[static_cast<std::size_t>(next)]);
    }
    s.pair.master.facets.push_back(pairing::lagrange_facet(nodes));
  }
  touch_itself(s, reach);
  return s;
}

/// The outline extruded along z in `layers` layers of height 0.5; no covers.
inline PairSample3 own_walls(const std::vector<Vec2>& points, cell::CellType type, int layers = 2,
                             double reach = 4) {
  PairSample3 s;
  const std::size_t n = points.size();
  std::map<std::tuple<long, long, long>, Index> known;
  const auto node = [&](const Vec3& p) {
    const auto key =
        std::tuple(std::lround(p.x() * 1e7), std::lround(p.y() * 1e7), std::lround(p.z() * 1e7));
    const auto [at, fresh] = known.emplace(key, static_cast<Index>(s.x.size()));
    if (fresh) s.x.push_back(p);
    return at->second;
  };
  const auto facet = [&](const Vec3& origin, const Vec3& u, const Vec3& v) {
    std::vector<Index> nodes;
    for (int k = 0; k < cell::info(type).nodes; ++k) {
      Vec2 xi = cell::area_node(type, k);
      if (!cell::is_triangle(type)) xi = 0.5 * (xi + Vec2::Ones());
      nodes.push_back(node(origin + xi.x() * u + xi.y() * v));
    }
    s.pair.master.facets.push_back(pairing::surface_facet(type, nodes));
  };
  for (std::size_t i = 0; i < n; ++i)
    for (int layer = 0; layer < layers; ++layer) {
      const Vec2 a = points[i], b = points[(i + 1) % n];
      const Vec3 low(b.x(), b.y(), 0.5 * layer), along(a.x() - b.x(), a.y() - b.y(), 0),
          up(0, 0, 0.5);
      facet(low, along, up);
      if (cell::is_triangle(type)) facet(Vec3(low + along + up), Vec3(-along), Vec3(-up));
    }
  touch_itself(s, reach);
  return s;
}

/// Deforms a sample; the history stays.
inline void move(PairSample& s, const std::function<Vec2(const Vec2&)>& to) {
  for (Vec2& p : s.x) p = to(p);
}
inline void move(PairSample3& s, const std::function<Vec2(const Vec2&)>& to) {
  for (Vec3& p : s.x) {
    const Vec2 q = to(p.head<2>());
    p = Vec3(q.x(), q.y(), p.z());
  }
}

/// Slave nodes in contact.
template <int Dim>
std::vector<Index> touching(const ContactSample<Dim>& s) {
  const pairing::PairEvaluation<Dim> e = pair_evaluation(s, flatten(s.x));
  std::vector<Index> nodes;
  for (std::size_t i = 0; i < e.points.size(); ++i)
    if (e.blocks[i].active()) nodes.push_back(s.pair.slave.nodes[i]);
  return nodes;
}

}  // namespace osculate::testing
