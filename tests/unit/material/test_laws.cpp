#include <gtest/gtest.h>

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
const Strain strains[] = {Strain(0, 0, 0, 0), Strain(0.1, -0.2, 0.05, 0.15),
                          Strain(2, -0.3, -0.1, -0.4), Strain(-0.4, -0.35, 1.5, 0.1)};

Mat<3, 3> stretch(const Strain& e) {
  Mat<3, 3> c;
  c << 1 + 2 * e[0], e[3], 0, e[3], 1 + 2 * e[1], 0, 0, 0, 1 + 2 * e[2];
  return c;
}

/// The energy as printed in the header, on full tensors: an oracle of its own.
double energy(const Law& law, const Strain& e) {
  const auto value = [&](const auto& m) {
    const Lame c = lame(unloaded(m).young, unloaded(m).poisson);
    if constexpr (std::is_same_v<std::decay_t<decltype(m)>, NeoHooke>) {
      const Mat<3, 3> stretched = stretch(e);
      const double log_j = 0.5 * std::log(stretched.determinant());
      return 0.5 * c.mu * (stretched.trace() - 3) - c.mu * log_j + 0.5 * c.lambda * log_j * log_j;
    }
    const double trace = e[0] + e[1] + e[2];
    return 0.5 * c.lambda * trace * trace +
           c.mu * (e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + 0.5 * e[3] * e[3]);
  };
  return std::visit(value, law);
}

TEST(Laws, TangentIsTheDerivativeOfTheStress) {
  const Vec<4> along(0.5, -0.3, 0.2, 0.7);
  for (const Law& law : all_laws)
    for (const Strain& e : strains) {
      const auto stress = [&](const Vec<4>& x) -> Eigen::VectorXd {
        return response(law, x).stress;
      };
      const auto r = testing::check_derivative(stress, response(law, e).tangent * along, e, along);
      EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1)
          << key_of(law) << " order " << r.order << " error " << r.error;
    }
}

TEST(Laws, StressIsTheDerivativeOfTheEnergy) {
  for (const Law& law : all_laws)
    for (const Strain& e : strains) {
      const Vec<4> along(0.5, -0.3, 0.2, 0.7);
      Eigen::VectorXd slope(1);
      slope[0] = response(law, e).stress.dot(along);
      const auto value = [&](const Vec<4>& x) {
        return Eigen::VectorXd(Eigen::VectorXd::Constant(1, energy(law, x)));
      };
      if (e.norm() == 0) {
        EXPECT_EQ(slope[0], 0.0);
        continue;
      }
      const auto r = testing::check_derivative(value, slope, e, along, 4e-3);
      EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.1)
          << key_of(law) << " order " << r.order << " error " << r.error;
    }
}

TEST(Laws, TangentIsSymmetric) {
  for (const Law& law : all_laws)
    for (const Strain& e : strains) {
      const Tangent t = response(law, e).tangent;
      EXPECT_LT((t - t.transpose()).norm(), 1e-15 * t.norm()) << key_of(law);
    }
}

TEST(Laws, AllAreHookesLawAtNoStrain) {
  for (const double nu : {-0.9, 0.0, 0.3, 0.499}) {
    const Tangent linear = response(LinearElastic{7, nu, 0}, Strain::Zero()).tangent;
    for (const Law& law : {Law{StVenantKirchhoff{7, nu, 0}}, Law{NeoHooke{7, nu, 0}}}) {
      EXPECT_LT((response(law, Strain::Zero()).tangent - linear).norm(), 1e-15 * linear.norm());
      EXPECT_EQ(response(law, Strain::Zero()).stress.norm(), 0.0);
    }
  }
}

// Young's modulus and Poisson's ratio are what a tension test measures.
TEST(LinearElastic, UniaxialTensionMeasuresItsConstants) {
  const double e = 1e-3, nu = 0.3;
  const Response r = response(LinearElastic{7, nu, 0}, Strain(e, -nu * e, -nu * e, 0));
  EXPECT_NEAR(r.stress[0], 7 * e, 1e-17);
  EXPECT_NEAR(r.stress[1], 0, 1e-17);
  EXPECT_NEAR(r.stress[2], 0, 1e-17);
}

TEST(NeoHooke, StressOfFullTensors) {
  const NeoHooke m{7, 0.3, 0};
  const Lame c = lame(m.young, m.poisson);
  for (const Strain& e : strains) {
    const Mat<3, 3> stretched = stretch(e), inverse = stretched.inverse();
    const double log_j = 0.5 * std::log(stretched.determinant());
    const Mat<3, 3> s = c.mu * (Mat<3, 3>::Identity() - inverse) + c.lambda * log_j * inverse;
    const Stress found = response(m, e).stress;
    EXPECT_LT((found - Stress(s(0, 0), s(1, 1), s(2, 2), s(0, 1))).norm(), 2e-14 * (1 + s.norm()));
  }
}

// Contact problems live at strains of 1e-6, where 1 - C^-1 would have lost ten digits.
template <class Any>
void expect_digits_at_small_strain(const Any& along) {
  for (const double nu : {-0.3, 0.3, 0.4999}) {
    const auto linear = response(LinearElastic{7, nu, 0}, along).stress;
    double before = 0;
    for (const double size : {1e-3, 1e-6, 1e-9, 1e-12}) {
      const auto s = response(NeoHooke{7, nu, 0}, Any(size * along)).stress;
      const double error = (s / size - linear).norm() / linear.norm();
      if (size < 1e-3) {  // the difference is proportional to the strain, down to rounding
        EXPECT_NEAR(error, 1e-3 * before, 0.02 * 1e-3 * before + 1e-15) << nu << " " << size;
      }
      before = error;
    }
  }
}
TEST(NeoHooke, KeepsItsDigitsAtSmallStrain) {
  expect_digits_at_small_strain(Strain(0.5, -0.3, 0.2, 0.7));
}
TEST(NeoHooke, KeepsItsDigitsAtSmallStrainInSpace) {
  expect_digits_at_small_strain(Strain3{{0.5, -0.3, 0.2, 0.7, -0.4, 0.6}});
}

TEST(NeoHooke, HasNoAnswerWithoutVolume) {
  const NeoHooke m{7, 0.3, 0};
  EXPECT_TRUE(response(m, Strain(-0.49, 0, 0, 0)).ok);
  EXPECT_FALSE(response(m, Strain(-0.5, 0, 0, 0)).ok);
  EXPECT_FALSE(response(m, Strain(0, 0, -0.5, 0)).ok);
  EXPECT_FALSE(response(m, Strain(0, 0, 0, 1)).ok);
  EXPECT_FALSE(response(m, Strain(-0.6, -0.6, 0, 0)).ok);  // both stretches negative
  EXPECT_FALSE(response(m, Strain(std::nan(""), 0, 0, 0)).ok);
  EXPECT_FALSE(response(m, Strain(0, 0, std::nan(""), 0)).ok);
}

TEST(NeoHooke, ResistsCrushingWithoutBound) {
  const NeoHooke m{7, 0.3, 0};
  double before = 0;
  for (const double stretched : {1e-1, 1e-2, 1e-3}) {
    const double s = response(m, Strain(0.5 * (stretched - 1), 0, 0, 0)).stress[0];
    EXPECT_LT(s, 5 * before);
    before = s;
  }
}

}  // namespace
}  // namespace osculate::material
