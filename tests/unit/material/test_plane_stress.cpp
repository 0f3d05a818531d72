#include <gtest/gtest.h>

#include <cmath>

#include "derivative_check.hpp"
#include "osculate/material/law.hpp"

namespace osculate::material {
namespace {

const Strain strains[] = {Strain(0.1, -0.2, 0, 0.15), Strain(2, -0.3, 0, -0.4),
                          Strain(-0.4, -0.35, 0, 0.1), Strain(1e-8, 2e-8, 0, -3e-8),
                          Strain(0, 0, 0, 0)};

double poisson_of(const Law& law) { return unloaded(law).poisson; }

template <class Visit>
void for_laws(const Visit& visit) {
  for (const double nu : {-0.3, 0.0, 0.3, 0.49, 0.499999}) {
    visit(Law{LinearElastic{7, nu, 0}});
    visit(Law{StVenantKirchhoff{7, nu, 0}});
    visit(Law{NeoHooke{7, nu, 0}});
  }
}

TEST(PlaneStress, FindsTheThicknessAtWhichTheStressVanishes) {
  for_laws([](const Law& law) {
    for (Strain e : strains) {
      double found = 7;
      const Response plane = plane_stress_response(law, e, &found);
      if (!plane.ok) {  // no thickness left, or (auxetic and compressed) none that balances
        EXPECT_TRUE(key_of(law) == StVenantKirchhoff::key || poisson_of(law) < 0);
        continue;
      }
      e[2] = found;
      const Response full = response(law, e);
      // relative to the sizes that cancel
      const double size = full.tangent.row(2).cwiseAbs() * e.cwiseAbs();
      EXPECT_LE(std::abs(full.stress[2]), 4e-15 * size) << key_of(law);
      EXPECT_EQ(plane.stress[2], 0.0);
      for (const int i : {0, 1, 3})
        EXPECT_NEAR(plane.stress[i], full.stress[i],
                    4e-15 * full.tangent.row(i).cwiseAbs() * e.cwiseAbs())
            << key_of(law);
    }
  });
}

TEST(PlaneStress, TangentIsTheDerivativeOfTheStress) {
  const Vec<4> along(0.5, -0.3, 0, 0.7);
  for_laws([&](const Law& law) {
    for (const Strain& e : strains) {
      const Response r = plane_stress_response(law, e);
      if (!r.ok) continue;
      const auto stress = [&](const Vec<4>& x) -> Eigen::VectorXd {
        return plane_stress_response(law, x).stress;
      };
      const auto d = testing::check_derivative(stress, r.tangent * along, e, along);
      EXPECT_TRUE(d.exact || std::abs(d.order - 2) < 0.1)
          << key_of(law) << " order " << d.order << " error " << d.error;
      EXPECT_LT((r.tangent - r.tangent.transpose()).norm(), 1e-15 * r.tangent.norm());
      EXPECT_EQ(r.tangent.row(2).norm(), 0.0);
    }
  });
}

TEST(PlaneStress, HasTheConstantsOfTheTextbook) {
  const double young = 7, nu = 0.3, factor = young / (1 - nu * nu);
  Tangent t = Tangent::Zero();
  t(0, 0) = t(1, 1) = factor;
  t(0, 1) = t(1, 0) = nu * factor;
  t(3, 3) = 0.5 * (1 - nu) * factor;
  for (const Law& law : {Law{LinearElastic{young, nu, 0}}, Law{StVenantKirchhoff{young, nu, 0}},
                         Law{NeoHooke{young, nu, 0}}})
    EXPECT_LT((plane_stress_response(law, Strain::Zero()).tangent - t).norm(), 1e-14 * t.norm());
}

TEST(PlaneStress, IgnoresTheGivenThicknessStrain) {
  for_laws([](const Law& law) {
    const Response a = plane_stress_response(law, Strain(0.1, -0.2, 0, 0.15));
    const Response b = plane_stress_response(law, Strain(0.1, -0.2, 5, 0.15));
    EXPECT_EQ(a.stress, b.stress);
    EXPECT_EQ(a.tangent, b.tangent);
  });
}

/// Condensation of the full tangent, the definition of the one of plane stress.
TEST(PlaneStress, TangentIsTheCondensedOne) {
  for_laws([](const Law& law) {
    for (Strain e : strains) {
      const Response plane = plane_stress_response(law, e, &e[2]);
      if (!plane.ok || poisson_of(law) > 0.4999) continue;  // the oracle cancels there
      const Tangent full = response(law, e).tangent;
      const Tangent condensed = full - full.col(2) * full.row(2) / full(2, 2);
      EXPECT_LT((plane.tangent - condensed).norm(), 2e-14 * full.norm()) << key_of(law);
    }
  });
}

// Stretching a sheet fourfold both ways: a guess from the linear law has no thickness left.
TEST(PlaneStress, NeoHookeFindsTheThicknessOfExtremeStretches) {
  for (const double nu : {0.0, 0.3, 0.4999, 0.4999999})
    for (const double stretched : {1e-6, 1e-2, 16.0, 1e4}) {
      const Strain e(0.5 * (stretched - 1), 0.5 * (stretched - 1), 0, 0);
      double found = 0;
      ASSERT_TRUE(plane_stress_response(NeoHooke{7, nu, 0}, e, &found).ok) << nu << stretched;
      const Lame c = lame(7, nu);
      const double c33 = 1 + 2 * found, log_j = std::log(stretched) + 0.5 * std::log(c33);
      ASSERT_GT(c33, 0);
      EXPECT_NEAR(c.lambda * log_j, c.mu * (1 - c33),
                  1e-15 * (c.lambda * (1 / stretched + 1 / c33 + std::abs(log_j)) + c.mu * c33))
          << nu << " " << stretched;
    }
}

TEST(PlaneStress, SaysWhenThereIsNone) {
  EXPECT_FALSE(plane_stress_response(StVenantKirchhoff{7, 0.3, 0}, Strain(2, 1, 0, 0)).ok);
  EXPECT_FALSE(plane_stress_response(NeoHooke{7, 0.3, 0}, Strain(-0.5, 0, 0, 0)).ok);
  EXPECT_FALSE(plane_stress_response(NeoHooke{7, 0.3, 0}, Strain(0, 0, 0, 1)).ok);
  EXPECT_FALSE(plane_stress_response(NeoHooke{7, 0.3, 0}, Strain(std::nan(""), 0, 0, 1)).ok);
  // auxetic and compressed so far that no thickness balances
  EXPECT_FALSE(plane_stress_response(NeoHooke{7, -0.3, 0}, Strain(-0.4, -0.35, 0, 0.1)).ok);
}

}  // namespace
}  // namespace osculate::material
