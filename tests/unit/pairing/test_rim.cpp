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
  s.pair.filter = {};
  s.pair.filter.distance = 1;
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

/// A punch 3 wide; the slave looks up at its lower face from 0.05 inside, 0.01 beside its side.
template <int Dim>
pairing::Projection<Dim> under_the_corner(const ContactSample<Dim>& punch, Index history,
                                          double distance = 0.01) {
  const std::span<const Vec<Dim>> x(punch.x);
  std::vector<search::Box<Dim>> boxes;
  facet_boxes(punch.pair.master, x, boxes);
  const pairing::Tree<Dim> tree(boxes);
  pairing::ProjectionQuery<Dim> query;
  query.point = Vec<Dim>::Constant(0.05);
  query.point[0] = 3 - distance;
  query.slave_normal = Vec<Dim>::UnitY();
  query.history = history;
  query.history_feature = history < 0 ? projection::Feature::none : projection::Feature::face;
  return closest(punch.pair.master, tree, x, query);
}

/// Facets whose middle lies on the lower face within `far` of the side x = 3, and on that side.
template <int Dim>
std::array<Index, 2> facets_at_the_corner(const ContactSample<Dim>& punch) {
  std::array<Index, 2> found{-1, -1};
  for (std::size_t f = 0; f < punch.pair.master.facets.size(); ++f) {
    const auto& facet = punch.pair.master.facets[f];
    Vec<Dim> low = punch.x[static_cast<std::size_t>(facet.nodes[0])], high = low;
    for (std::size_t k = 1; k < static_cast<std::size_t>(facet.count); ++k) {
      low = low.cwiseMin(punch.x[static_cast<std::size_t>(facet.nodes[k])]);
      high = high.cwiseMax(punch.x[static_cast<std::size_t>(facet.nodes[k])]);
    }
    if (Dim == 3 && low[Dim - 1] > 0.1) continue;  // the first layer
    if (high[0] > 2.9 && high[1] < 1e-9) found[0] = static_cast<Index>(f);
    if (low[0] > 2.9 && low[1] < 1e-9) found[1] = static_cast<Index>(f);
  }
  return found;
}

template <int Dim>
void expect_the_lower_face_to_bear(const ContactSample<Dim>& punch) {
  const auto [lower, side] = facets_at_the_corner(punch);
  ASSERT_GE(lower, 0);
  ASSERT_GE(side, 0);
  EXPECT_EQ(under_the_corner(punch, -1).facet, side) << "the nearest";
  EXPECT_EQ(under_the_corner(punch, side).facet, side) << "that came from the side";
  const pairing::Projection<Dim> p = under_the_corner(punch, lower);
  EXPECT_EQ(p.facet, lower);
  EXPECT_EQ(p.feature, projection::Feature::face);
  EXPECT_NEAR(p.distance, 0.05, 1e-12);
  EXPECT_NE(under_the_corner(punch, lower, -0.01).facet, lower) << "beside the punch";
}

TEST(Rim, APointThatCameThroughTheLowerFaceOfAPunchStaysOnIt) {
  expect_the_lower_face_to_bear(own_surface(plate));
  expect_the_lower_face_to_bear(own_walls(plate, cell::CellType::quad4));
}

}  // namespace
}  // namespace osculate::testing
