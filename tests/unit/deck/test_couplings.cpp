// Couplings of some displacements with a rigid body.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "osculate/deck/build.hpp"
#include "osculate/deck/parse.hpp"

namespace osculate::deck {
namespace {

using ::testing::HasSubstr;

/// A square under a body, which all of its top follows in some directions.
std::string under_a_body(const std::string& of, const std::string& loads,
                         const std::string& kinematics = "small") {
  return "osculate: 1\n"
         "mesh: {generate: {b: {box: {x: [0, 1], y: [0, 1], elements: [2, 2]}}}}\n"
         "materials: {m: {" +
         std::string(kinematics == "small" ? "linear_elastic" : "st_venant_kirchhoff") +
         ": {E: 100, nu: 0.3}}}\n"
         "sections: [{on: b, material: m, element: plane_strain, kinematics: " +
         kinematics +
         "}]\n"
         "rigid: {hub: {circle: {center: [0.3, 2], radius: 0.1}}}\n"
         "coupling: [{on: b.top, rigid: hub, of: " +
         of +
         "}]\n"
         "steps:\n"
         "  - {name: s, increments: 1, prescribe: [{on: b.bottom, ux: 0, uy: 0}, " +
         loads + "}\n";
}
/// A run, and the reactions at its end.
struct CoupledRun {
  Built built;
  model::AnalysisResult result;
  Eigen::VectorXd reaction;

