// The assembled system of cells and loads: patch tests, tangents, balance, large rotations.
#include <Eigen/Geometry>
#include <numbers>

#include "block.hpp"
#include "osculate/model/fields.hpp"

namespace osculate::model {
namespace {

constexpr double young = 210, thickness = 0.7;

template <class Dimension>
class SystemOf : public ::testing::Test {};
TYPED_TEST_SUITE(SystemOf, Dimensions, DimensionNames);

/// A distorted block on frictionless supports on its sides at the origin, in the plane without
/// stress across it.
template <int Dim>
BasicModel<Dim> supported_block() {
  solid::Section<Dim> section = elastic<Dim>(young);
  if constexpr (Dim == 2) {
    section.assumption = solid::Assumption::plane_stress;
    section.thickness = thickness;
  }
  BasicModel<Dim> m = block<Dim>({{0, 0, 0}, {2, 1, 1.5}, {3, 2, 3}, 0.2}, section);
  for (int d = 0; d < Dim; ++d) prescribe(m, nodes_at(m, d, 0), d, 0);
  return m;
}

/// Stress upwards = `expected`, all other components zero, in every node; reactions in balance.
template <int Dim>
void expect_uniaxial(const BasicModel<Dim>& m, double expected) {
  const double area = Dim == 2 ? 2 * thickness : 2 * 1, small = 1e-11 * std::abs(expected);
  (void)run_to_end(m, [&](const Converged<Dim>& c) {
    const BasicNodalFields<Dim> f = nodal_fields(c.system, m, c.state);
    for (const auto& s : f.stress)
      for (std::size_t i = 0; i < s.size(); ++i)
        EXPECT_NEAR(s[i], i == up<Dim> ? expected : 0.0, small) << i;
    for (const double mises : f.mises) EXPECT_NEAR(mises, std::abs(expected), small);
    EXPECT_NEAR(c.of_nodes(nodes_of(m, "block.bottom"), with_axis("rf", up<Dim>)), -area * expected,
                small);
    EXPECT_LT(resultant(m, c.system.forces().internal).cwiseAbs().maxCoeff(),
              1e-12 * std::abs(expected));
  });
}

TYPED_TEST(SystemOf, PatchTestByPrescribedDisplacement) {
  constexpr int Dim = TypeParam::value;
  BasicModel<Dim> m = supported_block<Dim>();
  prescribe(m, nodes_of(m, "block.top"), up<Dim>, -0.03);
  expect_uniaxial(m, -young * 0.02);
}

TYPED_TEST(SystemOf, PatchTestByPressure) {
  constexpr int Dim = TypeParam::value;
  BasicModel<Dim> m = supported_block<Dim>();
  add_pressure(m, "block.top", 4.2);
  EXPECT_EQ(m.steps[0].pressure[0].facets.size(), Dim == 2 ? 3u : 6u);
  expect_uniaxial(m, -4.2);
}

TYPED_TEST(SystemOf, PatchTestByDeadLoadOfSideWeights) {
  constexpr int Dim = TypeParam::value;
  BasicModel<Dim> m = supported_block<Dim>();
  add_traction<Dim>(m, "block.top", 3.0 * Vec<Dim>::Unit(up<Dim>));
  expect_uniaxial(m, 3.0);
}

TYPED_TEST(SystemOf, CellWeightsAndJacobians) {
  constexpr int Dim = TypeParam::value;
  const BasicModel<Dim> m = supported_block<Dim>();
  double volume = 0;
  for (const mesh::CellRef& ref : m.sections[0].cells) {
    EXPECT_GT(smallest_jacobian(m, ref), 0);
    for (const double w : cell_weights(m, m.sections[0], ref)) volume += w;
  }
  EXPECT_NEAR(volume, Dim == 2 ? 3.0 * thickness : 3.0, 1e-14);
}

TYPED_TEST(SystemOf, PressureTractionAndBodyForceAreCarriedByTheSupport) {
  constexpr int Dim = TypeParam::value;
  for (const bool quadratic : {false, true}) {
    BasicModel<Dim> m =
        block<Dim>({{0, 0, 0}, {2, 1, 3}, {2, 1, 3}, 0, quadratic}, elastic<Dim>(100));
    hold(m, "block.bottom");
    add_pressure(m, "block.top", 5);
    const Vec<Dim> traction = either<Dim>(Vec3(1, 2, 3)), force = either<Dim>(Vec3(0.1, 0.2, -0.3));
    add_traction<Dim>(m, "block.left", traction);
    DeadLoad load;
    load.ramp = {0, 1, {}};
    for (const mesh::CellRef& ref : m.sections[0].cells) {
      const std::vector<double> weights = cell_weights(m, m.sections[0], ref);
      for (std::size_t k = 0; k < weights.size(); ++k)
        for (int d = 0; d < Dim; ++d)
          load.unit.emplace_back(Dim * cell_nodes(m.mesh, ref).nodes[k] + d, weights[k] * force[d]);
    }
    m.steps[0].dead.push_back(load);
    const Vec<Dim> all = 3 * traction + 6 * force - 2 * 5 * Vec<Dim>::Unit(up<Dim>);
    (void)run_to_end(m, [&](const Converged<Dim>& c) {
      for (int d = 0; d < Dim; ++d)
        EXPECT_NEAR(c.of_nodes(nodes_of(m, "block.bottom"), with_axis("rf", d)), -all[d], 1e-9);
    });
  }
}

// ---- tangent and prediction ---------------------------------------------------------------------

/// A block that is held at its bottom and whose top is glued to a rigid body.
template <int Dim>
BasicModel<Dim> block_with_tool(const solid::Section<Dim>& section) {
  BasicModel<Dim> m = block<Dim>({{0, 0, 0}, {2, 1, 1.5}, {2, 2, 2}, 0.2}, section);
  add_rigid<Dim>(m, either<Dim>(Vec3(0.7, 0.4, 2)), nodes_of(m, "block.top"));
  hold(m, "block.bottom");
  return m;
}

template <int Dim>
void add_tool_load(BasicModel<Dim>& m) {
  load_body(m, either<Dim>({3, -5, 8}, {3, -2, -5, 6, -4, 8}), 2);
}

TYPED_TEST(SystemOf, TangentIsTheDerivativeOfTheResidual) {
  constexpr int Dim = TypeParam::value;
  for (const solid::Section<Dim>& section : {elastic<Dim>(young), rubber<Dim>(young)})
    for (const bool turned : {false, true}) {
      SCOPED_TRACE(turned);
      BasicModel<Dim> m = block_with_tool<Dim>(section);
      add_tool_load(m);
      add_pressure(m, "block.top", 30);
      if (turned) drive_body(m, either<Dim>({0.4}, {0.4, 0.4}), Dim);
      Probe<Dim> probe(m, 0.02);
      EXPECT_EQ(probe.system.symmetry(), la::Symmetry::unsymmetric);
      EXPECT_EQ(probe.system.dofs().unknowns(), Dim == 2 ? 2 * 6 + 3 : 3 * 18 + 6);
      expect_second_order(probe);
    }
}

TYPED_TEST(SystemOf, TangentWithEquations) {
  constexpr int Dim = TypeParam::value;
  BasicModel<Dim> m = block_with_tool<Dim>(rubber<Dim>(young));
  add_tool_load(m);
  const Index a = node_at(m, {2, 0, 0.75}), b = node_at(m, {1, 0, 0.75}),
              c = node_at(m, {0, 0, 0.75});
  const Dof turned = body_dof(m, 0, Dim == 2 ? 2 : 4);
  m.equations.push_back({{{Dim * a, 2.0}, {Dim * b + 1, -1.0}, {turned, 0.5}}, 0.02});
  m.equations.push_back({{{Dim * c + up<Dim>, 1.0}, {Dim * b + up<Dim>, -1.0}}, 0});
  Probe<Dim> probe(m, 0.02);
  expect_second_order(probe);
}

TYPED_TEST(SystemOf, PredictsToFirstOrder) {
  constexpr int Dim = TypeParam::value;
  BasicModel<Dim> m = block_with_tool<Dim>(rubber<Dim>(young));
  drive_body(m, either<Dim>({0.1, 0.08, 0.25}, {0.1, -0.05, 0.08, 0.2, -0.3, 0.25}));
  Probe<Dim> probe(m, 0);
  expect_first_order_prediction(probe, probe.base.state, 0.5);
}

// ---- balance ------------------------------------------------------------------------------------

Vec<1> moment_of(const Vec2& arm, const Vec2& force) { return Vec<1>(turn(arm).dot(force)); }
Vec3 moment_of(const Vec3& arm, const Vec3& force) { return arm.cross(force); }

template <int Dim>
std::string_view rigid_quantity(int i) {
  if constexpr (Dim == 2)
    return rigid_quantities[static_cast<std::size_t>(i)];
  else
    return rigid_quantities3[static_cast<std::size_t>(i)];
}

TYPED_TEST(SystemOf, ReactionsOfARigidBodyAreForceAndMomentAtItsReference) {
  constexpr int Dim = TypeParam::value, motions = body::motions<Dim>;
  BasicModel<Dim> m = block_with_tool<Dim>(rubber<Dim>(young));
  const Numbers target = either<Dim>({0.1, 0.08, 0.9}, {0.1, -0.05, 0.08, 0.3, -0.4, 0.9});
  drive_body(m, target);
  m.steps[0].increments = 3;
  (void)run_to_end(m, [&](const Converged<Dim>& c) {
    Vec<motions> motion, reaction;
    for (int i = 0; i < motions; ++i) {
      motion[i] = c.of_body(std::string(rigid_quantity<Dim>(i)));
      reaction[i] = c.of_body(std::string(rigid_quantity<Dim>(motions + i)));
      EXPECT_NEAR(motion[i], target[static_cast<std::size_t>(i)], 1e-15);
    }
    const Vec<Dim> force = reaction.template head<Dim>();
    const Vec<motions - Dim> moment = reaction.template tail<motions - Dim>();
    EXPECT_GT(moment.norm(), 1.0);
    // Forces and moments about the origin balance with the reactions of the bottom.
    const std::vector<Vec<Dim>> x = c.system.positions(c.state);
    const Eigen::VectorXd r = reactions(c.system);
    Vec<Dim> other = force;
    Vec<motions - Dim> about = moment + moment_of(c.state.rigid[0].center(), force);
    for (const Index n : nodes_of(m, "block.bottom")) {
      other += r.segment<Dim>(Dim * n);
      about += moment_of(x[static_cast<std::size_t>(n)], r.segment<Dim>(Dim * n));
    }
    EXPECT_LT(other.norm(), 1e-8 * force.norm());
    EXPECT_LT(about.norm(), 1e-8 * moment.norm());
  });
}

/// A moment about a fixed axis turns the tool until the block answers with just that moment.
TYPED_TEST(SystemOf, AMomentLoadIsAMomentAboutAFixedAxis) {
  constexpr int Dim = TypeParam::value, rotations = body::rotations<Dim>;
  BasicModel<Dim> m = block_with_tool<Dim>(rubber<Dim>(young));
  add_tool_load(m);
  m.steps[0].increments = 4;
  const auto& load = m.steps[0].dead[0];
  Vec<Dim + rotations> given;
  for (int i = 0; i < Dim + rotations; ++i)
    given[i] = 2 * load.unit[static_cast<std::size_t>(i)].second;
  (void)run_to_end(m, [&](const Converged<Dim>& c) {
    EXPECT_GT(body::total_rotation(c.state.rigid[0]).norm(), 0.05);
    const std::vector<Vec<Dim>> x = c.system.positions(c.state);
    Vec<Dim> force = Vec<Dim>::Zero();
    Vec<rotations> moment = Vec<rotations>::Zero();
    for (const Index n : m.rigid[0].nodes) {
      const Vec<Dim> f = c.system.forces().internal.template segment<Dim>(Dim * n);
      force += f;
      moment += moment_of(x[static_cast<std::size_t>(n)] - c.state.rigid[0].center(), f);
    }
    EXPECT_LT((force - given.template head<Dim>()).norm(), 1e-7 * force.norm());
    EXPECT_LT((moment - given.template tail<rotations>()).norm(), 1e-7 * moment.norm());
    EXPECT_NEAR(c.of_body("rmz"), 0.0, 1e-7 * moment.norm());
  });
}

/// The resultant of a pressure depends on the border of the current side alone.
TYPED_TEST(SystemOf, FollowerPressureTurnsWithItsSide) {
  constexpr int Dim = TypeParam::value;
  BasicModel<Dim> m = block<Dim>({{0, 0, 0}, {2, 1, 1}, {4, 2, 2}}, rubber<Dim>(100));
  hold(m, "block.bottom");
  add_pressure(m, "block.right", 7);
  Probe<Dim> probe(m, 0.1);
  (void)probe.at(probe.base, false);
  const std::vector<Vec<Dim>> x = probe.system.positions(probe.base.state);
  Vec<Dim> area = Vec<Dim>::Zero();  // of polygons: what two have in common drops out of the sum
  for (const PressureLoad::Facet& facet : m.steps[0].pressure[0].facets) {
    const auto corner = [&](std::size_t k) {
      return x[static_cast<std::size_t>(facet.nodes[k % facet.nodes.size()])];
    };
    if constexpr (Dim == 2)
      area += turn(corner(1) - corner(0));
    else
      for (std::size_t k = 0; k < 4; ++k) area += 0.5 * corner(k).cross(corner(k + 1));
  }
  const Vec<Dim> force = resultant(m, probe.system.forces().external);
  EXPECT_GT(area.norm(), 0.9);
  EXPECT_LT((force + 3.5 * area).norm(), 1e-13);  // half of the step: p = 3.5
}

TEST(System, AxisymmetricPressureActsOnTheWholeRing) {
  solid::Section<2> section = elastic<2>(100);
  section.assumption = solid::Assumption::axisymmetric;
  Model m = block<2>({{1, 0, 0}, {2, 0, 1}, {3, 1, 2}}, section);
  prescribe(m, nodes_of(m, "block.bottom"), 1, 0);
  add_pressure(m, "block.top", 2);
  (void)run_to_end(m, [&](const Converged<2>& c) {
    EXPECT_NEAR(c.of_nodes(nodes_of(m, "block.bottom"), "rfy"), 2 * std::numbers::pi * (4 - 1),
                1e-10);
  });
}

TYPED_TEST(SystemOf, EquationsHoldAndDoNoWork) {
  constexpr int Dim = TypeParam::value;
  solid::Section<Dim> section = elastic<Dim>(100);
  if constexpr (Dim == 2) section.assumption = solid::Assumption::plane_stress;
  BasicModel<Dim> m = block<Dim>({{0, 0, 0}, {2, 1, 1}, {4, 2, 2}}, section);
  const Index first = node_at(m, {0, 0, 1});
  const Dof a = Dim * node_at(m, {2, 0, 1}), b = Dim * node_at(m, {2, 0, 0}) + up<Dim>;
  m.equations.push_back({{{a, 1.0}, {b, -2.0}}, 0.1});
  const std::vector<Index>& top = nodes_of(m, "block.top");
  for (const Index n : top)
    if (n != first)
      m.equations.push_back({{{Dim * n + up<Dim>, 1.0}, {Dim * first + up<Dim>, -1.0}}, 0});
  for (int d = 0; d < up<Dim>; ++d) prescribe(m, nodes_at(m, d, 0), d, 0);
  prescribe(m, {node_at(m, {0, 0, 0})}, up<Dim>, 0);
  m.steps[0].dead.push_back({{{Dim * first + up<Dim>, 1.0}}, {0, 3, {}}});
  m.steps[0].increments = 2;
  m.steps[0].equation_start = 0;
  (void)run_to_end(m, [&](const Converged<Dim>& c) {
    EXPECT_NEAR(c.state.u[a] - 2 * c.state.u[b], 0.1, 1e-15);
    const Eigen::VectorXd r = reactions(c.system);
    EXPECT_GT(std::abs(r[a]), 0.1);
    EXPECT_NEAR(r[b], -2 * r[a], 1e-9);
    double sum = 0;
    for (const Index n : top) {
      EXPECT_NEAR(c.state.u[Dim * n + up<Dim>], c.state.u[Dim * first + up<Dim>], 1e-15);
      sum += r[Dim * n + up<Dim>];
    }
    EXPECT_NEAR(sum, 0, 1e-9);
  });
}

// ---- large motions, the same bits ---------------------------------------------------------------

/// A body that is moved without resistance: all forces are round-off.
TYPED_TEST(SystemOf, ABodyCarriedAlongConverges) {
  constexpr int Dim = TypeParam::value;
  const Vec<Dim> way = either<Dim>(Vec3(10, -2, 3));
  for (const solid::Section<Dim>& section : {elastic<Dim>(2.1e5), rubber<Dim>(2.1e5)}) {
    BasicModel<Dim> m = block<Dim>({{0, 0, 0}, {2, 1, 1}, {4, 2, 2}}, section);
    for (int d = 0; d < Dim; ++d) prescribe(m, nodes_of(m, "block.left"), d, way[d]);
    m.steps[0].increments = 3;
    const BasicAnalysisResult<Dim> result = run_to_end(m, [&](const Converged<Dim>& c) {
      for (Index n = 0; n < static_cast<Index>(m.reference.size()); ++n)
        EXPECT_LT((c.state.u.template segment<Dim>(Dim * n) - way).norm(), 1e-11);
    });
    ASSERT_EQ(result.steps.size(), 1u);
    EXPECT_EQ(result.steps[0].increments.size(), 3u);
  }
}

/// A block glued to a turning body follows it, over more than a whole turn, without stress.
TYPED_TEST(SystemOf, FollowsARigidBodyThroughWholeTurns) {
  constexpr int Dim = TypeParam::value;
  BasicModel<Dim> m = block<Dim>({{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, rubber<Dim>(young));
  add_rigid<Dim>(m, either<Dim>(Vec3(0.5, 0.5, 2)), nodes_of(m, "block.top"));
  const double angle = 2.5 * 2 * std::numbers::pi;
  drive_body(m, either<Dim>({0, 0, angle}, {0, 0, 0, 0.48 * angle, -0.6 * angle, 0.64 * angle}));
  m.steps[0].increments = 24;
  BasicAnalysisObserver<Dim> observer;
  observer.converged = [&](BasicSystem<Dim>& system, const BasicState<Dim>& state, const Progress&,
                           const solve::IncrementRecord*) {
    const std::vector<Vec<Dim>> x = system.positions(state);
    for (std::size_t n = 0; n < x.size(); ++n)
      EXPECT_LT((x[n] - state.rigid[0].position(m.reference[n])).norm(), 1e-8);
    return true;
  };
  const BasicAnalysisResult<Dim> result = run(m, {}, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
}

TYPED_TEST(SystemOf, ThreadsGiveTheSameBits) {
  constexpr int Dim = TypeParam::value;
  BasicModel<Dim> m =
      block<Dim>({{0, 0, 0}, {1, 1, 1}, {Dim == 2 ? 49 : 7, 7, 7}, 0.2}, rubber<Dim>(young));
  std::array<std::vector<double>, 2> values;
  std::array<Eigen::VectorXd, 2> residuals;
  for (std::size_t i = 0; i < 2; ++i) {
    BasicSystem<Dim> system(m, i == 0 ? 1 : 3);
    BasicState<Dim> state = system.initial_state();
    system.begin_step(m.steps[0], state);
    state.u = 0.01 * Eigen::VectorXd::LinSpaced(state.u.size(), -1, 1).array().sin();
    solve::Evaluation e;
    system.evaluate(state, 0.5, true, e);
    ASSERT_TRUE(e.ok) << e.message;
    values[i] = system.matrix().value;
    residuals[i] = e.residual;
  }
  EXPECT_EQ(values[0], values[1]);
  EXPECT_EQ(residuals[0], residuals[1]);
}

}  // namespace
}  // namespace osculate::model
