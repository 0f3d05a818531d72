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
  return pairing::path_length(s.pair.master, unflatten<2>(v), a, b, nullptr).value();
}

/// A closed polygon through `points`, in their order.
pairing::Chain ring(std::size_t points) {
  pairing::Chain chain;
  for (std::size_t i = 0; i < points; ++i)
    chain.facets.push_back(pairing::lagrange_facet(
        std::array<Index, 2>{static_cast<Index>(i), static_cast<Index>((i + 1) % points)}));
  pairing::connect(chain);
  return chain;
}

/// Sum of the gradient over the motion `d` against central differences.
void expect_gradient(const pairing::Chain& chain, const std::vector<Vec2>& x, const Location& from,
                     const Location& to, const std::string& what) {
  const Eigen::VectorXd v = flatten(x);
  Eigen::VectorXd d(v.size());
  for (Eigen::Index i = 0; i < d.size(); ++i) d[i] = std::sin(3.0 + static_cast<double>(i));
  std::vector<pairing::NodeGradient<2>> gradient;
  ASSERT_TRUE(pairing::path_length(chain, x, from, to, &gradient)) << what;
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(1);
  for (const pairing::NodeGradient<2>& g : gradient)
    expected[0] += g.value.dot(d.segment<2>(2 * g.node));
  const DerivativeReport r = check_derivative(
      [&](const Eigen::VectorXd& y) {
        return Eigen::VectorXd(Eigen::VectorXd::Constant(
            1, pairing::path_length(chain, unflatten<2>(y), from, to, nullptr).value()));
      },
      expected, v, d, 2e-3);
  EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1) << what << " " << r.order << " " << r.error;
}

// [eq:KS2D:19]
TEST(PathLength, IsTheArcLengthOverAllBordersBothWays) {
  const PairSample s = make_sample({});  // straight, facet lengths 1, 3, 1
  const Eigen::VectorXd v = flatten(s.x);
  EXPECT_NEAR(length(s, v, {0, 0.0}, {2, 0.0}), 0.5 + 3.0 + 0.5, 1e-14);
  EXPECT_NEAR(length(s, v, {2, 0.0}, {0, 0.0}), -4.0, 1e-14);
  EXPECT_NEAR(length(s, v, {1, -1.0}, {1, 1.0}), 3.0, 1e-14);
}

// [eq:KS2D:19] y = x^2 / 2 over -1..1 as one quadratic facet: sqrt 2 + asinh 1.
TEST(PathLength, OfAParabola) {
  pairing::Chain chain;
  chain.facets = {pairing::lagrange_facet(std::array<Index, 3>{0, 1, 2})};
  const std::vector<Vec2> x{{-1, 0.5}, {1, 0.5}, {0, 0}};
  const double exact = std::numbers::sqrt2 + std::asinh(1.0);
  EXPECT_NEAR(*pairing::path_length(chain, x, {0, -1}, {0, 1}, nullptr), exact, 1e-8);
  EXPECT_NEAR(*pairing::path_length(chain, x, {0, 1}, {0, 0}, nullptr), -exact / 2, 1e-12);
}

// Additive over the places on the way, also across borders of curved facets.
TEST(PathLength, AddsUpAlongCurvedFacets) {
  for (const int nodes : {3, 4}) {
    const PairSample s = make_sample({.nodes_per_facet = nodes, .bend = 0.05});
    const Eigen::VectorXd v = flatten(s.x);
    const Location a{0, -0.4}, b{1, 0.3}, c{2, 0.8};
    EXPECT_NEAR(length(s, v, a, b) + length(s, v, b, c), length(s, v, a, c), 1e-9);
    EXPECT_NEAR(length(s, v, a, c), -length(s, v, c, a), 1e-14);
    EXPECT_NEAR(length(s, v, {0, 1}, {1, -1}), 0.0, 1e-15);  // one place with two names
  }
}

