#pragma once
// A point that slides round a cylinder and a sphere of first-order facets, smoothed or not.
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "osculate/contact/law/law.hpp"
#include "osculate/pairing/pair.hpp"

namespace osculate::verification {

/// A round master of radius 1 and a great circle on it: (cos a) first + (sin a) second.
struct RoundMaster {
  std::vector<Vec3> x;
  pairing::FacetSurface surface;
  Vec3 first, second;
};

/// Facets over a grid of places; equal places are one node.
template <class Place>
void add_grid(RoundMaster& master, bool triangles, int n, int m, const Place& place) {
  const auto node = [&](int i, int j) {
    const Vec3 p = place(static_cast<double>(i) / n, static_cast<double>(j) / m);
    for (std::size_t k = 0; k < master.x.size(); ++k)
      if ((master.x[k] - p).norm() < 1e-9) return static_cast<Index>(k);
    master.x.push_back(p);
    return static_cast<Index>(master.x.size()) - 1;
  };
  const auto add = [&](cell::CellType type, std::initializer_list<Index> nodes) {
    master.surface.facets.push_back(
        pairing::surface_facet(type, std::span(nodes.begin(), nodes.size())));
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const std::array<Index, 4> q{node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
      if (triangles) {
        add(cell::CellType::tri3, {q[0], q[1], q[2]});
        add(cell::CellType::tri3, {q[0], q[2], q[3]});
      } else {
        add(cell::CellType::quad4, {q[0], q[1], q[2], q[3]});
      }
    }
}

/// A tube of `count` facets around and three along its axis y.
inline RoundMaster tube(int count, bool triangles) {
  RoundMaster out;
  add_grid(out, triangles, count, 3, [](double u, double v) {
    const double a = 2 * std::numbers::pi * u;
    return Vec3(std::sin(a), 1.2 * v - 0.5, std::cos(a));
  });
  out.first = Vec3::UnitZ();
  out.second = Vec3::UnitX();
  return out;
}

/// A cube blown up to a ball, `count` facets along its edges.
inline RoundMaster ball(int count, bool triangles) {
  RoundMaster out;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
      add_grid(out, triangles, count, count, [&](double u, double v) {
        Vec3 p;
        p[axis] = side;
        p[(axis + 1) % 3] = std::tan(std::numbers::pi / 4 * (2 * u - 1));
        p[(axis + 2) % 3] = std::tan(std::numbers::pi / 4 * side * (2 * v - 1));
        return Vec3(p.normalized());
      });
  out.first = Vec3(1, 0.1, 0.2).normalized();
  out.second = out.first.cross(Vec3(0.3, 1, -0.8)).normalized();
  return out;
}

/// A point that slides along the great circle, `depth` deep; its number is the last one.
struct RideInSpace {
  pairing::PairDefinition<3> pair;
  std::vector<Vec3> x;
  Vec3 first, second;

  [[nodiscard]] Vec3 outwards(double turns) const {
    const double angle = 2 * std::numbers::pi * turns;
    return std::cos(angle) * first + std::sin(angle) * second;
  }
};

inline RideInSpace ride_on(RoundMaster master, pairing::SmoothingKind kind, double stiffness,
                           const contact::FrictionLaw& friction) {
  RideInSpace ride{{}, std::move(master.x), master.first, master.second};
  ride.pair.master = std::move(master.surface);
  pairing::connect(ride.pair.master);
  smooth(ride.pair.master, ride.x, pairing::Smoothing{kind});
  const auto slave = static_cast<Index>(ride.x.size());
  ride.x.emplace_back(0, 0, 0);
  ride.pair.slave = pairing::make_slave_side(pairing::FacetSurface{}, std::array<Index, 1>{slave});
  ride.pair.weight = pairing::Weight::node;
  ride.pair.normal = contact::penalty(stiffness);
  ride.pair.friction = friction;
  pairing::prepare<3>(ride.pair, ride.x);
  return ride;
}

}  // namespace osculate::verification
