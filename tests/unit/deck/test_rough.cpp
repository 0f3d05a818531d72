// Rough contact of a block that is sheared until it parts.
#include <gtest/gtest.h>

#include <algorithm>

#include "system_test.hpp"

namespace osculate::deck {
namespace {

std::string sheared(const std::string& enforcement, const std::string& normal = "") {
  return "osculate: 1\n"
         "mesh:\n"
         "  generate:\n"
         "    low: {box: {x: [-2, 2], y: [-1, 0], elements: [10, 3]}}\n"
         "    up: {box: {x: [-0.95, 1.05], y: [0, 1.5], elements: [6, 5]}}\n"
         "materials: {m: {linear_elastic: {E: 1000, nu: 0.3}}}\n"
         "sections: [{on: [low, up], material: m, element: plane_strain, formulation: full}]\n"
         "contact: [{name: c, master: low.top, slave: up.bottom, sampling: nodes, friction: "
         "{rough: {}}, " +
         normal + "enforcement: " + enforcement +
         "}]\n"
         "steps:\n"
         "  - {name: press, increments: 2, prescribe: [{on: low.bottom, ux: 0, uy: 0}, {on: "
         "up.top, "
         "ux: 0, uy: -0.01}]}\n"
         "  - {name: shear, increments: 10, prescribe: [{on: up.top, ux: 0.3, uy: -0.01}]}\n"
         "solver: {arc_length: off}\n";
}

// One side of the block lifts off while it is sheared; what is left in contact has not slid.
TEST(Rough, LiftsOffWhileItIsSheared) {
  for (const char* const enforcement : {"penalty", "augmented_lagrange", "lagrange_multiplier"}) {
    const Built built = build_text(sheared(enforcement));
    int open = 0, stick = 0, slip = 0;
    const model::AnalysisResult result =
        run_to_end(built, 1, [&](model::System& system, const model::State&) {
          for (const auto& point : system.contact()[0].points) {
            open += point.status == contact::Status::open ? 1 : 0;
            stick += point.status == contact::Status::stick ? 1 : 0;
            slip += point.status == contact::Status::slip ? 1 : 0;
          }
        });
    EXPECT_EQ(result.outcome, solve::Outcome::converged) << enforcement << ": " << result.message;
    EXPECT_EQ(open, 4) << enforcement;
    EXPECT_EQ(stick, 3) << enforcement;
    EXPECT_EQ(slip, 0) << enforcement;
  }
}

// Points that are held do not part, and stick however they are pulled.
TEST(Rough, HeldPointsNeverSlide) {
  const Built held = build_text(sheared("penalty", "normal: {separation: no_separation}, "));
  EXPECT_TRUE(std::isinf(
      contact::predicted_limit(*held.model.pairs[0].definition.friction, 1, -1, {}).value));
  const Built free = build_text(sheared("penalty"));
  EXPECT_EQ(contact::predicted_limit(*free.model.pairs[0].definition.friction, 1, -1, {}).value,
            1e4);
}

}  // namespace
}  // namespace osculate::deck
