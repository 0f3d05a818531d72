// Tributary areas of slave nodes, in the plane and in space.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "derivative_check.hpp"
#include "pair_sample.hpp"

namespace osculate::testing {
namespace {

using cell::CellType;

TEST(SlaveSide, QuadraticLinesShareTheirLengthOneFourOne) {
  pairing::Chain chain;
  chain.facets = {pairing::lagrange_facet(std::array<Index, 3>{0, 1, 2})};
  pairing::connect(chain);
  const pairing::SlaveSide<2> side = pairing::make_slave_side(chain);
  EXPECT_EQ(side.nodes, (std::vector<Index>{0, 2, 1}));  // along the chain
  const std::vector<Vec2> x{{0, 0}, {6, 0}, {3, 0}};
  std::vector<double> areas;
  pairing::nodal_areas(side, x, {2.0, false}, areas, nullptr);
  EXPECT_NEAR(areas[0], 2.0, 1e-14);
  EXPECT_NEAR(areas[1], 8.0, 1e-14);
  EXPECT_NEAR(areas[2], 2.0, 1e-14);
}

TEST(SlaveSide, AxisymmetricAreasSumToTheRing) {
  const double pi = std::numbers::pi;
  pairing::Chain chain;
  chain.facets = {pairing::lagrange_facet(std::array<Index, 2>{0, 1}),
                  pairing::lagrange_facet(std::array<Index, 2>{1, 2})};
  pairing::connect(chain);
  const std::vector<Vec2> x{{0, 0}, {1, 0}, {3, 0}};
  std::vector<double> areas;
  pairing::nodal_areas(pairing::make_slave_side(chain), x, {1.0, true}, areas, nullptr);
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), 9 * pi, 1e-12);
  EXPECT_NEAR(areas[0], pi / 3, 1e-13);
}

pairing::SlaveSide<3> one_facet(CellType type, std::vector<Vec3>& x, double bend) {
  std::vector<Index> nodes;
  for (int k = 0; k < cell::info(type).nodes; ++k) {
    const Vec2 p = cell::area_node(type, k);
    x.emplace_back(2 * p.x(), p.y(), bend * p.x() * p.x());
    nodes.push_back(k);
  }
  pairing::FacetSurface surface;
  surface.facets.push_back(pairing::surface_facet(type, nodes));
  pairing::connect(surface);
  return pairing::make_slave_side(surface);
}

std::vector<double> areas_of(CellType type) {
  std::vector<Vec3> x;
  const pairing::SlaveSide<3> slave = one_facet(type, x, 0.0);
  std::vector<double> areas;
  pairing::nodal_areas(slave, x, {}, areas, nullptr);
  return areas;
}

TEST(NodalAreas, AreConsistentWhereThatIsPositive) {
  for (const double a : areas_of(CellType::quad4)) EXPECT_NEAR(a, 2.0, 1e-14);
  for (const double a : areas_of(CellType::tri3)) EXPECT_NEAR(a, 1.0 / 3, 1e-14);
  const std::vector<double> nine = areas_of(CellType::quad9);
  EXPECT_NEAR(nine[0], 8.0 / 36, 1e-14);
  EXPECT_NEAR(nine[4], 8.0 * 4 / 36, 1e-14);
  EXPECT_NEAR(nine[8], 8.0 * 16 / 36, 1e-14);
}

// int N^2 over the reference cell: tri6 1/60 and 4/45 per corner and middle, so shares 3/57 and
// 16/57; quad8 2/15 and 32/45 (corners 6/45), so shares 3/76 and 16/76.
TEST(NodalAreas, ArePositiveForTri6AndQuad8) {
  const std::vector<double> six = areas_of(CellType::tri6);
  const std::vector<double> eight = areas_of(CellType::quad8);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(six[k], 3.0 / 57, 1e-14);
    EXPECT_NEAR(six[k + 3], 16.0 / 57, 1e-14);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(eight[k], 8 * 3.0 / 76, 1e-14);
    EXPECT_NEAR(eight[k + 4], 8 * 16.0 / 76, 1e-14);
  }
}

template <int Dim>
void expect_area_gradients(const pairing::SlaveSide<Dim>& side, const std::vector<Vec<Dim>>& x,
                           const pairing::AreaRule& rule, double h) {
  const Eigen::VectorXd v = flatten(x);
  Eigen::VectorXd d(v.size());
  for (Eigen::Index i = 0; i < d.size(); ++i) d[i] = std::cos(2.0 + static_cast<double>(i));
  const auto areas = [&](const Eigen::VectorXd& y) -> Eigen::VectorXd {
    std::vector<double> a;
    pairing::nodal_areas(side, unflatten<Dim>(y), rule, a, nullptr);
    return Eigen::Map<Eigen::VectorXd>(a.data(), static_cast<Eigen::Index>(a.size()));
  };
  std::vector<double> a;
  std::vector<std::vector<pairing::NodeGradient<Dim>>> gradients;
  pairing::nodal_areas(side, x, rule, a, &gradients);
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(a.size()));
  for (std::size_t i = 0; i < gradients.size(); ++i)
    for (const pairing::NodeGradient<Dim>& g : gradients[i])
      expected[static_cast<Eigen::Index>(i)] += g.value.dot(d.segment<Dim>(Dim * g.node));
  const DerivativeReport r = check_derivative(areas, expected, v, d, h);
  EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1) << r.order << " " << r.error;
}

TEST(SlaveSide, AreaGradientsAreDerivatives) {
  for (const bool axisymmetric : {false, true})
    for (const int nodes : {2, 3}) {
      const PairSample s = make_sample({.nodes_per_facet = nodes, .bend = nodes > 2 ? 0.05 : 0.0});
      expect_area_gradients<2>(pairing::make_slave_side(s.pair.master), s.x, {1.5, axisymmetric},
                               1e-2);
    }
}

TEST(SlaveSide, AreaGradientsInSpaceAreDerivatives) {
  for (const CellType type :
       {CellType::tri3, CellType::tri6, CellType::quad4, CellType::quad8, CellType::quad9}) {
    SCOPED_TRACE(cell::info(type).name);
    std::vector<Vec3> x;
    const pairing::SlaveSide<3> side = one_facet(type, x, 0.2);
    expect_area_gradients<3>(side, x, {}, 1e-3);
  }
}

}  // namespace
}  // namespace osculate::testing
