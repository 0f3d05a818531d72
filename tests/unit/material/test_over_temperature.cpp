#include "osculate/material/over_temperature.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "osculate/material/energy.hpp"
#include "osculate/material/law.hpp"

namespace osculate::material {
namespace {

TEST(OverTemperature, ValuesAreLinearBetweenThePointsAndConstantBeyond) {
  const core::Table table{{-10, 4}, {0, 2}, {20, 3}};
  EXPECT_EQ(value_at(table, -50), 4);
  EXPECT_EQ(value_at(table, -10), 4);
  EXPECT_EQ(value_at(table, -5), 3);
  EXPECT_EQ(value_at(table, 0), 2);
  EXPECT_EQ(value_at(table, 5), 2.25);
  EXPECT_EQ(value_at(table, 20), 3);
  EXPECT_EQ(value_at(table, 1e6), 3);
}

template <class T>
T steel() {
  T law;
  law.young = 210;
  law.poisson = 0.25;
  law.young_over = {{0, 210}, {100, 150}};
  law.poisson_over = {{0, 0.25}, {200, 0.35}};
  return law;
}

template <class T>
void expect_that_of_the_temperature(double temperature, double young, double poisson) {
  Memory memory;
  memory.temperature = &temperature;
  const Law warm{steel<T>()};
  T constant;
  constant.young = young;
  constant.poisson = poisson;
  const Strain3 e(0.1, -0.05, 0.07, 0.2, -0.1, 0.05);
  const Strain plane(0.1, -0.05, 0.07, 0.2);
  EXPECT_LT((response(warm, e, memory).tangent - response(Law{constant}, e).tangent).norm(), 1e-12);
  EXPECT_LT((stress(warm, plane, memory).stress - stress(Law{constant}, plane).stress).norm(),
            1e-13);
  EXPECT_LT((plane_stress_response(warm, plane, nullptr, memory).stress -
             plane_stress_response(Law{constant}, plane).stress)
                .norm(),
            1e-13);
  EXPECT_NEAR(stored_energy(warm, e, memory), stored_energy(Law{constant}, e), 1e-14);
}

TEST(OverTemperature, ElasticConstantsAreThoseOfThePointsTemperature) {
  expect_that_of_the_temperature<LinearElastic>(50, 180, 0.275);
  expect_that_of_the_temperature<StVenantKirchhoff>(150, 150, 0.325);
}

/// Constants that change in different tables, at 50 degrees.
Orthotropic warm_wood() {
  Orthotropic wood{12, 1.1, 0.6, 0.35, 0.4, 0.5, 0.8, 0.7, 0.2, 0};
  wood.e1_over = {{0, 12}, {100, 10}};
  wood.nu23_over = {{20, 0.5}, {80, 0.3}};
  wood.g13_over = {{0, 0.7}, {50, 0.6}, {100, 0.1}};
  return wood;
}

TEST(OverTemperature, StiffnessesInAllDirectionsAreThoseOfThePointsTemperature) {
  const double temperature = 50;
  Memory memory;
  memory.temperature = &temperature;
  const Orthotropic cold{12, 1.1, 0.6, 0.35, 0.4, 0.5, 0.8, 0.7, 0.2, 0},
      there{11, 1.1, 0.6, 0.35, 0.4, 0.4, 0.8, 0.6, 0.2, 0};
  Anisotropic crystal, one;
  crystal.d1111 = crystal.d2222 = crystal.d3333 = 168;
  crystal.d1212 = crystal.d2323 = crystal.d1313 = 75;
  crystal.d1122 = crystal.d1133 = crystal.d2233 = 121;
  one = crystal;
  one.d1122 = 111;
  one.d1112 = 5;
  crystal.d1122_over = {{0, 121}, {100, 101}};
  crystal.d1112_over = {{0, 0}, {100, 10}};
  const Strain3 e(0.1, -0.05, 0.07, 0.2, -0.1, 0.05);
  const Mat<3, 3> axes =
      (Mat<3, 3>() << 0.36, 0.48, -0.8, -0.8, 0.6, 0, 0.48, 0.64, 0.6).finished();
  memory.axes = axes.data();
  Memory turned;
  turned.axes = axes.data();
  const auto same = [&](const Law& warm, const Law& constant) {
    EXPECT_TRUE(over_temperature(warm));
    EXPECT_FALSE(linear(warm));
    const Response3 a = response(warm, e, memory), b = response(constant, e, turned);
    EXPECT_LT((a.tangent - b.tangent).norm(), 1e-14 * b.tangent.norm());
    EXPECT_LT((a.stress - b.stress).norm(), 1e-14 * b.stress.norm());
    EXPECT_NEAR(stored_energy(warm, e, memory), stored_energy(constant, e, turned), 1e-13);
  };
  same(warm_wood(), there);
  same(in_finite_strain(warm_wood()), in_finite_strain(there));
  same(crystal, one);
  same(in_finite_strain(crystal), in_finite_strain(one));
  EXPECT_EQ(stiffnesses_of(Law(cold)).size(), 1U);
  EXPECT_EQ(stiffnesses_of(Law(warm_wood())).size(), 5U);  // 0, 20, 50, 80, 100
  EXPECT_EQ(stiffnesses_of(in_finite_strain(warm_wood()))[2], stiffness(there));
}

TEST(OverTemperature, CreepIsThatOfThePointsTemperature) {
  Norton over{200, 0.3, 0, 1e-3, 3}, there{150, 0.3, 0, 2e-3, 4};
  over.young_over = {{0, 200}, {100, 100}};
  over.rate_over = {{0, 1e-3}, {100, 3e-3}};
  over.exponent_over = {{0, 3}, {100, 5}};
  const double temperature = 50;
  const Strain3 e(0.01, -0.005, 0.007, 0.02, -0.01, 0.005);
  std::array<double, 8> one{}, two{};
  Memory memory{nullptr, one.data(), 8, 0.5};
  memory.temperature = &temperature;
  const Response3 a = response(over, e, memory),
                  b = response(there, e, {nullptr, two.data(), 8, 0.5});
  EXPECT_EQ(a.stress, b.stress);
  EXPECT_EQ(one, two);
  EXPECT_GT(one[0], 0);
  memory.committed = one.data();
  EXPECT_EQ(stored_energy(over, e, memory), stored_energy(there, e, {two.data()}));
  EXPECT_TRUE(over_temperature(over));
}

TEST(OverTemperature, AStiffnessIsPositiveDefiniteAtAllTemperatures) {
  EXPECT_EQ(range_problem(Law(warm_wood())), "");
  Orthotropic wood = warm_wood();
  wood.nu23_over = {{20, 0.5}, {80, 1.36}};
  EXPECT_EQ(range_problem(Law(wood)),
            "nu23^2 < E2 / E3 is needed: else the stiffness is not positive definite (at the "
            "temperature 80)");
  wood = warm_wood();
  wood.nu23_over = {};  // nu12^2 < E1 / E2 at the ends, and not between them
  wood.nu23 = 0;
  wood.e1_over = {};
  wood.e1 = 1;
  wood.nu12_over = {{0, 0.1}, {100, 4}};
  wood.e2_over = {{0, 1.1}, {100, 0.05}};
  EXPECT_NE(range_problem(Law(wood)).find("(at the temperature"), std::string::npos);
  wood.nu12_over = {{0, 0.1}, {100, 0.1}};
  EXPECT_EQ(range_problem(Law(wood)), "");
  Anisotropic crystal;
  crystal.d1111 = crystal.d2222 = crystal.d3333 = 168;
  crystal.d1212 = crystal.d2323 = crystal.d1313 = 75;
  crystal.d1122_over = {{0, 0}, {100, 170}};
  EXPECT_NE(range_problem(Law(crystal)).find("(at the temperature 100)"), std::string::npos);
}

TEST(OverTemperature, OnlySuchLawsDependOnIt) {
  EXPECT_TRUE(over_temperature(Law{steel<LinearElastic>()}));
  EXPECT_FALSE(over_temperature(Law{LinearElastic{1, 0.3, 0}}));
  EXPECT_FALSE(over_temperature(Law{NeoHooke{1, 0.3, 0}}));
  EXPECT_FALSE(linear(Law{steel<LinearElastic>()}));
  EXPECT_TRUE(linear(Law{LinearElastic{1, 0.3, 0}}));
}

TEST(OverTemperature, TablesAreWithinTheRangesOfTheirConstants) {
  LinearElastic law = steel<LinearElastic>();
  EXPECT_EQ(range_problem(Law{law}), "");
  law.poisson_over[1][1] = 0.5;
  EXPECT_EQ(range_problem(Law{law}), "nu = 0.5, but -1 < nu < 0.5 is needed");
}

}  // namespace
}  // namespace osculate::material
