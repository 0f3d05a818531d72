#include "osculate/body/inertia.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace osculate::body {
namespace {

constexpr double pi = std::numbers::pi;
const Vec3 tilted(0.4, -0.9, 0.7);

using Triangle = std::array<Vec3, 3>;

/// A box with edges a, b, c and one corner at `corner`, turned; normals outwards.
std::vector<Triangle> box(const Vec3& corner, const Vec3& edges, const Mat<3, 3>& r) {
  std::vector<Triangle> out;
  for (int d = 0; d < 3; ++d)
    for (int side = 0; side < 2; ++side) {
      const int e = (d + 1) % 3, f = (d + 2) % 3;
      std::array<Vec3, 4> q;
      for (int k = 0; k < 4; ++k) {
        Vec3 local = side * edges[d] * Vec3::Unit(d);
        if (k == 1 || k == 2) local += edges[e] * Vec3::Unit(e);
        if (k >= 2) local += edges[f] * Vec3::Unit(f);
        q[static_cast<std::size_t>(k)] = corner + r * local;
      }
      if (side == 0) std::swap(q[1], q[3]);
      out.push_back({q[0], q[1], q[2]});
      out.push_back({q[0], q[2], q[3]});
    }
  return out;
}

Inertia<3> of_triangles(const std::vector<Triangle>& facets, const Vec3& origin, double density) {
  VolumeMoments<3> moments;
  moments.origin = origin;
  for (const Triangle& t : facets) add_facet(moments, t[0], t[1], t[2]);
  return inertia_of(moments, density);
}

TEST(Inertia, OfABoxFromItsSurface) {
  const Mat<3, 3> r = Eigen::AngleAxisd(0.8, tilted.normalized()).toRotationMatrix();
  const Vec3 edges(1.5, 0.7, 2.2), corner(3, -1, 0.5);
  const double density = 1.3, mass = density * edges.prod();
  const Vec3 squares = edges.cwiseAbs2();
  const Vec3 principal = mass / 12 * Vec3(squares.sum() * Vec3::Ones() - squares);
  const Mat<3, 3> expected = r * principal.asDiagonal() * r.transpose();
  std::vector<Triangle> facets = box(corner, edges, r);
  for (const bool inwards : {false, true}) {
    if (inwards)
      for (Triangle& t : facets) std::swap(t[0], t[1]);
    for (const Vec3& origin : {corner, Vec3(0, 0, 0), Vec3(4, 1, -2)}) {
      const Inertia<3> found = of_triangles(facets, origin, density);
      EXPECT_NEAR(found.mass, mass, 1e-14 * mass * 10);
      EXPECT_LT((found.center - corner - r * edges / 2).norm(), 1e-14 * 5);
      EXPECT_LT((found.tensor - expected).norm(), 1e-13 * expected.norm());
      EXPECT_EQ(validate(found), "");
    }
  }
}

/// Base times height over three, centre at a quarter: the exact moments of a tetrahedron.
TEST(Inertia, OfATetrahedron) {
  const Vec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const Inertia<3> found =
      of_triangles({{o, y, x}, {o, x, z}, {o, z, y}, {x, y, z}}, Vec3(0.3, 0.1, 2), 6.0);
  EXPECT_NEAR(found.mass, 1.0, 1e-14);
  EXPECT_LT((found.center - Vec3::Constant(0.25)).norm(), 1e-14);
  // integral of x^2 is 1/60, of x y 1/120, times the density 6, less m/16
  const double square = 0.1 - 1.0 / 16, product = 0.05 - 1.0 / 16;
  const Mat<3, 3> second = (square - product) * Mat<3, 3>::Identity() + product * Mat<3, 3>::Ones();
  EXPECT_LT((found.tensor - second.trace() * Mat<3, 3>::Identity() + second).norm(), 1e-14);
}

TEST(Inertia, OfARectangleFromItsOutline) {
  const double c = std::cos(0.4), s = std::sin(0.4), a = 2.0, b = 0.6, density = 1.7;
  const Vec2 corner(5, -3), e(a * c, a * s), f(-b * s, b * c);
  const std::array<Vec2, 4> p{corner, corner + e, corner + e + f, corner + f};
  for (const bool clockwise : {true, false}) {
    VolumeMoments<2> moments;
    moments.origin = {4, 4};
    for (std::size_t i = 0; i < 4; ++i)
      if (clockwise)
        add_facet(moments, p[(i + 1) % 4], p[i]);
      else
        add_facet(moments, p[i], p[(i + 1) % 4]);
    EXPECT_EQ(moments.volume > 0, clockwise);
    const Inertia<2> found = inertia_of(moments, density);
    EXPECT_NEAR(found.mass, density * a * b, 1e-14 * 10);
    EXPECT_LT((found.center - corner - 0.5 * (e + f)).norm(), 1e-14 * 10);
    EXPECT_NEAR(found.tensor(0, 0), density * a * b * (a * a + b * b) / 12, 1e-12);
    EXPECT_EQ(validate(found), "");
  }
}

TEST(Inertia, OfADiscAndOfArcs) {
  const geometry::Circle circle{{2, 1}, 0.7, false};
  const double mass = 3 * pi * 0.49;
  const std::optional<VolumeMoments<2>> whole = enclosed(geometry::Curve(circle));
  ASSERT_TRUE(whole.has_value());
  const Inertia<2> disc = inertia_of(*whole, 3);
  EXPECT_NEAR(disc.mass, mass, 1e-14 * 10);
  EXPECT_LT((disc.center - circle.center).norm(), 1e-14 * 10);
  EXPECT_NEAR(disc.tensor(0, 0), 0.5 * mass * 0.49, 1e-14 * 10);
  // Half a disc: an arc and its chord. The arc runs clockwise, from (2.7, 1) back to (1.3, 1).
  VolumeMoments<2> half;
  half.origin = circle.center;
  add_curve(half, geometry::Arc{circle.center, 0.7, pi, 2 * pi, false});
  add_facet(half, Vec2(1.3, 1), Vec2(2.7, 1));
  const Inertia<2> lower = inertia_of(half, 3);
  EXPECT_NEAR(lower.mass, 0.5 * mass, 1e-14 * 10);
  EXPECT_LT((lower.center - circle.center - Vec2(0, -4 * 0.7 / (3 * pi))).norm(), 1e-14 * 10);
  EXPECT_NEAR(tensor_about<2>(lower, circle.center)(0, 0), 0.25 * mass * 0.49, 1e-14 * 10);
  EXPECT_FALSE(enclosed(geometry::Curve(geometry::Circle{{0, 0}, 1, true})).has_value());
  EXPECT_FALSE(enclosed(geometry::Curve(geometry::InfiniteLine{})).has_value());
}

/// A circle of nine rational control points: its knots are where the quadrature must stop.
TEST(Inertia, OfAClosedNurbs) {
  geometry::NurbsCurve c;
  c.degree = 2;
  c.knots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
  const std::array<Vec2, 9> square{Vec2(1, 0),  Vec2(1, -1), Vec2(0, -1), Vec2(-1, -1), Vec2(-1, 0),
                                   Vec2(-1, 1), Vec2(0, 1),  Vec2(1, 1),  Vec2(1, 0)};
  for (std::size_t i = 0; i < 9; ++i) {
    c.control.push_back(Vec2(4, 5) + 2 * square[i]);
    c.weights.push_back(i % 2 == 0 ? 1 : std::sqrt(0.5));
  }
  const std::optional<VolumeMoments<2>> moments = enclosed(geometry::Curve(c));
  ASSERT_TRUE(moments.has_value());
  const Inertia<2> disc = inertia_of(*moments, 1);
  EXPECT_NEAR(disc.mass, 4 * pi, 1e-12);
  EXPECT_LT((disc.center - Vec2(4, 5)).norm(), 1e-13);
  EXPECT_NEAR(disc.tensor(0, 0), 8 * pi, 1e-12);
}

/// The closed forms against the theorem, over facets at the surface: order 2 in their size.
void expect_surface_agrees(const geometry::Surface& surface, bool round_ends) {
  const std::optional<VolumeMoments<3>> moments = enclosed(surface);
  ASSERT_TRUE(moments.has_value());
  const Inertia<3> exact = inertia_of(*moments, 1.4);
  EXPECT_EQ(validate(exact), "");
  const Vec2 lo = geometry::lo(surface), hi = geometry::hi(surface);
  const auto error = [&](int n) {
    std::vector<Triangle> facets;
    const auto at = [&](int i, int j) {
      return geometry::jet(surface,
                           Vec2(lo[0] + (hi[0] - lo[0]) * i / n, lo[1] + (hi[1] - lo[1]) * j / n))
          .r;
    };
    const auto middle = [&](int j) { return Vec3(0.5 * (at(0, j) + at(n / 2, j))); };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        facets.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        facets.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
      if (!round_ends) continue;
      facets.push_back({middle(0), at(i + 1, 0), at(i, 0)});
      facets.push_back({middle(n), at(i, n), at(i + 1, n)});
    }
    const Inertia<3> found = of_triangles(facets, Vec3(0.3, 0.2, 0.1), 1.4);
    return Vec3(std::abs(found.mass / exact.mass - 1), (found.center - exact.center).norm(),
                (found.tensor - exact.tensor).norm() / exact.tensor.norm());
  };
  const Vec3 coarse = error(64), fine = error(128);
  EXPECT_NEAR(std::log2(coarse[0] / fine[0]), 2, 0.02) << coarse[0];
  EXPECT_NEAR(std::log2(coarse[2] / fine[2]), 2, 0.02) << coarse[2];
  EXPECT_TRUE(fine[1] < 1e-12 || std::abs(std::log2(coarse[1] / fine[1]) - 2) < 0.05) << fine[1];
}