TEST(PathLength, GradientIsItsDerivative) {
  for (const int nodes : {2, 3, 4})
    for (const Location from : {Location{0, -0.3}, Location{1, 0.9}, Location{2, 0.4}}) {
      const PairSample s = make_sample({.nodes_per_facet = nodes, .bend = nodes > 2 ? 0.05 : 0.0});
      expect_gradient(s.pair.master, s.x, from, {1, 0.2},
                      std::to_string(nodes) + " nodes from " + std::to_string(from.facet));
    }
}

TEST(PathLength, GradientOnClosedChainsAndRigidShapes) {
  const std::vector<Vec2> square{{0, 0}, {0, 2}, {2, 2}, {2, 0}};
  expect_gradient(ring(4), square, {3, 0.4}, {0, -0.6}, "ring, forward over its start");
  expect_gradient(ring(4), square, {0, -0.6}, {3, 0.4}, "ring, backward over its start");
  pairing::Chain circle;
  circle.facets = {pairing::shape_facet(geometry::Circle{{1, 2}, 3.0, false}, {0, 1, 2})};
  pairing::connect(circle);
  expect_gradient(circle, {{0, 0}, {1, 0}, {0, 1}}, {0, 6.1}, {0, 0.3}, "circle over its seam");
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

TEST(PathLength, AHoleIsWalkedTheShortWayToo) {
  pairing::Chain chain;
  chain.facets = {pairing::shape_facet(geometry::Circle{{1, 2}, 3.0, true}, {0, 1, 2})};
  pairing::connect(chain);
  const std::vector<Vec2> frame{{0, 0}, {1, 0}, {0, 1}};
  const double pi = std::numbers::pi;
  EXPECT_NEAR(*pairing::path_length(chain, frame, {0, 2 * pi - 0.3}, {0, 0.2}, nullptr), 1.5,
              1e-13);
}

TEST(PathLength, AClosedChainIsWalkedTheShortWay) {
  const std::vector<Vec2> square{{0, 0}, {0, 2}, {2, 2}, {2, 0}};
  const pairing::Chain chain = ring(4);
  EXPECT_EQ(chain.facets[0].prev, 3);
  EXPECT_EQ(chain.facets[3].next, 0);
  const auto walk = [&](const Location& a, const Location& b) {
    return *pairing::path_length(chain, square, a, b, nullptr);
  };
  EXPECT_NEAR(walk({3, 0.5}, {0, -0.5}), 1.0, 1e-14);
  EXPECT_NEAR(walk({0, -0.5}, {3, 0.5}), -1.0, 1e-14);
  EXPECT_NEAR(walk({0, 0.5}, {1, -0.5}), 1.0, 1e-14);
  EXPECT_NEAR(walk({0, -0.2}, {2, -0.3}), 2.9 + 1.0, 1e-14 * 4);  // opposite sides: by length
  EXPECT_NEAR(walk({0, -0.3}, {2, -0.2}), -2.9 - 1.0, 1e-14 * 4);
}

// Two half circles are neighbours at both their ends: counting borders cannot tell the way.
TEST(PathLength, ARingOfTwoFacetsIsWalkedTheShortWay) {
  pairing::Chain chain;
  chain.facets = {pairing::lagrange_facet(std::array<Index, 3>{0, 1, 2}),
                  pairing::lagrange_facet(std::array<Index, 3>{1, 0, 3})};
  pairing::connect(chain);
  const std::vector<Vec2> x{{-1, 0}, {1, 0}, {0, 1}, {0, -1}};
  const auto walk = [&](const Location& a, const Location& b) {
    return *pairing::path_length(chain, x, a, b, nullptr);
  };
  const double near = std::abs(walk({0, 0.9}, {0, 1.0}));
  EXPECT_NEAR(walk({0, 0.9}, {1, -0.9}), 2 * near, 1e-13);
  EXPECT_NEAR(walk({1, -0.9}, {0, 0.9}), -2 * near, 1e-13);
  EXPECT_NEAR(walk({1, 0.9}, {0, -0.9}), 2 * near, 1e-13);
  EXPECT_NEAR(walk({0, -0.9}, {1, 0.9}), -2 * near, 1e-13);
}

}  // namespace
}  // namespace osculate::testing
