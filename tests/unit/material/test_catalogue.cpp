#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "osculate/material/law.hpp"

namespace osculate::material {
namespace {

TEST(Catalogue, EachLawDescribesItselfAndItsParameters) {
  std::set<std::string_view> keys;
  for_each_law([&](auto law) {
    EXPECT_TRUE(keys.insert(law.key).second);
    EXPECT_FALSE(law.doc.empty());
    EXPECT_EQ(key_of(Law{law}), law.key);
    EXPECT_EQ(finite_strain(Law{law}), law.finite_strain);
    std::set<std::string_view> names;
    for (const auto& p : law.params()) {
      EXPECT_TRUE(names.insert(p.key).second) << law.key;
      EXPECT_FALSE(p.unit.empty() || p.doc.empty()) << law.key << p.key;
    }
    EXPECT_TRUE(names.contains("density")) << law.key;
    EXPECT_EQ(names.contains("E"), names.contains("nu")) << law.key;
  });
  EXPECT_EQ(keys, (std::set<std::string_view>{
                      "linear_elastic", "st_venant_kirchhoff", "neo_hooke", "elastoplastic",
                      "norton", "deformation_plasticity", "rubber", "ogden", "hyperfoam",
                      "arruda_boyce", "orthotropic", "anisotropic", "viscoelastic", "user"}));
}

TEST(Catalogue, ParametersAreWrittenThroughTheirSlots) {
  for_each_law([](auto law) {
    double value = 1;
    for (const auto& p : law.params()) core::set(law, p.slot, value *= 0.25);
    if constexpr (requires { law.young; }) {
      EXPECT_EQ(law.young, 0.25);
      EXPECT_EQ(law.poisson, 0.0625);
      EXPECT_EQ(law.density, 0.015625);
    } else if constexpr (requires { law.e1; }) {
      EXPECT_EQ(law.e1, 0.25);
      EXPECT_EQ(law.nu12, std::pow(0.25, 4));
      EXPECT_EQ(law.density, std::pow(0.25, 10));
    } else if constexpr (requires { law.d1111; }) {
      EXPECT_EQ(law.d1122, 0.0625);
      EXPECT_EQ(law.d2323, std::pow(0.25, 21));
    } else if constexpr (requires { law.alpha1; }) {
      EXPECT_EQ(law.mu1, 0.25);
      EXPECT_EQ(law.alpha1, 0.0625);
      EXPECT_EQ(law.density, std::pow(0.25, 10));
    } else if constexpr (requires { law.routine; }) {
      EXPECT_EQ(law.state, std::pow(0.25, 5));
      EXPECT_EQ(law.density, std::pow(0.25, 6));
    } else if constexpr (requires { law.lambda_m; }) {
      EXPECT_EQ(law.mu, 0.25);
      EXPECT_EQ(law.lambda_m, 0.0625);
      EXPECT_EQ(law.density, std::pow(0.25, 4));
    } else {
      EXPECT_EQ(law.c10, 0.25);
      EXPECT_EQ(law.c01, 0.0625);
    }
  });
}

TEST(Catalogue, RangesEndWhereTheLawsDo) {
  const auto problem = [](double young, double nu, double density) {
    return range_problem(Law{NeoHooke{young, nu, density}});
  };
  EXPECT_EQ(problem(1, 0.3, 0), "");
  EXPECT_EQ(problem(1, std::nextafter(0.5, 0), 0), "");
  EXPECT_EQ(problem(1, 0.5, 0), "nu = 0.5, but -1 < nu < 0.5 is needed");
  EXPECT_EQ(problem(1, -1, 0), "nu = -1, but -1 < nu < 0.5 is needed");
  EXPECT_EQ(problem(0, 0.3, 0), "E = 0, but E > 0 is needed");
  EXPECT_EQ(problem(1, 0.3, -2), "density = -2, but density >= 0 is needed");
  EXPECT_EQ(problem(std::nan(""), 0.3, 0), "E = nan, but E > 0 is needed");
}

TEST(Range, SaysInWordsWhatItContains) {
  EXPECT_EQ(core::describe({}, "x"), "x is any number");
  EXPECT_EQ(core::describe({.upper = 2, .with_upper = true}, "x"), "x <= 2");
  EXPECT_EQ(core::describe({.lower = 0, .upper = 2, .with_lower = true}, "x"), "0 <= x < 2");
  const core::Range half_open{.lower = 0, .upper = 2, .with_lower = true};
  EXPECT_TRUE(half_open.contains(0) && half_open.contains(1.9));
  EXPECT_FALSE(half_open.contains(2) || half_open.contains(-1e-300));
  EXPECT_FALSE(core::Range{}.contains(std::nan("")));
}

}  // namespace
}  // namespace osculate::material
