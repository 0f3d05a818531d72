// The projector on composed curves and surfaces: regions, signs, margins, degenerate input. Random
// points against brute force are a verification case (closest_points).
#include "osculate/projection/projector.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "osculate/core/error.hpp"
#include "sample_targets.hpp"

namespace {

using namespace osculate;
using cell::CellType;
using projection::ClosestPoint;
using projection::FacetMesh;
using projection::Feature;
using projection::MeshFacet;
using projection::Mode;
using projection::Projector;
using projection::Shape;
using projection::Status;
using projection::Target;

constexpr double infinity = std::numeric_limits<double>::infinity();

template <int Dim>
Projector<Dim> projector(FacetMesh<Dim> mesh) {
  return Projector<Dim>(Target<Dim>(std::move(mesh)));
}
Projector<2> projector(const geometry::Curve& curve) { return Projector<2>(Target<2>(curve)); }
Projector<3> projector(const geometry::Surface& surface) {
  return Projector<3>(Target<3>(surface));
}

/// Unit cube, normals outwards; `triangles`: each face cut along a diagonal.
FacetMesh<3> cube(bool triangles) {
  FacetMesh<3> mesh = osculate::testing::box(Vec3(1, 1, 1));
  if (!triangles) return mesh;
  for (const MeshFacet& f : std::exchange(mesh.facets, {})) {
    mesh.facets.push_back({CellType::tri3, {f.nodes[0], f.nodes[1], f.nodes[2]}});
    mesh.facets.push_back({CellType::tri3, {f.nodes[0], f.nodes[2], f.nodes[3]}});
  }
  return mesh;
}

// The seven regions outside the corner (1, 1, 1), and the inside.
TEST(Projector, RegionsOfACubeCorner) {
  for (const bool triangles : {false, true}) {
    const Projector<3> p = projector(cube(triangles));
    const double a = 0.3;
    for (int region = 1; region < 8; ++region) {
      const Vec3 out(region & 1 ? a : -a, region & 2 ? a : -a, region & 4 ? a : -a);
      const ClosestPoint<3> c = p.closest(Vec3(1, 1, 1) + out);
      const int beyond = (region & 1) + (region >> 1 & 1) + (region >> 2 & 1);
      EXPECT_EQ(static_cast<int>(c.feature), beyond) << region;
      EXPECT_NEAR(c.distance, a * std::sqrt(beyond), 1e-14);
      EXPECT_EQ(c.status, Status::projected);
      // Over a face the opposite one is a minimum too.
      EXPECT_NEAR(std::min(c.margin, 9.0), beyond == 1 ? 1 : 9, 1e-14);
      EXPECT_TRUE(c.unique);
    }
    const ClosestPoint<3> inside = p.closest({0.9, 0.8, 0.7});
    EXPECT_EQ(inside.feature, Feature::face);
    EXPECT_NEAR(inside.distance, -0.1, 1e-15);
    EXPECT_NEAR(inside.margin, 0.1, 1e-15);
    EXPECT_NEAR((inside.second - Vec3(0.9, 1, 0.7)).norm(), 0, 1e-15);
    EXPECT_EQ(p.closest({0.5, 0.5, 0.5}).status, Status::ambiguous);
  }
}

/// A corner whose facets are split unevenly: the plain sum of normals has the wrong sign there.
TEST(Projector, SignAtACornerIsWeightedByAngles) {
  FacetMesh<3> mesh;
  // A thin fin: two facets back to back at the tip, one of them cut into many slivers.
  mesh.nodes = {{0, 0, 0}};
  const Vec3 a(1, 0, 0.15), b(1, 0, -0.15);
  const int slivers = 12;
  std::vector<Index> rim;
  for (int k = 0; k <= slivers; ++k) {
    const double t = static_cast<double>(k) / slivers;
    rim.push_back(static_cast<Index>(mesh.nodes.size()));
    mesh.nodes.push_back(a + Vec3(0, -1 + 2 * t, 0));
  }
  const auto low = static_cast<Index>(mesh.nodes.size());
  mesh.nodes.push_back(b + Vec3(0, -1, 0));
  mesh.nodes.push_back(b + Vec3(0, 1, 0));
  for (int k = 0; k < slivers; ++k)
    mesh.facets.push_back(
        {CellType::tri3,
         {0, rim[static_cast<std::size_t>(k)], rim[static_cast<std::size_t>(k) + 1]}});
  mesh.facets.push_back({CellType::tri3, {0, low + 1, low}});
  mesh.facets.push_back({CellType::tri3, {0, low, rim.front()}});
  mesh.facets.push_back({CellType::tri3, {0, rim.back(), low + 1}});
  const Projector<3> p = projector(mesh);
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> u(-1, 1);
  int corners = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vec3 point(-0.3 * std::abs(u(generator)), 0.2 * u(generator), 0.3 * u(generator));
    const ClosestPoint<3> c = p.closest(point);
    EXPECT_GT(c.distance, 0) << point.transpose();  // the body lies at x > 0
    if (c.feature == Feature::corner) ++corners;
  }
  EXPECT_GT(corners, 500);
}

