// The key `enforcement`: what it becomes, and what it is refused with.
#include <gtest/gtest.h>

#include "deck_test.hpp"
#include "osculate/deck/build.hpp"

namespace osculate::deck {
namespace {

std::string refusal_of(const std::string& from, const std::string& to) {
  const std::string text = edited(test_file("enforcement.yaml"), from, to);
  try {
    const Description d = parse_model(text, "model.yaml");
    (void)build(d, load_mesh(d));
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(EnforcementKeys, BecomeThePairs) {
  const Description d = parse_model(test_file("enforcement.yaml"), "model.yaml");
  const Built built = build(d, load_mesh(d));
  const auto& a = built.model.pairs.at(0).definition;
  const auto* const asked = std::get_if<pairing::ByAugmentedLagrange>(&a.enforcement);
  ASSERT_NE(asked, nullptr);
  EXPECT_EQ(asked->target, 1e-5);
  EXPECT_TRUE(asked->every_iteration);
  const auto& b = built.model.pairs.at(1).definition;
  EXPECT_TRUE(pairing::by_multipliers(b));
  EXPECT_NEAR(contact::penalty_of(b.normal), 10 * 100 / (1.0 + 2.0 / 3), 1e-9);
}

TEST(EnforcementKeys, RefuseWhatDoesNotGoTogether) {
  const std::string exact = "enforcement: lagrange_multiplier";
  const std::string b = "model.yaml:16: contact[1].";
  struct Refusal {
    std::string to, message;
  };
  const std::vector<Refusal> all{
      {exact + ", sampling: {gauss: 2}",
       b + "enforcement: facets have more quadrature points than nodes, so their tractions cannot "
           "all be unknown: use sampling: nodes or mortar, or augmented_lagrange"},
      {exact + ", two_pass: true",
       b + "enforcement: with both sides as slaves there are more unknown tractions than nodes "
           "that could carry them: use penalty or augmented_lagrange"},
      {exact + ", residual: full",
       b + "residual: unknown tractions have the form surface only: without penetration there is "
           "no other"},
      {exact + ", tangent: covariant",
       b + "tangent: unknown tractions have the consistent tangent only"},
      {exact + ", normal: {table: [[0, 0], [1, 1]]}",
       b + "enforcement: a law that gives the pressure as a function of the gap is met by itself: "
           "use penalty"}};
  for (const Refusal& r : all) EXPECT_EQ(refusal_of(exact, r.to), r.message) << r.to;
}

}  // namespace
}  // namespace osculate::deck
