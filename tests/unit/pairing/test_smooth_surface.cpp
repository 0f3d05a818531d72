// Smooth patches through the nodes of quad4 and tri3 facets.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <tuple>

#include "expect_derivative.hpp"
#include "osculate/core/error.hpp"
#include "osculate/pairing/closest_patch.hpp"
#include "osculate/pairing/gregory.hpp"
#include "osculate/pairing/smoothing.hpp"
#include "osculate/projection/inside_facet.hpp"
#include "pair_sample.hpp"

namespace osculate::testing {
namespace {

using cell::CellType;
using contact::Status;
using pairing::FacetSurface;
using pairing::Smoothing;
using pairing::SmoothingKind;
using projection::Feature;

constexpr double everything = 3.0;  // no corner is sharp

/// A surface by its reference nodes, and where they are now.
struct Skin {
  FacetSurface surface;
  std::vector<Vec3> reference, x;
};

/// Adds facets over quadrilaterals p(0..n, 0..n) of a face, split in two for triangles; equal
/// points become one node.
template <class Place>
void add_grid(Skin& s, CellType type, int n, int m, const Place& place) {
  const auto node = [&](int i, int j) {
    const Vec3 p = place(static_cast<double>(i) / n, static_cast<double>(j) / m);
    for (std::size_t k = 0; k < s.reference.size(); ++k)
      if ((s.reference[k] - p).norm() < 1e-9) return static_cast<Index>(k);
    s.reference.push_back(p);
    return static_cast<Index>(s.reference.size()) - 1;
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const std::array<Index, 4> q{node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
      if (type == CellType::quad4) {
        s.surface.facets.push_back(pairing::surface_facet(type, q));
        continue;
      }
      s.surface.facets.push_back(
          pairing::surface_facet(type, std::array<Index, 3>{q[0], q[1], q[2]}));
      s.surface.facets.push_back(
          pairing::surface_facet(type, std::array<Index, 3>{q[0], q[2], q[3]}));
    }
}

void finish(Skin& s, double angle, double shake) {
  pairing::connect(s.surface);
  smooth(s.surface, s.reference, Smoothing{SmoothingKind::hermite, angle});
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-shake, shake);
  for (const Vec3& p : s.reference) {
    const double a = uniform(generator);
    const double b = uniform(generator);
    const double c = uniform(generator);
    s.x.emplace_back(p + Vec3(a, b, c));
  }
}

/// A cube of half width 1, or a ball of radius 1 made of it: corners where three facets meet.
Skin cube(CellType type, int n, bool ball, double angle, double shake) {
  Skin s;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
      add_grid(s, type, n, n, [&](double u, double v) {
        const double a = 2 * u - 1, b = side * (2 * v - 1), bend = std::numbers::pi / 4;
        Vec3 p;
        p[axis] = side;
        p[(axis + 1) % 3] = ball ? std::tan(bend * a) : a;
        p[(axis + 2) % 3] = ball ? std::tan(bend * b) : b;
        return ball ? Vec3(p.normalized()) : p;
      });
  finish(s, angle, shake);
  return s;
}

/// A bent sheet with open borders and unequal facets.
Skin sheet(CellType type, double shake) {
  Skin s;
  add_grid(s, type, 4, 3, [](double u, double v) {
    const double a = 3 * u + 0.4 * std::sin(3 * u), b = 2 * v + 0.3 * v * v;
    return Vec3(a, b, 0.15 * a * b - 0.1 * a * a);
  });
  finish(s, everything, shake);
  return s;
}

/// Part of a cylinder of radius 1 along y.
Skin tube(int count) {
  Skin s;
  add_grid(s, CellType::quad4, count, 2, [&](double u, double v) {
    const double angle = 2 * std::numbers::pi * u;
    return Vec3(std::sin(angle), 1.0 - 2.0 * v, std::cos(angle));
  });
  finish(s, 1.0, 0);
  return s;
}

std::vector<Skin> skins(double shake) {
  return {cube(CellType::quad4, 3, true, everything, shake),
          cube(CellType::tri3, 3, true, everything, shake), sheet(CellType::quad4, shake),
          sheet(CellType::tri3, shake)};
}

geometry::SurfaceJet jet_of(const Skin& s, std::size_t f, const Vec2& xi) {
  return pairing::facet_jet(s.surface.facets[f], xi, s.x);
}

Vec2 on_edge(const pairing::SurfaceFacet& facet, int edge, double t) {
  const std::array<int, 2> ends = pairing::edge_corners(facet, edge);
  return (1 - t) * cell::area_node(facet.type, ends[0]) + t * cell::area_node(facet.type, ends[1]);
}

TEST(SmoothSurface, PassesThroughTheNodes) {
  for (const Skin& s : skins(0.05))
    for (std::size_t f = 0; f < s.surface.facets.size(); ++f) {
      const pairing::SurfaceFacet& facet = s.surface.facets[f];
      ASSERT_TRUE(facet.patch);
      for (int k = 0; k < pairing::edge_count(facet); ++k)
        EXPECT_LT((jet_of(s, f, cell::area_node(facet.type, k)).r -
                   s.x[static_cast<std::size_t>(facet.nodes[static_cast<std::size_t>(k)])])
                      .norm(),
                  1e-14);
    }
}

// One curve and one normal from both sides of every border, in any configuration.
TEST(SmoothSurface, HasOneNormalAcrossItsBorders) {
  for (const Skin& s : skins(0.05))
    for (std::size_t f = 0; f < s.surface.facets.size(); ++f) {
      const pairing::SurfaceFacet& facet = s.surface.facets[f];
      for (int e = 0; e < pairing::edge_count(facet); ++e) {
        const Index other = facet.neighbour[static_cast<std::size_t>(e)];
        if (other < 0) continue;
        const auto g = static_cast<std::size_t>(other);
        int back = 0;
        while (s.surface.facets[g].neighbour[static_cast<std::size_t>(back)] !=
               static_cast<Index>(f))
          ++back;
        for (const double t : {0.0, 0.2, 0.5, 0.9, 1.0}) {
          const Vec2 here = on_edge(facet, e, t), there = on_edge(s.surface.facets[g], back, 1 - t);
          EXPECT_LT((jet_of(s, f, here).r - jet_of(s, g, there).r).norm(), 1e-14);
          EXPECT_LT((pairing::facet_normal(facet, here, s.x) -
                     pairing::facet_normal(s.surface.facets[g], there, s.x))
                        .norm(),
                    1e-12);
        }
      }
    }
}

TEST(SmoothSurface, ShapeFunctionsSumToOne) {
  for (const Skin& s : skins(0))
    for (const pairing::SurfaceFacet& facet : s.surface.facets)
      for (const Vec2& xi : {Vec2(0.2, 0.3), Vec2(0.0, 0.0), Vec2(0.7, 0.25), Vec2(0, 0.4)}) {
        const cell::FacetShape shape = pairing::facet_shape(facet, xi);
        for (std::size_t d = 0; d < 10; ++d) {
          double sum = 0;
          for (int k = 0; k < shape.count; ++k) sum += shape.n[d][static_cast<std::size_t>(k)];
          EXPECT_NEAR(sum, d == 0 ? 1 : 0, 1e-11);
        }
      }
}

// Flat stays flat, and an affine image of a flat reference is that of every point.
TEST(SmoothSurface, KeepsPlanes) {
  for (const CellType type : {CellType::quad4, CellType::tri3}) {
    Skin s;
    add_grid(s, type, 3, 3,
             [](double u, double v) { return Vec3(3 * u + 0.2 * u * v, 2 * v + 0.1 * u * u, 0); });
    finish(s, everything, 0);
    Mat<3, 3> map;
    map << 1, 0.4, 0, -0.3, 2, 0, 0.7, -0.5, 1;
    for (std::size_t f = 0; f < s.surface.facets.size(); ++f)
      for (const Vec2& xi : {Vec2(0.2, 0.3), Vec2(0.6, 0.1)}) {
        s.x = s.reference;
        const Vec3 flat = jet_of(s, f, xi).r;
        EXPECT_NEAR(flat.z(), 0, 1e-15);
        for (Vec3& p : s.x) p = Vec3(map * p) + Vec3(1, 2, 3);
        EXPECT_LT((jet_of(s, f, xi).r - map * flat - Vec3(1, 2, 3)).norm(), 1e-13);
      }
  }
}

TEST(SmoothSurface, DerivativesOfTheShapeFunctions) {
  for (const Skin& s : skins(0.05)) {
    constexpr std::array<std::array<std::size_t, 2>, 6> next{
        {{1, 2}, {3, 4}, {4, 5}, {6, 7}, {7, 8}, {8, 9}}};
    const pairing::SurfaceFacet& facet = s.surface.facets[4];
    const Vec2 at(0.27, 0.31);
    const auto values = [&](const Vec2& xi, std::size_t d) {
      Vec3 sum = Vec3::Zero();
      const cell::FacetShape shape = pairing::facet_shape(facet, xi);
      for (std::size_t k = 0; k < static_cast<std::size_t>(shape.count); ++k)
        sum += shape.n[d][k] * s.x[static_cast<std::size_t>(facet.nodes[k])];
      return sum;
    };
    for (std::size_t d = 0; d < next.size(); ++d)
      for (Eigen::Index i = 0; i < 2; ++i) {
        const auto error = [&](double h) {
          const Vec2 step = h * Vec2::Unit(i);
          return ((values(at + step, d) - values(at - step, d)) / (2 * h) -
                  values(at, next[d][static_cast<std::size_t>(i)]))
              .norm();
        };
        const double coarse = error(4e-3), fine = error(2e-3);
        EXPECT_TRUE(coarse < 1e-10 || std::abs(std::log2(coarse / fine) - 2) < 0.1)
            << d << " " << i << ": " << coarse << " " << fine;
      }
  }
}

/// Largest distance from the unit sphere, or the cylinder around y.
double roundness(const Skin& s, bool cylinder) {
  double worst = 0;
  for (std::size_t f = 0; f < s.surface.facets.size(); ++f)
    for (double u = 0.05; u < 1; u += 0.1)
      for (double v = 0.05; v < 1; v += 0.1) {
        const bool triangle = cell::is_triangle(s.surface.facets[f].type);
        if (triangle && u + v > 1) continue;
        Vec3 r = jet_of(s, f, triangle ? Vec2(u, v) : Vec2(2 * u - 1, 2 * v - 1)).r;
        if (cylinder) r.y() = 0;
        worst = std::max(worst, std::abs(r.norm() - 1));
      }
  return worst;
}

TEST(SmoothSurface, ApproachesBallsAndTubes) {
  for (const CellType type : {CellType::quad4, CellType::tri3}) {
    const double smooth_one = roundness(cube(type, 4, true, 1.0, 0), false),
                 facets = roundness(cube(type, 4, true, 0.0, 0), false);
    EXPECT_LT(smooth_one, 0.2 * facets) << smooth_one << " " << facets;
  }
  const double coarse = roundness(tube(12), true), fine = roundness(tube(24), true);
  EXPECT_NEAR(std::log2(coarse / fine), 4, 0.2);
}

// The faces of a cube stay planes with sharp edges between them.
TEST(SmoothSurface, SharpEdgesStaySharp) {
  for (const CellType type : {CellType::quad4, CellType::tri3}) {
    const Skin s = cube(type, 3, false, 0.5, 0);
    for (std::size_t f = 0; f < s.surface.facets.size(); ++f) {
      const Vec3 normal = pairing::facet_normal(s.surface.facets[f], {0.3, 0.3}, s.x);
      EXPECT_NEAR(normal.lpNorm<Eigen::Infinity>(), 1, 1e-14);
      for (double u = 0; u <= 1; u += 0.25) {
        const Vec2 xi(u, 1 - u);
        EXPECT_LT((pairing::facet_normal(s.surface.facets[f], xi, s.x) - normal).norm(), 1e-13);
        EXPECT_NEAR(jet_of(s, f, xi).r.dot(normal), 1, 1e-14);
      }
    }
  }
  Skin single;
  add_grid(single, CellType::quad4, 1, 1, [](double u, double v) { return Vec3(u, v, u * v); });
  finish(single, everything, 0);
  EXPECT_FALSE(single.surface.facets[0].patch);  // all its corners are sharp: nothing to smooth
}

TEST(SmoothSurface, BoxesHoldTheirFacets) {
  for (const Skin& s : skins(0.05)) {
    std::vector<search::Box<3>> boxes;
    pairing::facet_boxes(s.surface, s.x, boxes);
    for (std::size_t f = 0; f < boxes.size(); ++f)
      for (double u = 0; u <= 1; u += 0.125)
        for (double v = 0; v <= 1; v += 0.125) {
          const bool triangle = cell::is_triangle(s.surface.facets[f].type);
          if (triangle && u + v > 1) continue;
          const Vec3 p = jet_of(s, f, triangle ? Vec2(u, v) : Vec2(2 * u - 1, 2 * v - 1)).r;
          EXPECT_TRUE((p.array() >= boxes[f].lo.array() - 1e-14).all() &&
                      (p.array() <= boxes[f].hi.array() + 1e-14).all());
        }
  }
}

TEST(SmoothSurface, ClosestPoint) {
  for (const Skin& s : {cube(CellType::quad4, 3, true, everything, 0.02),
                        cube(CellType::tri3, 2, true, everything, 0.02)}) {
    std::vector<search::Box<3>> boxes;
    pairing::facet_boxes(s.surface, s.x, boxes);
    pairing::Tree<3> tree;
    tree.refit(boxes);
    for (int i = 0; i < 24; ++i) {
      pairing::ProjectionQuery<3> query;
      query.point = Vec3(std::cos(1.0 * i), std::sin(1.7 * i), std::cos(2.3 * i + 1)).normalized();
      query.point *= i % 2 ? 1.15 : 0.85;
      const pairing::Projection<3> p = pairing::closest(s.surface, tree, s.x, query);
      ASSERT_NE(p.feature, Feature::none);
      double best = 1e9;
      for (std::size_t f = 0; f < s.surface.facets.size(); ++f)
        for (double u = 0; u <= 1; u += 0.1)
          for (double v = 0; v <= 1; v += 0.1) {
            const bool triangle = cell::is_triangle(s.surface.facets[f].type);
            if (triangle && u + v > 1) continue;
            const Vec2 xi = triangle ? Vec2(u, v) : Vec2(2 * u - 1, 2 * v - 1);
            best = std::min(best, (query.point - jet_of(s, f, xi).r).norm());
          }
      EXPECT_LE(p.distance, best + 1e-12);
      EXPECT_GT(p.distance, best - 2e-2);
      if (p.feature != Feature::face) continue;
      const geometry::SurfaceJet foot = jet_of(s, static_cast<std::size_t>(p.facet), p.xi);
      for (std::size_t d = 0; d < 2; ++d)
        EXPECT_NEAR((query.point - foot.r).dot(foot.r1[d].normalized()), 0, 1e-10);
    }
  }
}

// Points that press obliquely near a border were placed on it.
TEST(SmoothSurface, NoWayInwardsFromABorderIsDownhill) {
  std::mt19937 generator(8);
  std::uniform_real_distribution<double> u(-1, 1);
  int borders = 0;
  for (const Skin& s : skins(0.2))
    for (int i = 0; i < 4000; ++i) {
      const auto f = static_cast<std::size_t>(i) % s.surface.facets.size();
      const pairing::SurfaceFacet& facet = s.surface.facets[f];
      const Vec2 middle = projection::middle_of_cell(facet.type);
      const pairing::GregoryPoints points = pairing::patch_points(facet, s.x);
      const Vec3 p = jet_of(s, f, middle).r + 0.6 * Vec3(u(generator), u(generator), u(generator));
      const projection::FacetFoot foot = pairing::closest_on_patch({facet.type, points, p}, middle);
      if (foot.feature != Feature::edge) continue;
      ++borders;
      const geometry::SurfaceJet jet = jet_of(s, f, foot.xi);
      const Vec2 to = middle - foot.xi;
      EXPECT_LT((p - jet.r).dot(to[0] * jet.r1[0] + to[1] * jet.r1[1]), 1e-11);
    }
  EXPECT_GT(borders, 1000);
}

// Ironing with a smooth punch crawled: so near the surface the distance is too coarse to find the
// place by better than 1e-8, and the slip had that noise.
TEST(SmoothSurface, FootPointsAreSharpToRounding) {
  for (const CellType type : {CellType::quad4, CellType::tri3}) {
    const Skin s = cube(type, 4, true, everything, 0.02);
    std::vector<search::Box<3>> boxes;
    pairing::facet_boxes(s.surface, s.x, boxes);
    pairing::Tree<3> tree;
    tree.refit(boxes);
    int faces = 0;
    for (int i = 0; i < 400; ++i) {
      const auto f = static_cast<std::size_t>(i) % s.surface.facets.size();
      const double a = 0.05 + 0.4 * std::abs(std::sin(0.7 * i)), b = 0.5 - a * std::cos(1.3 * i);
      const Vec2 xi =
          type == CellType::tri3 ? Vec2(a, 0.9 * (1 - a) * b) : Vec2(2 * a - 1, 1.8 * b - 1);
      const geometry::SurfaceJet jet = jet_of(s, f, xi);
      const Vec3 n = jet.r1[0].cross(jet.r1[1]).normalized();
      pairing::ProjectionQuery<3> query;
      query.point = jet.r + (i % 3 - 1.1) * 0.01 * n;
      const pairing::Projection<3> p = pairing::closest(s.surface, tree, s.x, query);
      if (p.feature != Feature::face) continue;
      ++faces;
      const geometry::SurfaceJet foot = jet_of(s, static_cast<std::size_t>(p.facet), p.xi);
      for (std::size_t d = 0; d < 2; ++d)
        EXPECT_NEAR((query.point - foot.r).dot(foot.r1[d].normalized()), 0, 2e-15);
    }
    EXPECT_GT(faces, 350);
  }
}

// The tangent couples the nodes around a patch; the history comes from its neighbours too.
TEST(SmoothSurface, TangentIsTheDerivative) {
  for (const CellType type : {CellType::quad4, CellType::tri3})
    for (const double mu : {0.0, 10.0, 0.01})
      for (const contact::ResidualForm form :
           {contact::ResidualForm::surface, contact::ResidualForm::full})
        for (const Index from : {0, 1}) {
          SCOPED_TRACE(::testing::Message()
                       << cell::info(type).name << " mu " << mu << " from " << from);
          const Skin skin = sheet(type, 0.02);
          PairSample3 s;
          s.pair.master = skin.surface;
          s.x = skin.x;
          const Index at = 7, other = skin.surface.facets[7].neighbour[static_cast<std::size_t>(
                                  skin.surface.facets[7].neighbour[0] < 0 ? 1 : 0)];
          const Vec2 xi = type == CellType::tri3 ? Vec2(0.3, 0.1) : Vec2(0.3, -0.9);
          const geometry::SurfaceJet jet = jet_of(skin, static_cast<std::size_t>(at), xi);
          s.x.push_back(jet.r - 0.03 * jet.r1[0].cross(jet.r1[1]).normalized());
          s.pair.slave = pairing::make_slave_side(
              FacetSurface{}, std::array<Index, 1>{static_cast<Index>(s.x.size()) - 1});
          s.pair.weight = pairing::Weight::node;
          s.pair.normal = contact::penalty(1000);
          if (mu > 0) s.pair.friction = contact::coulomb(mu, 80.0);
          s.pair.residual = form;
          pairing::prepare(s.pair, s.x);
          s.committed.points = {
              remembered(from == 0 ? at : other, Vec2(0.4, 0.2), -0.01, {4.0, -3.0})};
          const Eigen::VectorXd v = flatten(s.x);
          const PointFacts facts = pair_facts(s, v)[0];
          ASSERT_EQ(facts.status, mu > 1 ? Status::stick : Status::slip);
          ASSERT_EQ(facts.feature, Feature::face);
          ASSERT_EQ(facts.facet, at);
          expect_derivative([&](const Eigen::VectorXd& y) { return pair_residual(s, y); },
                            pair_tangent(s, v),
                            [&](const Eigen::VectorXd& y) { return pair_facts(s, y); }, v, 5e-4);
        }
}

// Three slave nodes, two of them over one facet: its nodes' part of their tangents is in one block,
// whatever the buffers were used for before.
TEST(SmoothSurface, PointsOverAFacetShareTheTangentOfItsNodes) {
  const Skin skin = sheet(CellType::quad4, 0.02);
  PairSample3 s;
  s.pair.master = skin.surface;
  s.x = skin.x;
  const auto below = [&](std::size_t facet, const Vec2& xi) {
    const geometry::SurfaceJet jet = jet_of(skin, facet, xi);
    return Vec3(jet.r - 0.03 * jet.r1[0].cross(jet.r1[1]).normalized());
  };
  const auto first = static_cast<Index>(s.x.size());
  s.x.insert(s.x.end(), {below(7, {0.3, 0.2}), below(7, {-0.5, 0.4}), below(4, {0.1, -0.3})});
  s.pair.slave =
      pairing::make_slave_side(FacetSurface{}, std::array<Index, 3>{first, first + 1, first + 2});
  s.pair.weight = pairing::Weight::node;
  s.pair.normal = contact::penalty(1000);
  s.pair.friction = contact::coulomb(10.0, 80.0);
  pairing::prepare(s.pair, s.x);
  s.committed.points = {remembered(7, Vec2(0.2, 0.2), -0.01, {4.0, -3.0}),
                        remembered(4, Vec2(0.4, 0.2), -0.01, {4.0, -3.0}),
                        remembered(4, Vec2(0.4, 0.2), -0.01, {4.0, -3.0})};
  std::vector<Vec3> elsewhere = s.x;
  std::swap(elsewhere[static_cast<std::size_t>(first)],
            elsewhere[static_cast<std::size_t>(first) + 2]);
  elsewhere[static_cast<std::size_t>(first) + 1] = below(8, {0.1, 0.1});
  pairing::PairEvaluation<3> fresh, used;
  pairing::evaluate<3>(s.pair, elsewhere, s.committed, true, used);
  for (pairing::PairEvaluation<3>* const e : {&fresh, &used})
    pairing::evaluate<3>(s.pair, s.x, s.committed, true, *e);
  const auto size = static_cast<Eigen::Index>(3 * s.x.size());
  EXPECT_EQ(assembled_tangent(used, size), assembled_tangent(fresh, size));
  std::vector<std::size_t> with_block;
  for (std::size_t f = 0; f < skin.surface.facets.size(); ++f)
    if (used.blocks[used.master_blocks + f].active()) with_block.push_back(f);
  EXPECT_EQ(with_block, (std::vector<std::size_t>{4, 7}));
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(used.blocks[i].slave_count, 1);
    const int master = 3 * (used.blocks[i].count - 1);
    EXPECT_TRUE(used.blocks[i].tangent.block(3, 3, master, master).isZero(0));
  }
  const Eigen::VectorXd v = flatten(s.x);
  expect_derivative([&](const Eigen::VectorXd& y) { return pair_residual(s, y); },
                    pair_tangent(s, v), [&](const Eigen::VectorXd& y) { return pair_facts(s, y); },
                    v, 5e-4);
}

// A fan of many quadrilaterals depends on more nodes than there is room for.
TEST(SmoothSurface, RefusesWhatItCannotHold) {
  Skin s;
  s.reference.emplace_back(0, 0, 0);
  const int count = 17;
  for (int i = 0; i < count; ++i) {
    const double a = 2 * std::numbers::pi * i / count, b = a + std::numbers::pi / count;
    s.reference.emplace_back(std::cos(a), std::sin(a), 0);
    s.reference.emplace_back(2 * std::cos(b), 2 * std::sin(b), 0);
  }
  for (Index i = 0; i < count; ++i)
    s.surface.facets.push_back(pairing::surface_facet(
        CellType::quad4, std::array<Index, 4>{0, 1 + 2 * i, 2 + 2 * i, 1 + 2 * ((i + 1) % count)}));
  pairing::connect(s.surface);
  const Smoothing options{SmoothingKind::hermite, everything};
  EXPECT_THROW(smooth(s.surface, s.reference, options), core::GeometryError);
}

}  // namespace
}  // namespace osculate::testing
