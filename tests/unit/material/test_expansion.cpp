#include "osculate/material/expansion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "derivative_check.hpp"
#include "osculate/material/energy.hpp"
#include "osculate/material/law.hpp"

namespace osculate::material {
namespace {

// 12e-6 at 0, 24e-6 at 1000, counted from 50: from 100 to 700 degrees.
TEST(Expansion, CountsMeanCoefficientsFromTheReferenceTemperature) {
  const Expansion law{{{0, 12e-6}, {1000, 24e-6}}, 50};
  const double now = (12e-6 + 0.7 * 12e-6) * (700 - 50),
               before = (12e-6 + 0.1 * 12e-6) * (100 - 50);
  EXPECT_NEAR(expansion(law, 700, 100), now - before, 1e-18);
  EXPECT_NEAR(expansion(law, 100, 100), 0, 1e-18);
  EXPECT_NEAR(expansion(law, 2000, 50), 24e-6 * 1950, 1e-17);  // constant beyond the table
  EXPECT_NEAR(expansion(law, -100, 50), 12e-6 * -150, 1e-17);
}

TEST(Expansion, OfOneCoefficientDoesNotDependOnTheReference) {
  EXPECT_EQ(expansion({{{0, 1e-5}}, 300}, 80, 20), 1e-5 * 60);
  EXPECT_EQ(expansion({}, 80, 20), 0.0);
}

// The Cauchy stress of F = F_e theta is that of the law at F_e.
TEST(Expansion, LeavesTheCauchyStressOfTheElasticDeformation) {
  Mat<3, 3> f;
  f << 1.1, 0.05, -0.1, 0.02, 0.95, 0.04, 0.03, -0.06, 1.05;
  const double strain = 0.08, theta = 1 + strain;
  const auto cauchy = [](const Law& law, const Mat<3, 3>& of, const Memory& memory) {
    const Mat<3, 3> e = 0.5 * (of.transpose() * of - Mat<3, 3>::Identity());
    Strain3 s;
    s << e(0, 0), e(1, 1), e(2, 2), 2 * e(0, 1), 2 * e(1, 2), 2 * e(0, 2);
    const Response3 r = response(law, s, memory);
    EXPECT_TRUE(r.ok);
    Mat<3, 3> t;
    t << r.stress[0], r.stress[3], r.stress[5], r.stress[3], r.stress[1], r.stress[4], r.stress[5],
        r.stress[4], r.stress[2];
    return Mat<3, 3>(of * t * of.transpose() / of.determinant());
  };
  Memory memory;
  memory.expansion = &strain;
  J2Plasticity plastic;
  plastic.young = 7;
  plastic.poisson = 0.3;
  plastic.yield = 0.1;
  for (const Law& law :
       {Law{NeoHooke{7, 0.3, 0}}, Law{StVenantKirchhoff{7, 0.3, 0}}, in_finite_strain(plastic)})
    EXPECT_LT((cauchy(law, f * theta, memory) - cauchy(law, f, {})).norm(),
              1e-14 * cauchy(law, f, {}).norm());
}

/// Components of a strain, shear twice that of the tensor.
Strain3 components(const Mat<3, 3>& e) {
  return {e(0, 0), e(1, 1), e(2, 2), 2 * e(0, 1), 2 * e(1, 2), 2 * e(0, 2)};
}
const Mat<3, 3> stretch =
    (Mat<3, 3>() << 1.08, 0.03, -0.02, 0.03, 0.95, 0.04, -0.02, 0.04, 1.03).finished();
const Strain3 by_directions = components(stretch - Mat<3, 3>::Identity());
const Strain3 sample(0.1, -0.05, 0.07, 0.2, -0.1, 0.05), direction(0.5, -0.3, 0.2, 0.7, -0.4, 0.6);

Memory expanded(const Strain3& strain) {
  Memory memory;
  memory.expansion = strain.data();
  memory.strains = 6;
  return memory;
}
std::vector<Law> finite_laws() {
  return {Law{NeoHooke{7, 0.3, 0}}, Law{StVenantKirchhoff{7, 0.3, 0}},
          in_finite_strain(Orthotropic{12, 1.1, 0.6, 0.35, 0.4, 0.5, 0.8, 0.7, 0.2, 0})};
}

TEST(Expansion, ByDirectionsCountsAsThatOfOneCoefficient) {
  Expansion law{{}, 50};
  const Strain3 cold(1, 2, 3, 4, 5, 6), hot(3, 2, 1, 0, 5, 8);
  law.directions = {{0, 1e-6 * cold}};
  EXPECT_EQ(strains_of(law), 6U);
  EXPECT_LT((expansion_by_directions(law, 80, 20) - 60e-6 * cold).norm(), 1e-18);
  law.directions.push_back({1000, 1e-6 * hot});
  const Strain3 at_700 = 0.3 * cold + 0.7 * hot, at_100 = 0.9 * cold + 0.1 * hot;
  EXPECT_LT((expansion_by_directions(law, 700, 100) - 650e-6 * at_700 + 50e-6 * at_100).norm(),
            1e-17);
  EXPECT_LT((expansion_by_directions(law, 2000, 50) - 1950e-6 * hot).norm(), 1e-17);
  EXPECT_EQ(strains_of(Expansion{}), 0U);
  EXPECT_EQ(strains_of(Expansion{{{0, 1e-5}}}), 1U);
}

TEST(Expansion, OfTheSameStrainInAllDirectionsIsTheOneOfOneNumber) {
  const double one = 0.07;
  const Strain3 same(one, one, one, 0, 0, 0);
  Memory memory;
  memory.expansion = &one;
  const Strain plane = sample.head<4>();
  std::vector<Law> laws = finite_laws();
  laws.emplace_back(LinearElastic{7, 0.3, 0});
  for (const Law& law : laws) {
    const Response3 a = response(law, sample, expanded(same)), b = response(law, sample, memory);
    EXPECT_LT((a.stress - b.stress).norm(), 1e-14 * b.stress.norm());
    EXPECT_LT((a.tangent - b.tangent).norm(), 1e-14 * b.tangent.norm());
    double across = 0, known = 0;
    const Response c = plane_stress_response(law, plane, &across, expanded(same)),
                   d = plane_stress_response(law, plane, &known, memory);
    EXPECT_LT((c.stress - d.stress).norm(), 1e-13 * d.stress.norm());
    EXPECT_LT((c.tangent - d.tangent).norm(), 1e-13 * d.tangent.norm());
    EXPECT_NEAR(across, known, 1e-15);
    EXPECT_NEAR(stored_energy(law, sample, expanded(same)), stored_energy(law, sample, memory),
                1e-15);
  }
}

// The Cauchy stress of F = F_e U is that of the law at F_e.
TEST(Expansion, ByDirectionsLeavesTheCauchyStressOfTheElasticDeformation) {
  Mat<3, 3> f;
  f << 1.1, 0.05, -0.1, 0.02, 0.95, 0.04, 0.03, -0.06, 1.05;
  const auto cauchy = [](const Law& law, const Mat<3, 3>& of, const Memory& memory) {
    const Strain3 e = components(0.5 * (of.transpose() * of - Mat<3, 3>::Identity()));
    const StressOf<6> s = stress(law, e, memory);
    EXPECT_TRUE(s.ok);
    Mat<3, 3> t;
    t << s.stress[0], s.stress[3], s.stress[5], s.stress[3], s.stress[1], s.stress[4], s.stress[5],
        s.stress[4], s.stress[2];
    return Mat<3, 3>(of * t * of.transpose() / of.determinant());
  };
  for (const Law& law : finite_laws()) {
    const Mat<3, 3> known = cauchy(law, f, {});
    EXPECT_LT((cauchy(law, f * stretch, expanded(by_directions)) - known).norm(),
              1e-14 * known.norm());
  }
}

TEST(Expansion, ByDirectionsHasAForceAndATangentOfItsEnergy) {
  const Memory memory = expanded(by_directions);
  std::vector<Law> laws = finite_laws();
  laws.emplace_back(LinearElastic{7, 0.3, 0});
  for (const Law& law : laws) {
    const Response3 here = response(law, sample, memory);
    const auto potential = [&](const Strain3& e) -> Eigen::VectorXd {
      return Eigen::VectorXd::Constant(1, stored_energy(law, e, memory));
    };
    const auto of_energy = testing::check_derivative(
        potential, Eigen::VectorXd::Constant(1, here.stress.dot(direction)), sample, direction);
    EXPECT_TRUE(of_energy.exact || std::abs(of_energy.order - 2) < 0.1) << of_energy.order;
    const auto of = [&](const Strain3& e) -> Eigen::VectorXd {
      return stress(law, e, memory).stress;
    };
    const auto of_stress =
        testing::check_derivative(of, here.tangent * direction, sample, direction);
    EXPECT_TRUE(of_stress.exact || std::abs(of_stress.order - 2) < 0.1) << of_stress.order;
    EXPECT_LT((here.tangent - here.tangent.transpose()).norm(), 1e-14 * here.tangent.norm());
  }
}

// Across the plane the strain is what the expansion gives and what makes the stress vanish.
TEST(Expansion, ByDirectionsIsPartOfTheStrainAcross) {
  const Strain3 flat(0.01, 0.02, 0.03, 0.01, 0, 0);
  double across = 0;
  (void)plane_stress_response(LinearElastic{7, 0.3, 0}, Strain(0.02, 0.015, 0, 0), &across,
                              expanded(flat));
  EXPECT_NEAR(across, 0.03 - 0.3 / 0.7 * (0.01 - 0.005), 1e-17);
  for (const Law& law : finite_laws()) {
    Strain whole(0.02, 0.015, 0, 0.05);
    const Response r = plane_stress_response(law, whole, &whole[2], expanded(flat));
    const Response full = response(law, whole, expanded(flat));
    EXPECT_LT(std::abs(full.stress[2]), 1e-14);
    EXPECT_LT((full.stress - r.stress).norm(), 1e-14);
  }
}

TEST(Expansion, InPlaneStressIsPartOfTheStrainAcross) {
  double across = 0;
  const double strain = 0.01;
  Memory memory;
  memory.expansion = &strain;
  (void)plane_stress_response(LinearElastic{7, 0.3, 0}, Strain(0.02, 0.015, 0, 0), &across, memory);
  EXPECT_NEAR(across, 0.01 - 0.3 / 0.7 * (0.01 + 0.005), 1e-17);
}

}  // namespace
}  // namespace osculate::material
