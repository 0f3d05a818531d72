// Slave facets that edges of a master cut: parts, their points and weights.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numeric>

#include "osculate/pairing/cut_facets.hpp"
#include "osculate/pairing/sampling.hpp"

namespace osculate::testing {
namespace {

using pairing::CellPart;
using pairing::FacetCutter;
using pairing::Sampling;
using Rule = pairing::Sampling::Rule;

// ---- in the plane -----------------------------------------------------------------------------

/// A slave line from (0, 0) to (4, 0), whose outside is below it, and a master under it.
struct Lines {
  std::vector<Vec2> x{{0, 0}, {4, 0}};
  pairing::Chain slave, master;

  explicit Lines(const std::vector<Vec2>& under) {
    slave.facets.push_back(pairing::lagrange_facet(std::array<Index, 2>{0, 1}));
    for (const Vec2& p : under) x.push_back(p);
    for (Index k = 2; k + 1 < static_cast<Index>(x.size()); ++k)
      master.facets.push_back(pairing::lagrange_facet(std::array<Index, 2>{k, k + 1}));
  }
  [[nodiscard]] std::vector<double> cuts() const {
    std::vector<double> at;
    for (const CellPart<2>& part : FacetCutter<2>(slave, master, x).parts(0))
      at.push_back(part.corners[1][0]);
    return at;
  }
};

TEST(CutFacets, LinesAreCutBelowTheEndsOfOthers) {
  const double y = -0.1;
  EXPECT_EQ(Lines({{3, y}, {1, y}}).cuts(), (std::vector<double>{-0.5, 0.5, 1}));
  EXPECT_EQ(Lines({{5, y}, {3, y}, {2, y}, {-1, y}}).cuts(), (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(Lines({{4, y}, {0, y}}).cuts(), std::vector<double>{});        // ends on ends
  EXPECT_EQ(Lines({{4, y}, {1e-5, y}}).cuts(), std::vector<double>{});     // nearly so
  EXPECT_EQ(Lines({{1, y}, {3, y}}).cuts(), std::vector<double>{});        // faces the same way
  EXPECT_EQ(Lines({{3, -4.1}, {1, -4.1}}).cuts(), std::vector<double>{});  // too far off
}

// ---- in space ---------------------------------------------------------------------------------

/// A slave square 0..2 that looks down and quadrilaterals or triangles under it, each by corners.
struct Squares {
  std::vector<Vec3> x;
  pairing::FacetSurface slave, master;

  explicit Squares(const std::vector<std::vector<Vec2>>& under, const Mat<3, 3>& turned,
                   double depth = -0.1) {
    const auto add = [&](const std::vector<Vec2>& corners, double z, pairing::FacetSurface& to) {
      std::vector<Index> nodes;
      for (const Vec2& p : corners) {
        nodes.push_back(static_cast<Index>(x.size()));
        x.emplace_back(turned * Vec3(p.x(), p.y(), z));
      }
      to.facets.push_back(pairing::surface_facet(
          corners.size() == 3 ? cell::CellType::tri3 : cell::CellType::quad4, nodes));
    };
    add({{0, 0}, {0, 2}, {2, 2}, {2, 0}}, 0, slave);
    for (const std::vector<Vec2>& corners : under) add(corners, depth, master);
  }
  explicit Squares(const std::vector<std::vector<Vec2>>& under)
      : Squares(under, Mat<3, 3>::Identity()) {}

  [[nodiscard]] std::vector<CellPart<3>> parts() const {
    return FacetCutter<3>(slave, master, x).parts(0);
  }
  /// The integral over the slave of a function of its x and y, by points on its parts.
  template <class F>
  [[nodiscard]] double integral(int points, const F& f) const {
    pairing::SlaveSide<3> side = pairing::make_slave_side(slave);
    pairing::sample<3>(side, {Rule::gauss, points, 1, true}, {&master, x});
    std::vector<double> areas;
    pairing::point_areas<3>(side, x, {}, areas, nullptr);
    double sum = 0;
    for (std::size_t i = 0; i < areas.size(); ++i)
      sum += areas[i] * f(pairing::position<3>(side.points[i], x));
    return sum;
  }
};

std::vector<Vec2> box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}
double area_of(const CellPart<3>& part) {
  double twice = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(part.count); ++k) {
    const Vec2 &a = part.corners[k],
               &b = part.corners[(k + 1) % static_cast<std::size_t>(part.count)];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}
double sum_of_areas(const std::vector<CellPart<3>>& parts) {
  return std::accumulate(parts.begin(), parts.end(), 0.0,
                         [](double sum, const auto& part) { return sum + area_of(part); });
}

TEST(CutFacets, EachPartLiesOverOneFacet) {
  const Squares four(
      {box(-1, -1, 0.5, 1), box(0.5, -1, 3, 1), box(-1, 1, 0.5, 3), box(0.5, 1, 3, 3)});
  const auto parts = four.parts();
  ASSERT_EQ(parts.size(), 4u);
  std::vector<double> areas;
  for (const auto& part : parts) areas.push_back(area_of(part));
  std::ranges::sort(areas);
  EXPECT_NEAR(areas[0], 0.5, 1e-14);  // of the cell, whose area is 4
  EXPECT_NEAR(areas[3], 1.5, 1e-14);
  EXPECT_NEAR(sum_of_areas(parts), 4, 1e-14);
  for (const auto& part : parts) EXPECT_EQ(part.count, 4);
}

TEST(CutFacets, WhatIsOverNoneHasPartsOfItsOwn) {
  const auto parts = Squares({box(0.5, 0.5, 1, 1)}).parts();
  EXPECT_NEAR(sum_of_areas(parts), 4, 1e-14);
  EXPECT_NEAR(area_of(parts[0]), 0.25, 1e-14);  // the one over the facet is the first
  for (const auto& part : parts) EXPECT_GT(area_of(part), 0);
  // corners cut off a triangle and leave a pentagon: a quadrilateral and a triangle
  const auto corner = Squares({{{-1, -1}, {2, -1}, {-1, 2}}}).parts();
  EXPECT_NEAR(sum_of_areas(corner), 4, 1e-14);
}

TEST(CutFacets, NothingIsCutWithoutAnEdgeAcrossOrByLayers) {
  EXPECT_TRUE(Squares({}).parts().empty());
  EXPECT_TRUE(Squares({box(-1, -1, 3, 3)}).parts().empty());
  EXPECT_TRUE(Squares({box(0, 0, 2, 2)}).parts().empty());
  EXPECT_TRUE(Squares({box(-1, -1, 1, 3), box(-1, -1, 3, 3)}).parts().empty());  // two layers
  EXPECT_TRUE(Squares({{{-1, -1}, {-1, 3}, {1, 3}, {1, -1}}}).parts().empty());  // looks down, too
  const Squares far({box(-1, -1, 1, 3)}, Mat<3, 3>::Identity(), -4);
  EXPECT_TRUE(far.parts().empty());
}

TEST(CutFacets, FacetsWithoutAreaOrBentInwardsAreNotCut) {
  const std::vector<std::vector<Vec2>> halves{box(-1, -1, 1, 3), box(1, -1, 3, 3)};
  EXPECT_EQ(Squares(halves).parts().size(), 2u);
  for (const auto& corners : {std::vector<Vec3>{{0, 0, 0}, {0, 2, 0}, {0, 2, 0}, {0, 0, 0}},
                              std::vector<Vec3>{{0, 0, 0}, {0, 2, 0}, {2, 2, 0}, {2, 2, 0}},
                              std::vector<Vec3>{{0, 0, 0}, {0, 2, 0}, {2, 2, 0}, {0.5, 1.5, 0}}}) {
    Squares pair(halves);
    for (std::size_t k = 0; k < 4; ++k) pair.x[k] = corners[k];
    EXPECT_TRUE(pair.parts().empty());
  }
}

/// A function that bends where the master's facets meet is integrated exactly, also turned.
TEST(CutFacets, KinksOverEdgesAreIntegratedExactly) {
  const std::vector<std::vector<Vec2>> halves{{{-1, -1}, {1.4, -1}, {0.2, 3}, {-1, 3}},
                                              {{1.4, -1}, {3, -1}, {3, 3}, {0.2, 3}}};
  const Mat<3, 3> turned = Eigen::AngleAxisd(0.7, Vec3(1, 2, -0.5).normalized()).toRotationMatrix();
  const Squares pair(halves, turned);
  // |distance from the edge|, exact: on both sides of 1.4 - 0.3 (y + 1) in every row of y
  const auto kink = [&](const Vec3& r) {
    const Vec3 p = turned.transpose() * r;
    return std::abs(p.x() - 1.4 + 0.3 * (p.y() + 1));
  };
  double exact = 0;  // int_0^2 (c^2 + (2 - c)^2) / 2 dy with c = 1.1 - 0.3 y
  for (const double y : {1 - std::sqrt(0.6), 1.0, 1 + std::sqrt(0.6)}) {
    const double c = 1.1 - 0.3 * y;
    exact += (y == 1 ? 8.0 : 5.0) / 9 * 0.5 * (c * c + (2 - c) * (2 - c));
  }
  EXPECT_NEAR(pair.integral(2, kink), exact, 1e-14);
  EXPECT_NEAR(pair.integral(3, kink), exact, 1e-14);
  const auto one = [](const Vec3&) { return 1.0; };
  EXPECT_NEAR(pair.integral(2, one), 4, 1e-14);
}

TEST(CutFacets, QuadrilateralsOfAnyShapeKeepTheirArea) {
  Squares pair(
      {box(-1, -1, 0.9, 0.8), box(0.9, -1, 3, 0.8), box(-1, 0.8, 0.9, 3), box(0.9, 0.8, 3, 3)});
  pair.x[0] += Vec3(0.3, 0.4, 0);
  pair.x[2] += Vec3(-0.5, 0.1, 0);
  const auto one = [](const Vec3&) { return 1.0; };
  const auto moment = [](const Vec3& r) { return r.x() * r.y(); };
  pairing::SlaveSide<3> side = pairing::make_slave_side(pair.slave);
  pairing::sample<3>(side, {Rule::gauss, 6});
  std::vector<double> areas;
  pairing::point_areas<3>(side, pair.x, {}, areas, nullptr);
  double area = 0, exact = 0;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    area += areas[i];
    exact += areas[i] * moment(pairing::position<3>(side.points[i], pair.x));
  }
  // parts meet along straight lines of the cell
  EXPECT_NEAR(pair.integral(3, one), area, 1e-14 * area);
  EXPECT_NEAR(pair.integral(3, moment), exact, 1e-9 * exact);
}

}  // namespace
}  // namespace osculate::testing
