// Logarithmic strain and its two derivatives, wherever the principal stretches meet.
#include "osculate/material/logarithmic.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "derivative_check.hpp"
#include "osculate/material/energy.hpp"
#include "osculate/material/law.hpp"

namespace osculate::material {
namespace {

Mat<3, 3> tensor(const Strain3& e) {
  Mat<3, 3> t;
  t << e[0], e[3] / 2, e[5] / 2, e[3] / 2, e[1], e[4] / 2, e[5] / 2, e[4] / 2, e[2];
  return t;
}
Strain3 components(const Mat<3, 3>& t) {
  return {t(0, 0), t(1, 1), t(2, 2), 2 * t(0, 1), 2 * t(1, 2), 2 * t(0, 2)};
}
Mat<3, 3> turned() {
  return Eigen::AngleAxisd(0.7, Vec3(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
}
/// With these eigenvalues, in skew axes.
Strain3 strain_of(const Vec3& values) {
  return components(turned() * values.asDiagonal() * turned().transpose());
}

/// Distinct, two and three equal, and as near to each other as makes formulas lose their digits.
std::vector<Strain3> all_strains() {
  std::vector<Strain3> out;
  for (const Vec3& values : {Vec3(0.3, -0.2, 0.05), Vec3(4, -0.3, 0.1), Vec3(0, 0, 0),
                             Vec3(0.2, 0.2, 0.2), Vec3(0.2, 0.2, -0.1), Vec3(-0.1, 0.3, 0.3)}) {
    out.push_back(strain_of(values));
    for (const double apart : {1e-13, 1e-10, 1e-7, 1e-4, 5e-4, 2e-3})
      out.push_back(strain_of(values + apart * Vec3(1, 0, -0.3)));
  }
  return out;
}

const J2Plasticity elastic{7, 0.3, 0};

TEST(LogarithmicStrain, IsHalfTheLogarithmOfTheStretch) {
  for (const Strain3& e : all_strains()) {
    const Mat<3, 3> c = Mat<3, 3>::Identity() + 2 * tensor(e);
    const Eigen::SelfAdjointEigenSolver<Mat<3, 3>> eigen(c);
    const Mat<3, 3> log = eigen.eigenvectors() *
                          (0.5 * eigen.eigenvalues().array().log()).matrix().asDiagonal() *
                          eigen.eigenvectors().transpose();
    EXPECT_LT((tensor(LogarithmicStrain(e).strain()) - log).norm(), 2e-15);
  }
}

TEST(LogarithmicStrain, KeepsItsDigitsAtSmallStrain) {
  const Strain3 along{{0.5, -0.3, 0.2, 0.7, -0.4, 0.6}};
  for (const double size : {1e-6, 1e-9, 1e-12}) {
    const Strain3 difference = LogarithmicStrain(size * along).strain() / size - along;
    EXPECT_LT(difference.norm(), 2 * size + 4e-16);
  }
}

TEST(LogarithmicStrain, OfAPlaneStaysInIt) {
  const LogarithmicStrain log(in_space(Strain(0.3, -0.2, 0.1, 0.4)));
  EXPECT_EQ(log.strain()[4], 0.0);
  EXPECT_EQ(log.strain()[5], 0.0);
  EXPECT_NEAR(log.strain()[2], 0.5 * std::log(1.2), 1e-16);
}

TEST(LogarithmicStrain, HasNoneWithoutVolume) {
  EXPECT_FALSE(LogarithmicStrain(strain_of({-0.5, 0, 0})).ok());
  EXPECT_FALSE(LogarithmicStrain(strain_of({-0.6, -0.6, 0})).ok());
  EXPECT_FALSE(LogarithmicStrain(Strain3(Strain3::Constant(std::nan("")))).ok());
  EXPECT_TRUE(LogarithmicStrain(strain_of({-0.499, 0, 0})).ok());
  const Law law = in_finite_strain(elastic);
  EXPECT_FALSE(response(law, strain_of({-0.5, 0, 0})).ok);
  EXPECT_FALSE(plane_stress_response(law, Strain(-0.5, 0, 0, 0)).ok);
  EXPECT_TRUE(std::isinf(stored_energy(law, strain_of({-0.5, 0, 0}))));
}

TEST(LogarithmicStrain, SecondDifferencesOfTheLogarithm) {
  for (const double at : {-0.4, 0.0, 0.3, 5.0})
    for (const double apart : {0.0, 1e-12, 1e-8, 1e-5, 3.9e-4, 4.1e-4, 1e-2, 0.09}) {
      const long double l[3] = {1 + 2 * static_cast<long double>(at),
                                1 + 2 * static_cast<long double>(at + apart),
                                1 + 2 * static_cast<long double>(at - 0.4 * apart)};
      // the mean of f''/2 over the simplex, by Gauss' rule of degree 5 (Hammer, Marlowe & Stroud)
      const long double lambda = 1 + 2 * static_cast<long double>(at);
      long double sum = 0;
      const auto add = [&](long double a, long double b, long double weight) {
        const long double x = a * l[0] + b * l[1] + (1 - a - b) * l[2];
        sum -= weight / (2 * x * x);
      };
      const long double root = std::sqrt(15.0L);
      add(1 / 3.0L, 1 / 3.0L, 0.225L);
      for (const int sign : {-1, 1}) {
        const long double s = (6 + sign * root) / 21, w = (155 + sign * root) / 1200;
        add(s, s, w);
        add(s, 1 - 2 * s, w);
        add(1 - 2 * s, s, w);
      }
      const double found = second_difference_of_log(at, at + apart, at - 0.4 * apart);
      const double rule = std::pow(apart / static_cast<double>(lambda), 6);
      EXPECT_NEAR(found / static_cast<double>(sum), 1, 1e-12 + 50 * rule) << at << " " << apart;
    }
}

// The stress of a fixed stress in logarithmic strain is the derivative of its work.
TEST(LogarithmicStrain, FirstDerivativeIsOfOrderTwo) {
  const Stress3 t{{2, -1, 0.5, 0.7, -0.4, 0.3}};
  const Strain3 along{{0.5, -0.3, 0.2, 0.7, -0.4, 0.6}};
  for (const Strain3& e : all_strains()) {
    const auto work = [&](const Strain3& at) -> Eigen::VectorXd {
      return Eigen::VectorXd::Constant(1, t.dot(LogarithmicStrain(at).strain()));
    };
    const Eigen::VectorXd slope =
        Eigen::VectorXd::Constant(1, LogarithmicStrain(e).stress(t).dot(along));
    const auto r = testing::check_derivative(work, slope, e, along, 4e-3);
    EXPECT_NEAR(r.order, 2, 0.1) << e.transpose() << " error " << r.error;
  }
}

TEST(LogarithmicStrain, SecondDerivativeIsOfOrderTwo) {
  Response3 fixed;
  fixed.stress << 2, -1, 0.5, 0.7, -0.4, 0.3;  // its tangent is zero: T : L alone
  const Strain3 along{{0.5, -0.3, 0.2, 0.7, -0.4, 0.6}};
  for (const Strain3& e : all_strains()) {
    const auto stress = [&](const Strain3& at) -> Eigen::VectorXd {
      return LogarithmicStrain(at).stress(fixed.stress);
    };
    const Response3 here = LogarithmicStrain(e).response(fixed);
    const auto r = testing::check_derivative(stress, here.tangent * along, e, along, 4e-3);
    EXPECT_NEAR(r.order, 2, 0.1) << e.transpose() << " error " << r.error;
    EXPECT_EQ((here.tangent - here.tangent.transpose()).norm(), 0.0);
  }
}

TEST(Logarithmic, TangentIsTheDerivativeOfTheStress) {
  const Law law = in_finite_strain(elastic);
  const Strain3 along{{0.5, -0.3, 0.2, 0.7, -0.4, 0.6}};
  for (const Strain3& e : all_strains()) {
    const auto stress = [&](const Strain3& at) -> Eigen::VectorXd {
      return response(law, at).stress;
    };
    const auto r =
        testing::check_derivative(stress, response(law, e).tangent * along, e, along, 4e-3);
    EXPECT_NEAR(r.order, 2, 0.1) << e.transpose() << " error " << r.error;
  }
}

TEST(Logarithmic, StressIsTheDerivativeOfTheEnergyAndTheSameAlone) {
  const Law law = in_finite_strain(elastic);
  const Strain3 along{{0.5, -0.3, 0.2, 0.7, -0.4, 0.6}};
  for (const Strain3& e : all_strains()) {
    const Stress3 s = response(law, e).stress;
    EXPECT_EQ(stress(law, e).stress, s);
    if (s.norm() < 1e-3) continue;  // no slope worth a difference
    const auto energy = [&](const Strain3& at) -> Eigen::VectorXd {
      return Eigen::VectorXd::Constant(1, stored_energy(law, at));
    };
    const Eigen::VectorXd slope = Eigen::VectorXd::Constant(1, s.dot(along));
    const auto r = testing::check_derivative(energy, slope, e, along, 4e-3);
    EXPECT_NEAR(r.order, 2, 0.1) << e.transpose() << " error " << r.error;
  }
}

// A bar that is stretched and thins by nu in logarithmic strain: force per reference area
// E ln(stretch) / stretch times the volume ratio.
TEST(Logarithmic, BarHasHenckysStress) {
  const Law law = in_finite_strain(elastic);
  for (const double stretch : {0.3, 0.9, 1.2, 3.0}) {
    const double log = std::log(stretch), across = std::exp(-0.3 * log);
    const Strain3 e{{(stretch * stretch - 1) / 2, (across * across - 1) / 2,
                     (across * across - 1) / 2, 0, 0, 0}};
    const Stress3 s = response(law, e).stress;
    EXPECT_NEAR(s[0], 7 * log / (stretch * stretch), 1e-13);
    EXPECT_NEAR(s[1], 0, 1e-13);
  }
}

}  // namespace
}  // namespace osculate::material