TEST(Inertia, OfRoundShapesAgreesWithTheirSurfaces) {
  expect_surface_agrees(geometry::Torus{{1, 2, 3}, tilted, 2.0, 0.6, false}, false);
  expect_surface_agrees(geometry::Cylinder{{1, 2, 3}, tilted, 0.8, false, 2.5}, true);
  expect_surface_agrees(geometry::Cone{{1, 2, 3}, tilted, 0.4, false, 0.7, 2.5}, true);
  expect_surface_agrees(geometry::Cone{{1, 2, 3}, tilted, 0.4, false, 0.0, 2.5}, true);
}

/// The textbook's numbers.
TEST(Inertia, OfSolidShapes) {
  const Inertia<3> sphere =
      inertia_of(*enclosed(geometry::Surface(geometry::Sphere{{1, 2, 3}, 0.5})), 2.0);
  const double m = 2.0 * 4 / 3 * pi * 0.125;
  EXPECT_NEAR(sphere.mass, m, 1e-15);
  EXPECT_EQ(sphere.center, Vec3(1, 2, 3));
  EXPECT_LT((sphere.tensor - 0.4 * m * 0.25 * Mat<3, 3>::Identity()).norm(), 1e-15);
  const Inertia<3> cylinder = inertia_of(
      *enclosed(geometry::Surface(geometry::Cylinder{{0, 0, -1}, {0, 0, 3}, 0.5, false, 4})), 2.0);
  const double mass = 2 * pi;
  EXPECT_NEAR(cylinder.mass, mass, 1e-14);
  EXPECT_LT((cylinder.center - Vec3(0, 0, 1)).norm(), 1e-15);
  EXPECT_NEAR(cylinder.tensor(2, 2), 0.5 * mass * 0.25, 1e-14);
  EXPECT_NEAR(cylinder.tensor(0, 0), mass * (0.25 / 4 + 16.0 / 12), 1e-14);
  const Inertia<3> cone = inertia_of(*enclosed(geometry::Surface(geometry::Cone{
                                         {0, 0, 0}, {0, 0, 1}, std::atan(0.5), false, 0, 2})),
                                     1.0);
  EXPECT_NEAR(cone.mass, pi * 2 / 3, 1e-14);
  EXPECT_NEAR(cone.center.z(), 1.5, 1e-14);
  EXPECT_NEAR(cone.tensor(2, 2), 0.3 * cone.mass, 1e-14);
  EXPECT_NEAR(cone.tensor(0, 0), cone.mass * 3.0 / 80 * (4 * 1 + 4), 1e-14);
  const double infinite = std::numeric_limits<double>::infinity();
  for (const geometry::Surface& open :
       std::vector<geometry::Surface>{geometry::Plane{}, geometry::Sphere{{0, 0, 0}, 1, true},
                                      geometry::Cylinder{{0, 0, 0}, {0, 0, 1}, 1, false, infinite},
                                      geometry::Cone{{0, 0, 0}, {0, 0, 1}, 0.5, false, 0, infinite},
                                      geometry::Torus{{0, 0, 0}, {0, 0, 1}, 2, 1, true}})
    EXPECT_FALSE(enclosed(open).has_value());
}

