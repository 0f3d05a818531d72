// Steps with inertia: rigid bodies in space whose rotation is prescribed in part, or later on.
#include <gtest/gtest.h>

#include "space_test.hpp"

namespace osculate::deck {
namespace {

/// A ball in the air under a moment, beside a block that takes no part.
std::string in_the_air(const std::string& scheme, const std::string& prescribed,
                       const std::string& more) {
  return R"(osculate: 1
mesh: {generate: {low: {box: {x: [0, 1], y: [0, 1], z: [-5, -4], elements: [1, 1, 1]}}}}
materials: {m: {linear_elastic: {E: 100, nu: 0.25, density: 1}}}
sections: [{on: low, material: m, element: solid}]
rigid: {wheel: {sphere: {center: [0, 0, 0], radius: 1}, mass: 2.5, inertia: [2, 2.5, 3, 0.4, 0.2, -0.3]}}
amplitudes: {at_once: [[0, 1], [1, 1]]}
initial_velocity: [{on: wheel, wy: 3}]
steps:
  - name: spin
    increments: 20
    duration: 1
    dynamics: {scheme: )" +
         scheme + R"(}
    prescribe: [{on: low.bottom, ux: 0, uy: 0, uz: 0}, {on: wheel, ux: 0, uy: 0, uz: 0)" +
         prescribed + R"(}]
    forces: [{on: wheel, my: 0.5, amplitude: at_once}]
)" + more +
         "output: {history: [{on: wheel, of: ry}]}\n";
}

model::State3 at_the_end(const Built3& built) {
  model::State3 last;
  model::AnalysisObserver3 observer;
  observer.converged = [&](model::System3&, const model::State3& s, const model::Progress&,
                           const solve::IncrementRecord*) {
    last = s;
    return true;
  };
  const model::AnalysisResult3 result = model::run(built.model, built.options, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  return last;
}

// A wheel on an axle that is not a principal axis: the bearings take what the moments of deviation
// ask for, and the angle is a parabola, which every scheme meets exactly.
TEST(DynamicsRotation, AWheelOnItsAxleTurnsByItsMomentOfInertia) {
  for (const char* const scheme :
       {"newmark", "{hht: {alpha: 0.1}}", "{generalized_alpha: {radius: 0.6}}"})
    for (const char* const impact : {"dissipative", "average", "plastic"}) {
      const Built3 built =
          built_from(in_the_air(std::string(scheme) + ", impact: " + impact, ", rx: 0, rz: 0", ""));
      const model::State3 last = at_the_end(built);
      ASSERT_EQ(last.rigid.size(), 1u);
      EXPECT_NEAR(total_rotation(last.rigid[0]).y(), 3.1, 1e-9) << scheme << impact;
      EXPECT_NEAR(body::spin(last.rigid[0], last.rates.spins[0]).y(), 3.2, 1e-9);
    }
}

// What is prescribed is the total rotation vector, also of a body that has turned far before.
TEST(DynamicsRotation, APrescribedRotationIsTheTotal) {
  std::string text = in_the_air("newmark", "", R"(  - name: turn
    increments: 4
    duration: 1
    prescribe: [{on: wheel, rx: 0.4, ry: 3.5, rz: -0.2}]
)");
  const model::State3 last = at_the_end(built_from(text));
  ASSERT_EQ(last.rigid.size(), 1u);
  EXPECT_LT((total_rotation(last.rigid[0]) - Vec3(0.4, 3.5, -0.2)).norm(), 1e-12);
  EXPECT_LT((last.rigid[0].orientation() - body::rotation_matrix({0.4, 3.5, -0.2})).norm(), 1e-12);
}

// Free all the way, it turns through more than a whole turn, and the total goes on.
TEST(DynamicsRotation, AFreeBodyPassesWholeTurns) {
  std::string text = in_the_air("newmark", "", "");
  text.replace(text.find("inertia: [2, 2.5, 3, 0.4, 0.2, -0.3]"), 36, "inertia: [1, 2, 2.5]");
  text.replace(text.find("wy: 3"), 5, "wy: 9");
  const model::State3 last = at_the_end(built_from(text));
  ASSERT_EQ(last.rigid.size(), 1u);
  EXPECT_FALSE(last.rigid[0].base.isIdentity(0));
  EXPECT_LT((total_rotation(last.rigid[0]) - Vec3(0, 9.125, 0)).norm(), 1e-9);
}

}  // namespace
}  // namespace osculate::deck
