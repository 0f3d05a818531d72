// Shape functions of facets: nodal values, sums, agreement with AreaShape, derivatives by order.
#include "osculate/cell/facet_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "osculate/cell/linear_facet.hpp"
#include "osculate/cell/quadratic_facet.hpp"
#include "osculate/cell/shape.hpp"

namespace osculate::cell {
namespace {

constexpr std::array<CellType, 5> facets{CellType::tri3, CellType::tri6, CellType::quad4,
                                         CellType::quad8, CellType::quad9};

TEST(FacetShape, OneAtItsNodeAndZeroAtTheOthers) {
  for (const CellType type : facets)
    for (int k = 0; k < info(type).nodes; ++k) {
      const FacetShape s = facet_shape(type, area_node(type, k));
      ASSERT_EQ(s.count, info(type).nodes);
      for (int l = 0; l < s.count; ++l)
        EXPECT_EQ(s.n[0][static_cast<std::size_t>(l)], k == l ? 1.0 : 0.0) << info(type).name;
    }
}

TEST(FacetShape, AgreesWithAreaShape) {
  const Vec2 xi(0.31, 0.22);
  for (const CellType type : facets) {
    const FacetShape s = facet_shape(type, xi);
    const AreaShape a = area_shape(type, xi);
    for (int k = 0; k < s.count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      EXPECT_NEAR(s.n[0][i], a.n[k], 1e-15) << info(type).name;
      EXPECT_NEAR(s.n[1][i], a.d(k, 0), 1e-15) << info(type).name;
      EXPECT_NEAR(s.n[2][i], a.d(k, 1), 1e-15) << info(type).name;
    }
  }
}

TEST(LinearFacet, IsTheSumOverItsShapeFunctions) {
  const std::array<Vec3, 4> x{Vec3(0.1, 0.2, -0.3), Vec3(1.2, 0.1, 0.4), Vec3(1.5, 1.3, -0.2),
                              Vec3(-0.2, 0.9, 0.5)};
  const auto node = [&](std::size_t k) -> const Vec3& { return x[k]; };
  for (const CellType type : facets) {
    if (!is_linear_facet(type)) continue;
    for (const Vec2& xi : {Vec2(0.31, 0.22), Vec2(0, 0), Vec2(-0.7, 0.9)}) {
      const FacetShape s = facet_shape(type, xi, 2);
      const FacetDerivatives r = linear_facet(type, node, xi);
      for (std::size_t d = 0; d < r.size(); ++d) {
        Vec3 sum = Vec3::Zero();
        for (std::size_t k = 0; k < static_cast<std::size_t>(s.count); ++k) sum += s.n[d][k] * x[k];
        EXPECT_LT((r[d] - sum).norm(), 1e-15) << info(type).name << " " << d;
      }
    }
  }
}

TEST(QuadraticFacet, IsTheSumOverItsShapeFunctions) {
  const std::array<Vec3, 9> x{Vec3(0.1, 0.2, -0.3), Vec3(1.2, 0.1, 0.4),  Vec3(1.5, 1.3, -0.2),
                              Vec3(-0.2, 0.9, 0.5), Vec3(0.6, 0.1, 0.3),  Vec3(1.3, 0.7, -0.1),
                              Vec3(0.5, 1.2, 0.7),  Vec3(-0.1, 0.5, 0.1), Vec3(0.4, 0.6, 0.2)};
  for (const CellType type : facets) {
    if (is_linear_facet(type)) continue;
    const QuadraticFacet f =
        quadratic_facet(type, [&](std::size_t k) -> const Vec3& { return x[k]; });
    for (const Vec2& xi : {Vec2(0.31, 0.22), Vec2(0, 0), Vec2(1, 0), Vec2(-0.7, 0.9)}) {
      const FacetShape s = facet_shape(type, xi, 2);
      const FacetDerivatives r = f.at(xi);
      for (std::size_t d = 0; d < r.size(); ++d) {
        Vec3 sum = Vec3::Zero();
        for (std::size_t k = 0; k < static_cast<std::size_t>(s.count); ++k) sum += s.n[d][k] * x[k];
        EXPECT_LT((r[d] - sum).norm(), 1e-14) << info(type).name << " " << d;
      }
    }
  }
}

// Polynomials of degree two per variable: the central difference of each derivative is exact.
TEST(FacetShape, EveryDerivativeIsTheDerivativeOfTheOneBelow) {
  constexpr double h = 0.25;
  constexpr std::array<std::array<std::size_t, 2>, 6> up{
      {{1, 2}, {3, 4}, {4, 5}, {6, 7}, {7, 8}, {8, 9}}};  // of 0, 1, 2, 3, 4, 5
  const Vec2 xi(0.31, -0.2);
  for (const CellType type : facets)
    for (std::size_t d = 0; d < up.size(); ++d)
      for (int direction = 0; direction < 2; ++direction) {
        const Vec2 step = h * Vec2::Unit(direction);
        const FacetShape plus = facet_shape(type, xi + step), minus = facet_shape(type, xi - step);
        const FacetShape at = facet_shape(type, xi);
        for (std::size_t k = 0; k < static_cast<std::size_t>(at.count); ++k)
          EXPECT_NEAR((plus.n[d][k] - minus.n[d][k]) / (2 * h),
                      at.n[up[d][static_cast<std::size_t>(direction)]][k], 1e-14)
              << info(type).name << " " << d;
      }
}

TEST(FacetShape, ValuesSumToOneAndDerivativesToZero) {
  for (const CellType type : facets) {
    const FacetShape s = facet_shape(type, {0.2, 0.4});
    for (std::size_t d = 0; d < s.n.size(); ++d) {
      double sum = 0;
      for (const double value : s.n[d]) sum += value;
      EXPECT_NEAR(sum, d == 0 ? 1.0 : 0.0, 1e-14) << info(type).name << " " << d;
    }
  }
}

TEST(FacetShape, BilinearOnesInPlaceAreTheSame) {
  for (const Vec2& xi : {Vec2(0.31, -0.2), Vec2(-1, 0.7), Vec2(1.3, 1)}) {
    const FacetShape expected = facet_shape(CellType::quad4, xi, 2);
    FacetShape s = facet_shape(CellType::quad9, Vec2(0.1, 0.6), 2);  // of another place
    set_bilinear(xi, s);
    EXPECT_EQ(s.count, 4);
    for (std::size_t d = 0; d < 6; ++d)
      for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(s.n[d][k], expected.n[d][k], 1e-15) << d;
  }
}

}  // namespace
}  // namespace osculate::cell
