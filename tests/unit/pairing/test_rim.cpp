// Bodies of one outline on top of each other: the nodes at the rim of the slave lie on the rim of
// the master, up to rounding on the one or the other side of its edge.
#include <gtest/gtest.h>

#include "own_surface_sample.hpp"

namespace osculate::testing {
namespace {

const std::vector<Vec2> plate = outline({{0, 0}, {0, 0.4}, {3, 0.4}, {3, 0}}, 0.2);
constexpr double depth = 1e-3;

/// The sample's surface, and the same once more on top of it, as slave.
template <int Dim>
ContactSample<Dim> stacked(ContactSample<Dim> s, double beside) {
  const std::size_t count = s.x.size();
  for (std::size_t n = 0; n < count; ++n) {
    Vec<Dim> p = s.x[n];
    p[0] += beside;
    p[1] += 0.4 - depth;
    s.x.push_back(p);
  }
  auto upper = s.pair.master;
  for (auto& facet : upper.facets)
    for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k)
      facet.nodes[k] += static_cast<Index>(count);
  pairing::connect(upper);
  s.pair.slave = pairing::make_slave_side(upper);
  s.pair.scope = {};
  s.pair.scope.reach = 1;
  pairing::prepare(s.pair, s.x);
  s.committed = pairing::initial_state<Dim>(s.pair, s.x);
  return s;
}

template <int Dim>
void expect_straight_push(const ContactSample<Dim>& sample) {
  for (const double beside : {-1e-3, -1e-8, -1e-11, 0.0, 1e-11, 3e-9, 1e-8, 1e-6, 1e-3}) {
    const ContactSample<Dim> s = stacked<Dim>(sample, beside);
    pairing::PairEvaluation<Dim> e;
    pairing::evaluate<Dim>(s.pair, s.x, s.committed, true, e);
    double force = 0;
    for (const pairing::PointResult<Dim>& p : e.points) {
      if (p.status == contact::Status::open) continue;
      EXPECT_NEAR(p.gap, -depth, 1e-12) << beside;
      EXPECT_NEAR(p.normal[1], 1, 1e-12) << beside;
      force -= p.weight * p.normal_traction;
    }
    const double area = Dim == 2 ? 3 : 3 * 1.0;  // two layers of 0.5
    EXPECT_NEAR(force, contact::penalty_of(s.pair.normal) * depth * area, 1e-9) << beside;
  }
}

TEST(Rim, NodesOfAStackArePushedAlongTheFaceInThePlane) {
  for (const int nodes : {2, 3}) expect_straight_push<2>(own_surface(plate, nodes));
}

TEST(Rim, NodesOfAStackArePushedAlongTheFaceInSpace) {
  for (const cell::CellType type : {cell::CellType::quad4, cell::CellType::quad9})
    expect_straight_push<3>(own_walls(plate, type));
}

TEST(Rim, ANodeBesideTheBlockIsNotInIt) {
  const PairSample s = stacked<2>(own_surface(plate), 0.05);
  pairing::PairEvaluation<2> e;
  pairing::evaluate<2>(s.pair, s.x, s.committed, false, e);
  for (std::size_t i = 0; i < e.points.size(); ++i) {
    const Vec2& p = s.x[static_cast<std::size_t>(s.pair.slave.nodes[i])];
    if (p.x() > 3.02) {
      EXPECT_EQ(e.points[i].status, contact::Status::open) << p.transpose();
    }
  }
}

}  // namespace
}  // namespace osculate::testing
