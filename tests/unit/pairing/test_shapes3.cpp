// Analytic shapes as masters in space: exact tangents, and no trace of their parameters.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "derivative_check.hpp"
#include "osculate/geometry/surface_frame.hpp"
#include "osculate/projection/point_to_surface.hpp"
#include "pair_sample.hpp"
#include "sample_surfaces.hpp"

namespace osculate::testing {
namespace {

using contact::Status;
using geometry::Surface;

/// One slave node `depth` below the place `xi` of a shape; its last foot point is near the place
/// `before`, its traction there `traction` (a vector in space, tangential by projection).
struct ShapeSample {
  Surface shape;
  Vec3 place, before;
  Vec3 traction{3, -4, 2};
  double depth = 0.03;
  double mu = 10;
};

PairSample3 make_shape_sample(const ShapeSample& o) {
  PairSample3 s;
  s.x = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  s.pair.master.facets.push_back(pairing::shape_facet(o.shape, {0, 1, 2, 3}));
  pairing::connect(s.pair.master);
  const Vec2 xi = projection::closest_point(o.shape, o.place).xi;
  const geometry::SurfaceJet jet = geometry::jet(o.shape, xi);
  const Vec3 n = geometry::surface_frame(jet).normal;
  const Vec3 far = jet.r + 0.5 * n;
  add_sample_slave<3>(s, {jet.r - o.depth * n, far + Vec3(0, 0.04, 0), far + Vec3(0.05, 0.05, 0.01),
                          far + Vec3(0.04, 0, 0)});
  s.pair.friction = contact::coulomb(o.mu, 80.0);
  pairing::prepare(s.pair, s.x);
  const Vec2 old = projection::closest_point(o.shape, o.before).xi;
  const geometry::SurfaceFrame f = geometry::surface_frame(geometry::jet(o.shape, old));
  const Vec3 e1 = f.tangent[0].normalized(), e2 = f.normal.cross(e1);
  s.committed.points[0] = remembered(0, old, -0.01, Vec2(o.traction.dot(e1), o.traction.dot(e2)));
  return s;
}

/// Tangent of the slave's own displacement against the residual (the frame is a rigid body's).
void expect_exact_tangent(const ShapeSample& o, Status status) {
  const PairSample3 s = make_shape_sample(o);
  const Eigen::VectorXd v = flatten(s.x);
  const PointFacts at = pair_facts(s, v)[0];
  ASSERT_EQ(at.status, status);
  ASSERT_EQ(at.feature, projection::Feature::face);
  for (Eigen::Index i = 0; i < 3; ++i) {
    Eigen::VectorXd d = Eigen::VectorXd::Zero(v.size());
    d[12 + i] = 1;
    d[12 + (i + 1) % 3] = 0.4;
    const DerivativeReport r =
        check_derivative([&](const Eigen::VectorXd& y) { return pair_residual(s, y); },
                         Eigen::VectorXd(pair_tangent(s, v) * d), v, d, 1e-3);
    EXPECT_TRUE(r.exact || std::abs(r.order - 2.0) < 0.15)
        << "order " << r.order << " error " << r.error;
  }
}

TEST(Shapes3, TangentIsTheDerivativeOnEveryShape) {
  for (const NamedSurface& sample : sample_surfaces()) {
    SCOPED_TRACE(sample.name);
    const std::array<Vec2, 2> range = finite_range(sample.surface);
    const Vec2 xi = range[0] + Vec2(0.33, 0.34).cwiseProduct(range[1] - range[0]);
    const geometry::SurfaceJet jet = geometry::jet(sample.surface, xi);
    ShapeSample o{.shape = sample.surface, .place = jet.r, .before = jet.r + 0.05 * jet.r1[0]};
    expect_exact_tangent(o, Status::stick);
    o.mu = 0.05;
    expect_exact_tangent(o, Status::slip);
  }
}

TEST(Shapes3, TangentIsTheDerivativeAcrossSeams) {
  const geometry::Cylinder cylinder{.radius = 1.5};
  const geometry::Torus torus{};
  const geometry::Sphere sphere{.radius = 1.5};
  const Vec3 ray(0.8, 0.6, 0);
  for (const double mu : {10.0, 0.05}) {
    const Status status = mu > 1 ? Status::stick : Status::slip;
    expect_exact_tangent({.shape = cylinder,
                          .place = Vec3(1.5, 0.1, 0.3),
                          .before = Vec3(1.5, -0.1, 0.25),
                          .mu = mu},
                         status);
    expect_exact_tangent(
        {.shape = torus, .place = Vec3(3, 0.1, -0.1), .before = Vec3(3, -0.1, 0.05), .mu = mu},
        status);
    expect_exact_tangent({.shape = sphere,
                          .place = 1.5 * (ray + Vec3(0, 0, 0.05)),
                          .before = 1.5 * (ray - Vec3(0, 0, 0.06)),
                          .mu = mu},
                         status);
  }
}

TEST(Shapes3, ForceDoesNotKnowWhereTheChartsOfASphereMeet) {
  const Vec3 place = Vec3(0.3, 0.2, 1.4), before = Vec3(0.4, 0.1, 1.4);
  int crossed = 0;
  for (const double mu : {10.0, 0.05})
    for (const bool inside : {false, true}) {
      Vec3 expected = Vec3::Zero();
      Mat<3, 3> stiffness = Mat<3, 3>::Zero();
      // middle of a chart, its edge (history in the other chart), anything between
      for (const Vec3& axis :
           {Vec3(0, 0, 1), Vec3(0.3, 0.2, 1.4), Vec3(1.4, 0, -0.25), Vec3(-1, 2, 0.4)}) {
        SCOPED_TRACE(::testing::Message() << axis.transpose() << " mu " << mu);
        const geometry::Sphere sphere{Vec3(0.1, 0, 0), 1.5, inside, axis};
        const PairSample3 s =
            make_shape_sample({.shape = sphere, .place = place, .before = before, .mu = mu});
        const Vec2 xi = projection::closest_point(sphere, place).xi;
        if (std::abs(xi.x() - s.committed.points[0].xi.x()) > 1.5) ++crossed;
        const Eigen::VectorXd v = flatten(s.x);
        ASSERT_NE(pair_facts(s, v)[0].status, Status::open);
        const Vec3 force = pair_residual(s, v).segment<3>(12);
        const Mat<3, 3> k = pair_tangent(s, v).block<3, 3>(12, 12);
        if (expected.isZero(0.0)) expected = force, stiffness = k;
        EXPECT_GT(force.norm(), 0.1);
        EXPECT_LT((force - expected).norm(), 1e-12 * expected.norm());
        EXPECT_LT((k - stiffness).norm(), 1e-12 * stiffness.norm());
      }
    }
  EXPECT_EQ(crossed, 4);
}

TEST(Shapes3, AFrameThatTurnsCarriesTheShape) {
  const Mat<3, 3> turn = Eigen::AngleAxisd(0.8, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const Vec3 shift(0.3, -1, 2);
  for (const NamedSurface& sample : sample_surfaces()) {
    SCOPED_TRACE(sample.name);
    const std::array<Vec2, 2> range = finite_range(sample.surface);
    const Vec2 xi = range[0] + Vec2(0.33, 0.34).cwiseProduct(range[1] - range[0]);
    const geometry::SurfaceJet jet = geometry::jet(sample.surface, xi);
    PairSample3 s = make_shape_sample(
        {.shape = sample.surface, .place = jet.r, .before = jet.r + 0.05 * jet.r1[0]});
    const Vec3 force = pair_residual(s, flatten(s.x)).segment<3>(12);
    for (Vec3& x : s.x) x = turn * x + shift;
    const Eigen::VectorXd r = pair_residual(s, flatten(s.x));
    EXPECT_LT((r.segment<3>(12) - turn * force).norm(), 1e-11 * force.norm());
    Vec3 sum = Vec3::Zero();
    for (Eigen::Index k = 0; k < r.size() / 3; ++k) sum += r.segment<3>(3 * k);
    EXPECT_LT(sum.norm(), 1e-12 * force.norm());
  }
}

}  // namespace
}  // namespace osculate::testing
