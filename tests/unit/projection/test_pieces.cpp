// Bernstein bounds, pieces and triangles: what the proofs of the projector rest on.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <bit>
#include <cmath>
#include <numbers>
#include <random>

#include "osculate/projection/cells.hpp"
#include "osculate/projection/local_domain.hpp"
#include "osculate/projection/piece_minima.hpp"
#include "osculate/projection/piece_trees.hpp"
#include "osculate/projection/shape_answer.hpp"
#include "osculate/projection/triangle.hpp"
#include "sample_targets.hpp"

namespace {

using namespace osculate;
using namespace osculate::projection;

template <int C>
double value(const Net<C>& net, double s, double t) {
  double sum = 0;
  for (int i = 0; i <= net.m; ++i)
    for (int j = 0; j <= net.n; ++j)
      sum += net.at(i, j) * binomial(net.m, i) * std::pow(s, i) * std::pow(1 - s, net.m - i) *
             binomial(net.n, j) * std::pow(t, j) * std::pow(1 - t, net.n - j);
  return sum;
}

Net<25> random_net(std::mt19937& generator) {
  std::uniform_real_distribution<double> u(-1, 1);
  Net<25> net;
  net.m = 4;
  net.n = 3;
  for (int i = 0; i <= net.m; ++i)
    for (int j = 0; j <= net.n; ++j) net.at(i, j) = u(generator);
  return net;
}

TEST(Bernstein, HalvesAndSidesAreTheSamePolynomial) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> u(0, 1);
  for (int k = 0; k < 50; ++k) {
    const Net<25> net = random_net(generator);
    const double s = u(generator), t = u(generator);
    Net<25> low, high;
    halve(net, 0, low, high);
    EXPECT_NEAR(value(low, s, t), value(net, 0.5 * s, t), 1e-14);
    EXPECT_NEAR(value(high, s, t), value(net, 0.5 + 0.5 * s, t), 1e-14);
    halve(net, 1, low, high);
    EXPECT_NEAR(value(low, s, t), value(net, s, 0.5 * t), 1e-14);
    EXPECT_NEAR(value(high, s, t), value(net, s, 0.5 + 0.5 * t), 1e-14);
    EXPECT_NEAR(value(side_of(net, 0, true), 0, t), value(net, 1, t), 1e-14);
    EXPECT_NEAR(value(side_of(net, 1, false), s, 0), value(net, s, 0), 1e-14);
  }
}

/// Differences of the polynomial stay inside the bounds of its derivatives, and the bounds close up
/// with the order that branch and bound needs.
TEST(Bernstein, DerivativeBoundsHold) {
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> u(0.01, 0.99);
  constexpr double h = 1e-4;
  for (int k = 0; k < 200; ++k) {
    const Net<25> net = random_net(generator);
    const NetBounds b = derivative_bounds(net);
    const double s = u(generator), t = u(generator);
    const auto f = [&](double a, double c) { return value(net, s + a * h, t + c * h); };
    const double slack = 1e-5;
    const auto inside = [&](const Bounds& range, double x) {
      EXPECT_GE(x, range.lo - slack);
      EXPECT_LE(x, range.hi + slack);
    };
    inside(b.first[0], (f(1, 0) - f(-1, 0)) / (2 * h));
    inside(b.first[1], (f(0, 1) - f(0, -1)) / (2 * h));
    inside(b.second[0], (f(1, 0) - 2 * f(0, 0) + f(-1, 0)) / (h * h));
    inside(b.second[2], (f(0, 1) - 2 * f(0, 0) + f(0, -1)) / (h * h));
    inside(b.second[1], (f(1, 1) - f(1, -1) - f(-1, 1) + f(-1, -1)) / (4 * h * h));
  }
}