/// Two halves of a box are the box; so are the cells of a grid.
TEST(Inertia, OfPartsIsThatOfTheWhole) {
  const Mat<3, 3> r = Eigen::AngleAxisd(0.8, tilted.normalized()).toRotationMatrix();
  const Vec3 corner(3, -1, 0.5), half(0.75, 0.7, 2.2), edges(1.5, 0.7, 2.2);
  const Inertia<3> a = of_triangles(box(corner, half, r), corner, 1.3);
  const Inertia<3> b = of_triangles(box(corner + r * Vec3(0.75, 0, 0), half, r), corner, 1.3);
  const Inertia<3> whole = of_triangles(box(corner, edges, r), corner, 1.3), sum = joined(a, b);
  EXPECT_NEAR(sum.mass, whole.mass, 1e-13);
  EXPECT_LT((sum.center - whole.center).norm(), 1e-13);
  EXPECT_LT((sum.tensor - whole.tensor).norm(), 1e-13);
  // Gauss points of the box as pieces of volume: exact for second moments.
  VolumeMoments<3> cells;
  const double g = 0.5 / std::sqrt(3.0);
  for (const double x : {-g, g})
    for (const double y : {-g, g})
      for (const double z : {-g, g})
        add_volume<3>(cells, corner + r * (0.5 * edges + edges.cwiseProduct(Vec3(x, y, z))).eval(),
                      edges.prod() / 8);
  EXPECT_LT((inertia_of(cells, 1.3).tensor - whole.tensor).norm(), 1e-13);
}

TEST(Inertia, NamesWhatIsWrong) {
  Inertia<3> one{1.0, Vec3::Zero(), Vec3(1, 2, 2.5).asDiagonal()};
  EXPECT_EQ(validate(one), "");
  one.tensor(2, 2) = 3.1;
  EXPECT_NE(validate(one).find("larger than the sum"), std::string::npos);
  one.tensor(2, 2) = -1;
  EXPECT_EQ(validate(one), "the moments of inertia must be positive");
  one.tensor(0, 1) = 0.5;
  EXPECT_EQ(validate(one), "the inertia must be symmetric");
  one.mass = 0;
  EXPECT_EQ(validate(one), "the mass must be positive");
  EXPECT_EQ(validate(Inertia<2>{1, Vec2::Zero(), Mat<1, 1>(0.0)}),
            "the moment of inertia must be positive");
  const Inertia<3> nothing = inertia_of(VolumeMoments<3>{}, 1.0);
  EXPECT_EQ(nothing.mass, 0);
  EXPECT_EQ(validate(nothing), "the mass must be positive");
}

}  // namespace
}  // namespace osculate::body
