// Laws that are functions of the user, asked by their address.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "osculate/contact/law/catalogue.hpp"

namespace osculate::contact {
namespace {

using ::testing::HasSubstr;

extern "C" {
void quadratic_pressure(osculate_normal_point* at) {
  const double depth = -at->gap, k = at->constants[0];
  at->pressure = k * depth * depth;
  at->d_pressure = -2 * k * depth;
  at->energy = k * depth * depth * depth / 3;
}
void coulomb_limit(osculate_friction_point* at) {
  at->limit = at->constants[0] * at->pressure;
  at->d_trial = 0;
  at->d_pressure = at->constants[0];
  at->next[0] = at->memory[0] + at->slid;
  at->next[1] = static_cast<double>(at->count);
}
void viscous_limit(osculate_friction_point* at) {
  const double share = 1 / (1 + at->stiffness * at->duration / at->constants[0]);
  at->limit = share * at->trial;
  at->d_trial = share;
  at->d_pressure = 0;
}
}

template <class Law, class Function>
Law opened(Function* function, std::vector<double> constants) {
  Law law;
  law.function = fmt::format("{:#x}", reinterpret_cast<std::uintptr_t>(function));
  law.constants = std::move(constants);
  const std::optional<core::Fault> fault = law.open("");
  EXPECT_FALSE(fault) << fault->why;
  return law;
}

/// Its traction is minus the slope of its energy: by the order of central differences.
TEST(UserLaws, PressureIsTheSlopeOfTheEnergy) {
  const NormalLaw law = opened<UserNormal>(&quadratic_pressure, {30});
  EXPECT_FALSE(response(law, 0.1).active);
  EXPECT_EQ(stored_energy(law, 0.1), 0);
  EXPECT_DOUBLE_EQ(response(law, -0.2).traction, -30 * 0.04);
  EXPECT_FALSE(augmentable(law));
  EXPECT_EQ(onset_gap(law), 0);
  const auto error = [&](double h) {
    const double slope = (stored_energy(law, -0.2 + h) - stored_energy(law, -0.2 - h)) / (2 * h);
    return std::abs(slope - response(law, -0.2).traction);
  };
  EXPECT_NEAR(std::log2(error(0.02) / error(0.01)), 2, 1e-3);
  const double rise = (response(law, -0.19).traction - response(law, -0.21).traction) / 0.02;
  EXPECT_NEAR(response(law, -0.2).d_traction, rise, 1e-10);
}

TEST(UserLaws, ALimitHasTheReturnMappingOfTheOthers) {
  UserFriction own = opened<UserFriction>(&coulomb_limit, {0.3});
  own.stiffness = 50;
  const FrictionLaw law = own, usual = coulomb(0.3, 50);
  EXPECT_EQ(stiffness(law), 50);
  EXPECT_EQ(stiffness(law.stiffened(2)), 100);
  for (const Vec<2>& trial : {Vec<2>(0.1, 0.2), Vec<2>(3, -1), Vec<2>(0, 0)})
    for (const double normal : {-2.0, 0.0, 1.0}) {
      const auto a = response<3>(law, trial, normal, {}), b = response<3>(usual, trial, normal, {});
      EXPECT_EQ(a.status, b.status);
      EXPECT_EQ(a.traction, b.traction);
      EXPECT_EQ(a.d_predictor, b.d_predictor);
      EXPECT_EQ(a.d_normal, b.d_normal);
    }
  const auto in_the_plane = response<2>(law, Vec<1>(-3), -2, {});
  EXPECT_EQ(in_the_plane.traction[0], -0.6);
  const LawMemory kept = remembered(law, 0.25, {.distance = 9, .memory = {1, 5}});
  EXPECT_EQ(kept, (LawMemory{1.25, 1}));
}

TEST(UserLaws, ALimitMayGoByTheSpeed) {
  UserFriction own = opened<UserFriction>(&viscous_limit, {4});
  own.stiffness = 50;
  own.timed = 1;
  EXPECT_TRUE(needs_duration(FrictionLaw(own)));
  EXPECT_FALSE(needs_duration(FrictionLaw(opened<UserFriction>(&coulomb_limit, {0.3}))));
  const FrictionLaw law = own, usual = ViscousFriction{4, 50};
  const Sliding sliding{.duration = 0.1};
  const Vec<2> trial(3, -1);
  const auto a = response<3>(law, trial, -2, sliding), b = response<3>(usual, trial, -2, sliding);
  EXPECT_LT((a.traction - b.traction).norm(), 1e-15);
  EXPECT_LT((a.d_predictor - b.d_predictor).norm(), 1e-15);
}

TEST(UserLaws, WhatIsNoFunctionIsSaid) {
  UserFriction law;
  law.function = "my_friction";
  EXPECT_THAT(law.open("")->why, HasSubstr("an address"));
  law.library = "none.so";
  EXPECT_THAT(law.open("/tmp")->why, HasSubstr("there is no file '/tmp/none.so'"));
  EXPECT_EQ(law.open("/tmp")->key, "library");
  law.function = "0x";
  law.library.clear();
  EXPECT_EQ(law.open("")->key, "function");
}

}  // namespace
}  // namespace osculate::contact