/// A smooth shape and the NURBS that is the same: distance, sign, feature, margin.
TEST(Projector, NurbsCircleIsTheCircle) {
  geometry::NurbsCurve n;
  const double w = std::sqrt(0.5);
  n.degree = 2;
  n.knots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
  n.control = {{1, 0}, {1, -1}, {0, -1}, {-1, -1}, {-1, 0}, {-1, 1}, {0, 1}, {1, 1}, {1, 0}};
  n.weights = {1, w, 1, w, 1, w, 1, w, 1};
  const Projector<2> a = projector(geometry::Curve(n)),
                     b = projector(geometry::Curve(geometry::Circle{}));
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> u(-2, 2);
  for (int k = 0; k < 3000; ++k) {
    const Vec2 point(u(generator), u(generator));
    const ClosestPoint<2> x = a.closest(point), y = b.closest(point);
    EXPECT_NEAR(x.distance, y.distance, 1e-14);
    EXPECT_EQ(x.feature, y.feature);
    EXPECT_EQ(x.margin, y.margin) << point.transpose();
    EXPECT_EQ(x.status, y.status);
  }
  for (const Projector<2>* p : {&a, &b}) {
    const ClosestPoint<2> centre = p->closest({0, 0});
    EXPECT_EQ(centre.status, Status::outside_domain);
    EXPECT_FALSE(centre.unique);
    EXPECT_NEAR(centre.distance, -1, 1e-15);
    EXPECT_LE(centre.margin, 1e-12);
  }
}

TEST(Projector, OpenArcKnowsItsFarEnd) {
  geometry::Arc arc;
  arc.from = 0;
  arc.to = 1.75 * std::numbers::pi;
  const Projector<2> p = projector(geometry::Curve(arc));
  // Over the gap: one end is near, the other one the second minimum.
  const ClosestPoint<2> c = p.closest({0.9, -0.3});
  EXPECT_EQ(c.feature, Feature::corner);
  EXPECT_NEAR((c.point - Vec2(1, 0)).norm(), 0, 1e-15);
  const double r = std::sqrt(0.5);
  EXPECT_NEAR(c.margin, (Vec2(0.9, -0.3) - Vec2(r, -r)).norm() - std::abs(c.distance), 1e-14);
  EXPECT_EQ(p.closest(1.5 * Vec2(std::cos(-0.125 * std::numbers::pi),
                                 std::sin(-0.125 * std::numbers::pi)))
                .status,
            Status::ambiguous);
}

