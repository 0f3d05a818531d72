#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "derivative_check.hpp"
#include "osculate/material/law.hpp"

namespace osculate::material {
namespace {

const Law all_laws[] = {LinearElastic{7.0, 0.3, 0},     LinearElastic{7.0, -0.4, 0},
                        StVenantKirchhoff{7.0, 0.3, 0}, StVenantKirchhoff{7.0, -0.4, 0},
                        NeoHooke{7.0, 0.3, 0},          NeoHooke{7.0, 0.4999, 0},
                        NeoHooke{7.0, -0.4, 0}};

Strain3 strain(double e11, double e22, double e33, double c12, double c23, double c13) {
  Strain3 e;
  e << e11, e22, e33, c12, c23, c13;
  return e;
}
const Strain3 strains[] = {strain(0, 0, 0, 0, 0, 0), strain(0.1, -0.2, 0.05, 0.15, -0.1, 0.2),
                           strain(2, -0.3, -0.1, -0.4, 0.2, 0.3),
                           strain(-0.4, -0.35, 1.5, 0.1, 0.2, -0.1)};
const Strain3 along = strain(0.5, -0.3, 0.2, 0.7, -0.4, 0.6);

/// Symmetric tensor of six components; `shear` is what the shear components are divided by.
Mat<3, 3> tensor(const Vec<6>& v, double shear) {
  Mat<3, 3> t;
  t << v[0], v[3] / shear, v[5] / shear, v[3] / shear, v[1], v[4] / shear, v[5] / shear,
      v[4] / shear, v[2];
  return t;
}
Vec<6> components(const Mat<3, 3>& t, double shear) {
  return strain(t(0, 0), t(1, 1), t(2, 2), shear * t(0, 1), shear * t(1, 2), shear * t(0, 2));
}

/// The energy as printed in the headers, on full tensors: an oracle of its own.
double energy(const Law& law, const Strain3& strain) {
  const auto value = [&](const auto& m) {
    const Lame c = lame(unloaded(m).young, unloaded(m).poisson);
    const Mat<3, 3> e = tensor(strain, 2);
    if constexpr (std::is_same_v<std::decay_t<decltype(m)>, NeoHooke>) {
      const Mat<3, 3> stretched = Mat<3, 3>::Identity() + 2 * e;
      const double log_j = 0.5 * std::log(stretched.determinant());
      return 0.5 * c.mu * (stretched.trace() - 3) - c.mu * log_j + 0.5 * c.lambda * log_j * log_j;
    }
    return 0.5 * c.lambda * e.trace() * e.trace() + c.mu * e.squaredNorm();
  };
  return std::visit(value, law);
}

TEST(Space, PlaneResponseIsItsSubBlock) {
  const Strain plane_strains[] = {Strain(0, 0, 0, 0), Strain(0.1, -0.2, 0.05, 0.15),
                                  Strain(2, -0.3, -0.1, -0.4), Strain(-0.4, -0.35, 1.5, 0.1)};
  for (const Law& law : all_laws)
    for (const Strain& e : plane_strains) {
      Strain3 full = Strain3::Zero();
      full.head<4>() = e;
      const Response plane = response(law, e);
      const Response3 space = response(law, full);
      ASSERT_TRUE(space.ok);
      const double size = plane.tangent.norm();
      EXPECT_LT((space.stress.head<4>() - plane.stress).norm(), 4e-16 * size) << key_of(law);
      EXPECT_LT((space.tangent.topLeftCorner<4, 4>() - plane.tangent).norm(), 2e-15 * size)
          << key_of(law);
      EXPECT_EQ(space.stress.tail<2>().norm(), 0.0);
      EXPECT_EQ((space.tangent.bottomLeftCorner<2, 4>().norm()), 0.0);
      EXPECT_EQ((space.tangent.topRightCorner<4, 2>().norm()), 0.0);
    }
}

TEST(Space, TangentIsTheDerivativeOfTheStressAndSymmetric) {
  for (const Law& law : all_laws)
    for (const Strain3& e : strains) {
      const auto stress = [&](const Vec<6>& x) -> Eigen::VectorXd {
        return response(law, x).stress;
      };
      const Tangent3 t = response(law, e).tangent;
      const auto r = testing::check_derivative(stress, t * along, e, along);
      EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1)
          << key_of(law) << " order " << r.order << " error " << r.error;
      EXPECT_LT((t - t.transpose()).norm(), 1e-15 * t.norm()) << key_of(law);
    }
}

TEST(Space, StressIsTheDerivativeOfTheEnergy) {
  for (const Law& law : all_laws)
    for (const Strain3& e : strains) {
      Eigen::VectorXd slope(1);
      slope[0] = response(law, e).stress.dot(along);
      if (e.norm() == 0) {
        EXPECT_EQ(slope[0], 0.0);
        continue;
      }
      const auto value = [&](const Vec<6>& x) {
        return Eigen::VectorXd(Eigen::VectorXd::Constant(1, energy(law, x)));
      };
      const auto r = testing::check_derivative(value, slope, e, along, 4e-3);
      EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1)
          << key_of(law) << " order " << r.order << " error " << r.error;
    }
}

