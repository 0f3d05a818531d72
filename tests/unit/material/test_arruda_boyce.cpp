// Rubber whose chains lock.
#include "osculate/material/arruda_boyce.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "derivative_check.hpp"
#include "osculate/material/law.hpp"

namespace osculate::material {
namespace {

const ArrudaBoyce chains{0.3, 3, 0.02, 0};
const Strain3 strains[] = {Strain3(0.1, -0.2, 0.05, 0.15, -0.1, 0.2),
                           Strain3(2, -0.3, -0.1, -0.4, 0.1, 0.2),
                           Strain3(1e-3, 2e-3, -1e-3, 1e-3, 0, 0)};

/// W as printed in the header, on the full tensor.
double printed(const ArrudaBoyce& k, const Strain3& e) {
  Mat<3, 3> c;
  c << 1 + 2 * e[0], e[3], e[5], e[3], 1 + 2 * e[1], e[4], e[5], e[4], 1 + 2 * e[2];
  const double j = std::sqrt(c.determinant()), first = std::pow(j, -2.0 / 3) * c.trace();
  const double l = k.lambda_m * k.lambda_m;
  return k.mu * ((first - 3) / 2 + (std::pow(first, 2) - 9) / (20 * l) +
                 11 * (std::pow(first, 3) - 27) / (1050 * l * l) +
                 19 * (std::pow(first, 4) - 81) / (7000 * l * l * l) +
                 519 * (std::pow(first, 5) - 243) / (673750 * l * l * l * l)) +
         ((j * j - 1) / 2 - std::log(j)) / k.d;
}

TEST(ArrudaBoyce, EnergyStressAndTangentAreDerivatives) {
  const Vec<6> along(0.5, -0.3, 0.2, 0.7, -0.4, 0.3);
  for (const Strain3& e : strains) {
    EXPECT_NEAR(energy_of(chains, e), printed(chains, e), 2e-14 * (1 + printed(chains, e)));
    const auto value = [&](const Vec<6>& x) -> Eigen::VectorXd {
      return Eigen::VectorXd::Constant(1, printed(chains, x));
    };
    Eigen::VectorXd slope(1);
    slope[0] = respond(chains, e).stress.dot(along);
    const auto first = testing::check_derivative(value, slope, e, along);
    EXPECT_TRUE(first.exact || std::abs(first.order - 2) < 0.1) << first.order;
    const auto stress = [&](const Vec<6>& x) -> Eigen::VectorXd {
      return respond(chains, Strain3(x)).stress;
    };
    const auto second =
        testing::check_derivative(stress, respond(chains, e).tangent * along, e, along);
    EXPECT_TRUE(second.exact || std::abs(second.order - 2) < 0.1) << second.order;
  }
}

/// The shear modulus without strain, as Abaqus' manual prints it.
TEST(ArrudaBoyce, UnloadedItIsIsotropic) {
  const Isotropic is = unloaded(chains);
  const double mu =
      0.3 * (1 + 3.0 / 5 / 9 + 99.0 / 175 / 81 + 513.0 / 875 / 729 + 42039.0 / 67375 / 6561);
  EXPECT_NEAR(is.young / (2 * (1 + is.poisson)), mu, 1e-15);
  EXPECT_NEAR(is.young / (3 * (1 - 2 * is.poisson)), 100, 1e-11);
  const Response3 small =
      response(Law{LinearElastic{is.young, is.poisson, 0}}, Strain3(Strain3::Zero()));
  EXPECT_LT((respond(chains, Strain3(Strain3::Zero())).tangent - small.tangent).norm(),
            1e-13 * small.tangent.norm());
}

/// Chains that never lock are those of neo-Hooke.
TEST(ArrudaBoyce, LongChainsAreNeoHookes) {
  Rubber rubber;
  rubber.c10 = 0.15;
  rubber.d1 = 0.02;
  const ArrudaBoyce law{0.3, 1e9, 0.02, 0};
  const double g = 0.7;  // in shear the volume stays, of which the two differ
  const Strain3 sheared(0, 0.5 * g * g, 0, g, 0, 0);
  EXPECT_LT((respond(law, sheared).stress - respond(rubber, sheared).stress).norm(), 1e-13);
}

TEST(ArrudaBoyce, KeepsItsDigitsAtSmallStrain) {
  const Vec<6> along(0.5, -0.3, 0.2, 0.7, -0.4, 0.3);
  const Mat<6, 6> stiffness = respond(chains, Strain3(Strain3::Zero())).tangent;
  for (const double size : {1e-6, 1e-9, 1e-12}) {
    const Strain3 e = size * along;
    const Vec<6> linear = stiffness * e;
    EXPECT_LT((respond(chains, e).stress - linear).norm(),
              30 * size * linear.norm() + 1e-15 * linear.norm());
  }
}

/// A sheet stretched alike along two axes: P = 2 W_1 (s - s^-5).
TEST(ArrudaBoyce, BiaxialStretchOfASheet) {
  const ArrudaBoyce law{0.3, 3, 1e-8, 0};
  for (const double s : {0.7, 1.1, 2.0}) {
    const Strain e(0.5 * (s * s - 1), 0.5 * (s * s - 1), 0, 0);
    double thickness = 0;
    const Response r = respond_plane_stress(law, e, thickness);
    ASSERT_TRUE(r.ok) << s;
    Invariants v;
    v.bar_first = 2 * s * s + std::pow(s, -4) - 3;
    const double nominal = 2 * by_invariants(law, v).d1 * (s - std::pow(s, -5));
    EXPECT_NEAR(s * r.stress[0], nominal, 3e-7 * std::abs(nominal)) << s;
  }
}

TEST(ArrudaBoyce, WithoutVolumeThereIsNoAnswer) {
  double thickness = 0;
  EXPECT_FALSE(respond(chains, Strain3(-0.5, 0, 0, 0, 0, 0)).ok);
  EXPECT_FALSE(respond_plane_stress(chains, Strain(-0.5, 0, 0, 0), thickness).ok);
  EXPECT_EQ(energy_of(chains, Strain3(-0.6, 0, 0, 0, 0, 0)),
            std::numeric_limits<double>::infinity());
}

TEST(ArrudaBoyce, NeedsItsConstants) {
  EXPECT_NE(range_problem(Law{ArrudaBoyce{0, 3, 0.1, 0}}), "");
  EXPECT_NE(range_problem(Law{ArrudaBoyce{1, 0, 0.1, 0}}), "");
  EXPECT_NE(range_problem(Law{ArrudaBoyce{1, 3, 0, 0}}), "");
  EXPECT_EQ(range_problem(Law{chains}), "");
}

}  // namespace
}  // namespace osculate::material