std::vector<CellComplex<3>> sample_complexes() {
  std::vector<CellComplex<3>> all;
  all.push_back(make_complex(osculate::testing::wavy_patch()));
  for (const auto type : {cell::CellType::tri3, cell::CellType::tri6, cell::CellType::quad4,
                          cell::CellType::quad8, cell::CellType::quad9}) {
    FacetMesh<3> mesh;
    MeshFacet facet{type, {}};
    for (int k = 0; k < cell::info(type).nodes; ++k) {
      const Vec2 xi =
          cell::is_triangle(type)
              ? std::array<Vec2,
                           6>{Vec2(0, 0),  Vec2(1, 0),   Vec2(0, 1),
                              Vec2(.5, 0), Vec2(.5, .5), Vec2(0, .5)}[static_cast<std::size_t>(k)]
              : std::array<Vec2, 9>{Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1),
                                    Vec2(-1, 1),  Vec2(0, -1), Vec2(1, 0),
                                    Vec2(0, 1),   Vec2(-1, 0), Vec2(0, 0)}[static_cast<std::size_t>(
                    k)];
      facet.nodes[static_cast<std::size_t>(k)] = static_cast<Index>(k);
      mesh.nodes.push_back({xi[0] + 0.1 * std::sin(5.0 * k), xi[1] + 0.1 * std::cos(3.0 * k),
                            0.3 * std::sin(4.0 * k)});
    }
    mesh.facets.push_back(facet);
    all.push_back(make_complex<3>(mesh));
  }
  return all;
}

/// Every piece is the part of its cell that it says, lies in its box, and has its normals in its
/// cone and its inward directions in theirs.
TEST(Pieces, AreTheirPartOfTheCell) {
  std::mt19937 generator(4);
  std::uniform_real_distribution<double> u(0, 1);
  for (const CellComplex<3>& all : sample_complexes())
    for (const Piece<3>& piece : all.set.pieces) {
      if (piece.triangle) continue;
      const Control<3> control = control_of(piece, all.set.control);
      search::Box<3> box = box_of<3>(piece, control);
      box.inflate(1e-13);
      const Cone<3> cone = normal_cone<3>(piece, control);
      for (int k = 0; k < 10; ++k) {
        const Vec2 st(u(generator), u(generator));
        const PieceJet<3> j = jet<3>(piece, control, st);
        const PieceJet<3> of_cell = cell_jet(all, all.cell(piece.cell), piece.cell_xi(st));
        EXPECT_NEAR((j.r - of_cell.r).norm(), 0, 1e-14);
        EXPECT_EQ(box.squared_distance(j.r), 0);
        const Vec3 n = j.r1[0].cross(j.r1[1]).normalized();
        if (cone.narrow()) {
          EXPECT_LE(std::acos(std::min(1.0, n.dot(cone.axis))), cone.angle + 1e-7);
        }
        for (std::size_t side = 0; side < 4; ++side) {
          const Cone<3> inward = inward_cone<3>(piece, control, side);
          const Vec3 d = (side % 2 == 0 ? 1 : -1) * j.r1[side / 2].normalized();
          if (inward.narrow()) {
            EXPECT_LE(std::acos(std::min(1.0, d.dot(inward.axis))), inward.angle + 1e-7);
          }
        }
      }
    }
}

/// First and second derivatives by the order of central differences.
TEST(Pieces, JetsByConvergenceOrder) {
  const CellComplex<3> all = make_complex(osculate::testing::wavy_patch());
  const Piece<3>& piece = all.set.pieces[7];
  const Control<3> control = control_of(piece, all.set.control);
  ASSERT_TRUE(piece.rational);
  const Vec2 st(0.37, 0.61);
  const PieceJet<3> j = jet<3>(piece, control, st);
  for (int direction = 0; direction < 2; ++direction) {
    std::array<double, 2> error{}, error2{}, mixed{};
    for (std::size_t k = 0; k < 2; ++k) {
      const double h = k == 0 ? 0.02 : 0.01;
      const Vec2 step = direction == 0 ? Vec2(h, 0) : Vec2(0, h);
      const PieceJet<3> a = jet<3>(piece, control, st + step),
                        b = jet<3>(piece, control, st - step);
      const auto d = static_cast<std::size_t>(direction);
      error[k] = ((a.r - b.r) / (2 * h) - j.r1[d]).norm();
      error2[k] = ((a.r1[d] - b.r1[d]) / (2 * h) - j.r2[2 * d]).norm();
      mixed[k] = ((a.r1[1 - d] - b.r1[1 - d]) / (2 * h) - j.r2[1]).norm();
    }
    EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.1);
    EXPECT_NEAR(std::log2(error2[0] / error2[1]), 2, 0.1);
    EXPECT_NEAR(std::log2(mixed[0] / mixed[1]), 2, 0.1);
  }
}

