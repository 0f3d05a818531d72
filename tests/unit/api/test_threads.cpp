#include "osculate/api/threads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>

#include "osculate/contact/law/user_laws.hpp"
#include "osculate/core/machine.hpp"
#include "osculate/material/user_material.hpp"

namespace osculate::api {
namespace {

/// Threads by default, with OMP_NUM_THREADS as it is said here.
template <int Dim>
int threads_with(const model::BasicModel<Dim>& model, const char* said) {
  constexpr const char* name = "OMP_NUM_THREADS";
  const char* const now = std::getenv(name);
  const std::optional<std::string> before = now ? std::optional<std::string>(now) : std::nullopt;
  if (said)
    setenv(name, said, 1);
  else
    unsetenv(name);
  const int threads = threads_that_pay(model);
  if (before)
    setenv(name, before->c_str(), 1);
  else
    unsetenv(name);
  return threads;
}

template <int Dim>
model::BasicModel<Dim> of_nodes(std::size_t count) {
  model::BasicModel<Dim> model;
  model.reference.resize(count, Vec<Dim>::Zero());
  return model;
}

TEST(Threads, AreThoseOfTheProcessorUpToFourInLargeModels) {
  const int expected = std::min(core::processors_here(), 4);
  EXPECT_EQ(threads_with(of_nodes<3>(1000), nullptr), expected);
  EXPECT_EQ(threads_with(of_nodes<2>(1500), nullptr), expected);
  EXPECT_EQ(threads_with(of_nodes<3>(999), nullptr), 1);
  EXPECT_EQ(threads_with(of_nodes<2>(1499), nullptr), 1);
}

TEST(Threads, AreThoseOfTheEnvironmentWhereItSaysHowMany) {
  EXPECT_EQ(threads_with(of_nodes<3>(1000), "7"), 7);
  EXPECT_EQ(threads_with(of_nodes<3>(1000), "1"), 1);
  EXPECT_EQ(threads_with(of_nodes<3>(1000), "100000"), 1024);
  EXPECT_EQ(threads_with(of_nodes<3>(999), "7"), 1);
  EXPECT_EQ(threads_with(of_nodes<3>(1000), "many"), threads_with(of_nodes<3>(1000), nullptr));
}

TEST(Threads, AreNoneBesideTheFirstForLawsOfOnesOwn) {
  model::Model3 pressure = of_nodes<3>(1000);
  pressure.pairs.emplace_back();
  EXPECT_EQ(threads_with(pressure, "3"), 3);
  pressure.pairs.back().definition.normal = contact::UserNormal{};
  EXPECT_EQ(threads_with(pressure, "3"), 1);

  model::Model friction = of_nodes<2>(1500);
  friction.pairs.emplace_back();
  friction.pairs.back().definition.friction = contact::UserFriction{};
  EXPECT_EQ(threads_with(friction, "3"), 1);

  model::Model3 later = of_nodes<3>(1000);
  later.pair_changes.emplace_back();
  EXPECT_EQ(threads_with(later, "3"), 3);
  later.pair_changes.back().friction = contact::UserFriction{};
  EXPECT_EQ(threads_with(later, "3"), 1);
}

TEST(Threads, AreNoneBesideTheFirstForMaterialsOfOnesOwn) {
  model::Model3 model = of_nodes<3>(1000);
  model.sections.emplace_back();
  EXPECT_EQ(threads_with(model, "3"), 3);
  model.sections.back().section.law = material::UserMaterial{};
  EXPECT_EQ(threads_with(model, "3"), 1);

  model::Model later = of_nodes<2>(1500);
  later.body_changes.emplace_back().materials.emplace_back();
  EXPECT_EQ(threads_with(later, "3"), 3);
  later.body_changes.back().materials.back().now.law = material::UserMaterial{};
  EXPECT_EQ(threads_with(later, "3"), 1);
}

TEST(Threads, AreCountedByWhatMoves) {
  model::Model3 model = of_nodes<3>(1000);
  model.body_of_node.assign(1000, -1);
  EXPECT_EQ(threads_with(model, "3"), 3);
  model.body_of_node.back() = 0;
  EXPECT_EQ(threads_with(model, "3"), 1);
}

TEST(Threads, AreNoneBesideTheFirstWhereSeveralProgramsAreUnderWay) {
  setenv("OSCULATE_ALONE", "1", 1);
  EXPECT_EQ(threads_with(of_nodes<3>(1000), "3"), 1);
  unsetenv("OSCULATE_ALONE");
}

}  // namespace
}  // namespace osculate::api
