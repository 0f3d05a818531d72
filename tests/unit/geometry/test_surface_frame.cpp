// Metric and curvature of surfaces: exact values, identities, derivatives by order.
#include "osculate/geometry/surface_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sample_surfaces.hpp"

namespace osculate::geometry {
namespace {

using testing::at_surface_places;
using testing::is_derivative;

TEST(SurfaceFrame, MetricAndItsInverse) {
  // [eq:KSVD:4] [eq:KSVD:5] [eq:KSVD:6]
  at_surface_places([](const Surface& s, const Vec2& xi) {
    const SurfaceJet j = jet(s, xi);
    const SurfaceFrame f = surface_frame(j);
    EXPECT_LT((f.a_inv * f.a - Mat<2, 2>::Identity()).norm(), 1e-13);
    EXPECT_NEAR(f.a.determinant() / (f.area * f.area), 1.0, 1e-13);
    EXPECT_GT(f.normal.dot(f.tangent[0].cross(f.tangent[1])), 0.0);  // right-handed
    const std::array<Vec3, 2> dual = contravariant_basis(f);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(f.a(static_cast<Eigen::Index>(i), 1), j.r1[i].dot(j.r1[1]), 1e-15 * f.a.norm());
      for (std::size_t k = 0; k < 2; ++k)
        EXPECT_NEAR(dual[i].dot(f.tangent[k]), i == k ? 1.0 : 0.0, 1e-13);
      EXPECT_NEAR(dual[i].dot(f.normal) / dual[i].norm(), 0.0, 1e-13);
    }
  });
}

TEST(SurfaceFrame, GaussFormulaGivesTheSecondDerivatives) {
  // [eq:KSVD:7] [eq:KSVD:10] [eq:KSVD:11]
  at_surface_places([](const Surface& s, const Vec2& xi) {
    const SurfaceJet j = jet(s, xi);
    const SurfaceFrame f = surface_frame(j);
    for (Eigen::Index i = 0; i < 2; ++i)
      for (Eigen::Index k = 0; k < 2; ++k) {
        const Vec3& second = j.r2[static_cast<std::size_t>(i + k)];
        EXPECT_LT((gauss_formula(f, i, k) - second).norm(), 1e-13 * (1 + second.norm()));
      }
  });
}

TEST(SurfaceFrame, ChristoffelSymbolsAreThoseOfTheMetric) {
  // 2 a_km Gamma^k_ij = a_mi,j + a_mj,i - a_ij,m with the derivatives of the metric from the jet
  at_surface_places([](const Surface& s, const Vec2& xi) {
    const SurfaceJet jt = jet(s, xi);
    const SurfaceFrame f = surface_frame(jt);
    const auto slope = [&](std::size_t p, std::size_t q, std::size_t m) {  // a_pq,m
      return jt.r2[p + m].dot(jt.r1[q]) + jt.r1[p].dot(jt.r2[q + m]);
    };
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j)
        for (std::size_t m = 0; m < 2; ++m) {
          double lowered = 0;
          for (std::size_t k = 0; k < 2; ++k)
            lowered += 2 * f.a(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(m)) *
                       f.gamma[k](static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
          const double expected = slope(m, i, j) + slope(m, j, i) - slope(i, j, m);
          EXPECT_NEAR(lowered, expected, 1e-12 * (1 + f.a.norm()));
        }
  });
}

TEST(SurfaceFrame, WeingartenByOrder) {  // [eq:KSVD:9]
  at_surface_places([](const Surface& s, const Vec2& xi) {
    const SurfaceFrame f = surface_frame(jet(s, xi));
    const auto normal = [&](const Vec2& x) { return surface_frame(jet(s, x)).normal; };
    for (Eigen::Index i = 0; i < 2; ++i) {
      const Vec3 exact = weingarten_formula(f, i);
      EXPECT_TRUE(is_derivative(normal, exact, xi, i));
      if (exact.norm() > 1e-2) {
        EXPECT_FALSE(is_derivative(normal, -exact, xi, i));
      }
    }
  });
}

TEST(SurfaceFrame, RaisedCurvatureTensorActsOnTheDualBasis) {  // [eq:KSVD:8]
  // h^ij r_i (x) r_j = h_ij r^i (x) r^j is one and the same tensor of the space around
  at_surface_places([](const Surface& s, const Vec2& xi) {
    const SurfaceFrame f = surface_frame(jet(s, xi));
    const Mat<2, 2> up = contravariant_curvature(f);
    const std::array<Vec3, 2> dual = contravariant_basis(f);
    Mat<3, 3> a = Mat<3, 3>::Zero(), b = Mat<3, 3>::Zero();
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j) {
        const auto p = static_cast<Eigen::Index>(i), q = static_cast<Eigen::Index>(j);
        a += up(p, q) * f.tangent[i] * f.tangent[j].transpose();
        b += f.h(p, q) * dual[i] * dual[j].transpose();
      }
    EXPECT_LT((a - b).norm(), 1e-12 * (1 + b.norm()));
    EXPECT_NEAR(0.5 * a.trace(), mean_curvature(f), 1e-12 * (1 + b.norm()));
  });
}

