// The assembled system in space: patch tests, tangents by order, balance, large rotations.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "block3.hpp"
#include "osculate/model/fields.hpp"
#include "osculate/model/quantities.hpp"

namespace osculate::model {
namespace {

constexpr double young = 210, poisson = 0.3;

solid::VolumeSection elastic() {
  return {solid::Kinematics::small, solid::VolumeFormulation::full,
          material::LinearElastic{young, poisson}};
}
solid::VolumeSection rubber() {
  return {solid::Kinematics::finite, solid::VolumeFormulation::full,
          material::NeoHooke{young, poisson}};
}

bool at(double a, double b) { return std::abs(a - b) < 1e-9; }

/// A distorted block on frictionless supports on three sides.
Model3 supported_block(const solid::VolumeSection& section) {
  Model3 m;
  add_block(m, {{0, 0, 0}, {2, 1, 1.5}, {3, 2, 3}, 0.2, section});
  Step step;
  step.name = "s";
  for (int d = 0; d < 3; ++d)
    prescribe(step, nodes_where(m, [d](const Vec3& x) { return at(x[d], 0); }), d, 0);
  m.steps.push_back(step);
  return m;
}

double sum_of(const System3& system, const Model3& m, const State3& state,
              const std::vector<Index>& nodes, const std::string& quantity) {
  return history_value(system, m, state, {"", HistoryRequest::Kind::nodes, -1, nodes, quantity});
}

/// Stress zz = `expected`, all other components zero, in every node; reactions in balance.
void expect_uniaxial(const Model3& m, double expected) {
  AnalysisObserver3 observer;
  int seen = 0;
  observer.converged = [&](System3& system, const State3& state, const Progress&,
                           const solve::IncrementRecord* record) {
    if (!record) return true;
    ++seen;
    const NodalFields3 f = nodal_fields(system, m, state);
    for (const auto& s : f.stress)
      for (std::size_t i = 0; i < 6; ++i)
        EXPECT_NEAR(s[i], i == 2 ? expected : 0.0, 1e-11 * std::abs(expected)) << i;
    for (const double mises : f.mises)
      EXPECT_NEAR(mises, std::abs(expected), 1e-11 * std::abs(expected));
    const std::vector<Index> bottom = nodes_where(m, [](const Vec3& x) { return at(x.z(), 0); });
    EXPECT_NEAR(sum_of(system, m, state, bottom, "rfz"), -2 * 1 * expected,
                1e-11 * std::abs(expected));
    const Forces& forces = system.forces();
    for (int d = 0; d < 3; ++d) {
      double internal = 0;
      for (Index n = 0; n < system.dofs().nodes(); ++n) internal += forces.internal[3 * n + d];
      EXPECT_NEAR(internal, 0.0, 1e-12 * std::abs(expected));
    }
    return true;
  };
  const AnalysisResult3 result = run(m, {}, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  EXPECT_EQ(seen, 1);
}

TEST(System3, PatchTestByPrescribedDisplacement) {
  Model3 m = supported_block(elastic());
  prescribe(m.steps[0], nodes_where(m, [](const Vec3& x) { return at(x.z(), 1.5); }), 2, -0.03);
  expect_uniaxial(m, -young * 0.02);
}

TEST(System3, PatchTestByPressure) {
  Model3 m = supported_block(elastic());
  PressureLoad load;
  load.ramp = {0, 4.2, {}};
  for (const std::vector<Index>& face : top_faces(m, 1.5))
    load.facets.push_back({0, face, cell::CellType::quad4});
  EXPECT_EQ(load.facets.size(), 6u);
  m.steps[0].pressure.push_back(load);
  expect_uniaxial(m, -4.2);
}

TEST(System3, PatchTestByDeadLoadOfFaceWeights) {
  Model3 m = supported_block(elastic());
  DeadLoad load;
  load.ramp = {0, 3.0, {}};
  for (const std::vector<Index>& face : top_faces(m, 1.5)) {
    const std::vector<double> weights = face_weights(m, cell::CellType::quad4, face);
    for (std::size_t k = 0; k < 4; ++k) load.unit.emplace_back(3 * face[k] + 2, weights[k]);
  }
  m.steps[0].dead.push_back(load);
  expect_uniaxial(m, 3.0);
}

TEST(System3, CellWeightsAndJacobians) {
  const Model3 m = supported_block(elastic());
  double volume = 0;
  for (const mesh::CellRef& ref : m.sections[0].cells) {
    EXPECT_GT(smallest_jacobian(m, ref), 0);
    for (const double w : cell_weights(m, m.sections[0], ref)) volume += w;
  }
  EXPECT_NEAR(volume, 3.0, 1e-14);
}

/// A block whose top face is glued to a rigid body, with a load on it.
Model3 block_with_tool(const solid::VolumeSection& section) {
  Model3 m;
  add_block(m, {{0, 0, 0}, {2, 1, 1.5}, {2, 2, 2}, 0.2, section});
  add_rigid(m, {0.7, 0.4, 2}, nodes_where(m, [](const Vec3& x) { return at(x.z(), 1.5); }));
  Step step;
  step.name = "s";
  const std::vector<Index> bottom = nodes_where(m, [](const Vec3& x) { return at(x.z(), 0); });
  for (int d = 0; d < 3; ++d) prescribe(step, bottom, d, 0);
  m.steps.push_back(step);
  return m;
}

void add_tool_load(Model3& m) {
  DeadLoad load;
  load.ramp = {0, 2, {}};
  const std::array<double, 6> unit{3, -2, -5, 6, -4, 8};
  for (int i = 0; i < 6; ++i)
    load.unit.emplace_back(body_dof(m, 0, i), unit[static_cast<std::size_t>(i)]);
  m.steps[0].dead.push_back(load);
}

TEST(System3, TangentIsTheDerivativeOfTheResidual) {
  for (const solid::VolumeSection& section : {elastic(), rubber()})
    for (const bool turned : {false, true}) {
      Model3 m = block_with_tool(section);
      add_tool_load(m);
      PressureLoad load;
      load.ramp = {0, 30, {}};
      for (const std::vector<Index>& face : top_faces(m, 1.5))
        load.facets.push_back({0, face, cell::CellType::quad4});
      m.steps[0].pressure.push_back(load);
      if (turned)
        for (int i = 3; i < 5; ++i)
          m.steps[0].prescribed.push_back({body_dof(m, 0, i), {0, 0.4, {}}, false});
      Probe3 probe(m, 0.02);
      EXPECT_EQ(probe.system.symmetry(), la::Symmetry::unsymmetric);
      EXPECT_EQ(probe.system.dofs().unknowns(), 3 * 18 + 6);
      const testing::DerivativeReport report = check_tangent(probe);
      EXPECT_TRUE(report.exact || std::abs(report.order - 2.0) < 0.1)
          << "order " << report.order << ", error " << report.error << ", turned " << turned;
    }
}

TEST(System3, TangentWithEquations) {
  Model3 m = block_with_tool(rubber());
  add_tool_load(m);
  const std::vector<Index> side =
      nodes_where(m, [](const Vec3& x) { return at(x.x(), 2) && at(x.z(), 0.75); });
  ASSERT_EQ(side.size(), 3u);
  m.equations.push_back(
      {{{3 * side[0], 2.0}, {3 * side[1] + 1, -1.0}, {body_dof(m, 0, 4), 0.5}}, 0.02});
  m.equations.push_back({{{3 * side[2] + 2, 1.0}, {3 * side[1] + 2, -1.0}}, 0});
  Probe3 probe(m, 0.02);
  const testing::DerivativeReport report = check_tangent(probe);
  EXPECT_NEAR(report.order, 2.0, 0.1) << report.error;
}

/// The prediction is residual + K du_prescribed: what is left over is of second order.
TEST(System3, PredictsToFirstOrder) {
  Model3 m = block_with_tool(rubber());
  const std::array<double, 6> target{0.1, -0.05, 0.08, 0.2, -0.3, 0.25};
  for (int i = 0; i < 6; ++i)
    m.steps[0].prescribed.push_back(
        {body_dof(m, 0, i), {0, target[static_cast<std::size_t>(i)], {}}, false});
  System3 system(m, 1);
  State3 start = system.initial_state();
  system.begin_step(m.steps[0], start);
  start = system.apply(start, Eigen::VectorXd::Zero(system.dofs().unknowns()), 0.5, 1.0);
  std::array<double, 2> rest{};
  for (std::size_t i = 0; i < 2; ++i) {
    const double fraction = 0.5 + (i == 0 ? 2e-3 : 1e-3);
    solve::Evaluation predicted, moved;
    system.predict(start, fraction, predicted);
    system.evaluate(
        start, system.apply(start, Eigen::VectorXd::Zero(system.dofs().unknowns()), fraction, 1.0),
        fraction, false, moved);
    rest[i] = (predicted.residual - moved.residual).norm();
  }
  EXPECT_NEAR(std::log2(rest[0] / rest[1]), 2.0, 0.05) << rest[0] << " " << rest[1];
}

TEST(System3, ReactionsOfARigidBodyAreForceAndMomentAtItsReference) {
  Model3 m = block_with_tool(rubber());
  const std::array<double, 6> target{0.1, -0.05, 0.08, 0.3, -0.4, 0.9};
  for (int i = 0; i < 6; ++i)
    m.steps[0].prescribed.push_back(
        {body_dof(m, 0, i), {0, target[static_cast<std::size_t>(i)], {}}, false});
  m.steps[0].increments = 3;
  bool seen = false;
  AnalysisObserver3 observer;
  observer.converged = [&](System3& system, const State3& state, const Progress& progress,
                           const solve::IncrementRecord* record) {
    if (!record || progress.fraction < 1) return true;
    seen = true;
    const auto value = [&](const std::string& quantity) {
      return history_value(system, m, state, {"", HistoryRequest::Kind::rigid, 0, {}, quantity});
    };
    EXPECT_NEAR(value("ry"), -0.4, 1e-14);
    EXPECT_NEAR(value("uz"), 0.08, 1e-15);
    const Vec3 force(value("rfx"), value("rfy"), value("rfz"));
    const Vec3 moment(value("rmx"), value("rmy"), value("rmz"));
    EXPECT_GT(moment.norm(), 1.0);
    // Forces and moments about the origin balance with the reactions of the bottom.
    const std::vector<Vec3> x = system.positions(state);
    const Eigen::VectorXd r = reactions(system);
    Vec3 other = Vec3::Zero(), about = Vec3::Zero();
    for (const Index n : nodes_where(m, [](const Vec3& p) { return at(p.z(), 0); })) {
      other += r.segment<3>(3 * n);
      about += x[static_cast<std::size_t>(n)].cross(Vec3(r.segment<3>(3 * n)));
    }
    EXPECT_LT((force + other).norm(), 1e-8 * force.norm());
    EXPECT_LT((moment + state.rigid[0].center().cross(force) + about).norm(), 1e-8 * moment.norm());
    return true;
  };
  const AnalysisResult3 result = run(m, {}, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  EXPECT_TRUE(seen);
}

/// A moment about a fixed axis turns the tool until the block answers with just that moment.
TEST(System3, AMomentLoadIsAMomentInSpace) {
  Model3 m = block_with_tool(rubber());
  add_tool_load(m);
  m.steps[0].increments = 4;
  bool seen = false;
  AnalysisObserver3 observer;
  observer.converged = [&](System3& system, const State3& state, const Progress& progress,
                           const solve::IncrementRecord* record) {
    if (!record || progress.fraction < 1) return true;
    seen = true;
    EXPECT_GT(state.rigid[0].rotation.norm(), 0.05);
    const std::vector<Vec3> x = system.positions(state);
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (const Index n : m.rigid[0].nodes) {
      const Vec3 f = system.forces().internal.segment<3>(3 * n);
      force += f;
      moment += (x[static_cast<std::size_t>(n)] - state.rigid[0].center()).cross(f);
    }
    EXPECT_LT((force - 2 * Vec3(3, -2, -5)).norm(), 1e-7 * force.norm());
    EXPECT_LT((moment - 2 * Vec3(6, -4, 8)).norm(), 1e-7 * moment.norm());
    EXPECT_NEAR(history_value(system, m, state, {"", HistoryRequest::Kind::rigid, 0, {}, "rmz"}),
                0.0, 1e-7 * moment.norm());
    return true;
  };
  const AnalysisResult3 result = run(m, {}, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  EXPECT_TRUE(seen);
}

/// A block glued to a turning body follows it, over more than a whole turn, without stress.
TEST(System3, FollowsARigidBodyThroughWholeTurns) {
  Model3 m;
  add_block(m, {{0, 0, 0}, {1, 1, 1}, {1, 1, 1}, 0, rubber()});
  add_rigid(m, {0.5, 0.5, 2}, nodes_where(m, [](const Vec3& x) { return at(x.z(), 1); }));
  Step step;
  step.name = "turn";
  step.increments = 24;
  const Vec3 axis(0.48, -0.6, 0.64);
  const double angle = 2.5 * 2 * std::numbers::pi;
  for (int i = 0; i < 6; ++i)
    step.prescribed.push_back(
        {body_dof(m, 0, i), {0, i < 3 ? 0.0 : angle * axis[i - 3], {}}, false});
  m.steps.push_back(step);
  AnalysisObserver3 observer;
  observer.converged = [&](System3& system, const State3& state, const Progress&,
                           const solve::IncrementRecord*) {
    const std::vector<Vec3> x = system.positions(state);
    for (std::size_t n = 0; n < x.size(); ++n)
      EXPECT_LT((x[n] - state.rigid[0].position(m.reference[n])).norm(), 1e-8);
    return true;
  };
  const AnalysisResult3 result = run(m, {}, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
}

TEST(System3, ThreadsGiveTheSameBits) {
  Model3 m;
  add_block(m, {{0, 0, 0}, {1, 1, 1}, {7, 7, 7}, 0.2, rubber()});
  m.steps.emplace_back();
  std::array<std::vector<double>, 2> values;
  std::array<Eigen::VectorXd, 2> residuals;
  for (std::size_t i = 0; i < 2; ++i) {
    System3 system(m, i == 0 ? 1 : 3);
    State3 state = system.initial_state();
    system.begin_step(m.steps[0], state);
    state.u = 0.01 * Eigen::VectorXd::LinSpaced(state.u.size(), -1, 1).array().sin();
    solve::Evaluation e;
    system.evaluate(state, state, 0.5, true, e);
    ASSERT_TRUE(e.ok) << e.message;
    values[i] = system.matrix().value;
    residuals[i] = e.residual;
  }
  EXPECT_EQ(values[0], values[1]);
  EXPECT_EQ(residuals[0], residuals[1]);
}

}  // namespace
}  // namespace osculate::model
