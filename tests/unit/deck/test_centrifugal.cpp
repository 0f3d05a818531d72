// Centrifugal forces at the places that bodies have come to.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "space_test.hpp"
#include "system_test.hpp"

namespace osculate::deck {
namespace {

/// A ring section of finite strain that turns about y, and a plane body of it about an axis askew.
std::string turning(const std::string& element, const std::string& axis,
                    const std::string& kinematics = "finite", const std::string& more = "") {
  const std::string law = kinematics == "small" ? "linear_elastic" : "st_venant_kirchhoff";
  return "osculate: 1\n"
         "mesh: {generate: {b: {box: {x: [1, 2], y: [0, 1], elements: [2, 2], type: quad8}}}}\n"
         "materials: {m: {" +
         law + ": {E: 100, nu: 0.3, density: 2}}}\n" +
         "sections: [{on: b, material: m, element: " + element + ", kinematics: " + kinematics +
         "}]\n" +
         "steps: [{name: one, increments: 1, prescribe: [{on: b.bottom, uy: 0}], centrifugal: [{"
         "on: b, speed_squared: 9, " +
         axis + more + "}]}]\n";
}
const std::string about_y = "from: [0, 0, 0], to: [0, 1, 0]",
                  askew = "from: [0.1, -0.2, 0.3], to: [1, 1, 0.5]";

/// Its derivative is that of the residual: of second order with finite strain.
TEST(Centrifugal, TangentIsTheDerivative) {
  for (const std::string& text : {turning("axisymmetric", about_y), turning("plane_stress", askew),
                                  turning("plane_strain", askew)}) {
    Probe probe(text, 0.05);
    const testing::DerivativeReport report = check_tangent_of(probe);
    EXPECT_NEAR(report.order, 2, 0.1) << report.error;
  }
}

/// Alone: linear, symmetric, none along the axis, -w^2 times the mass across it.
TEST(Centrifugal, SoftensByTheMassAcrossTheAxis) {
  Probe probe(turning("plane_stress", askew), 0.05);
  for (const model::Term term : {model::Term::bulk, model::Term::contact, model::Term::rigid})
    probe.system.enable(term, false);
  const Eigen::VectorXd d = probe.random(1.0);
  const auto moved = [&](double by) {
    return probe.at(probe.system.apply(probe.base, Eigen::VectorXd(by * d), probe.fraction, 1.0),
                    false);
  };
  const solve::Evaluation here = probe.at(probe.base, true);
  const la::SparseMatrix matrix = probe.system.matrix();
  Eigen::MatrixXd k(matrix.n, matrix.n);
  for (Index u = 0; u < matrix.n; ++u)
    k.col(u) = la::multiply(matrix, Eigen::VectorXd(Eigen::VectorXd::Unit(matrix.n, u)));
  Eigen::VectorXd kd = k * d;
  for (Index u = 0; u < matrix.n; ++u)
    if (probe.system.prescribed(u)) kd[u] = 0;
  EXPECT_LT((moved(1).residual - here.residual - kd).norm(), 1e-12 * kd.norm());
  EXPECT_LT((k - k.transpose()).norm(), 1e-14 * k.norm());
  double of_all = 0;  // force of a motion of the whole along x, where nothing is held
  for (Index u = 0; u < matrix.n; ++u)
    for (Index v = 0; v < matrix.n; ++v)
      if (probe.system.dofs().dof_of_unknown(u) % 2 == 0 &&
          probe.system.dofs().dof_of_unknown(v) % 2 == 0)
        of_all += k(u, v);
  const Vec3 axis = Vec3(0.9, 1.2, 0.2).normalized();
  const double mass = 2, half_of_speed_squared = 4.5;
  EXPECT_NEAR(of_all, -half_of_speed_squared * mass * (1 - axis.x() * axis.x()), 1e-12);
}

Eigen::VectorXd moved_by(const std::string& text) {
  const Built built = build_text(text);
  const model::AnalysisResult result = model::run(built.model, built.options, {});
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  return result.state.u;
}

/// Bodies of small strain feel them at the undeformed places, unless the load says otherwise.
TEST(Centrifugal, PlacesAreThoseOfTheStrains) {
  const auto u = [](const std::string& kinematics, const std::string& more) {
    return moved_by(turning("axisymmetric", about_y, kinematics, more));
  };
  const std::string here = ", places: deformed", first = ", places: undeformed";
  const Eigen::VectorXd small = u("small", ""), finite = u("finite", "");
  EXPECT_EQ((small - u("small", first)).norm(), 0);
  EXPECT_EQ((finite - u("finite", here)).norm(), 0);
  EXPECT_GT(u("small", here).norm(), 1.1 * small.norm());
  EXPECT_GT(finite.norm(), 1.05 * u("finite", first).norm());
}

/// A load that a later step gives other places goes there from where it is.
TEST(Centrifugal, PlacesMayChangeBetweenSteps) {
  const std::string text = turning("axisymmetric", about_y, "small", ", places: undeformed");
  const std::string after = edited(
      text, "}]}]\n",
      "}]}, {name: two, increments: 1, centrifugal: [{on: b, speed_squared: 9, places: deformed, " +
          about_y + "}]}]\n");
  const Eigen::VectorXd u = moved_by(after);
  const Eigen::VectorXd at_once =
      moved_by(turning("axisymmetric", about_y, "small", ", places: deformed"));
  EXPECT_LT((u - at_once).norm(), 1e-10 * u.norm());
}

/// A body of small strain that turns about its own axis, which softens what moves across it.
model::Vibrations vibrations(const std::string& places, const std::string& about = "last") {
  const Built built = build_text(
      "osculate: 1\n"
      "mesh: {generate: {b: {box: {x: [0, 1], y: [-0.01, 0.01], elements: [9, 1], type: quad8}}}}\n"
      "materials: {m: {linear_elastic: {E: 100, nu: 0, density: 1}}}\n"
      "sections: [{on: b, material: m, element: plane_stress}]\n"
      "steps:\n"
      "  - {name: turn, increments: 1, prescribe: [{on: b, ux: 0}, {on: b.left, uy: 0}], "
      "centrifugal: [{on: b, speed_squared: 50, from: [0, 0], to: [1, 0], places: " +
      places + "}]}\n  - {name: modes, modes: {count: 2, about: " + about + "}}\n");
  const model::AnalysisResult result = model::run(built.model, built.options, {});
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  return result.steps.back().vibrations.value();
}
TEST(Centrifugal, SoftensVibrationsAboutAState) {
  const Eigen::VectorXd still = vibrations("automatic", "start").omega_squared;
  for (const char* const places : {"automatic", "deformed"})
    for (int n = 0; n < 2; ++n)
      EXPECT_NEAR(vibrations(places).omega_squared[n], still[n] - 50, 1e-4 * 50) << places;
  EXPECT_NEAR(vibrations("undeformed").omega_squared[0], still[0], 1e-4 * 50);
}

/// A column under a force that turns about its own axis: K - w^2 M - f G is singular, where that
/// softening counts, for the rotation before and the factor of the force, and for the same rotation
/// as a part of the loads that the factor multiplies.
double buckling_factor(const std::string& places, double speed_squared, double added) {
  const auto turn = [&](double size) {
    return fmt::format(
        "centrifugal: [{{on: b, speed_squared: {}, from: [0, 0], to: [1, 0], places: {}}}]", size,
        places);
  };
  const Built built = build_text(
      "osculate: 1\n"
      "mesh: {generate: {b: {box: {x: [0, 1], y: [-0.01, 0.01], elements: [20, 1], type: "
      "quad8}}}}\n"
      "materials: {m: {linear_elastic: {E: 1e5, nu: 0, density: 1}}}\n"
      "sections: [{on: b, material: m, element: plane_stress}]\n"
      "steps:\n"
      "  - {name: turn, increments: 1, prescribe: [{on: b.left, ux: 0, uy: 0}], " +
      turn(speed_squared) +
      "}\n"
      "  - {name: buckle, buckling: 1, total_force: [{on: b.right, fx: -1}], " +
      turn(added) + "}\n");
  const model::AnalysisResult result = model::run(built.model, built.options, {});
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  return result.steps.back().buckling.value().factors[0];
}
TEST(Centrifugal, SoftensBucklingWhereBodiesOfSmallStrainFeelIt) {
  const double none = buckling_factor("undeformed", 10, 0);
  EXPECT_NEAR(buckling_factor("automatic", 10, 0), none, 1e-12 * none);
  EXPECT_LT(buckling_factor("deformed", 10, 0), 0.9 * none);
  const double growing = buckling_factor("deformed", 0, 100);
  EXPECT_LT(growing, 0.9 * none);
  EXPECT_NEAR(buckling_factor("deformed", 100 * growing, 0), growing, 1e-3 * none);
}

/// Explicit steps take them where bodies are, too.
TEST(Centrifugal, GrowsInExplicitSteps) {
  const auto end = [](const std::string& scheme, const std::string& places) {
    return moved_by(
        "osculate: 1\n"
        "mesh: {generate: {b: {box: {x: [0, 1], y: [0, 0.2], elements: [5, 1]}}}}\n"
        "materials: {m: {st_venant_kirchhoff: {E: 100, nu: 0, density: 1}}}\n"
        "sections: [{on: b, material: m, element: plane_stress, kinematics: finite}]\n"
        "amplitudes: {at_once: [[0, 1], [1, 1]]}\n"
        "steps: [{name: turn, increments: 200, duration: 0.2, dynamics: {" +
        scheme +
        "mass: lumped}, prescribe: [{on: b, uy: 0}, {on: b.left, ux: 0}], centrifugal: [{on: b, "
        "speed_squared: 60, from: [0, 0], to: [0, 1], amplitude: at_once, places: " +
        places + "}]}]\n");
  };
  const std::string is_explicit = "scheme: central_differences, ";
  const Eigen::VectorXd u = end("", "automatic");
  EXPECT_LT((end(is_explicit, "automatic") - u).norm(), 1e-3 * u.norm());
  EXPECT_GT((end(is_explicit, "undeformed") - u).norm(), 0.1 * u.norm());
}

TEST(Centrifugal, ActsOnMasses) {
  const std::string model =
      "osculate: 1\n"
      "mesh: {generate: {b: {box: {x: [0, 1], y: [0, 1], z: [0, 1], elements: [1, 1, 1]}}}}\n"
      "materials: {m: {linear_elastic: {E: 1, nu: 0}}}\n"
      "sections: [{on: b, material: m, element: solid}]\n"
      "masses: [{on: b.top_back_right, mass: 3}]\n"
      "steps: [{name: one, increments: 1, prescribe: [{on: b.bottom, ux: 0, uy: 0, uz: 0}], "
      "centrifugal: [{on: b.top_back_right, speed_squared: 5}]}]\n";
  const Built3 built = built_from(model);
  const model::CentrifugalLoad& load = built.model.steps[0].centrifugal.at(0);
  ASSERT_EQ(load.cells->size(), 1U);
  EXPECT_FALSE(load.cells->front().moves);
  model::BulkBlock3 block;
  model::centrifugal_block(built.model, load, load.cells->front(), nullptr, block);
  EXPECT_LT((block.result.force - Vec3(3, 3, 0)).norm(), 1e-15);
  expect_refusals(model, {{"on: b.top_back_right, speed", "on: b.top_front_right, speed",
                           "model.yaml:6: steps[0].centrifugal[0].on: set 'b.top_front_right' has "
                           "neither bulk cells with a section nor `masses`"}});
}

}  // namespace
}  // namespace osculate::deck