/// Everything scales: the same named answers from 1e-12 to 1e12.
TEST(Projector, AnswersDoNotDependOnTheUnit) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> u(-1, 1);
  std::vector<Vec3> points;
  for (int k = 0; k < 200; ++k) points.push_back(Vec3(u(generator), u(generator), u(generator)));
  FacetMesh<3> unit;
  unit.nodes = {{0, 0, 0},      {1, 0, 0},     {1, 1, 0},     {0, 1, 0},   {.5, -.1, .3},
                {1.1, .5, -.2}, {.5, 1.1, .3}, {-.1, .5, .2}, {.5, .5, .6}};
  unit.facets = {{CellType::quad9, {0, 1, 2, 3, 4, 5, 6, 7, 8}}};
  const Projector<3> reference = projector(unit);
  for (const double scale : {1e-12, 1e-3, 1e12}) {
    FacetMesh<3> mesh = unit;
    for (Vec3& x : mesh.nodes) x *= scale;
    const Projector<3> p = projector(mesh);
    for (const Vec3& x : points) {
      const ClosestPoint<3> a = reference.closest(x), b = p.closest(scale * x);
      EXPECT_NEAR(b.distance / scale, a.distance, 1e-13);
      EXPECT_EQ(a.feature, b.feature);
      EXPECT_EQ(a.status, b.status);
      if (std::isfinite(a.margin)) {
        EXPECT_NEAR(b.margin / scale, a.margin, 1e-12);
      } else {
        EXPECT_EQ(b.margin, infinity);
      }
    }
  }
}

TEST(Projector, FarPointsAndPointsOnTheSurface) {
  const Projector<3> p = projector(cube(true));
  const ClosestPoint<3> far = p.closest({1e12, 0.5, 0.25});
  EXPECT_EQ(far.feature, Feature::face);
  EXPECT_NEAR(far.distance, 1e12 - 1, 1e-3);
  EXPECT_EQ(far.point, Vec3(1, 0.5, 0.25));
  const ClosestPoint<3> on = p.closest({1, 0.5, 0.25});
  EXPECT_EQ(on.distance, 0);
  EXPECT_EQ(on.feature, Feature::face);
  EXPECT_EQ(on.status, Status::projected);
  const ClosestPoint<3> vertex = p.closest({1, 1, 1});
  EXPECT_EQ(vertex.distance, 0);
  for (const double bad : {std::nan(""), infinity, -infinity}) {
    const ClosestPoint<3> c = p.closest({0, bad, 0});
    EXPECT_EQ(c.status, Status::invalid);
    EXPECT_EQ(c.feature, Feature::none);
    EXPECT_EQ(c.facet, -1);
  }
}

struct Degenerate {
  const char* name;
  FacetMesh<3> mesh;
};

std::vector<Degenerate> degenerate_meshes() {
  std::vector<Degenerate> all;
  const auto add = [&](const char* name, CellType type, std::vector<Vec3> nodes,
                       std::vector<Index> order) {
    FacetMesh<3> mesh;
    mesh.nodes = std::move(nodes);
    MeshFacet facet{type, {}};
    std::copy(order.begin(), order.end(), facet.nodes.begin());
    mesh.facets = {facet};
    all.push_back({name, mesh});
  };
  add("triangle that is a line", CellType::tri3, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {0, 1, 2});
  add("triangle that is a point", CellType::tri3, {{1, 1, 1}}, {0, 0, 0});
  add("quad with one corner twice", CellType::quad4, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
      {0, 1, 2, 2});
  add("quad with coincident nodes", CellType::quad4, {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}},
      {0, 1, 2, 3});
  add("quad that is a line", CellType::quad4, {{0, 0, 0}, {1, 0, 0}}, {0, 1, 1, 0});
  add("folded quad", CellType::quad4, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {0, 1, 2, 3});
  add("quad9 folded by its middle", CellType::quad9,
      {{0, 0, 0},
       {1, 0, 0},
       {1, 1, 0},
       {0, 1, 0},
       {.5, 0, 0},
       {1, .5, 0},
       {.5, 1, 0},
       {0, .5, 0},
       {1.9, .5, 0}},
      {0, 1, 2, 3, 4, 5, 6, 7, 8});
  add("tri6 with a mid node on a corner", CellType::tri6,
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {.5, .5, 0}, {0, .5, 0}}, {0, 1, 2, 3, 4, 5});
  add("quad9 that is a point", CellType::quad9, {{1, 2, 3}}, {0, 0, 0, 0, 0, 0, 0, 0, 0});
  return all;
}