struct Collect {
  std::vector<PieceMinimum<3>> found;
  [[nodiscard]] double reach2() const { return 1e300; }
  void offer(const PieceMinimum<3>& m) { found.push_back(m); }
};

/// All minima of a saddle-shaped facet seen from a point with two of them, and of none more.
TEST(PieceMinima, FindsEveryMinimumOnce) {
  FacetMesh<3> mesh;  // z = x^2 - y^2 / 2 over -1..1 squared
  const double xy[9][2] = {{-1, -1}, {1, -1}, {1, 1},  {-1, 1}, {0, -1},
                           {1, 0},   {0, 1},  {-1, 0}, {0, 0}};
  MeshFacet facet{cell::CellType::quad9, {}};
  for (std::size_t k = 0; k < 9; ++k) {
    const double x = xy[k][0], y = xy[k][1];
    mesh.nodes.push_back({x, y, x * x - 0.5 * y * y});
    facet.nodes[k] = static_cast<Index>(k);
  }
  mesh.facets = {facet};
  const CellComplex<3> all = make_complex<3>(mesh);
  const Vec3 point(0, 0, 0.8);  // above the centre of curvature 1/2: two minima at x = +-sqrt(0.3)
  Collect collect;
  for (const Piece<3>& piece : all.set.pieces)
    find_minima<3>(piece, control_of(piece, all.set.control), point, 1e-13, collect);
  std::vector<Vec3> inside;
  for (const PieceMinimum<3>& m : collect.found) {
    EXPECT_FALSE(m.flat);
    bool known = false;
    for (const Vec3& other : inside) known = known || (other - m.point).norm() < 1e-9;
    if (m.pressed == 0 && !known) inside.push_back(m.point);
  }
  ASSERT_EQ(inside.size(), 2U);
  for (const Vec3& r : inside)
    EXPECT_NEAR((r - Vec3(std::copysign(std::sqrt(0.3), r[0]), 0, 0.3)).norm(), 0, 1e-12);
}

/// A node of the tree that its normals exclude has no local minimum: checked by brute force over
/// random nodes of a bumpy closed surface.
TEST(PieceTrees, WhatIsLeftOutHoldsNoMinimum) {
  FacetMesh<3> mesh;
  const int n = 48;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double a = 2 * std::numbers::pi * i / n, b = 2 * std::numbers::pi * j / n;
      const double r = 1 + 0.05 * std::sin(3 * a + b);
      mesh.nodes.push_back({(2.5 + r * std::cos(b)) * std::cos(a),
                            (2.5 + r * std::cos(b)) * std::sin(a), r * std::sin(b)});
    }
  const auto id = [&](int i, int j) { return static_cast<Index>((i % n) * n + j % n); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      mesh.facets.push_back(
          {cell::CellType::quad4, {id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)}});
  const CellComplex<3> all = make_complex<3>(mesh);
  const PieceTrees<3> trees = plant(all);
  EXPECT_EQ(trees.border.tree.size(), 0U);
  std::mt19937 generator(8);
  std::uniform_real_distribution<double> u(-4, 4);
  int left_out = 0;
  for (int q = 0; q < 50; ++q) {
    const Vec3 point(u(generator), u(generator), u(generator));
    std::vector<bool> offered(all.set.pieces.size(), false);
    const double reach = 1e300;
    for_each_possible(trees, point, reach,
                      [&](Index k) { offered[static_cast<std::size_t>(k)] = true; });
    for (std::size_t k = 0; k < offered.size(); ++k) {
      if (offered[k]) continue;
      ++left_out;
      // Somewhere on the piece the distance still falls along the surface: sample the slope.
      const Piece<3>& piece = all.set.pieces[k];
      for (int i = 0; i <= 4; ++i)
        for (int j = 0; j <= 4; ++j) {
          const PieceJet<3> here =
              jet<3>(piece, control_of(piece, all.set.control), Vec2(i / 4.0, j / 4.0));
          const Vec3 gap = point - here.r;
          const Vec3 normal = here.r1[0].cross(here.r1[1]).normalized();
          EXPECT_GT((gap - gap.dot(normal) * normal).norm(), 1e-6 * gap.norm());
        }
    }
  }
  EXPECT_GT(left_out, 1000);
}

