// Smooth curves through the nodes of first-order facets.
#include "osculate/pairing/smoothing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "expect_derivative.hpp"
#include "osculate/projection/point_to_curve.hpp"
#include "pair_sample.hpp"

namespace osculate::testing {
namespace {

using contact::Status;
using pairing::Chain;
using pairing::Smoothing;
using pairing::SmoothingKind;
using projection::Feature;

constexpr std::array<SmoothingKind, 2> kinds{SmoothingKind::hermite, SmoothingKind::nurbs};

Chain chain_of(Index facets, bool ring) {
  Chain chain;
  for (Index i = 0; i < facets; ++i)
    chain.facets.push_back(
        pairing::lagrange_facet(std::array<Index, 2>{i, ring ? (i + 1) % facets : i + 1}));
  pairing::connect(chain);
  return chain;
}

/// Corners of a polygon on a circle, clockwise, unequal angles between them for `uneven` > 0.
std::vector<Vec2> circle(int count, double radius = 1, double uneven = 0) {
  std::vector<Vec2> x;
  for (int i = 0; i < count; ++i) {
    const double angle = -2 * std::numbers::pi * (i + uneven * std::sin(1.0 + 2.0 * i)) / count;
    x.push_back(radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return x;
}

/// A chain smoothed in one configuration, and another one that it is in now.
struct Deformed {
  Chain chain;
  std::vector<Vec2> reference, x;
};

Deformed deformed_ring(SmoothingKind kind, int count = 9) {
  Deformed d{chain_of(count, true), circle(count, 1, 0.2), {}};
  smooth(d.chain, d.reference, Smoothing{kind, 2.0});
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(-0.1, 0.1);
  for (const Vec2& p : d.reference) {
    const double a = uniform(generator);
    const double b = uniform(generator);
    d.x.emplace_back(p + Vec2(a, b));
  }
  return d;
}

geometry::CurveJet<2> jet_at(const Deformed& d, std::size_t f, double xi) {
  return pairing::facet_jet(d.chain.facets[f], xi, d.x);
}

TEST(Smoothing, PassesThroughTheNodesWithOneNormal) {
  for (const SmoothingKind kind : kinds) {
    const Deformed d = deformed_ring(kind);
    for (std::size_t f = 0; f < d.chain.facets.size(); ++f) {
      const pairing::Facet& facet = d.chain.facets[f];
      ASSERT_EQ(facet.count, 4);
      const auto next = static_cast<std::size_t>(facet.next);
      EXPECT_LT((jet_at(d, f, -1).r - d.x[f]).norm(), 1e-15);
      EXPECT_LT((jet_at(d, f, 1).r - jet_at(d, next, -1).r).norm(), 1e-15);
      const Vec2 before = turn(jet_at(d, f, 1).r1).normalized(),
                 after = turn(jet_at(d, next, -1).r1).normalized();
      EXPECT_LT((before - after).norm(), 1e-12);
    }
  }
}

// By the reference length t the derivatives themselves are continuous: the first of both kinds,
// the second of `nurbs`.
TEST(Smoothing, ContinuityInTheReferenceLength) {
  for (const SmoothingKind kind : kinds) {
    const Deformed d = deformed_ring(kind);
    double largest = 0;
    for (std::size_t f = 0; f < d.chain.facets.size(); ++f) {
      const auto next = static_cast<std::size_t>(d.chain.facets[f].next);
      const auto length = [&](std::size_t i) {
        return (d.reference[(i + 1) % d.reference.size()] - d.reference[i]).norm();
      };
      const double a = 2 / length(f), b = 2 / length(next);  // d(xi)/dt
      const geometry::CurveJet<2> before = jet_at(d, f, 1), after = jet_at(d, next, -1);
      EXPECT_LT((a * before.r1 - b * after.r1).norm(), 1e-13);
      largest = std::max(largest, (a * a * before.r2 - b * b * after.r2).norm());
    }
    if (kind == SmoothingKind::nurbs) {
      EXPECT_LT(largest, 1e-11);
    } else {
      EXPECT_GT(largest, 0.1);
    }
  }
}

TEST(Smoothing, ShapeFunctionsSumToOneAndKeepParabolas) {
  for (const SmoothingKind kind : kinds)
    for (const bool ring : {false, true}) {
      Chain chain = chain_of(6, ring);
      std::vector<Vec2> reference = circle(ring ? 6 : 7, 1, 0.2);
      smooth(chain, reference, Smoothing{kind, 3.0});
      for (const pairing::Facet& facet : chain.facets)
        for (const double xi : {-1.0, -0.3, 0.4, 1.0}) {
          const cell::LineShape shape = pairing::facet_shape(facet, xi);
          for (std::size_t order = 0; order < 4; ++order) {
            double sum = 0;
            for (int k = 0; k < shape.count; ++k)
              sum += shape.n[order][static_cast<std::size_t>(k)];
            EXPECT_NEAR(sum, order == 0 ? 1 : 0, 1e-12);
          }
        }
    }
  // Nodes on a parabola, unequally spaced: linear and quadratic precision, ends included.
  const std::vector<double> t{0, 1, 3, 3.5, 5, 6};
  std::vector<Vec2> straight, bent;
  for (const double at : t) {
    straight.emplace_back(at, 0);
    bent.emplace_back(2 * at - 1, 0.3 * at * at);
  }
  for (const SmoothingKind kind : kinds) {
    Chain chain = chain_of(5, false);
    smooth(chain, straight, Smoothing{kind, 0.5});
    for (std::size_t f = 0; f < 5; ++f)
      for (const double xi : {-0.7, 0.1, 0.9}) {
        const double at = t[f] + 0.5 * (1 + xi) * (t[f + 1] - t[f]);
        const geometry::CurveJet<2> line = pairing::facet_jet(chain.facets[f], xi, straight),
                                    parabola = pairing::facet_jet(chain.facets[f], xi, bent);
        EXPECT_LT((line.r - Vec2(at, 0)).norm(), 1e-14);
        EXPECT_LT((parabola.r - Vec2(2 * at - 1, 0.3 * at * at)).norm(), 1e-13);
      }
  }
}

TEST(Smoothing, DerivativesOfTheShapeFunctions) {
  const Deformed h = deformed_ring(SmoothingKind::hermite), n = deformed_ring(SmoothingKind::nurbs);
  for (const Deformed* d : {&h, &n})
    for (const double xi : {-0.8, 0.1, 0.7}) {
      const auto at = [&](double s) { return jet_at(*d, 3, s); };
      const double step = 1e-3;
      const auto error = [&](double by) {
        const geometry::CurveJet<2> a = at(xi - by), b = at(xi + by), c = at(xi);
        return std::array<double, 3>{((b.r - a.r) / (2 * by) - c.r1).norm(),
                                     ((b.r1 - a.r1) / (2 * by) - c.r2).norm(),
                                     ((b.r2 - a.r2) / (2 * by) - c.r3).norm()};
      };
      const std::array<double, 3> coarse = error(step), fine = error(step / 2);
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_TRUE(coarse[i] < 1e-11 || std::abs(std::log2(coarse[i] / fine[i]) - 2) < 0.1) << i;
    }
}

// Distance from the circle: fourth order of the facet length, and far less than that of polygons.
TEST(Smoothing, ApproachesACircle) {
  const auto error = [](SmoothingKind kind, int count) {
    Chain chain = chain_of(count, true);
    const std::vector<Vec2> x = circle(count);
    smooth(chain, x, Smoothing{kind, 1.0});
    double worst = 0;
    for (double xi = -1; xi <= 1; xi += 0.01)
      worst = std::max(worst, std::abs(pairing::facet_jet(chain.facets[0], xi, x).r.norm() - 1));
    return worst;
  };
  for (const SmoothingKind kind : kinds) {
    EXPECT_NEAR(std::log2(error(kind, 24) / error(kind, 48)), 4, 0.1);
    EXPECT_LT(error(kind, 24), 0.05 * (1 - std::cos(std::numbers::pi / 24)));
  }
}

// A square with two nodes more on each side: its corners stay, its sides are straight.
TEST(Smoothing, SharpCornersStaySharp) {
  std::vector<Vec2> x;
  const std::array<Vec2, 4> corners{Vec2(0, 0), Vec2(0, 3), Vec2(3, 3), Vec2(3, 0)};
  for (std::size_t c = 0; c < 4; ++c)
    for (int i = 0; i < 3; ++i)
      x.push_back(corners[c] + i * (corners[(c + 1) % 4] - corners[c]) / 3);
  Chain sharp = chain_of(12, true), round = chain_of(12, true);
  smooth(sharp, x, Smoothing{SmoothingKind::hermite});
  smooth(round, x, Smoothing{SmoothingKind::hermite, 2.0});
  EXPECT_EQ(sharp.facets[0].count, 3);
  EXPECT_EQ(sharp.facets[1].count, 4);
  EXPECT_EQ(round.facets[0].count, 4);
  for (std::size_t f = 0; f < 3; ++f)
    for (const double xi : {-1.0, -0.2, 1.0}) {
      EXPECT_NEAR(pairing::facet_jet(sharp.facets[f], xi, x).r.x(), 0, 1e-15);
      EXPECT_NEAR(pairing::facet_jet(sharp.facets[f], xi, x).r1.x(), 0, 1e-15);
    }
  EXPECT_GT(std::abs(pairing::facet_jet(round.facets[0], -1.0, x).r1.x()), 0.1);
}

// No smooth corner at all: the facets stay what they are.
TEST(Smoothing, LeavesAlone) {
  std::vector<Vec2> x{{0, 0}, {0, 1}, {1, 1}};
  Chain chain = chain_of(2, false);
  smooth(chain, x, Smoothing{SmoothingKind::hermite});
  EXPECT_TRUE(chain.facets[0].straight());
  smooth(chain, x, Smoothing{SmoothingKind::none, 3.0});
  EXPECT_TRUE(chain.facets[0].straight());
  Chain triangle = chain_of(3, true);
  smooth(triangle, x, Smoothing{SmoothingKind::hermite, 3.0});
  EXPECT_EQ(triangle.facets[0].count, 3);  // before and after are one node
  for (std::size_t f = 0; f < 3; ++f)
    EXPECT_LT((pairing::facet_jet(triangle.facets[f], 1.0, x).r - x[(f + 1) % 3]).norm(), 1e-15);
}

TEST(Smoothing, BoxesHoldTheirFacets) {
  for (const SmoothingKind kind : kinds) {
    const Deformed d = deformed_ring(kind);
    std::vector<search::Box<2>> boxes;
    pairing::facet_boxes(d.chain, d.x, boxes);
    for (std::size_t f = 0; f < boxes.size(); ++f)
      for (double xi = -1; xi <= 1; xi += 0.02) {
        const Vec2 p = jet_at(d, f, xi).r;
        EXPECT_TRUE((p.array() >= boxes[f].lo.array() - 1e-15).all() &&
                    (p.array() <= boxes[f].hi.array() + 1e-15).all());
      }
  }
}

// The nearest point of all facets, by brute force.
TEST(Smoothing, ClosestPoint) {
  for (const SmoothingKind kind : kinds) {
    const Deformed d = deformed_ring(kind);
    std::vector<search::Box<2>> boxes;
    pairing::facet_boxes(d.chain, d.x, boxes);
    pairing::Tree<2> tree;
    tree.refit(boxes);
    for (int i = 0; i < 60; ++i) {
      pairing::ProjectionQuery<2> query;
      query.point = 1.2 * Vec2(std::cos(0.11 * i), std::sin(0.11 * i));
      const pairing::Projection<2> p = pairing::closest(d.chain, tree, d.x, query);
      ASSERT_EQ(p.feature, Feature::face);
      double best = 1e9;
      for (std::size_t f = 0; f < d.chain.facets.size(); ++f)
        for (double xi = -1; xi <= 1; xi += 1e-3)
          best = std::min(best, (query.point - jet_at(d, f, xi).r).norm());
      EXPECT_LE(p.distance, best + 1e-14);
      EXPECT_GT(p.distance, best - 1e-5);
      const auto foot = jet_at(d, static_cast<std::size_t>(p.facet), p.xi[0]);
      EXPECT_NEAR((query.point - foot.r).dot(foot.r1.normalized()), 0, 1e-12);
    }
  }
}

// The tangent couples the neighbours' nodes, history from either side of a border.
TEST(Smoothing, TangentIsTheDerivative) {
  for (const SmoothingKind kind : kinds)
    for (const double mu : {0.0, 10.0, 0.01})
      for (const contact::ResidualForm form :
           {contact::ResidualForm::surface, contact::ResidualForm::full})
        for (const Index from : {0, 1, 2, 3}) {
          SCOPED_TRACE(::testing::Message()
                       << static_cast<int>(kind) << " mu " << mu << " from " << from);
          PairSample s = make_sample({.facets = 5, .bend = 0.03, .at = 2, .xi = -0.9});
          smooth(s.pair.master, s.x, Smoothing{kind, 1.0});
          const auto jet = pairing::facet_jet(s.pair.master.facets[2], -0.9, s.x);
          s.x[s.x.size() - 2] = jet.r - 0.04 * turn(jet.r1).normalized();
          if (mu > 0) s.pair.friction = contact::coulomb(mu, 80.0);
          s.pair.residual = form;
          s.committed.points[0] = remembered(true, from, Feature::face, 0.8, -0.01, 7.0);
          const Eigen::VectorXd v = flatten(s.x);
          const Status status = mu > 1 ? Status::stick : Status::slip;
          const auto branch = [&](const Eigen::VectorXd& y) { return pair_status(s, y)[0]; };
          ASSERT_EQ(branch(v), status);
          expect_derivative([&](const Eigen::VectorXd& y) { return pair_residual(s, y); },
                            pair_tangent(s, v), branch, v, 2e-3);
        }
}

}  // namespace
}  // namespace osculate::testing
