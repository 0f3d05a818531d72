// Arc length along chains and its gradient.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "derivative_check.hpp"
#include "pair_sample.hpp"

namespace osculate::testing {
namespace {

using pairing::Location;

double length(const PairSample& s, const Eigen::VectorXd& v, const Location& a, const Location& b) {
  return pairing::path_length(s.pair.master, unflatten(v), a, b, nullptr).value();
}

// [eq:KS2D:19]
TEST(PathLength, IsTheArcLengthOverAllBordersBothWays) {
  const PairSample s = make_sample({});  // straight, facet lengths 1, 3, 1
  const Eigen::VectorXd v = flatten(s.x);
  EXPECT_NEAR(length(s, v, {0, 0.0}, {2, 0.0}), 0.5 + 3.0 + 0.5, 1e-14);
  EXPECT_NEAR(length(s, v, {2, 0.0}, {0, 0.0}), -4.0, 1e-14);
  EXPECT_NEAR(length(s, v, {1, -1.0}, {1, 1.0}), 3.0, 1e-14);
}

TEST(PathLength, GradientIsItsDerivative) {
  for (const int nodes : {2, 3, 4})
    for (const Location from : {Location{0, -0.3}, Location{1, 0.9}, Location{2, 0.4}}) {
      const PairSample s = make_sample({.nodes_per_facet = nodes, .bend = nodes > 2 ? 0.05 : 0.0});
      const Eigen::VectorXd v = flatten(s.x);
      const Location to{1, 0.2};
      std::vector<pairing::NodeGradient> gradient;
      ASSERT_TRUE(pairing::path_length(s.pair.master, s.x, from, to, &gradient));
      Eigen::VectorXd d(v.size());
      for (Eigen::Index i = 0; i < d.size(); ++i) d[i] = std::sin(3.0 + static_cast<double>(i));
      Eigen::VectorXd expected = Eigen::VectorXd::Zero(1);
      for (const pairing::NodeGradient& g : gradient)
        expected[0] += g.value.dot(d.segment<2>(2 * g.node));
      const DerivativeReport r = check_derivative(
          [&](const Eigen::VectorXd& y) {
            return Eigen::VectorXd(Eigen::VectorXd::Constant(1, length(s, y, from, to)));
          },
          expected, v, d, 2e-3);
      EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1) << r.order << " " << r.error;
    }
}

TEST(PathLength, UnconnectedPlacesHaveNone) {
  PairSample s = make_sample({});
  s.pair.master.facets[0].next = s.pair.master.facets[1].prev = -1;
  EXPECT_FALSE(pairing::path_length(s.pair.master, s.x, {0, 0}, {1, 0}, nullptr));
  EXPECT_FALSE(pairing::path_length(s.pair.master, s.x, {-1, 0}, {1, 0}, nullptr));
}

TEST(PathLength, AClosedCircleIsWalkedTheShortWay) {
  pairing::Chain chain;
  chain.facets = {pairing::shape_facet(geometry::Circle{{1, 2}, 3.0, false}, {0, 1, 2})};
  pairing::connect(chain);
  const std::vector<Vec2> frame{{0, 0}, {1, 0}, {0, 1}};
  const double pi = std::numbers::pi;
  EXPECT_NEAR(*pairing::path_length(chain, frame, {0, 0.1}, {0, 0.6}, nullptr), 1.5, 1e-13);
  EXPECT_NEAR(*pairing::path_length(chain, frame, {0, 0.2}, {0, 2 * pi - 0.3}, nullptr), -1.5,
              1e-13);
}

}  // namespace
}  // namespace osculate::testing
