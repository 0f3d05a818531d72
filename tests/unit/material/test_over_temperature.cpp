#include "osculate/material/over_temperature.hpp"

#include <gtest/gtest.h>

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