/// Never a hang, a NaN or a farther point than a dense sample of the facet.
TEST(Projector, BeyondTheRangeOfSquaresPointsAreInvalidAndNotWrong) {
  const Projector<3> sphere{Target<3>(geometry::Surface(geometry::Sphere{}))};
  FacetMesh<3> mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.facets = {{cell::CellType::tri3, {0, 1, 2}}};
  const Projector<3> triangle{Target<3>(mesh)};
  for (const Projector<3>* const projector : {&sphere, &triangle}) {
    EXPECT_EQ(projector->closest({1e151, 0, 0}).status, Status::invalid);
    EXPECT_EQ(projector->closest({0, -1e308, 0}, Mode::fast).status, Status::invalid);
    const ClosestPoint<3> far = projector->closest({0, 0, 1e150});
    EXPECT_EQ(far.status, Status::projected);
    EXPECT_NEAR(far.distance / 1e150, 1, 1e-12);
  }
}

TEST(Projector, DegenerateFacetsEndInANamedAnswer) {
  std::mt19937 generator(17);
  std::uniform_real_distribution<double> u(-1, 2);
  for (const Degenerate& d : degenerate_meshes()) {
    const Projector<3> p = projector(d.mesh);
    const MeshFacet& f = d.mesh.facets.front();
    for (int k = 0; k < 60; ++k) {
      // Also in the plane of the facet and on its nodes.
      Vec3 point(u(generator), u(generator), k % 3 == 0 ? 0.0 : u(generator));
      if (k == 1) point = d.mesh.nodes.front();
      for (const Mode mode : {Mode::fast, Mode::nearest, Mode::certified}) {
        const ClosestPoint<3> c = p.closest(point, mode);
        EXPECT_NE(c.status, Status::invalid) << d.name;
        EXPECT_NE(c.feature, Feature::none) << d.name;
        EXPECT_TRUE(std::isfinite(c.distance)) << d.name;
        if (mode == Mode::certified) {
          EXPECT_FALSE(std::isnan(c.margin)) << d.name;
        }
        if (mode == Mode::fast) continue;
        double sampled = infinity;
        const int n = 30;
        for (int i = 0; i <= n; ++i)
          for (int j = 0; j <= n; ++j) {
            Vec2 xi(2.0 * i / n - 1, 2.0 * j / n - 1);
            if (cell::is_triangle(f.type))
              xi = Vec2(static_cast<double>(i) / n, static_cast<double>(j) / n * (n - i) / n);
            const cell::FacetShape shape = cell::facet_shape(f.type, xi, 0);
            Vec3 r = Vec3::Zero();
            for (std::size_t s = 0; s < static_cast<std::size_t>(shape.count); ++s)
              r += shape.n[0][s] * d.mesh.nodes[static_cast<std::size_t>(f.nodes[s])];
            sampled = std::min(sampled, (point - r).norm());
          }
        EXPECT_LE(std::abs(c.distance), sampled + 1e-12) << d.name << " " << point.transpose();
      }
    }
  }
}

