// Tributary areas and normals of slave nodes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "derivative_check.hpp"
#include "pair_sample.hpp"

namespace osculate::testing {
namespace {

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

TEST(SlaveSide, AreaGradientsAreDerivatives) {
  for (const bool axisymmetric : {false, true})
    for (const int nodes : {2, 3}) {
      const PairSample s = make_sample({.nodes_per_facet = nodes, .bend = nodes > 2 ? 0.05 : 0.0});
      const pairing::SlaveSide<2> side = pairing::make_slave_side(s.pair.master);
      const pairing::AreaRule rule{1.5, axisymmetric};
      const Eigen::VectorXd v = flatten(s.x);
      Eigen::VectorXd d(v.size());
      for (Eigen::Index i = 0; i < d.size(); ++i) d[i] = std::cos(2.0 + static_cast<double>(i));
      std::vector<double> areas;
      std::vector<std::vector<pairing::NodeGradient<2>>> gradients;
      pairing::nodal_areas(side, s.x, rule, areas, &gradients);
      Eigen::VectorXd expected = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(areas.size()));
      for (std::size_t i = 0; i < areas.size(); ++i)
        for (const pairing::NodeGradient<2>& g : gradients[i])
          expected[static_cast<Eigen::Index>(i)] += g.value.dot(d.segment<2>(2 * g.node));
      const DerivativeReport r = check_derivative(
          [&](const Eigen::VectorXd& y) {
            std::vector<double> a;
            pairing::nodal_areas(side, unflatten(y), rule, a, nullptr);
            return Eigen::VectorXd(
                Eigen::Map<Eigen::VectorXd>(a.data(), static_cast<Eigen::Index>(a.size())));
          },
          expected, v, d, 1e-2);
      EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1) << r.order << " " << r.error;
    }
}

}  // namespace
}  // namespace osculate::testing
