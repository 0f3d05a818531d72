#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "derivative_check.hpp"
#include "osculate/cell/line_shape.hpp"
#include "osculate/cell/shape.hpp"

namespace osculate::cell {
namespace {

constexpr std::array<CellType, 5> area_types{CellType::tri3, CellType::tri6, CellType::quad4,
                                             CellType::quad8, CellType::quad9};
const std::array<Vec2, 4> places{Vec2(0.2, 0.3), Vec2(-0.7, 0.45), Vec2(0.9, -0.95), Vec2(0, 0)};

TEST(AreaShape, CountsItsNodes) {
  for (const CellType type : area_types)
    EXPECT_EQ(area_shape(type, Vec2::Zero()).count, info(type).nodes) << info(type).name;
}

TEST(AreaShape, IsEmptyForOtherCells) {
  EXPECT_EQ(area_shape(CellType::line3, Vec2::Zero()).count, 0);
  EXPECT_EQ(area_shape(CellType::point1, Vec2::Zero()).count, 0);
}

TEST(AreaShape, IsOneAtItsNodeAndZeroAtTheOthers) {
  for (const CellType type : area_types)
    for (int i = 0; i < info(type).nodes; ++i) {
      const AreaShape s = area_shape(type, area_node(type, i));
      for (int k = 0; k < s.count; ++k)
        EXPECT_EQ(s.n[k], i == k ? 1.0 : 0.0) << info(type).name << i << k;
    }
}

TEST(AreaShape, SumsToOneAndItsSlopesToZero) {
  for (const CellType type : area_types)
    for (const Vec2& xi : places) {
      const AreaShape s = area_shape(type, xi);
      EXPECT_NEAR(s.n.sum(), 1.0, 1e-15) << info(type).name;
      EXPECT_LT(s.d.colwise().sum().norm(), 2e-15) << info(type).name;
    }
}

TEST(AreaShape, ReproducesThePolynomialsOfItsOrder) {
  for (const CellType type : area_types)
    for (int p = 0; p <= info(type).order; ++p)
      for (int q = 0; p + q <= info(type).order; ++q)
        for (const Vec2& xi : places) {
          const AreaShape s = area_shape(type, xi);
          double sum = 0;
          for (int k = 0; k < s.count; ++k) {
            const Vec2 at = area_node(type, k);
            sum += s.n[k] * std::pow(at.x(), p) * std::pow(at.y(), q);
          }
          EXPECT_NEAR(sum, std::pow(xi.x(), p) * std::pow(xi.y(), q), 1e-15) << info(type).name;
        }
}

TEST(AreaShape, SlopesAreTheDerivatives) {
  for (const CellType type : area_types)
    for (const Vec2& xi : places) {
      const Vec2 along(0.6, -0.8);
      const AreaShape s = area_shape(type, xi);
      const auto values = [&](const Vec2& at) -> Eigen::VectorXd { return area_shape(type, at).n; };
      const testing::DerivativeReport r = testing::check_derivative(values, s.d * along, xi, along);
      EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1)
          << info(type).name << " order " << r.order << " error " << r.error;
    }
}

// On an edge only the nodes of the edge count, with the shape functions of the line in its order:
// neighbours meet without a gap.
TEST(AreaShape, IsTheLineOfTheEdgeOnAnEdge) {
  for (const CellType type : area_types) {
    const CellInfo& cell = info(type);
    for (std::size_t e = 0; e < static_cast<std::size_t>(cell.edge_count); ++e) {
      const int nodes = info(cell.edge_type).nodes;
      const double t = 0.37;
      const LineShape line = lagrange_line(nodes, t);
      const Vec2 from = area_node(type, cell.edges[e][0]), to = area_node(type, cell.edges[e][1]);
      const Vec2 xi = 0.5 * (1 - t) * from + 0.5 * (1 + t) * to;
      Vec<max_area_nodes> rest = area_shape(type, xi).n;
      for (std::size_t k = 0; k < static_cast<std::size_t>(nodes); ++k)
        rest[cell.edges[e][k]] -= line.n[0][k];
      EXPECT_LT(rest.norm(), 1e-15) << cell.name << " edge " << e;
    }
  }
}

}  // namespace
}  // namespace osculate::cell