  explicit CoupledRun(const std::string& text) {
    const Description d = parse_model(text, "m.yaml");
    built = build(d, load_mesh(d));
    model::AnalysisObserver observer;
    observer.converged = [&](model::System& system, const model::State& state,
                             const model::Progress&, const solve::IncrementRecord*) {
      const model::Forces& f = system.forces();
      reaction = (f.internal + f.contact - f.external).head(state.u.size());
      return true;
    };
    result = model::run(built.model, built.options, observer);
    EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  }
};
std::string refusal_of(const std::string& text) {
  try {
    const Description d = parse_model(text, "m.yaml");
    (void)build(d, load_mesh(d));
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "no error";
}

/// Along axes of their own the nodes follow, across them they are free.
TEST(Couplings, NodesFollowABodyAlongAxes) {
  const CoupledRun run(under_a_body("[ux], axes: {rectangular: {x: [1, 1, 0], xy: [0, 1, 0]}}",
                                    "{on: hub, ux: 0.02, uy: 0.01, rz: 0.1}]"));
  bool across = false;
  for (const Index n : run.built.model.mesh.find_set("b.top")->nodes) {
    const Vec2 arm = run.built.model.reference[static_cast<std::size_t>(n)] - Vec2(0.3, 2);
    const Vec2 apart =
        run.result.state.u.segment<2>(2 * n) - Vec2(0.02 - 0.1 * arm.y(), 0.01 + 0.1 * arm.x());
    EXPECT_LT(std::abs(apart.sum()), 1e-13);
    across = across || std::abs(apart[0] - apart[1]) > 1e-3;
  }
  EXPECT_TRUE(across);
  // A circle about the reference point of the body: what is held around it turns with it.
  const CoupledRun round(
      under_a_body("[uy], axes: {cylindrical: {from: [0.3, 2, 0], to: [0.3, 2, 1]}}",
                   "{on: hub, ux: 0, uy: 0, rz: 0.1}]"));
  for (const Index n : round.built.model.mesh.find_set("b.top")->nodes) {
    const Vec2 arm = round.built.model.reference[static_cast<std::size_t>(n)] - Vec2(0.3, 2);
    EXPECT_NEAR(turn(arm).dot(Vec2(round.result.state.u.segment<2>(2 * n))),
                0.1 * arm.squaredNorm(), 1e-13);
  }
  EXPECT_THAT(refusal_of(under_a_body("[ux], axes: {rectangular: {x: [1, 0, 0], xy: [2, 0, 0]}}",
                                      "{on: hub, ux: 0, uy: 0, rz: 0}]")),
              HasSubstr("the two points do not give axes"));
}

/// Two squares, free but for a body at the side of the first, which the second follows in the mean.
std::string turned_by_a_body(const std::string& kinematics) {
  return "osculate: 1\n"
         "mesh: {generate: {a: {box: {x: [0, 1], y: [0, 1], elements: [2, 2]}}, b: {box: {x: [2, "
         "3], y: [0, 1], elements: [2, 2]}}}}\n"
         "materials: {m: {linear_elastic: {E: 100, nu: 0.3}}}\n"
         "sections: [{on: a, material: m, element: plane_strain}, {on: b, material: m, element: "
         "plane_strain}]\n"
         "rigid: {hub: {set: a.right, reference: [1, 0.3]" +
         kinematics +
         "}}\n"
         "coupling: [{on: b.left, rigid: hub}]\n"
         "steps:\n"
         "  - {name: s, increments: 1, prescribe: [{on: hub, ux: 0.2, uy: -0.3, rz: 0.1}]}\n";
}

/// Bodies of small strain that are bound to it are not strained by its rotation if that is small.
TEST(Couplings, SmallRotationsOfABodyStrainNothing) {
  const CoupledRun run(turned_by_a_body(", kinematics: small"));
  for (Index n = 0; n < 18; ++n) {
    const Vec2 arm = run.built.model.reference[static_cast<std::size_t>(n)] - Vec2(1, 0.3);
    const Vec2 moved(0.2 - 0.1 * arm.y(), -0.3 + 0.1 * arm.x());
    EXPECT_LT((run.result.state.u.segment<2>(2 * n) - moved).norm(), 1e-13) << n;
  }
  EXPECT_LT(run.reaction.norm(), 1e-11);
  const CoupledRun finite(turned_by_a_body(""));
  const Vec2 far = finite.result.state.u.segment<2>(0);
  EXPECT_NEAR((far - Vec2(0.2, -0.3)).norm(), 2 * std::sin(0.05) * std::hypot(1, 0.3), 1e-2);
  EXPECT_GT(finite.reaction.norm(), 1e-2);
}

/// u_i = U_i + theta (e_z x (X - X_b))_i in the directions that are named, and in no other.
TEST(Couplings, NodesFollowABodyInSomeDirections) {
  for (const char* const of : {"[uy]", "[ux]", "[ux, uy]"}) {
    const CoupledRun run(under_a_body(of, "{on: hub, ux: 0.02, uy: 0.01, rz: 0.1}]"));
    bool other = false;
    for (const Index n : run.built.model.mesh.find_set("b.top")->nodes) {
      const Vec2 arm = run.built.model.reference[static_cast<std::size_t>(n)] - Vec2(0.3, 2);
      const Vec2 moved(0.02 - 0.1 * arm.y(), 0.01 + 0.1 * arm.x());
      const Vec2 u = run.result.state.u.segment<2>(2 * n);
      for (const int i : {0, 1}) {
        const bool follows = std::string(of).find(i == 0 ? "ux" : "uy") != std::string::npos;
        const double apart = std::abs(u[i] - moved[i]);
        if (!follows)
          other = other || apart > 1e-3;
        else
          EXPECT_LT(apart, 1e-13) << of;
      }
    }
    EXPECT_EQ(other, std::string(of) != "[ux, uy]");
  }
}

/// A force on a body that is free reaches the square, with its moment.
TEST(Couplings, ForcesOfTheBodyReachItsNodes) {
  const CoupledRun run(under_a_body("[ux, uy]",
                                    "{on: hub, uy: 0}], release: [{on: hub, of: [ux, rz]}], "
                                    "forces: [{on: hub, fx: 0.1, mz: 0.3}]"));
  double force = 0, moment = 0;
  for (const Index n : run.built.model.mesh.find_set("b.bottom")->nodes) {
    const Vec2 reaction = run.reaction.segment<2>(2 * n);
    const Vec2 arm = run.built.model.reference[static_cast<std::size_t>(n)] - Vec2(0.3, 2);
    force += reaction.x();
    moment += arm.x() * reaction.y() - arm.y() * reaction.x();
  }
  EXPECT_NEAR(force, -0.1, 1e-12);
  EXPECT_NEAR(moment, -0.3, 1e-12);
}

TEST(Couplings, WhatCannotFollowIsTold) {
  const std::string held = "{on: hub, ux: 0}]";
  EXPECT_EQ(refusal_of(under_a_body("[ux]", held)), "no error");
  EXPECT_THAT(refusal_of(under_a_body("[ux, uz]", held)), HasSubstr("has no displacement 'uz'"));
  EXPECT_THAT(refusal_of(under_a_body("[ux, ux]", held)), HasSubstr("'ux' is given twice"));
  EXPECT_THAT(refusal_of(under_a_body("[ux]", held, "finite")),
              HasSubstr("one of small rotations: not with sections of finite kinematics"));
}

}  // namespace
}  // namespace osculate::deck
