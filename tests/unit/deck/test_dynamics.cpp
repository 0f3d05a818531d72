// Steps with inertia: keys, tangents, energies.
#include <gmock/gmock.h>

#include "space_test.hpp"
#include "system_test.hpp"

namespace osculate::deck {
namespace {

const char* const schemes[] = {"newmark", "{hht: {alpha: 0.1}}",
                               "{generalized_alpha: {radius: 0.6}}"};
const char* const impacts[] = {"dissipative", "average", "plastic"};

std::string thrown(const std::string& scheme, const std::string& impact) {
  return edited(edited(test_file("dynamics.yaml"), "scheme: newmark", "scheme: " + scheme),
                "impact: dissipative", "impact: " + impact);
}

std::string refusal_of(const std::string& from, const std::string& to) {
  try {
    (void)build_text(edited(test_file("dynamics.yaml"), from, to));
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(DynamicsKeys, BecomeTheModel) {
  const Built built = build_text(thrown(schemes[1], impacts[1]));
  const model::Step& step = built.model.steps.at(0);
  ASSERT_TRUE(step.dynamics.has_value());
  EXPECT_EQ(step.dynamics->scheme.alpha_f, 0.1);
  EXPECT_EQ(step.dynamics->scheme.impact, solve::Impact::average);
  EXPECT_EQ(step.dynamics->damping_mass, 0.3);
  EXPECT_EQ(step.dynamics->damping_stiffness, 1e-3);
  EXPECT_EQ(step.gravity.at(1).value(0), -9.81);
  EXPECT_EQ(built.model.rigid.at(0).mass, 2);
  EXPECT_NEAR(built.model.rigid.at(0).inertia(0, 0), 1, 1e-12);  // m r^2 / 2
  EXPECT_EQ(built.model.rigid.at(1).mass, 0);
  for (const model::PrescribedDof& p : step.prescribed)
    EXPECT_TRUE(p.dof < 2 * static_cast<Index>(built.model.reference.size()) ||
                p.dof >= 2 * static_cast<Index>(built.model.reference.size()) + 3);
}

TEST(DynamicsKeys, AreRefusedWithTheReason) {
  EXPECT_THAT(refusal_of("    duration: 0.1\n", ""), ::testing::HasSubstr("needs a duration"));
  EXPECT_THAT(refusal_of(", density: 0.5", ""),
              ::testing::HasSubstr("density of material 'rubber'"));
  EXPECT_THAT(refusal_of("radius: 1}, mass: 2", "radius: 1}, inertia: 2"),
              ::testing::HasSubstr("goes with a mass"));
  EXPECT_THAT(refusal_of("normal: [0, 1]}}", "normal: [0, 1]}, mass: 1}"),
              ::testing::HasSubstr("inertia is missing"));
  EXPECT_THAT(refusal_of("[0.2, -9.81]", "[0.2, -9.81, 1]"), ::testing::HasSubstr("components"));
  EXPECT_THAT(refusal_of("wz: 2", "wx: 2"), ::testing::HasSubstr("space only"));
  EXPECT_THAT(refusal_of("{on: block, vx: 0.1}", "{on: block, wz: 0.1}"),
              ::testing::HasSubstr("needs a rigid body"));
  EXPECT_THAT(refusal_of("mass: 2}", "mass: 2, inertia: [1, 2, 3]}"),
              ::testing::HasSubstr("one moment of inertia"));
}

// The columns of the energies can be plotted, and their names are taken.
TEST(DynamicsKeys, HaveColumnsOfTheirOwn) {
  const std::string model = test_file("dynamics.yaml");
  const Built built = build_text(model + "  plots: [{x: elapsed, y: [energy.kinetic, disc.vy]}]\n");
  EXPECT_EQ(built.history.size(), 3 + model::energy_quantities.size());
  EXPECT_EQ(built.history.back().name, "energy.residual");
  EXPECT_THAT(refusal_of("{on: disc, of: vy}", "{on: disc, of: vy, name: elapsed}"),
              ::testing::HasSubstr("column 'elapsed' is always there"));
}

// The body of a cylinder with two ends has its centre between them.
TEST(DynamicsKeys, PutTheReferenceAtTheCentreOfMass) {
  const std::string with = edited(
      edited(test_file("dynamics_space.yaml"), "sphere: {center: [0.1, 0.05, 0.9], radius: 1}",
             "cylinder: {point: [0, 0, 1], axis: [1, 0, 0], radius: 1, length: 6}"),
      ", inertia: [0.5, 0.8, 1.1, 0.05, -0.1, 0.02]", "");
  const model::RigidBody3 body = built_from(with).model.rigid.at(0);
  EXPECT_LT((body.reference - Vec3(3, 0, 1)).norm(), 1e-12);
  EXPECT_NEAR(body.inertia(0, 0), 0.5 * 2, 1e-12);              // m r^2 / 2
  EXPECT_NEAR(body.inertia(1, 1), 2 * (3 + 36) / 12.0, 1e-12);  // m (3 r^2 + l^2) / 12
  EXPECT_THAT(any_refusal(edited(with, "mass: 2", "mass: 2, reference: [0, 0, 1]")),
              ::testing::HasSubstr("centre of mass"));
}

template <class AnyProbe>
void expect_second_order_tangent(AnyProbe& probe, const std::string& what) {
  const auto r = check_tangent_of(probe);
  EXPECT_TRUE(r.exact || std::abs(r.order - 2) < 0.15) << what << " order " << r.order;
}

TEST(Dynamics, TangentIsTheDerivativeForEveryScheme) {
  for (const char* const scheme : schemes)
    for (const char* const impact : impacts) {
      Probe probe(thrown(scheme, impact));
      probe.start = probe.system.begin_motion(probe.start);
      expect_second_order_tangent(probe, std::string(scheme) + " " + impact);
    }
}

/// Runs to the end and returns the energies of every state.
std::vector<model::Energies> energies_of(const Built& built) {
  std::vector<model::Energies> out;
  model::AnalysisObserver observer;
  observer.converged = [&](model::System&, const model::State& state, const model::Progress&,
                           const solve::IncrementRecord*) {
    out.push_back(state.rates.energies);
    return true;
  };
  const model::AnalysisResult result = model::run(built.model, built.options, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
  return out;
}

std::string linear(const std::string& text) {
  return edited(edited(text, "neo_hooke", "linear_elastic"), "increments: 4", "increments: 40");
}

// Linear bodies: every joule has its place, and implicit contact loses energy in every increment.
TEST(Dynamics, EnergyIsAccountedFor) {
  for (const char* const scheme : schemes)
    for (const char* const impact : impacts) {
      const std::vector<model::Energies> all =
          energies_of(build_text(linear(thrown(scheme, impact))));
      ASSERT_EQ(all.size(), 41u);
      const double size = all.front().start;
      double before = 0;
      for (const model::Energies& e : all) {
        EXPECT_NEAR(e.residual, 0, 2e-3 * size);
        if (std::string(impact) == "dissipative" && std::string(scheme) == "newmark") {
          EXPECT_GE(e.numerical, before - 2e-3 * size);
        }
        before = e.numerical;
      }
      EXPECT_GT(all.back().friction, 0);
      EXPECT_GT(all.back().damping, 0);
    }
}

// What damped contact takes stands in the column of the damping, and nothing is left over. With
// implicit contact the scheme still gives nothing.
TEST(Dynamics, EnergyOfDampedContactIsAccountedFor) {
  for (const char* const law : {"{viscous: 0.5}", "{restitution: 0.4}"})
    for (const char* const impact : impacts) {
      const std::string text =
          edited(edited(linear(thrown("newmark", impact)), "{mass: 0.3, stiffness: 1e-3}",
                        "{mass: 0, stiffness: 0}"),
                 "normal: {", std::string("normal: {damping: ") + law + ", ");
      const std::vector<model::Energies> all = energies_of(build_text(text));
      ASSERT_EQ(all.size(), 41u);
      const double size = all.front().start;
      model::Energies before;
      for (const model::Energies& e : all) {
        EXPECT_NEAR(e.residual, 0, 2e-3 * size);
        EXPECT_GE(e.damping, before.damping);
        if (std::string(impact) == "dissipative") {
          EXPECT_GE(e.numerical, before.numerical - 2e-3 * size);
        }
        before = e;
      }
      EXPECT_GT(all.back().damping, 0) << law << impact;
    }
}

// Constant acceleration is exact for every scheme: y = h + v t - g t^2 / 2.
TEST(Dynamics, AThrownBodyFliesOnItsParabola) {
  for (const char* const scheme : schemes) {
    std::string text =
        edited(thrown(scheme, impacts[0]), "center: [0.3, 0.995]", "center: [0.3, 3]");
    text = edited(text, "damping: {mass: 0.3, stiffness: 1e-3}", "damping: {}");
    const Built built = build_text(text);
    model::State last;
    (void)run_to_end(built, 1, [&](model::System&, const model::State& s) { last = s; });
    const double t = 0.1;
    EXPECT_NEAR(last.rigid[0].translation.y(), -t - 0.5 * 9.81 * t * t, 1e-14);
    EXPECT_NEAR(last.rigid[0].translation.x(), 0.3 * t + 0.5 * 0.2 * t * t, 1e-14);
    EXPECT_NEAR(last.rigid[0].angle, 2 * t, 1e-14);
    const Index first = 2 * static_cast<Index>(built.model.reference.size());
    EXPECT_NEAR(last.rates.velocity[first + 1], -1 - 9.81 * t, 1e-13);
  }
}

/// A body with three different moments of inertia that turns while it slides on a block.
std::string spinning_ball() { return test_file("dynamics_space.yaml"); }

TEST(Dynamics, TangentIsTheDerivativeInSpace) {
  for (const char* const scheme : schemes)
    for (const char* const impact : impacts) {
      const Built3 built =
          built_from(edited(edited(spinning_ball(), "newmark", scheme), "dissipative", impact));
      model::System3 system(built.model, 1);
      model::State3 start = system.initial_state();
      system.begin_step(built.model.steps.front(), start);
      start = system.begin_motion(start);
      const Eigen::Index n = system.unknowns();
      const double fraction = 0.5;
      const auto moved = [&](const model::State3& from, const Eigen::VectorXd& d) {
        return system.apply(from, d, fraction, 1.0);
      };
      const model::State3 base = moved(start, 0.02 * testing::random_direction(n, 3));
      solve::Evaluation out;
      system.evaluate(start, base, fraction, true, out);
      ASSERT_TRUE(out.ok) << out.message;
      EXPECT_GT(out.counts.stick + out.counts.slip, 0);
      const std::uint64_t states = out.counts.signature;
      Eigen::VectorXd d = testing::random_direction(n, 5);
      for (Index u = 0; u < n; ++u)
        if (system.prescribed(u)) d[u] = 0;
      const la::SparseMatrix k = system.matrix();
      Eigen::VectorXd df = la::multiply(k, d);
      for (Index u = 0; u < n; ++u)
        if (system.prescribed(u)) df[u] = 0;
      bool same = true;
      const auto residual = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
        solve::Evaluation e;
        system.evaluate(start, moved(base, v), fraction, false, e);
        same = same && e.counts.signature == states;
        return e.residual;
      };
      const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
      const auto r = testing::check_derivative(residual, df, zero, d, 1e-4);
      EXPECT_TRUE(same);
      EXPECT_NEAR(r.order, 2, 0.15) << scheme << " " << impact << " error " << r.error;
    }
}

// Without friction and moments, the angular momentum about a vertical axis cannot change.
TEST(Dynamics, ABallThatTurnsKeepsItsSpinWithoutFriction) {
  std::string text = edited(spinning_ball(), ", friction: {coulomb: {mu: 0.4, penalty: 700}}", "");
  text = edited(text, "    forces: [{on: ball, mx: 0.3, mz: -0.2}]\n", "");
  text = edited(text, "[0.5, 0.8, 1.1, 0.05, -0.1, 0.02]", "[0.8, 0.8, 0.8]");
  const Built3 built = built_from(text);
  model::AnalysisObserver3 observer;
  const Index spin = 3 * static_cast<Index>(built.model.reference.size()) + 3;
  observer.converged = [&](model::System3&, const model::State3& s, const model::Progress&,
                           const solve::IncrementRecord*) {
    EXPECT_LT((s.rates.velocity.segment<3>(spin) - Vec3(2, -1, 3)).norm(), 1e-10);
    return true;
  };
  const model::AnalysisResult3 result = model::run(built.model, built.options, observer);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.message;
}

}  // namespace
}  // namespace osculate::deck
