// The generalized projection along paths: continuous from face to edge to corner, with jumps only
// across the medial axis; a node in the wedge between two faces is held.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <set>

#include "osculate/projection/point_to_facet.hpp"
#include "pair_sample.hpp"

namespace osculate::testing {
namespace {

using cell::CellType;
using projection::Feature;

/// A pair of one slave node (the last one) and the master through `facets`.
PairSample3 one_node(std::vector<Vec3> x, const std::vector<std::array<Index, 4>>& facets) {
  PairSample3 s;
  for (const std::array<Index, 4>& nodes : facets)
    s.pair.master.facets.push_back(pairing::surface_facet(CellType::quad4, nodes));
  s.x = std::move(x);
  s.x.emplace_back(0, 0, 9);
  make_last_node_slave(s);
  return s;
}

/// The cube -1..1. Facets: z-, z+, y-, x+, y+, x-.
PairSample3 cube() {
  return one_node(
      {{-1, -1, -1},
       {1, -1, -1},
       {1, 1, -1},
       {-1, 1, -1},
       {-1, -1, 1},
       {1, -1, 1},
       {1, 1, 1},
       {-1, 1, 1}},
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

/// Three walls seen from inside the room x, y, z > 0; the master's body is behind them.
PairSample3 room() {
  return one_node({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                  {{0, 1, 2, 3}, {0, 4, 5, 1}, {0, 3, 6, 4}});
}

/// Largest change from one sample of a path to the next.
struct Jumps {
  double foot = 0, gap = 0, normal = 0, force = 0;
  std::vector<Feature> features;  ///< in the order of the path
};

Jumps along(PairSample3 s, const std::vector<Vec3>& corners, int samples) {
  Jumps jumps;
  pairing::PairEvaluation<3> e;
  pairing::PointResult<3> last;
  Vec3 last_force;
  bool first = true;
  for (std::size_t leg = 0; leg + 1 < corners.size(); ++leg)
    for (int i = 0; i < samples; ++i) {
      const double t = static_cast<double>(i) / samples;
      s.x.back() = (1 - t) * corners[leg] + t * corners[leg + 1];
      pairing::evaluate(s.pair, s.x, s.committed, false, e);
      const pairing::PointResult<3>& p = e.points[0];
      Vec3 force = Vec3::Zero();
      if (e.blocks[0].active()) force = e.blocks[0].force.head<3>();
      if (jumps.features.empty() || jumps.features.back() != p.history.feature)
        jumps.features.push_back(p.history.feature);
      if (!first) {
        jumps.foot = std::max(jumps.foot, (p.foot - last.foot).norm());
        jumps.gap = std::max(jumps.gap, std::abs(p.gap - last.gap));
        jumps.normal = std::max(jumps.normal, (p.normal - last.normal).norm());
        jumps.force = std::max(jumps.force, (force - last_force).norm());
      }
      first = false;
      last = p;
      last_force = force;
      s.committed = pairing::commit(e);
    }
  return jumps;
}

const std::vector<Feature> all_features{Feature::face, Feature::edge,   Feature::face,
                                        Feature::edge, Feature::corner, Feature::edge,
                                        Feature::face};

/// Every quantity changes in proportion to the step: it is Lipschitz continuous along the path.
void expect_continuous(const Jumps& coarse, const Jumps& fine) {
  EXPECT_NEAR(coarse.foot / fine.foot, 8.0, 0.4);
  EXPECT_NEAR(coarse.gap / fine.gap, 8.0, 0.4);
  EXPECT_NEAR(coarse.normal / fine.normal, 8.0, 0.4);
  if (fine.force > 0) {
    EXPECT_NEAR(coarse.force / fine.force, 8.0, 0.4);
  }
}

TEST(GeneralizedPath, OutsideAConvexBodyFootGapAndNormalAreContinuous) {
  const std::vector<Vec3> way{{0.3, 0.1, 1.5},  {1.5, 0.1, 1.5},  {1.5, 0.1, 0.12},
                              {1.5, 1.6, 1.64}, {0.1, 1.6, 1.64}, {0.1, 0.2, 1.64}};
  const Jumps coarse = along(cube(), way, 101), fine = along(cube(), way, 808);
  EXPECT_EQ(coarse.features, all_features);
  EXPECT_EQ(fine.features, all_features);
  expect_continuous(coarse, fine);
}

TEST(GeneralizedPath, BehindAValleyTheForceIsContinuousToo) {
  const std::vector<Vec3> way{{0.5, 0.5, -0.1},    {0.5, -0.1, -0.1}, {0.5, -0.1, 0.57},
                              {-0.13, -0.1, -0.1}, {0.5, -0.1, -0.1}, {0.5, 0.4, -0.1}};
  const Jumps coarse = along(room(), way, 101), fine = along(room(), way, 808);
  EXPECT_EQ(coarse.features, all_features);
  EXPECT_EQ(fine.features, all_features);
  expect_continuous(coarse, fine);
  PairSample3 sticking = room();
  sticking.pair.friction = contact::coulomb(1e6, 80.0);
  expect_continuous(along(sticking, way, 101), along(sticking, way, 808));
}

// The order is 1, not more: the slope of the force jumps between a face and its edge.
TEST(GeneralizedPath, AcrossTheMedialAxisTheNormalJumps) {
  const std::vector<Vec3> way{{0.5, 0.1, 0.9}, {0.9, 0.1, 0.51}};
  for (const int samples : {101, 808}) {
    const Jumps jumps = along(cube(), way, samples);
    EXPECT_EQ(jumps.features, std::vector<Feature>{Feature::face});
    EXPECT_NEAR(jumps.normal, std::sqrt(2.0), 1e-12);  // from +z to +x, whatever the step
    EXPECT_LT(jumps.gap, 0.6 / samples);               // the distance itself is continuous
  }
}

// --- a slave node under a dead load -------------------------------------------------------------

/// Newton's iterations of the last node under `load`; what is not `free` stays. Returns the
/// residual.
template <int Dim>
double settle(ContactSample<Dim>& s, const Vec<Dim>& load, const Mat<Dim, Dim>& free) {
  pairing::PairEvaluation<Dim> e;
  double rest = 0;
  for (int i = 0; i < 12; ++i) {
    pairing::evaluate<Dim>(s.pair, s.x, s.committed, true, e);
    const Vec<Dim> force =
        e.blocks[0].active() ? Vec<Dim>(e.blocks[0].force.template head<Dim>()) : Vec<Dim>::Zero();
    const Vec<Dim> residual = free * (force - load);
    rest = residual.norm();
    if (!e.blocks[0].active()) return rest;
    Mat<Dim, Dim> k = free * e.blocks[0].tangent.template topLeftCorner<Dim, Dim>() * free;
    for (const pairing::NodeMatrix<Dim>& g : e.blocks[0].path())
      if (g.node == static_cast<Index>(s.x.size()) - 1)
        k += free * e.blocks[0].path_rows.template topRows<Dim>() * g.value * free;
    k += Mat<Dim, Dim>::Identity() - free;
    s.x.back() -= Vec<Dim>(k.fullPivLu().solve(residual));
  }
  s.committed = pairing::commit(e);
  return rest;
}

/// Facets that hold the foot of the last node inside: what a projection onto faces alone finds.
int faces_with_a_foot(const PairSample3& s) {
  int count = 0;
  for (const pairing::SurfaceFacet& f : s.pair.master.facets) {
    std::vector<Vec3> nodes;
    for (std::size_t k = 0; k < static_cast<std::size_t>(f.count); ++k)
      nodes.push_back(s.x[static_cast<std::size_t>(f.nodes[k])]);
    if (projection::closest_point(f.type, nodes, s.x.back()).feature == Feature::face) ++count;
  }
  return count;
}

TEST(HeldByTheWedge, NodeBehindTheEdgeAndTheCornerOfARoom) {
  const Mat<3, 3> all = Mat<3, 3>::Identity(), across = Vec3(0, 1, 1).asDiagonal();
  for (const bool corner : {false, true}) {
    PairSample3 s = room();
    const Vec3 load = corner ? Vec3(-10, -20, -15) : Vec3(0, -20, -15);
    s.x.back() = corner ? Vec3(-0.01, -0.01, -0.01) : Vec3(0.5, -0.01, -0.01);
    EXPECT_LT(settle<3>(s, load, corner ? all : across), 1e-10);
    const Vec3 vertex = corner ? Vec3(0, 0, 0) : Vec3(0.5, 0, 0);
    EXPECT_LT((s.x.back() - vertex - load / 1000.0).norm(), 1e-13);  // held by a spring
    EXPECT_EQ(s.committed.points[0].feature, corner ? Feature::corner : Feature::edge);
    // No face holds it: with faces alone there is no contact, here and wherever the load pushes it.
    for (const double further : {0.0, 0.01, 0.1, 1.0}) {
      s.x.back() = vertex + (1 / 1000.0 + further) * load;
      EXPECT_EQ(faces_with_a_foot(s), 0) << further;
    }
  }
}

/// A polyline of three points and one slave node, the last one.
PairSample line_and_node(const std::array<Vec2, 3>& points, const Vec2& node) {
  PairSample s;
  for (const Vec2& p : points) s.x.push_back(p);
  s.x.push_back(node);
  s.pair.master = line_through(3);
  make_last_node_slave(s);
  return s;
}

TEST(HeldByTheWedge, NodeUnderAValleyInThePlane) {
  PairSample s = line_and_node({Vec2(-2, 1), Vec2(0, 0), Vec2(2, 1.5)}, {0, -0.02});
  const Vec2 load(1, -20);
  EXPECT_LT(settle<2>(s, load, Mat<2, 2>::Identity()), 1e-10);
  EXPECT_LT((s.x.back() - load / 1000.0).norm(), 1e-13);
  EXPECT_EQ(s.committed.points[0].feature, Feature::corner);
  for (const double further : {0.0, 0.01, 0.1}) {  // beyond the ends of both facets
    const Vec2 p = s.x.back() + further * load;
    EXPECT_GT(p.dot(Vec2(2, -1)), 0);   // left facet: past its right end
    EXPECT_LT(p.dot(Vec2(2, 1.5)), 0);  // right facet: before its left end
  }
}

// On the axis of a ridge both faces are equally near and push to their sides: with one of them the
// node is pushed off; the averaged normal of the vertex holds it.
TEST(HeldByTheWedge, NodeOnTheAxisOfARidge) {
  const Vec2 load(0, -20);
  PairSample s = line_and_node({Vec2(-2, -1), Vec2(0, 0), Vec2(2, -1)}, {0, -0.01});
  EXPECT_LT(settle<2>(s, load, Mat<2, 2>::Identity()), 1e-10);
  EXPECT_LT((s.x.back() - load / 1000.0).norm(), 1e-13);
  EXPECT_EQ(s.committed.points[0].feature, Feature::corner);
  EXPECT_LT(settle<2>(s, 2 * load, Mat<2, 2>::Identity()), 1e-10);  // and goes on doing so
  EXPECT_EQ(s.committed.points[0].feature, Feature::corner);
  for (const Index side : {0, 1}) {
    s.committed.points[0] = remembered(true, side, Feature::face, 0.0, -0.01, 0.0);
    pairing::PairEvaluation<2> e;
    pairing::evaluate(s.pair, s.x, s.committed, false, e);
    EXPECT_EQ(e.points[0].history.facet, side);
    EXPECT_EQ(e.points[0].history.feature, Feature::face);
    EXPECT_GT(std::abs(e.blocks[0].force[0]), 1.0);  // a face alone pushes it aside
  }
}

TEST(HeldByTheWedge, NodeOnTheAxisOfARidgeInSpace) {
  const PairSample3 start =
      one_node({{-2, 0, -1}, {0, 0, 0}, {2, 0, -1}, {-2, 1, -1}, {0, 1, 0}, {2, 1, -1}},
               {{0, 1, 4, 3}, {1, 2, 5, 4}});
  PairSample3 s = start;
  s.x.back() = {0, 0.4, -0.01};
  const Vec3 load(0, 0, -20);
  const Mat<3, 3> across = Vec3(1, 0, 1).asDiagonal();
  EXPECT_LT(settle<3>(s, load, across), 1e-10);
  EXPECT_LT((s.x.back() - Vec3(0, 0.4, -0.02)).norm(), 1e-13);
  EXPECT_EQ(s.committed.points[0].feature, Feature::edge);
  for (const Index side : {0, 1}) {
    s.committed.points[0] = remembered(side, {0, 0}, -0.01, {0, 0});
    pairing::PairEvaluation<3> e;
    pairing::evaluate(s.pair, s.x, s.committed, false, e);
    EXPECT_EQ(e.points[0].history.facet, side);
    EXPECT_GT(std::abs(e.blocks[0].force[0]), 1.0);
  }
}

}  // namespace
}  // namespace osculate::testing