TEST(SurfaceFrame, OffsetTangentsByOrder) {  // [eq:KSVD:17]
  at_surface_places([](const Surface& s, const Vec2& xi) {
    for (const double zeta : {-0.3, 0.2}) {
      const auto offset = [&](const Vec2& x) {
        const SurfaceJet j = jet(s, x);
        return offset_point(j, surface_frame(j).normal, zeta);
      };
      const SurfaceFrame f = surface_frame(jet(s, xi));
      for (Eigen::Index i = 0; i < 2; ++i)
        EXPECT_TRUE(is_derivative(offset, offset_tangent(f, i, zeta), xi, i));
    }
  });
}

TEST(SurfaceFrame, CovariantDerivativeIsTheTangentPartOfTheDerivative) {  // [eq:KSVD:19]
  const auto field = [](const Vec2& x) {
    return Vec2(0.7 + 0.4 * x.x() * x.y(), std::sin(0.8 * x.x()) - 0.3 * x.y());
  };
  at_surface_places([&](const Surface& s, const Vec2& xi) {
    Mat<2, 2> partial;
    partial << 0.4 * xi.y(), 0.4 * xi.x(), 0.8 * std::cos(0.8 * xi.x()), -0.3;
    const SurfaceFrame f = surface_frame(jet(s, xi));
    const Vec2 a = field(xi);
    const Mat<2, 2> nabla = covariant_derivative(f, a, partial);
    const auto vector = [&](const Vec2& x) {
      const SurfaceJet j = jet(s, x);
      const Vec2 v = field(x);
      return Vec3(v[0] * j.r1[0] + v[1] * j.r1[1]);
    };
    for (Eigen::Index j = 0; j < 2; ++j) {
      const double normal_part = a[0] * f.h(0, j) + a[1] * f.h(1, j);
      const Vec3 whole =
          nabla(0, j) * f.tangent[0] + nabla(1, j) * f.tangent[1] + normal_part * f.normal;
      EXPECT_TRUE(is_derivative(vector, whole, xi, j));
    }
  });
}

TEST(SurfaceFrame, SphereCylinderConeAndTorusHaveTheirCurvatures) {
  const Vec3 c(0.4, -0.7, 0.2), axis(1, -2, 0.5);
  const double big = 2.0, small = 0.7, slope = 0.6;
  for (const bool inside : {false, true}) {
    const double sign = inside ? -1.0 : 1.0;
    const auto expect = [&](const SurfaceJet& j, double k1, double k2) {
      const SurfaceFrame f = surface_frame(j);
      const PrincipalCurvatures p = principal_curvatures(f);
      EXPECT_NEAR(p.value[0], std::max(sign * k1, sign * k2), 5e-15);
      EXPECT_NEAR(p.value[1], std::min(sign * k1, sign * k2), 5e-15);
      EXPECT_NEAR(mean_curvature(f), sign * 0.5 * (k1 + k2), 5e-15);
      EXPECT_NEAR(gaussian_curvature(f), k1 * k2, 5e-15);
    };
    for (double u = 0.1; u < 6.2; u += 0.8)
      for (double v = 0.3; v < 6.2; v += 0.8) {
        const Sphere sphere{c, big, inside, axis};
        expect(sphere.jet({u - 3, v - 3}), -1 / big, -1 / big);
        const Cylinder cylinder{.point = c, .axis = axis, .radius = small, .inside = inside};
        expect(cylinder.jet({u, v}), -1 / small, 0);
        const Torus torus{c, axis, big, small, inside};
        expect(torus.jet({u, v}), -1 / small, -std::cos(v) / (big + small * std::cos(v)));
        const Cone cone{.apex = c, .axis = axis, .half_angle = slope, .inside = inside};
        expect(cone.jet({u, v}), -std::cos(slope) / (v * std::tan(slope)), 0);
      }
  }
}

TEST(SurfaceFrame, SphereHasTheMetricForItsCurvatureTensor) {
  const Sphere sphere{Vec3(1, 2, 3), 2.0, false, Vec3(0, 0, 1)};
  for (const Vec2& xi : {Vec2(0, 0), Vec2(0.4, -0.9), Vec2(4.3, 0.2)}) {
    const SurfaceFrame f = surface_frame(sphere.jet(xi));
    EXPECT_LT((f.h + f.a / 2.0).norm(), 1e-15 * f.a.norm());
    EXPECT_LT((f.h_mixed + Mat<2, 2>::Identity() / 2.0).norm(), 1e-15);
  }
}