TEST(Projector, RefusesWhatIsNoSurface) {
  const auto message = [](const FacetMesh<3>& mesh) {
    try {
      (void)projector(mesh);
    } catch (const core::InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  FacetMesh<3> mesh;
  EXPECT_EQ(message(mesh), "a surface needs at least one facet");
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.facets = {{CellType::tri3, {0, 1, 3}}};
  EXPECT_EQ(message(mesh), "facet 0 names node 3; there are nodes 0 to 2");
  mesh.facets = {{CellType::line2, {0, 1}}};
  EXPECT_EQ(message(mesh), "facet 0 is a line2, which is not a facet here");
  mesh.facets = {{CellType::tri3, {0, 1, 2}}};
  mesh.nodes[1][2] = std::nan("");
  EXPECT_EQ(message(mesh), "node 1 has a coordinate that is not finite");
}

/// Where the medial axis is not crossed the foot follows the point: steps of the path shorten, and
/// so do those of the foot, over faces, edges and corners.
TEST(Projector, FootFollowsThePointOverEdgesAndCorners) {
  const Projector<3> p = projector(cube(false));
  const auto path = [](double t) {
    const double a = 2 * std::numbers::pi * t;  // closed, round the corner (1, 1, 1)
    return Vec3(1 + 0.4 * std::cos(a) + 0.15, 1 + 0.4 * std::sin(a) + 0.1,
                1.26 + 0.25 * std::cos(2 * a));
  };
  int features[4] = {0, 0, 0, 0};
  for (const int steps : {500, 5000}) {
    ClosestPoint<3> before = p.closest(path(0));
    for (int k = 1; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      const ClosestPoint<3> now = p.closest(path(t));
      ++features[static_cast<int>(now.feature)];
      const double moved = (path(t) - path(static_cast<double>(k - 1) / steps)).norm();
      // Outside a convex body the projection does not stretch.
      EXPECT_LE((now.point - before.point).norm(), moved * (1 + 1e-12));
      EXPECT_LE(std::abs(now.distance - before.distance), moved * (1 + 1e-12));
      before = now;
    }
  }
  EXPECT_GT(features[1], 0);
  EXPECT_GT(features[2], 0);
  EXPECT_GT(features[3], 0);
}

/// Inside a valley the jump happens on the plane between both faces and nowhere else.
TEST(Projector, FootJumpsOnlyAcrossTheMedialAxis) {
  FacetMesh<2> valley;  // the body is below: y < |x|
  valley.nodes = {{1, 1}, {0, 0}, {-1, 1}};
  valley.facets = {{CellType::line2, {1, 0}}, {CellType::line2, {2, 1}}};
  const Projector<2> p = projector(valley);
  ClosestPoint<2> before = p.closest({-0.3, 0.7});
  int jumps = 0;
  const int steps = 1001;
  for (int k = 1; k <= steps; ++k) {
    const double x = -0.3 + 0.6 * k / steps;
    const ClosestPoint<2> now = p.closest({x, 0.7});
    if ((now.point - before.point).norm() > 0.01) {
      ++jumps;
      EXPECT_LT(std::abs(x), 0.6 / steps);
      EXPECT_LT(std::min(now.margin, before.margin), 2e-3);
    }
    before = now;
  }
  EXPECT_EQ(jumps, 1);
  EXPECT_EQ(p.closest({0, 0.7}).status, Status::ambiguous);
  const ClosestPoint<2> below = p.closest({0, -0.5});  // outside the kink on the convex side
  EXPECT_EQ(below.feature, Feature::corner);
  EXPECT_EQ(below.status, Status::projected);
  EXPECT_EQ(below.margin, infinity);
}

/// With history an equidistant point keeps its side, from whichever it came; away from there the
/// answers are those without.
TEST(Projector, EquidistantPointsKeepTheSideTheyCameFrom) {
  FacetMesh<2> valley;
  valley.nodes = {{1, 1}, {0, 0}, {-1, 1}};
  valley.facets = {{CellType::line2, {1, 0}}, {CellType::line2, {2, 1}}};
  const Projector<2> p = projector(valley);
  for (const double side : {-1.0, 1.0}) {
    ClosestPoint<2> last = p.closest({0.3 * side, 0.7});
    for (int k = 9; k >= 0; --k) {
      last = p.follow({0.03 * side * k, 0.7}, last);
      EXPECT_GT(last.point[0] * side, 0.2);
      EXPECT_NEAR(std::abs(last.distance), std::abs(p.closest({0.03 * side * k, 0.7}).distance),
                  1e-15);
    }
  }
  const Projector<3> box = projector(cube(true));
  std::mt19937 generator(31);
  std::uniform_real_distribution<double> u(-1, 2);
  ClosestPoint<3> last = box.closest({2, 2, 2});
  for (int k = 0; k < 500; ++k) {
    const Vec3 point(u(generator), u(generator), u(generator));
    const ClosestPoint<3> now = box.closest(point);
    if (now.status != Status::projected) continue;
    for (const Mode mode : {Mode::fast, Mode::certified}) {
      last = box.follow(point, last, mode);
      EXPECT_NEAR(last.distance, now.distance, 1e-14);
      EXPECT_EQ(last.feature, now.feature);
    }
    EXPECT_NEAR((last.point - now.point).norm(), 0, 1e-14);
  }
}

/// A foot point that comes to lie on a corner by rounding lies on it exactly.
TEST(Projector, CornersAreReachedExactly) {
  FacetMesh<3> mesh;  // z = (x^2 - y^2)/2 over the unit square
  const double x[9] = {0, 1, 1, 0, 0.5, 1, 0.5, 0, 0.5}, y[9] = {0, 0, 1, 1, 0, 0.5, 1, 0.5, 0.5};
  MeshFacet facet{CellType::quad9, {}};
  for (std::size_t k = 0; k < 9; ++k) {
    mesh.nodes.push_back({x[k], y[k], 0.5 * (x[k] * x[k] - y[k] * y[k])});
    facet.nodes[k] = static_cast<Index>(k);
  }
  mesh.facets = {facet};
  const Projector<3> p = projector(mesh);
  // The centre of curvature of the corner (1, 0, 1/2) is nearer to the corner (0, 0, 0).
  const ClosestPoint<3> c = p.closest({-1, 0, 2.5});
  EXPECT_EQ(c.point, Vec3(0, 0, 0));
  EXPECT_EQ(c.feature, Feature::corner);
  EXPECT_NEAR(c.distance, std::sqrt(7.25), 1e-15);
  // The corner itself is the second one, flat: its distance is bounded from below to 1e-13.
  EXPECT_NEAR(c.margin, std::sqrt(8) - std::sqrt(7.25), 2e-13);
}

/// Points on the evolute of a parabola: the second derivative of the distance vanishes.
TEST(Projector, PointsOnTheEvoluteAreOutsideTheDomain) {
  FacetMesh<2> mesh;
  mesh.nodes = {{-1, 1}, {1, 1}, {0, 0}};
  mesh.facets = {{CellType::line3, {0, 1, 2}}};  // y = x^2
  const Projector<2> p = projector(mesh);
  EXPECT_EQ(p.closest({0, 0.5}).status, Status::outside_domain);  // radius 1/2 at the vertex
  EXPECT_EQ(p.closest({0, 0.49}).status, Status::projected);
  EXPECT_EQ(p.closest({0, 0.6}).status, Status::ambiguous);
  EXPECT_NEAR(std::abs(p.closest({0, 0.5}).distance), 0.5, 1e-12);
}

TEST(Projector, SeamsAndPolesOfAPatchAreNoBorders) {
  // Half a circle turned about the z axis: a sphere with two poles and a seam.
  const double w = std::sqrt(0.5);
  geometry::NurbsPatch sphere;
  sphere.degree = {2, 2};
  sphere.knots = {std::vector<double>{0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4},
                  std::vector<double>{0, 0, 0, 1, 1, 2, 2, 2}};
  sphere.count = {9, 5};
  const Vec2 ring[9] = {{1, 0},   {1, 1},  {0, 1},  {-1, 1}, {-1, 0},
                        {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
  const Vec2 arc[5] = {{0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}};
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 5; ++j) {
      sphere.control.push_back({arc[j][0] * ring[i][0], arc[j][0] * ring[i][1], arc[j][1]});
      sphere.weights.push_back((i % 2 ? w : 1) * (j % 2 ? w : 1));
    }
  const Projector<3> p = projector(geometry::Surface(sphere));
  std::mt19937 generator(23);
  std::uniform_real_distribution<double> u(-2, 2);
  for (int k = 0; k < 1000; ++k) {
    Vec3 point(u(generator), u(generator), u(generator));
    if (k % 5 == 0) point[1] = 0;             // the plane of the seam
    if (k % 7 == 0) point[0] = point[1] = 0;  // the axis through the poles
    if (point.norm() < 1e-3) continue;
    const ClosestPoint<3> c = p.closest(point);
    EXPECT_NEAR(c.distance, point.norm() - 1, 1e-13) << point.transpose();
    EXPECT_EQ(c.status, Status::projected) << point.transpose();
    EXPECT_EQ(c.margin, infinity) << point.transpose();
  }
  EXPECT_NE(p.closest({0, 0, 0}).status, Status::projected);
}

}  // namespace
