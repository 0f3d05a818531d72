#include "osculate/material/expansion.hpp"

#include <gtest/gtest.h>

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
