#include "osculate/material/rubber.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "derivative_check.hpp"
#include "osculate/material/law.hpp"

namespace osculate::material {
namespace {

/// All terms, and those of well known laws.
Rubber whole() { return {0.4, 0.1, 0.05, 0.03, 0.02, 0.01, 0.004, 0.003, 0.002, 0.1, 0.2, 0.3, 0}; }
Rubber mooney(double d1) {
  Rubber law;
  law.c10 = 0.4;
  law.c01 = 0.1;
  law.d1 = d1;
  return law;
}
const Rubber laws[] = {whole(), mooney(0.01)};
const Strain3 strains[] = {Strain3::Zero(), Strain3(0.1, -0.2, 0.05, 0.15, -0.1, 0.2),
                           Strain3(2, -0.3, -0.1, -0.4, 0.1, 0.2),
                           Strain3(-0.3, -0.25, 1.5, 0.1, 0.3, -0.2)};

/// W as printed in the header, on full tensors: an oracle of its own.
double energy(const Rubber& k, const Strain3& e) {
  Mat<3, 3> c;
  c << 1 + 2 * e[0], e[3], e[5], e[3], 1 + 2 * e[1], e[4], e[5], e[4], 1 + 2 * e[2];
  const double j = std::sqrt(c.determinant());
  const double a = std::pow(j, -2.0 / 3) * c.trace() - 3;
  const double b = std::pow(j, -4.0 / 3) * (c.trace() * c.trace() - (c * c).trace()) / 2 - 3;
  double w = k.c10 * a + k.c01 * b + k.c20 * a * a + k.c11 * a * b + k.c02 * b * b +
             k.c30 * a * a * a + k.c21 * a * a * b + k.c12 * a * b * b + k.c03 * b * b * b +
             std::pow(j - 1, 2) / k.d1;
  if (k.d2 > 0) w += std::pow(j - 1, 4) / k.d2;
  if (k.d3 > 0) w += std::pow(j - 1, 6) / k.d3;
  return w;
}

TEST(Rubber, EnergyStressAndTangentAreDerivatives) {
  const Vec<6> along(0.5, -0.3, 0.2, 0.7, -0.4, 0.3);
  for (const Rubber& law : laws)
    for (const Strain3& e : strains) {
      EXPECT_NEAR(energy_of(law, e), energy(law, e), 1e-13 * (1 + energy(law, e)));
      if (e.norm() == 0) continue;
      const auto value = [&](const Vec<6>& x) -> Eigen::VectorXd {
        return Eigen::VectorXd::Constant(1, energy(law, x));
      };
      Eigen::VectorXd slope(1);
      slope[0] = respond(law, e).stress.dot(along);
      const auto first = testing::check_derivative(value, slope, e, along);
      EXPECT_TRUE(first.exact || std::abs(first.order - 2) < 0.1) << first.order;
      const auto stress = [&](const Vec<6>& x) -> Eigen::VectorXd {
        return respond(law, Strain3(x)).stress;
      };
      const auto second =
          testing::check_derivative(stress, respond(law, e).tangent * along, e, along);
      EXPECT_TRUE(second.exact || std::abs(second.order - 2) < 0.1) << second.order;
    }
}

TEST(Rubber, ThePlaneIsThatOfSpace) {
  const Strain e(0.1, -0.2, 0.05, 0.15);
  const Response plane = respond(whole(), e);
  const Response3 space = respond(whole(), in_space(e));
  EXPECT_EQ(plane.stress, Stress(space.stress.head<4>()));
  EXPECT_EQ(plane.tangent, Tangent(space.tangent.topLeftCorner<4, 4>()));
  EXPECT_EQ(energy_of(whole(), e), energy_of(whole(), in_space(e)));
}

TEST(Rubber, UnloadedItIsIsotropic) {
  for (const Rubber& law : laws) {
    const Isotropic is = unloaded(law);
    const Response3 small =
        response(Law{LinearElastic{is.young, is.poisson, 0}}, Strain3(Strain3::Zero()));
    EXPECT_LT((respond(law, Strain3(Strain3::Zero())).tangent - small.tangent).norm(),
              1e-14 * small.tangent.norm());
  }
}

TEST(Rubber, KeepsItsDigitsAtSmallStrain) {
  const Vec<6> along(0.5, -0.3, 0.2, 0.7, -0.4, 0.3);
  const Mat<6, 6> stiffness = respond(whole(), Strain3(Strain3::Zero())).tangent;
  for (const double size : {1e-6, 1e-9, 1e-12}) {
    const Vec<6> linear = stiffness * (size * along);
    EXPECT_LT((respond(whole(), Strain3(size * along)).stress - linear).norm(),
              30 * size * linear.norm() + 1e-15 * linear.norm());
  }
}

/// Two axes stretched alike, no change of volume: sigma = 2 (s^2 - s^-4) (c10 + c01 s^2).
TEST(Rubber, BiaxialStretchOfASheet) {
  const Rubber law = mooney(1e-9);
  for (const double s : {0.5, 0.9, 1.1, 2.0, 3.0}) {
    const Strain e(0.5 * (s * s - 1), 0.5 * (s * s - 1), 0, 0);
    double thickness = 0;
    const Response r = respond_plane_stress(law, e, thickness);
    ASSERT_TRUE(r.ok) << s;
    const double cauchy = 2 * (s * s - std::pow(s, -4)) * (law.c10 + law.c01 * s * s);
    EXPECT_NEAR(r.stress[0], cauchy / (s * s), 1e-7 * std::abs(cauchy)) << s;
    EXPECT_NEAR(1 + 2 * thickness, std::pow(s, -4), 1e-7 * std::pow(s, -4)) << s;
  }
}

TEST(Rubber, PlaneStressIsItsOwnDerivative) {
  const Vec<4> along(0.5, -0.3, 0, 0.7);
  for (const Rubber& law : laws)
    for (const Strain& e : {Strain(0, 0, 0, 0), Strain(0.1, -0.2, 0, 0.15), Strain(2, 1, 0, 0.5)}) {
      const auto stress = [&](const Vec<4>& x) -> Eigen::VectorXd {
        double thickness = 0;
        return respond_plane_stress(law, x, thickness).stress;
      };
      double found = 0;
      const Response r = respond_plane_stress(law, e, found);
      ASSERT_TRUE(r.ok);
      Strain full = e;
      full[2] = found;
      const Response there = respond(law, full);
      EXPECT_NEAR(there.stress[2], 0, 1e-14 * there.tangent.norm());
      const auto check = testing::check_derivative(stress, r.tangent * along, e, along);
      EXPECT_TRUE(check.exact || std::abs(check.order - 2) < 0.1) << check.order;
    }
}

TEST(Rubber, WithoutVolumeThereIsNoAnswer) {
  double thickness = 0;
  EXPECT_FALSE(respond(whole(), Strain3(-0.5, 0, 0, 0, 0, 0)).ok);
  EXPECT_FALSE(respond(whole(), Strain3(0, 0, 0, 0, std::nan(""), 0)).ok);
  EXPECT_FALSE(respond_plane_stress(whole(), Strain(-0.5, 0, 0, 0), thickness).ok);
  EXPECT_EQ(energy_of(whole(), Strain3(-0.6, 0, 0, 0, 0, 0)),
            std::numeric_limits<double>::infinity());
}

TEST(Rubber, NeedsAShearModulus) {
  Rubber law = mooney(0.01);
  law.c01 = -0.4;
  EXPECT_NE(range_problem(Law{law}), "");
  EXPECT_EQ(range_problem(Law{mooney(0.01)}), "");
}

}  // namespace
}  // namespace osculate::material
