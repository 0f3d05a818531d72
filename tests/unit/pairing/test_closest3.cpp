// Generalized projection onto a surface in space: faces, edges, corners, open borders.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "closest_sample.hpp"

namespace osculate::testing {
namespace {

using cell::CellType;
using pairing::Projection;
using projection::Feature;

/// The unit cube -1..1, outward normals. Facets: z-, z+, y-, x+, y+, x-.
Target<3> cube() {
  pairing::FacetSurface surface;
  const std::vector<Vec3> x{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                            {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  for (const std::array<Index, 4>& nodes :
       {std::array<Index, 4>{0, 3, 2, 1}, std::array<Index, 4>{4, 5, 6, 7},
        std::array<Index, 4>{0, 1, 5, 4}, std::array<Index, 4>{1, 2, 6, 5},
        std::array<Index, 4>{2, 3, 7, 6}, std::array<Index, 4>{3, 0, 4, 7}})
    surface.facets.push_back(pairing::surface_facet(CellType::quad4, nodes));
  return {x, surface};
}

TEST(ClosestOnSurface, OfACubeIsExactEverywhereOutside) {
  const Target<3> t = cube();
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> u(-2, 2);
  std::array<int, 4> seen{};
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p(u(generator), u(generator), u(generator));
    if (p.lpNorm<Eigen::Infinity>() <= 1) continue;
    const Vec3 foot = p.cwiseMax(-1).cwiseMin(1);
    int clamped = 0;
    for (int k = 0; k < 3; ++k) clamped += std::abs(p[k]) > 1 ? 1 : 0;
    const Projection<3> found = t.at(p);
    EXPECT_NEAR(found.distance, (p - foot).norm(), 1e-12);
    const Feature expected = clamped == 1   ? Feature::face
                             : clamped == 2 ? Feature::edge
                                            : Feature::corner;
    EXPECT_EQ(found.feature, expected);
    ++seen[static_cast<std::size_t>(clamped)];
    EXPECT_FALSE(found.beyond_end);
    const pairing::SurfaceFacet& facet = t.boundary.facets[static_cast<std::size_t>(found.facet)];
    EXPECT_LT((pairing::facet_jet(facet, found.xi, t.x).r - foot).norm(), 1e-12);
    if (clamped == 1) continue;
    Vec3 outward = Vec3::Zero();  // average of the faces that meet there
    for (int k = 0; k < 3; ++k)
      if (std::abs(p[k]) > 1) outward[k] = p[k] > 0 ? 1 : -1;
    EXPECT_LT((found.outward - outward.normalized()).norm(), 1e-12);
  }
  for (std::size_t k = 1; k < 4; ++k) EXPECT_GT(seen[k], 100);
}

TEST(ClosestOnSurface, InsideTheNearestFaceWinsAndEquidistantPointsKeepTheirSide) {
  const Target<3> t = cube();
  EXPECT_EQ(t.at({0.2, 0.1, 0.8}).facet, 1);
  EXPECT_EQ(t.at({0.9, 0.1, 0.8}).facet, 3);
  const Projection<3> shared = t.at({0.9, 0.1, 0.9});
  EXPECT_EQ(shared.feature, Feature::edge);
  EXPECT_LT((shared.outward - Vec3(1, 0, 1).normalized()).norm(), 1e-14);
  for (const Index history : {1, 3}) {
    const Projection<3> kept = t.at({0.9, 0.1, 0.9}, history);
    EXPECT_EQ(kept.feature, Feature::face);
    EXPECT_EQ(kept.facet, history);
  }
}

/// The corner (1, 1, 1) of a cube whose top is a fan of `fan` triangles there: the other faces are
/// one triangle each, so that the top has `fan` normals of three or more.
Target<3> fanned_corner(int fan) {
  pairing::FacetSurface surface;
  std::vector<Vec3> x{{1, 1, 1}, {1, -1, 1}, {-1, 1, 1}, {1, 1, -1}};
  const auto add = [&](Index a, Index b, Index c) {
    surface.facets.push_back(pairing::surface_facet(CellType::tri3, std::array<Index, 3>{a, b, c}));
  };
  Index last = 2;  // the top, z+, from (-1, 1) round to (1, -1)
  for (int i = 1; i < fan; ++i) {
    const double s = static_cast<double>(i) / fan;
    x.emplace_back(-1 + 2 * s, 1 - 2 * s, 1);
    add(0, last, static_cast<Index>(x.size()) - 1);
    last = static_cast<Index>(x.size()) - 1;
  }
  add(0, last, 1);
  add(0, 1, 3);  // x+
  add(0, 3, 2);  // y+
  return {x, surface};
}

Target<3> flat_strip() {
  const PairSample3 s = make_sample3({});
  return {s.x, s.pair.master};
}

// A sum over facets leans towards the face that is cut into most of them.
TEST(ClosestOnSurface, TheCornerOfACubeHasOneNormalHoweverItsFacesAreCut) {
  for (const int fan : {1, 2, 7, 40}) {
    const Projection<3> p = fanned_corner(fan).at({1.3, 1.2, 1.1});
    ASSERT_EQ(p.feature, Feature::corner);
    EXPECT_LT((p.outward - Vec3(1, 1, 1).normalized()).norm(), 1e-14) << fan;
  }
}

TEST(ClosestOnSurface, SharedEdgesOfAFlatSurfaceHaveNoGap) {
  const Target<3> t = flat_strip();
  for (const double offset : {-1e-7, -1e-9, -1e-12, 0.0, 1e-12, 1e-9, 1e-7}) {
    const Projection<3> p = t.at({1.0 + offset, 0.3, -0.05});
    EXPECT_EQ(p.feature, Feature::face) << offset;
    EXPECT_NEAR(p.distance, 0.05, 1e-15) << offset;
  }
}

TEST(ClosestOnSurface, OpenBordersAreContinuedALittle) {
  const Target<3> t = flat_strip();
  EXPECT_EQ(t.at({5.04, 0.3, -0.05}).feature, Feature::face);
  EXPECT_FALSE(t.at({5.04, 0.3, -0.05}).beyond_end);
  EXPECT_TRUE(t.at({5.2, 0.3, -0.05}).beyond_end);
  EXPECT_TRUE(t.at({5.2, 1.3, -0.05}).beyond_end);
}

TEST(ClosestOnSurface, OpenBordersAreContinuedAsFarAsThePointAsks) {
  const Target<3> t = flat_strip();
  pairing::ProjectionQuery<3> query;
  query.beyond_open = pairing::border_tolerance;
  const auto beyond = [&](double x) {
    query.point = {x, 0.3, -0.05};
    return t.at(query).beyond_end;
  };
  EXPECT_FALSE(beyond(4.99));
  EXPECT_TRUE(beyond(5.001));
  query.kept = t.at(query).facet;  // only to its neighbour a facet is kept
  EXPECT_TRUE(beyond(5.001));
  EXPECT_FALSE(beyond(1.001)) << "between neighbours";
}

}  // namespace
}  // namespace osculate::testing