TEST(SurfaceFrame, PrincipalDirectionsAreEigenvectors) {
  at_surface_places([](const Surface& s, const Vec2& xi) {
    const SurfaceFrame f = surface_frame(jet(s, xi));
    const PrincipalCurvatures p = principal_curvatures(f);
    EXPECT_NEAR(p.direction[0].dot(p.direction[1]), 0.0, 1e-14);
    EXPECT_NEAR(p.value[0] + p.value[1], 2 * mean_curvature(f), 1e-12);
    EXPECT_NEAR(p.value[0] * p.value[1], gaussian_curvature(f), 1e-12);
    const std::array<Vec3, 2> dual = contravariant_basis(f);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(p.direction[k].norm(), 1.0, 1e-14);
      EXPECT_NEAR(p.direction[k].dot(f.normal), 0.0, 1e-14);
      // dn along d = -kappa d
      const Vec3 turn = p.direction[k].dot(dual[0]) * weingarten_formula(f, 0) +
                        p.direction[k].dot(dual[1]) * weingarten_formula(f, 1);
      EXPECT_LT((turn + p.value[k] * p.direction[k]).norm(), 1e-12);
    }
  });
  const Cylinder cylinder{.point = Vec3(0, 0, 0), .axis = Vec3(0, 0, 2), .radius = 3};
  const PrincipalCurvatures p = principal_curvatures(surface_frame(cylinder.jet({0.3, 0.7})));
  EXPECT_NEAR(std::abs(p.direction[0].z()), 1.0, 1e-15);  // straight along the axis
}

/// The surface in other parameters y: xi = y + bend terms, by the chain rule to second order.
SurfaceJet reparameterised(const SurfaceJet& j, const Mat<2, 2>& d1,
                           const std::array<Vec2, 3>& d2) {
  SurfaceJet out;
  out.r = j.r;
  for (std::size_t a = 0; a < 2; ++a) {
    const auto p = static_cast<Eigen::Index>(a);
    out.r1[a] = d1(0, p) * j.r1[0] + d1(1, p) * j.r1[1];
    for (std::size_t b = a; b < 2; ++b) {
      const auto q = static_cast<Eigen::Index>(b);
      out.r2[a + b] = d1(0, p) * d1(0, q) * j.r2[0] + d1(1, p) * d1(1, q) * j.r2[2] +
                      (d1(0, p) * d1(1, q) + d1(1, p) * d1(0, q)) * j.r2[1] +
                      d2[a + b][0] * j.r1[0] + d2[a + b][1] * j.r1[1];
    }
  }
  return out;
}

TEST(SurfaceFrame, CurvaturesDoNotDependOnTheParameters) {
  Mat<2, 2> d1;
  d1 << 1.7, 0.4, -0.3, 0.6;
  const std::array<Vec2, 3> d2{Vec2(0.5, -1.2), Vec2(2.0, 0.3), Vec2(-0.7, 0.9)};
  at_surface_places([&](const Surface& s, const Vec2& xi) {
    const SurfaceJet j = jet(s, xi);
    const SurfaceFrame f = surface_frame(j), g = surface_frame(reparameterised(j, d1, d2));
    EXPECT_NEAR(mean_curvature(g), mean_curvature(f), 1e-12);
    EXPECT_NEAR(gaussian_curvature(g), gaussian_curvature(f), 1e-12);
    EXPECT_LT((g.normal - f.normal).norm(), 1e-14);
    const double kappa = principal_curvatures(f).value[0];
    EXPECT_NEAR(principal_curvatures(g).value[0], kappa, 1e-10);
    // the Christoffel symbols do: they are no tensor
    EXPECT_GT((g.gamma[0] - f.gamma[0]).norm(), 1e-2);
  });
  Mat<2, 2> mirrored;
  mirrored << 0, 1, 1, 0;
  const SurfaceJet j = Torus{}.jet({0.3, 0.8});
  const SurfaceFrame f = surface_frame(j);
  const SurfaceFrame g =
      surface_frame(reparameterised(j, mirrored, {Vec2::Zero(), Vec2::Zero(), Vec2::Zero()}));
  EXPECT_NEAR(mean_curvature(g), -mean_curvature(f), 1e-15);  // the other side
  EXPECT_NEAR(gaussian_curvature(g), gaussian_curvature(f), 1e-15);
}

TEST(SurfaceFrame, DegeneratePointsAreInvalidAndZero) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  SurfaceJet none, parallel, broken, endless;
  parallel.r1 = {Vec3(0.1, 0.2, 0.3), Vec3(0.3, 0.6, 0.9)};
  broken.r1 = {Vec3(1, 0, 0), Vec3(0, nan, 0)};
  endless.r1 = {Vec3(1, 0, 0), Vec3(0, infinite, 0)};
  for (const SurfaceJet& j : {none, parallel, broken, endless, Cone{}.jet({0.3, 0.0})}) {
    const SurfaceFrame f = surface_frame(j);
    EXPECT_FALSE(f.valid);
    EXPECT_EQ(f.normal.norm() + f.a.norm() + f.a_inv.norm() + f.h.norm() + f.gamma[0].norm(), 0.0);
    EXPECT_EQ(mean_curvature(f), 0.0);
    EXPECT_EQ(gaussian_curvature(f), 0.0);
    EXPECT_EQ(principal_curvatures(f).value[0], 0.0);
  }
  SurfaceJet tiny;  // small is not degenerate
  tiny.r1 = {Vec3(1e-60, 0, 0), Vec3(0, 1e-60, 0)};
  EXPECT_TRUE(surface_frame(tiny).valid);
  EXPECT_TRUE(surface_frame(tiny).a_inv.allFinite());
}

}  // namespace
}  // namespace osculate::geometry
