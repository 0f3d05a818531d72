// Laws by principal stretches: Ogden's rubber and foam, also where two or three stretches are
// equal.
#include "osculate/material/ogden.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "derivative_check.hpp"
#include "osculate/material/energy.hpp"
#include "osculate/material/hyperfoam.hpp"
#include "osculate/material/law.hpp"

namespace osculate::material {
namespace {

const Ogden three{4.095, 1.3, 0.03, 5, 0.1, -2, 0.02, 0.3, 0.4, 0};
const Ogden one{3.488, 2.163, 0, 0, 0, 0, 0.04, 0, 0, 0};
const Hyperfoam foam{0.16, 8.9, 0.1, 0.05, -4.8, 0.3, 0.1, 2, 0, 0};
const Hyperfoam light{0.16, 8.9, 0, 2.3e-5, -4.8, 0, 0, 0, 0, 0};
const Law laws[] = {three, one, foam, light};

/// The last four with two or three equal stretches, one of them but for rounding, in turned axes.
std::vector<Strain3> strains() {
  const double c = std::cos(0.4), s = std::sin(0.4);
  const double a = 0.3 + 1e-13, b = -0.2;
  return {Strain3(0.1, -0.2, 0.05, 0.15, -0.1, 0.2),
          Strain3(1.2, -0.25, -0.1, -0.4, 0.1, 0.2),
          Strain3(-0.2, 0.1, 0, 0, 0, 0),
          Strain3(0.3, 0.3, -0.2, 0, 0, 0),
          Strain3(-0.1, -0.1, -0.1, 0, 0, 0),
          Strain3(0.25, 0.25, 0.25, 0, 0, 0),
          Strain3(a * c * c + b * s * s, a * s * s + b * c * c, 0.3, 2 * (a - b) * c * s, 0, 0)};
}

Vec3 stretches(const Strain3& e) {
  Mat<3, 3> c;
  c << 1 + 2 * e[0], e[3], e[5], e[3], 1 + 2 * e[1], e[4], e[5], e[4], 1 + 2 * e[2];
  return Eigen::SelfAdjointEigenSolver<Mat<3, 3>>(c).eigenvalues().cwiseSqrt();
}
double power_sum(const Vec3& l, double alpha) { return l.array().pow(alpha).sum() - 3; }

/// W as printed in the headers: oracles of their own.
double energy(const Ogden& k, const Strain3& e) {
  const Vec3 l = stretches(e);
  const double j = l.prod();
  const Vec3 bar = std::pow(j, -1.0 / 3) * l;
  double w = std::pow(j - 1, 2) / k.d1;
  for (const auto& [mu, alpha] : {std::pair(k.mu1, k.alpha1), {k.mu2, k.alpha2}, {k.mu3, k.alpha3}})
    if (mu != 0) w += 2 * mu / (alpha * alpha) * power_sum(bar, alpha);
  if (k.d2 > 0) w += std::pow(j - 1, 4) / k.d2;
  if (k.d3 > 0) w += std::pow(j - 1, 6) / k.d3;
  return w;
}
double energy(const Hyperfoam& k, const Strain3& e) {
  const Vec3 l = stretches(e);
  const double j = l.prod();
  double w = 0;
  for (const auto& [mu, alpha, nu] :
       {std::array{k.mu1, k.alpha1, k.nu1}, {k.mu2, k.alpha2, k.nu2}, {k.mu3, k.alpha3, k.nu3}}) {
    if (mu == 0) continue;
    const double beta = nu / (1 - 2 * nu);
    const double volume = nu == 0 ? -alpha * std::log(j) : (std::pow(j, -alpha * beta) - 1) / beta;
    w += 2 * mu / (alpha * alpha) * (power_sum(l, alpha) + volume);
  }
  return w;
}
double printed_energy(const Law& law, const Strain3& e) {
  if (const auto* const ogden = std::get_if<Ogden>(&law)) return energy(*ogden, e);
  return energy(std::get<Hyperfoam>(law), e);
}

TEST(Stretches, EnergyStressAndTangentAreDerivatives) {
  const Vec<6> along(0.5, -0.3, 0.2, 0.7, -0.4, 0.3);
  for (const Law& law : laws)
    for (const Strain3& e : strains()) {
      const double w = printed_energy(law, e);
      EXPECT_NEAR(stored_energy(law, e), w, 1e-13 * (1 + w));
      const auto value = [&](const Vec<6>& x) -> Eigen::VectorXd {
        return Eigen::VectorXd::Constant(1, printed_energy(law, x));
      };
      const Response3 here = response(law, e);
      ASSERT_TRUE(here.ok);
      Eigen::VectorXd slope(1);
      slope[0] = here.stress.dot(along);
      const auto first = testing::check_derivative(value, slope, e, along);
      EXPECT_TRUE(first.exact || std::abs(first.order - 2) < 0.1) << first.order;
      const auto stress = [&](const Vec<6>& x) -> Eigen::VectorXd {
        return response(law, Strain3(x)).stress;
      };
      const auto second = testing::check_derivative(stress, here.tangent * along, e, along);
      EXPECT_TRUE(second.exact || std::abs(second.order - 2) < 0.1)
          << second.order << " " << second.error << " at " << e.transpose();
      EXPECT_LT((here.tangent - here.tangent.transpose()).norm(), 1e-14 * here.tangent.norm());
    }
}

/// Powers 2 and -2 are the invariants: the polynomial of Mooney and Rivlin, to rounding, whose
/// formulas know no axes.
TEST(Stretches, OgdenWithTheRightPowersIsMooneyRivlin) {
  Rubber rubber;
  rubber.c10 = 0.4;
  rubber.c01 = 0.1;
  rubber.d1 = 0.05;
  rubber.d2 = 0.2;
  const Ogden ogden{0.8, 2, 0.2, -2, 0, 0, 0.05, 0.2, 0, 0};
  auto all = strains();
  all.emplace_back(Strain3::Zero());
  for (const Strain3& e : all) {
    const Response3 r = respond(ogden, e), there = respond(rubber, e);
    EXPECT_LT((r.stress - there.stress).norm(), 1e-13 * there.tangent.norm());
    EXPECT_LT((r.tangent - there.tangent).norm(), 1e-13 * there.tangent.norm());
    EXPECT_NEAR(energy_of(ogden, e), energy_of(rubber, e), 1e-14);
  }
  const Isotropic a = unloaded(ogden), b = unloaded(rubber);
  EXPECT_NEAR(a.young, b.young, 1e-14);
  EXPECT_NEAR(a.poisson, b.poisson, 1e-14);
}

/// Tangents do not jump where stretches meet, however near they are.
TEST(Stretches, MeetWithoutAJump) {
  const Strain3 equal(0.3, 0.3, -0.2, 0, 0, 0);
  for (const Law& law : laws) {
    const Tangent3 limit = response(law, equal).tangent;
    for (const double apart : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
      const Strain3 e = equal + apart * Strain3(1, -0.5, 0, 0.7, 0, 0);
      EXPECT_LT((response(law, e).tangent - limit).norm(), 60 * (apart + 1e-16) * limit.norm());
    }
  }
}

TEST(Stretches, UnloadedTheyAreIsotropic) {
  for (const Law& law : laws) {
    const Isotropic is = unloaded(law);
    const Response3 small =
        response(Law{LinearElastic{is.young, is.poisson, 0}}, Strain3(Strain3::Zero()));
    EXPECT_LT((response(law, Strain3(Strain3::Zero())).tangent - small.tangent).norm(),
              1e-14 * small.tangent.norm());
    const Vec<6> along(0.5, -0.3, 0.2, 0.7, -0.4, 0.3);
    for (const double size : {1e-6, 1e-9, 1e-12}) {
      const Vec<6> linear = small.tangent * (size * along);
      EXPECT_LT((response(law, Strain3(size * along)).stress - linear).norm(),
                60 * size * linear.norm() + 2e-15 * linear.norm());
    }
  }
}

/// A bar of foam of one term: across lambda^-nu, force 2 mu/alpha (lambda^alpha - lambda^(-alpha
/// nu)) / lambda.
TEST(Stretches, AFoamOfOneTermIsThinnedByItsRatio) {
  const Hyperfoam law{0.16, 8, 0.1, 0, 0, 0, 0, 0, 0, 0};
  for (const double s : {0.4, 0.9, 1.5}) {
    const double t = std::pow(s, -0.1);
    const Strain3 e(0.5 * (s * s - 1), 0.5 * (t * t - 1), 0.5 * (t * t - 1), 0, 0, 0);
    const Response3 r = respond(law, e);
    const double force = 2 * 0.16 / 8 * (std::pow(s, 8) - std::pow(s, -0.8)) / s;
    EXPECT_NEAR(s * r.stress[0], force, 1e-14 * (1 + std::abs(force)));
    EXPECT_NEAR(r.stress[1], 0, 1e-14);
    double thickness = 0;
    const Response flat = respond_plane_stress(law, Strain(e.head<4>()), thickness);
    ASSERT_TRUE(flat.ok);
    EXPECT_NEAR(thickness, e[2], 1e-14);
    EXPECT_NEAR(flat.stress[1], 0, 1e-14);
  }
}

TEST(Stretches, PlaneStressIsItsOwnDerivative) {
  const Vec<4> along(0.5, -0.3, 0, 0.7);
  for (const Law& law : laws)
    for (const Strain& e :
         {Strain(0, 0, 0, 0), Strain(0.1, -0.2, 0, 0.15), Strain(1, 0.5, 0, 0.4)}) {
      const auto stress = [&](const Vec<4>& x) -> Eigen::VectorXd {
        return plane_stress_response(law, x).stress;
      };
      double found = 0;
      const Response r = plane_stress_response(law, e, &found);
      ASSERT_TRUE(r.ok);
      Strain full = e;
      full[2] = found;
      const Response there = response(law, full);
      EXPECT_NEAR(there.stress[2], 0, 1e-13 * there.tangent.norm());
      const auto check = testing::check_derivative(stress, r.tangent * along, e, along);
      EXPECT_TRUE(check.exact || std::abs(check.order - 2) < 0.1) << check.order;
    }
}

TEST(Stretches, WithoutVolumeThereIsNoAnswer) {
  for (const Law& law : laws) {
    EXPECT_FALSE(response(law, Strain3(-0.5, 0, 0, 0, 0, 0)).ok);
    EXPECT_FALSE(response(law, Strain3(0, 0, 0, 0, std::nan(""), 0)).ok);
    EXPECT_FALSE(response(law, Strain3(1e300, 0, 0, 0, 0, 0)).ok);
    EXPECT_FALSE(plane_stress_response(law, Strain(-0.5, 0, 0, 0)).ok);
    EXPECT_EQ(stored_energy(law, Strain3(-0.6, 0, 0, 0, 0, 0)),
              std::numeric_limits<double>::infinity());
  }
}

TEST(Stretches, WhatIsNoSolidIsRefused) {
  for (const Law& law : laws) EXPECT_EQ(range_problem(law), "");
  Ogden ogden = three;
  ogden.alpha2 = 0;
  EXPECT_EQ(range_problem(Law{ogden}), "a term with mu has a power that is not 0");
  ogden = three;
  ogden.mu1 = -5;
  EXPECT_EQ(range_problem(Law{ogden}), "mu1 + mu2 + mu3 > 0 is needed: the shear modulus");
  Hyperfoam thin{1, 2, -0.9, 1, 2, -0.9, 0, 0, 0, 0};
  EXPECT_EQ(range_problem(Law{thin}), "");
  thin.mu2 = -0.9;
  thin.nu2 = 0.4;
  EXPECT_EQ(range_problem(Law{thin}), "the terms together do not resist changes of volume");
}

}  // namespace
}  // namespace osculate::material
