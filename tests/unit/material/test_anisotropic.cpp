// Materials whose stiffness differs with the direction, and where their axes point.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>

#include "derivative_check.hpp"
#include "osculate/material/energy.hpp"
#include "osculate/material/law.hpp"
#include "sample_laws.hpp"

namespace osculate::material {
namespace {

/// Wood, roughly: moduli along the grain, across it, and around.
const Orthotropic oak{12, 1.1, 0.6, 0.35, 0.4, 0.5, 0.8, 0.7, 0.2, 0};

/// Without any symmetry; positive definite, as its diagonal outweighs the rest.
Anisotropic crystal() {
  Anisotropic c;
  double off = 0.1;
  for (const auto& p : Anisotropic::params()) {
    const bool own = p.key.size() == 5 && p.key.substr(1, 2) == p.key.substr(3, 2);
    if (p.key != "density") core::set(c, p.slot, own ? 5 + off : off);
    off += 0.03;
  }
  return c;
}

const Law laws[] = {oak, in_finite_strain(oak), crystal(), in_finite_strain(crystal())};
const Strain3 sample(0.1, -0.05, 0.07, 0.2, -0.1, 0.05);
const Strain in_plane_sample(0.1, -0.05, 0.07, 0.2);

Mat<3, 3> some_axes() {
  return Eigen::AngleAxisd(1.1, Vec3(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
}
Memory along(const Mat<3, 3>& axes) {
  Memory memory;
  memory.axes = axes.data();
  return memory;
}
/// Full tensor; `shear` is what a component of shear stands for.
Mat<3, 3> tensor(const Vec<6>& v, double shear) {
  Mat<3, 3> t;
  t << v[0], shear * v[3], shear * v[5], shear * v[3], v[1], shear * v[4], shear * v[5],
      shear * v[4], v[2];
  return t;
}
Vec<6> components(const Mat<3, 3>& t, double shear) {
  return {t(0, 0), t(1, 1), t(2, 2), shear * t(0, 1), shear * t(1, 2), shear * t(0, 2)};
}

TEST(Directional, IsotropicConstantsMakeTheIsotropicMaterialInAllAxes) {
  const double young = 7, poisson = 0.3;
  const Mat<3, 3> axes = some_axes();
  const auto check = [&](auto law, bool finite) {
    testing::set_elastic(law, young, poisson);
    const Law tested = finite ? in_finite_strain(law) : Law{law};
    const Law known =
        finite ? Law{StVenantKirchhoff{young, poisson, 0}} : Law{LinearElastic{young, poisson, 0}};
    EXPECT_EQ(finite_strain(tested), finite);
    for (const Memory& memory : {Memory{}, along(axes)}) {
      const Response3 a = response(tested, sample, memory), b = response(known, sample);
      EXPECT_LT((a.stress - b.stress).norm(), 1e-14 * b.stress.norm());
      EXPECT_LT((a.tangent - b.tangent).norm(), 1e-14 * b.tangent.norm());
      EXPECT_LT((stress(tested, sample, memory).stress - b.stress).norm(), 1e-14 * b.stress.norm());
      const Response plane = response(tested, in_plane_sample, memory);
      EXPECT_LT((plane.tangent - response(known, in_plane_sample).tangent).norm(),
                1e-14 * plane.tangent.norm());
      double e33 = 0, known_e33 = 0;
      const Response free = plane_stress_response(tested, in_plane_sample, &e33, memory);
      const Response known_free = plane_stress_response(known, in_plane_sample, &known_e33);
      EXPECT_LT((free.stress - known_free.stress).norm(), 1e-14 * free.stress.norm());
      EXPECT_LT((free.tangent - known_free.tangent).norm(), 1e-14 * free.tangent.norm());
      EXPECT_NEAR(e33, known_e33, 1e-15);
      EXPECT_NEAR(stored_energy(tested, sample, memory), stored_energy(known, sample), 1e-15);
    }
    EXPECT_NEAR(unloaded(tested).young, young, 1e-13);
    EXPECT_NEAR(unloaded(tested).poisson, poisson, 1e-14);
  };
  for (const bool finite : {false, true}) {
    check(Orthotropic{}, finite);
    check(Anisotropic{}, finite);
  }
}

// Each unit stress makes the strains that the engineering constants say.
TEST(Directional, EngineeringConstantsAreThoseOfPullsAndShears) {
  const Mat<6, 6> s = stiffness(oak).inverse();
  Mat<6, 6> expected = Mat<6, 6>::Zero();
  expected.diagonal() << 1 / oak.e1, 1 / oak.e2, 1 / oak.e3, 1 / oak.g12, 1 / oak.g23, 1 / oak.g13;
  expected(0, 1) = expected(1, 0) = -oak.nu12 / oak.e1;
  expected(0, 2) = expected(2, 0) = -oak.nu13 / oak.e1;
  expected(1, 2) = expected(2, 1) = -oak.nu23 / oak.e2;
  EXPECT_LT((s - expected).norm(), 1e-13 * expected.norm());
}

// S_ij = D_ijkl E_kl, summed over all four indices of the constants' names.
TEST(Directional, TheNameOfAConstantSaysWhatItMultiplies) {
  const Anisotropic c = crystal();
  Mat<3, 3> sum = Mat<3, 3>::Zero();
  const Mat<3, 3> e = tensor(sample, 0.5);
  const auto named = [&](int i, int j, int k, int l) {
    const auto pair = [](int a, int b) { return 10 * (std::min(a, b) + 1) + std::max(a, b) + 1; };
    for (const auto& p : Anisotropic::params()) {
      if (p.key == "density") continue;
      const int whole = std::stoi(std::string(p.key.substr(1)));
      const bool same = whole / 100 == pair(i, j) && whole % 100 == pair(k, l);
      const bool turned = whole / 100 == pair(k, l) && whole % 100 == pair(i, j);
      if (same || turned) return *core::number_in(c, p.slot);
    }
    ADD_FAILURE();
    return 0.0;
  };
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) sum(i, j) += named(i, j, k, l) * e(k, l);
  EXPECT_LT((response(Law{c}, sample).stress - components(sum, 1)).norm(), 1e-14 * sum.norm());
}

// Axes and strain that turn together turn the stress with them.
TEST(Directional, TheStressTurnsWithTheAxes) {
  const Mat<3, 3> r = some_axes(),
                  axes = Eigen::AngleAxisd(-0.6, Vec3(1, 2, 0.5).normalized()).toRotationMatrix(),
                  turned_axes = r * axes;
  const Strain3 turned_strain = components(r * tensor(sample, 0.5) * r.transpose(), 2);
  for (const Law& law : laws) {
    const Response3 before = response(law, sample, along(axes)),
                    after = response(law, turned_strain, along(turned_axes));
    const Stress3 expected = components(r * tensor(before.stress, 1) * r.transpose(), 1);
    EXPECT_LT((after.stress - expected).norm(), 1e-14 * expected.norm());
    EXPECT_NEAR(stored_energy(law, turned_strain, along(turned_axes)),
                stored_energy(law, sample, along(axes)), 1e-15);
    // in its own axes the body answers as one whose axes are the global ones
    const Strain3 own = components(axes.transpose() * tensor(sample, 0.5) * axes, 2);
    const Stress3 there =
        components(axes * tensor(response(law, own).stress, 1) * axes.transpose(), 1);
    EXPECT_LT((before.stress - there).norm(), 1e-14 * there.norm());
    EXPECT_GT((before.stress - response(law, sample).stress).norm(), 0.01 * there.norm());
  }
}

TEST(Directional, StressAndTangentAreDerivativesOfTheEnergy) {
  const Mat<3, 3> axes = some_axes();
  const Vec<6> way(0.5, -0.3, 0.2, 0.7, -0.4, 0.3);
  for (const Law& law : laws) {
    const Response3 r = response(law, sample, along(axes));
    const auto energy = [&](const Vec<6>& e) -> Eigen::VectorXd {
      return Eigen::VectorXd::Constant(1, stored_energy(law, Strain3(e), along(axes)));
    };
    const Eigen::VectorXd slope = Eigen::VectorXd::Constant(1, r.stress.dot(way));
    EXPECT_TRUE(testing::check_derivative(energy, slope, Vec<6>(sample), way).exact);
    const auto force = [&](const Vec<6>& e) -> Eigen::VectorXd {
      return stress(law, Strain3(e), along(axes)).stress;
    };
    EXPECT_TRUE(testing::check_derivative(force, r.tangent * way, Vec<6>(sample), way).exact);
    EXPECT_EQ(r.tangent, Tangent3(r.tangent.transpose()));
  }
}

TEST(Directional, InPlaneStressTheThicknessIsFreeOfStress) {
  const Mat<3, 3> axes = Eigen::AngleAxisd(0.4, Vec3::UnitZ()).toRotationMatrix();
  for (const Law& law : {laws[0], laws[1]}) {
    double e33 = 0;
    const Response r = plane_stress_response(law, in_plane_sample, &e33, along(axes));
    Strain found = in_plane_sample;
    found[2] = e33;
    const Response whole = response(law, found, along(axes));
    EXPECT_NEAR(whole.stress[2], 0, 1e-15);
    EXPECT_LT((whole.stress - r.stress).norm(), 1e-14 * r.stress.norm());
    const auto free = [&](const Vec<4>& e) -> Eigen::VectorXd {
      return plane_stress_response(law, Strain(e), nullptr, along(axes)).stress;
    };
    const Vec<4> way(0.5, -0.3, 0, 0.7);
    EXPECT_TRUE(
        testing::check_derivative(free, r.tangent * way, Vec<4>(in_plane_sample), way).exact);
  }
  const Strain stretched(5, 5, 0, 0);
  EXPECT_TRUE(plane_stress_response(laws[0], stretched).ok);
  EXPECT_FALSE(plane_stress_response(laws[1], stretched).ok);  // no thickness is left
}

TEST(Directional, WhatGivesEnergyIsRefusedByItsKey) {
  const auto problem = [](auto change) {
    Orthotropic law = oak;
    change(law);
    return range_problem(Law{law});
  };
  EXPECT_EQ(problem([](Orthotropic&) {}), "");
  EXPECT_EQ(problem([](Orthotropic& l) { l.g23 = 0; }), "G23 = 0, but G23 > 0 is needed");
  EXPECT_EQ(problem([](Orthotropic& l) { l.nu12 = 3.4; }),
            "nu12^2 < E1 / E2 is needed: else the stiffness is not positive definite");
  EXPECT_EQ(problem([](Orthotropic& l) { l.nu23 = -1.5; }),
            "nu23^2 < E2 / E3 is needed: else the stiffness is not positive definite");
  EXPECT_EQ(problem([](Orthotropic& l) { l.nu12 = 2.5, l.nu13 = 2.5, l.nu23 = 1; }),
            "nu12^2 E2 / E1 + nu13^2 E3 / E1 + nu23^2 E3 / E2 + 2 nu12 nu13 nu23 E3 / E1 < 1 is "
            "needed: else the stiffness is not positive definite");
  Anisotropic c = crystal();
  EXPECT_EQ(range_problem(Law{c}), "");
  c.d2223 = 6;
  EXPECT_EQ(
      range_problem(Law{c}),
      "D2323 is too small beside the other constants: the stiffness is not positive definite");
  EXPECT_EQ(*c.fault()->key.data(), 'D');
}

TEST(Orientation, AxesAreRightHandedAndOfLengthOne) {
  using Kind = Orientation::Kind;
  for (const Orientation& o : {Orientation{Kind::rectangular, {2, 1, 0}, {0, 1, 3}, 2, 0.3},
                               Orientation{Kind::cylindrical, {0, 0, 1}, {1, 2, 3}, 0, -0.7}}) {
    const Mat<3, 3> axes = axes_at(o, {3, -1, 2});
    EXPECT_LT((axes.transpose() * axes - Mat<3, 3>::Identity()).norm(), 1e-14);
    EXPECT_NEAR(axes.determinant(), 1, 1e-14);
    EXPECT_TRUE(gives_axes(o));
  }
  EXPECT_EQ(axes_at({}, {1, 2, 3}), (Mat<3, 3>::Identity()));
  EXPECT_FALSE(gives_axes({Kind::rectangular, {1, 2, 0}, {2, 4, 0}}));
  EXPECT_FALSE(gives_axes({Kind::cylindrical, {1, 2, 0}, {1, 2, 0}}));
}

TEST(Orientation, PointsAlongAndAroundAndMayBeTurned) {
  using Kind = Orientation::Kind;
  const Mat<3, 3> flat = axes_at({Kind::rectangular, {0, 0, 1}, {1, 0, 0}}, {5, 5, 5});
  EXPECT_EQ(flat.col(0), Vec3::UnitZ());
  EXPECT_EQ(flat.col(1), Vec3::UnitX());
  EXPECT_EQ(flat.col(2), Vec3::UnitY());
  const Orientation round{Kind::cylindrical, {1, 0, 0}, {1, 0, 7}};
  const Mat<3, 3> there = axes_at(round, {1, 3, -2});
  EXPECT_LT((there.col(0) - Vec3::UnitY()).norm(), 1e-15);
  EXPECT_LT((there.col(1) + Vec3::UnitX()).norm(), 1e-15);
  EXPECT_LT((there.col(2) - Vec3::UnitZ()).norm(), 1e-15);
  EXPECT_TRUE(axes_at(round, {1, 0, 4}).allFinite());  // on the axis
  Orientation helix = round;
  helix.about = 0;
  helix.angle = std::numbers::pi / 2;  // about the radius: around becomes along
  const Mat<3, 3> wound = axes_at(helix, {1, 3, -2});
  EXPECT_LT((wound.col(0) - Vec3::UnitY()).norm(), 1e-15);
  EXPECT_LT((wound.col(1) - Vec3::UnitZ()).norm(), 1e-15);
  EXPECT_LT((wound.col(2) - Vec3::UnitX()).norm(), 1e-15);
}

TEST(Orientation, IsLaidOntoAShell) {
  const Vec3 normal = Vec3(1, 2, -0.5).normalized();
  const Mat<3, 3> axes = axes_at({Orientation::Kind::rectangular, {2, 1, 0}, {0, 1, 3}}, {});
  const Mat<3, 3> laid = axes_along_shell(axes, normal);
  EXPECT_LT((laid.transpose() * laid - Mat<3, 3>::Identity()).norm(), 1e-14);
  EXPECT_NEAR(laid.determinant(), 1, 1e-14);
  EXPECT_LT((laid.col(2) - normal).norm(), 1e-15);
  // no direction of the shell is nearer to the first axis than the first one of these
  EXPECT_NEAR(laid.col(1).dot(axes.col(0)), 0, 1e-15);
  EXPECT_GT(laid.col(0).dot(axes.col(0)), 0.5);
  EXPECT_LT((axes_along_shell(laid, normal) - laid).norm(), 1e-15);
  // where it is the normal, the third one leads
  const Mat<3, 3> led = axes_along_shell(axes, axes.col(0));
  EXPECT_LT((led.col(0) - axes.col(2)).norm(), 1e-15);
}

}  // namespace
}  // namespace osculate::material