TEST(Triangle, AgainstSamplesInEveryRegion) {
  std::mt19937 generator(6);
  std::uniform_real_distribution<double> u(-2, 2);
  int seen[4] = {0, 0, 0, 0};
  for (int k = 0; k < 400; ++k) {
    const auto random = [&] { return Vec3(u(generator), u(generator), u(generator)); };
    const Vec3 a = random(), b = random(), c = random(), p = random();
    const TriangleFoot foot = closest_on_triangle(a, b, c, p);
    double sampled = 1e300;
    const int n = 60;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j)
        sampled = std::min(sampled, (p - (a + (b - a) * i / n + (c - a) * j / n)).norm());
    EXPECT_LE(std::sqrt(foot.squared_distance), sampled + 1e-14);
    EXPECT_GT(std::sqrt(foot.squared_distance), sampled - 0.1);
    EXPECT_NEAR((a + foot.xi[0] * (b - a) + foot.xi[1] * (c - a) - foot.point).norm(), 0, 1e-14);
    ++seen[std::popcount(foot.pressed)];
  }
  EXPECT_GT(seen[0], 20);
  EXPECT_GT(seen[1], 20);
  EXPECT_GT(seen[2], 20);
  EXPECT_EQ(seen[3], 0);
}

TEST(LeastBend, IsOneMinusGapTimesCurvature) {
  // A cylinder of radius 2 along y, parameters of unlike size, seen from inside at distance 0.5.
  const std::array<Vec3, 2> r1{Vec3(6, 0, 0), Vec3(0.2, 0.5, 0)};
  const double k = 1 / 2.0;
  const std::array<Vec3, 3> r2{Vec3(0, 0, 36 * k), Vec3(0, 0, 1.2 * k), Vec3(0, 0, 0.04 * k)};
  EXPECT_NEAR(least_bend(Vec3(0, 0, 0.5), r1, r2), 1 - 0.5 * k, 1e-14);
  EXPECT_NEAR(least_bend(Vec3(0, 0, -0.5), r1, r2), 1, 1e-14);  // along the axis
  EXPECT_NEAR(least_bend(Vec3(0, 0, 2), r1, r2), 0, 1e-14);
  EXPECT_NEAR(least_bend(Vec3(0, 0, 3), r1, r2), 1 - 3 * k, 1e-14);
  // On a sphere both curvatures are equal, and no digits may be lost.
  const std::array<Vec3, 3> round{Vec3(0, 0, 36 * k), Vec3(0, 0, 1.2 * k), Vec3(0, 0, 0.29 * k)};
  for (const double gap : {-3.0, 0.5, 1.9})
    EXPECT_NEAR(least_bend(Vec3(0, 0, gap), r1, round), 1 - gap * k, 1e-14);
  const geometry::CurveFrame curve = geometry::curve_frame(
      geometry::CurveJet<2>{Vec2::Zero(), Vec2(3, 0), Vec2(1, 9 * k), Vec2::Zero()});
  EXPECT_NEAR(distance_bend(curve, 0.5), 1 - 0.5 * k, 1e-14);
}

}  // namespace
