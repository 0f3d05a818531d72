// A point at the centre of curvature of the master is marked and gives no force.
#include <gtest/gtest.h>

#include <numbers>

#include "pair_sample.hpp"

namespace osculate::testing {
namespace {

/// A rigid disc of radius 2 about the origin and one slave node.
PairSample disc(const Vec2& node) {
  PairSample s;
  s.x = {{0, 0}, {1, 0}, {0, 1}, node};
  s.pair.master.facets.push_back(
      pairing::shape_facet(geometry::Circle{Vec2(0, 0), 2.0, false}, {0, 1, 2}));
  make_last_node_slave(s);
  return s;
}

TEST(OutsideDomain, CentreOfADisc) {
  PairSample s = disc({0, 0});
  pairing::PairEvaluation<2> e;
  pairing::evaluate(s.pair, s.x, s.committed, true, e);
  EXPECT_TRUE(e.points[0].outside_domain);
  EXPECT_EQ(e.points[0].status, contact::Status::open);
  EXPECT_FALSE(e.blocks[0].active());
  EXPECT_FALSE(pairing::initial_state(s.pair, s.x).points[0].active);
  s.x[3] = {0.01, 0};
  pairing::evaluate(s.pair, s.x, s.committed, true, e);
  EXPECT_FALSE(e.points[0].outside_domain);
  EXPECT_TRUE(e.blocks[0].active());
  EXPECT_NEAR(e.points[0].gap, -1.99, 1e-14);
  s.pair.depth = 1.0;  // not looked for so deep: nothing to report
  s.x[3] = {0, 0};
  pairing::evaluate(s.pair, s.x, s.committed, true, e);
  EXPECT_FALSE(e.points[0].outside_domain);
}

// A quadratic facet y = -x^2 / 2, body below: centre of curvature of its top at (0, -1).
TEST(OutsideDomain, CentreOfCurvatureOfAQuadraticFacet) {
  PairSample s;
  s.x = {{-2, -2}, {2, -2}, {0, 0}, {0, -1}};
  s.pair.master.facets.push_back(pairing::lagrange_facet(std::array<Index, 3>{0, 1, 2}));
  make_last_node_slave(s);
  pairing::PairEvaluation<2> e;
  for (const double deeper : {-0.1, 0.0, 0.1}) {
    s.x[3].y() = -1 - deeper;
    pairing::evaluate(s.pair, s.x, s.committed, true, e);
    EXPECT_EQ(e.points[0].outside_domain, deeper == 0) << deeper;
    EXPECT_TRUE(e.blocks[0].force.allFinite());
    if (deeper != 0) {  // below it two places on the flanks are the nearest
      EXPECT_TRUE(e.blocks[0].active());
      EXPECT_NEAR(std::abs(e.points[0].foot.x()), deeper > 0 ? std::sqrt(2 * deeper) : 0.0, 1e-7);
    }
  }
}

// Sphere: both curvatures; cylinder: one.
TEST(OutsideDomain, CentreOfASphereAndAxisOfACylinder) {
  const std::array<geometry::Surface, 2> shapes{
      geometry::Sphere{Vec3(0, 0, 0), 2.0}, geometry::Cylinder{Vec3(0, 0, 0), Vec3(0, 0, 1), 2.0}};
  for (const geometry::Surface& shape : shapes) {
    PairSample3 s;
    s.x = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
    s.pair.master.facets.push_back(pairing::shape_facet(shape, {0, 1, 2, 3}));
    make_last_node_slave(s);
    pairing::PairEvaluation<3> e;
    pairing::evaluate(s.pair, s.x, s.committed, true, e);
    EXPECT_TRUE(e.points[0].outside_domain);
    EXPECT_FALSE(e.blocks[0].active());
    s.x[4] = {0.1, 0.1, 0};
    pairing::evaluate(s.pair, s.x, s.committed, true, e);
    EXPECT_FALSE(e.points[0].outside_domain);
    EXPECT_TRUE(e.blocks[0].active());
  }
}

}  // namespace
}  // namespace osculate::testing