TEST(Space, StressTurnsWithTheStrain) {
  const Mat<3, 3> q = Eigen::AngleAxisd(1.1, Vec3(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
  for (const Law& law : all_laws)
    for (const Strain3& e : strains) {
      const Strain3 turned = components(q * tensor(e, 2) * q.transpose(), 2);
      const Response3 a = response(law, e), b = response(law, turned);
      const Mat<3, 3> expected = q * tensor(a.stress, 1) * q.transpose();
      EXPECT_LT((tensor(b.stress, 1) - expected).norm(), 4e-15 * a.tangent.norm()) << key_of(law);
    }
}

TEST(Space, StressOfNeoHookeFromFullTensors) {
  const NeoHooke m{7, 0.3, 0};
  const Lame c = lame(m.young, m.poisson);
  for (const Strain3& e : strains) {
    const Mat<3, 3> stretched = Mat<3, 3>::Identity() + 2 * tensor(e, 2);
    const Mat<3, 3> inverse = stretched.inverse();
    const double log_j = 0.5 * std::log(stretched.determinant());
    const Mat<3, 3> s = c.mu * (Mat<3, 3>::Identity() - inverse) + c.lambda * log_j * inverse;
    EXPECT_LT((tensor(response(m, e).stress, 1) - s).norm(), 2e-14 * (1 + s.norm()));
  }
}

TEST(Space, NeoHookeHasNoAnswerWithoutVolume) {
  const NeoHooke m{7, 0.3, 0};
  const double nan = std::nan("");
  EXPECT_TRUE(response(m, strain(-0.49, 0, 0, 0, 0, 0)).ok);
  EXPECT_FALSE(response(m, strain(-0.5, 0, 0, 0, 0, 0)).ok);
  EXPECT_FALSE(response(m, strain(0, -0.5, 0, 0, 0, 0)).ok);
  EXPECT_FALSE(response(m, strain(0, 0, -0.5, 0, 0, 0)).ok);
  EXPECT_FALSE(response(m, strain(0, 0, 0, 1, 0, 0)).ok);
  EXPECT_FALSE(response(m, strain(0, 0, 0, 0, 1, 0)).ok);
  EXPECT_FALSE(response(m, strain(0, 0, 0, 0, 0, 1)).ok);
  EXPECT_FALSE(response(m, strain(-0.6, -0.6, 0, 0, 0, 0)).ok);  // two stretches negative
  EXPECT_FALSE(response(m, strain(0, -0.6, -0.6, 0, 0, 0)).ok);
  for (int i = 0; i < 6; ++i) EXPECT_FALSE(response(m, Strain3(nan * Strain3::Unit(i))).ok);
}

}  // namespace
}  // namespace osculate::material
