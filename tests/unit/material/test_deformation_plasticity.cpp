// Ramberg and Osgood's curve in all directions.
#include "osculate/material/deformation_plasticity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "derivative_check.hpp"
#include "osculate/material/energy.hpp"
#include "osculate/material/law.hpp"

namespace osculate::material {
namespace {

const DeformationPlasticity steel{190, 0.34, 0, 0.9, 12, 0.45};
const DeformationPlasticity soft{190, 0.2, 0, 0.9, 3, 2};
const DeformationPlasticity straight{190, 0.3, 0, 0.9, 1, 0.5};
const Strain3 bent{{0.012, -0.006, 0.004, 0.010, -0.005, 0.008}};
const Strain3 along{{0.5, -0.3, 0.2, 0.7, -0.4, 0.6}};

/// Strain of a stress, as the law is printed.
Strain3 strain_of(const DeformationPlasticity& law, const Stress3& sigma) {
  const double mean = sigma.head<3>().mean();
  Vec<6> s = sigma;
  s.head<3>().array() -= mean;
  const double q = std::sqrt(1.5 * (s.head<3>().squaredNorm() + 2 * s.tail<3>().squaredNorm()));
  const double more = 1.5 * law.offset * std::pow(q / law.yield, law.exponent - 1);
  Strain3 e = (1 + law.poisson + more) / law.young * s;
  e.head<3>().array() += (1 - 2 * law.poisson) / law.young * mean;
  e.tail<3>() *= 2;
  return e;
}

TEST(DeformationPlasticity, IsTheInverseOfThePrintedLaw) {
  for (const DeformationPlasticity& law : {steel, soft, straight})
    for (const double size : {0.1, 0.5, 1.0, 1.5}) {
      const Stress3 sigma = size * Stress3{{1.1, -0.2, 0.3, 0.2, -0.1, 0.25}};
      const Response3 r = response(law, strain_of(law, sigma));
      ASSERT_TRUE(r.ok);
      EXPECT_LT((r.stress - sigma).norm(), 1e-12 * sigma.norm());
    }
}

TEST(DeformationPlasticity, EnergyStressAndTangentAreDerivatives) {
  for (const DeformationPlasticity& small : {steel, soft, straight})
    for (const Law& law : {Law(small), in_finite_strain(small)}) {
      const Response3 here = response(law, bent);
      const auto energy = [&](const Strain3& e) -> Eigen::VectorXd {
        return Eigen::VectorXd::Constant(1, stored_energy(law, e));
      };
      const auto stress = [&](const Strain3& e) -> Eigen::VectorXd {
        return response(law, e).stress;
      };
      const Eigen::VectorXd work = Eigen::VectorXd::Constant(1, here.stress.dot(along));
      const auto first = testing::check_derivative(energy, work, bent, along, 1e-4);
      EXPECT_TRUE(first.exact || std::abs(first.order - 2) < 0.1) << first.order;
      const auto second =
          testing::check_derivative(stress, here.tangent * along, bent, along, 1e-4);
      EXPECT_TRUE(second.exact || std::abs(second.order - 2) < 0.1) << second.order;
    }
}

TEST(DeformationPlasticity, PlaneStressIsFreeAcross) {
  const Strain e{{0.01, -0.004, 0, 0.006}};
  for (const Law& law : {Law(steel), in_finite_strain(steel)}) {
    double across = 0;
    const Response r = plane_stress_response(law, e, &across);
    ASSERT_TRUE(r.ok);
    Strain full = e;
    full[2] = across;
    EXPECT_NEAR(response(law, full).stress[2], 0, 1e-13 * r.stress.norm());
    const auto stress = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
      return plane_stress_response(law, Strain(x)).stress;
    };
    const Eigen::VectorXd d = Strain{{1, -0.5, 0, 0.7}};
    const auto order =
        testing::check_derivative(stress, r.tangent * d, Eigen::VectorXd(e), d, 1e-4);
    EXPECT_NEAR(order.order, 2, 0.1);
  }
}

TEST(DeformationPlasticity, IsElasticAtFirstAndRemembersNothing) {
  const Response3 rest = response(steel, Strain3(Strain3::Zero()));
  const Response3 hooke = response(LinearElastic{190, 0.34, 0}, Strain3(Strain3::Zero()));
  EXPECT_EQ(rest.tangent, hooke.tangent);
  EXPECT_TRUE(memory_of(steel).empty());
  EXPECT_TRUE(memory_of(in_finite_strain(steel)).empty());
  EXPECT_FALSE(linear(steel));
  EXPECT_FALSE(response(steel, Strain3(std::nan("") * along)).ok);
}

}  // namespace
}  // namespace osculate::material
