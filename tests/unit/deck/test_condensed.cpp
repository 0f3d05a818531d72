// Condensed multipliers: the same corrections as with multipliers that are unknowns of the solver.
#include <fmt/format.h>

#include <set>

#include "space_test.hpp"
#include "system_test.hpp"

namespace osculate::deck {
namespace {

struct Setting {
  std::string sampling = "nodes", friction = "coulomb: {mu: 0.3, penalty: 100}", type = "quad4";
  std::string more{};  ///< prescribed beside the usual
};

const std::string none;

std::string contact_of(const Setting& s) {
  const std::string friction =
      s.friction.empty() ? "" : fmt::format(" friction: {{{}}},", s.friction);
  return fmt::format(
      "contact: [{{name: c, master: low.top, slave: up.bottom, sampling: {},{} normal: {{penalty: "
      "100}}, enforcement: lagrange_multiplier}}]\n",
      s.sampling, friction);
}

/// A block that hangs over the edge of another one, pressed on it and sheared until a part slides.
std::string plane(const Setting& s) {
  return fmt::format(R"(osculate: 1
mesh:
  generate:
    low: {{box: {{x: [0, 4], y: [0, 1], elements: [12, 3], type: {0}}}}}
    up: {{box: {{x: [2.5, 4.51], y: [1.001, 2], elements: [5, 3], type: {0}}}}}
materials: {{s: {{linear_elastic: {{E: 100, nu: 0.3}}}}}}
sections: [{{on: low, material: s, element: plane_strain}}, {{on: up, material: s, element: plane_strain}}]
{1}steps:
  - {{name: press, increments: 2, prescribe: [{{on: low.bottom, uy: 0, ux: 0}}, {{on: up.top, uy: -0.1, ux: 0}}{2}]}}
  - {{name: shear, increments: 3, prescribe: [{{on: up.top, ux: 0.2}}]}}
solver: {{tolerance: {{residual: 1.0e-11}}}}
)",
                     s.type, contact_of(s), s.more);
}

std::string space(const Setting& s) {
  return fmt::format(R"(osculate: 1
mesh:
  generate:
    low: {{box: {{x: [0, 3], y: [0, 2], z: [0, 1], elements: [5, 3, 2]}}}}
    up: {{box: {{x: [0.53, 2.04], y: [0, 1.4], z: [1.001, 2], elements: [3, 2, 2]}}}}
materials: {{s: {{linear_elastic: {{E: 100, nu: 0.3}}}}}}
sections: [{{on: [low, up], material: s, element: solid, formulation: full}}]
{0}steps:
  - {{name: press, increments: 1, prescribe: [{{on: low.bottom, ux: 0, uy: 0, uz: 0}}, {{on: up.top, ux: 0, uy: 0, uz: -0.08}}{1}]}}
  - {{name: shear, increments: 2, prescribe: [{{on: up.top, ux: 0.05, uy: 0.01}}]}}
solver: {{tolerance: {{residual: 1.0e-11}}}}
)",
                     contact_of(s), s.more);
}

double difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return b.size() > 0 && b.norm() > 0 ? (a - b).norm() / b.norm() : 0.0;
}

/// What was seen in the iterations of an analysis.
struct Seen {
  double difference = 0;  ///< largest relative one of a correction, multipliers over penalties
  int most_kept = 0;      ///< multipliers that were not condensed
  std::set<std::uint64_t> states;  ///< signatures of the points' states
  bool stuck = false, slid = false, open = false;

  void add(const solve::StateCounts& c) {
    states.insert(c.signature);
    stuck = stuck || c.stick > 0;
    slid = slid || c.slipping > 0;
    open = open || c.open > 0;
  }
};

/// Newton's method; every correction is computed in both ways.
template <int Dim>
Seen corrections(const model::BasicModel<Dim>& m) {
  Seen seen;
  model::BasicSystem<Dim> system(m, 1);
  model::BasicState<Dim> state = system.initial_state();
  la::DirectSolver plain, condensing(la::DirectOptions{.condense = la::Condense::always});
  la::Condensation condensed;
  const auto add = [&](const solve::Evaluation& e) -> Eigen::VectorXd {
    Eigen::VectorXd as_it_is = -(e.branch_residual.size() > 0 ? e.branch_residual : e.residual);
    Eigen::VectorXd other = as_it_is;
    if (solve::factored(system, plain).status == la::SolveStatus::singular) {
      EXPECT_TRUE(system.soften());  // as Newton's method does
      EXPECT_EQ(solve::factored(system, plain).status, la::SolveStatus::ok);
    }
    EXPECT_EQ(solve::factored(system, condensing).status, la::SolveStatus::ok);
    EXPECT_EQ(plain.solve(as_it_is), la::SolveStatus::ok);
    EXPECT_EQ(condensing.solve(other), la::SolveStatus::ok);
    const Index n = system.displacements();
    seen.difference = std::max(seen.difference, difference(other, as_it_is));
    EXPECT_TRUE(condensed.reduce(system.matrix(), system.condensable()));
    seen.most_kept = std::max(seen.most_kept, condensed.matrix().n - n);
    return as_it_is;
  };
  for (const model::Step& step : m.steps) {
    system.begin_step(step, state);
    state.fraction = 0;
    for (int i = 1; i <= step.increments; ++i) {
      const double time = static_cast<double>(i) / step.increments;
      solve::Evaluation e;
      system.predict(state, time, e);
      model::BasicState<Dim> trial = state;
      bool converged = false;
      for (int n = 0; n < 25 && !converged; ++n) {
        trial = system.remember(trial);
        trial = system.apply(trial, add(e), time, 1.0);
        system.evaluate(state, trial, time, true, e);
        if (!e.ok) break;
        seen.add(e.counts);
        converged = e.residual.norm() <= 1e-11 * e.force_scale;
      }
      EXPECT_TRUE(converged) << step.name << i;
      state = system.commit(trial, time);
    }
  }
  return seen;
}

constexpr double same = 1e-9;

TEST(Condensed, CorrectionsAreTheSameInThePlane) {
  for (const std::string sampling : {"nodes", "mortar"})
    for (const std::string& friction : {none, Setting{}.friction}) {
      const Seen seen = corrections(build_text(plane({sampling, friction})).model);
      EXPECT_LT(seen.difference, same) << sampling << friction;
      EXPECT_EQ(seen.most_kept, 0) << sampling << friction;
      EXPECT_TRUE(seen.open) << "beyond the edge";
      if (friction.empty()) continue;
      EXPECT_TRUE(seen.stuck && seen.slid && seen.states.size() > 3) << sampling;
    }
}

TEST(Condensed, CorrectionsAreTheSameInSpace) {
  for (const std::string sampling : {"nodes", "mortar"})
    for (const std::string& friction : {none, Setting{}.friction}) {
      const Seen seen = corrections(built_from(space({sampling, friction})).model);
      EXPECT_LT(seen.difference, same) << sampling << friction;
      EXPECT_EQ(seen.most_kept, 0) << sampling << friction;
      if (friction.empty()) continue;
      EXPECT_TRUE(seen.stuck && seen.slid && seen.states.size() > 3) << sampling;
    }
}

/// Slave nodes in a plane of symmetry: where the master is not held in it, what holds them there is
/// not of their own equations.
TEST(Condensed, PrescribedSlaveNodesAreNoObstacle) {
  for (const std::string sampling : {"nodes", "mortar"}) {
    Setting s{sampling};
    s.more = ", {on: up.front, uy: 0}, {on: low.front, uy: 0}";
    s.friction = none;  // in the plane nothing tells a node's shear
    const Seen held = corrections(built_from(space(s)).model);
    EXPECT_LT(held.difference, same) << sampling;
    s.more = ", {on: up.front, uy: 0}";
    s.friction = Setting{}.friction;
    const Seen free = corrections(built_from(space(s)).model);
    EXPECT_LT(free.difference, same) << sampling;
    EXPECT_GT(free.most_kept, held.most_kept) << sampling;
    EXPECT_LE(free.most_kept, 4) << "one shear of each node in the plane";
  }
}

/// Nodes on edges: on facets that are partly covered the multipliers belong to the corners, and act
/// on the other nodes too.
TEST(Condensed, QuadraticFacetsKeepTheMultipliersOfPartlyCoveredOnes) {
  for (const std::string& friction : {none, Setting{}.friction}) {
    const Seen seen = corrections(build_text(plane({"mortar", friction, "quad8"})).model);
    EXPECT_LT(seen.difference, same) << friction;
    EXPECT_GT(seen.most_kept, 0);
    EXPECT_LT(seen.most_kept, 11 * (friction.empty() ? 1 : 3)) << "of 11 slave nodes";
  }
}

/// Whole analyses, with line search, predictor and cut-backs.
TEST(Condensed, AnalysesHaveTheSameIterations) {
  for (const std::string sampling : {"nodes", "mortar"})
    for (const std::string& friction : {none, Setting{}.friction}) {
      Built built = build_text(plane({sampling, friction}));
      built.options.condense = la::Condense::never;
      const model::AnalysisResult plain = model::run(built.model, built.options, {});
      built.options.condense = la::Condense::always;
      const model::AnalysisResult condensed = model::run(built.model, built.options, {});
      ASSERT_EQ(plain.outcome, solve::Outcome::converged) << plain.message;
      ASSERT_EQ(condensed.outcome, solve::Outcome::converged) << condensed.message;
      EXPECT_LT(difference(condensed.state.u, plain.state.u), same);
      for (std::size_t step = 0; step < plain.steps.size(); ++step) {
        const auto& a = plain.steps[step].increments;
        const auto& b = condensed.steps[step].increments;
        ASSERT_EQ(a.size(), b.size()) << sampling << friction;
        for (std::size_t i = 0; i < a.size(); ++i) {
          ASSERT_EQ(a[i].iterations.size(), b[i].iterations.size()) << sampling << friction;
          for (std::size_t n = 0; n < a[i].iterations.size(); ++n)
            EXPECT_EQ(a[i].iterations[n].counts.signature, b[i].iterations[n].counts.signature);
        }
      }
    }
}

TEST(Condensed, SameBitsForAnyNumberOfThreads) {
  for (const std::string sampling : {"nodes", "mortar"}) {
    Built built = build_text(plane({sampling}));
    built.options.condense = la::Condense::always;
    std::vector<Eigen::VectorXd> u;
    for (const int threads : {1, 2}) {
      built.options.threads = threads;
      u.push_back(model::run(built.model, built.options, {}).state.u);
    }
    EXPECT_EQ(u[0], u[1]) << sampling;
  }
}

TEST(Condensed, ChangesNothingWithoutMultipliers) {
  Built built = build_text(
      edited(plane({}), "enforcement: lagrange_multiplier", "enforcement: augmented_lagrange"));
  model::System system(built.model, 1);
  system.begin_step(built.model.steps.front(), system.initial_state());
  EXPECT_TRUE(system.condensable().empty());
  built.options.condense = la::Condense::never;
  const Eigen::VectorXd plain = model::run(built.model, built.options, {}).state.u;
  built.options.condense = la::Condense::always;
  EXPECT_EQ(model::run(built.model, built.options, {}).state.u, plain);
}

/// tri6 and quad8 faces: their functions are dual to others than the shape functions.
TEST(Condensed, LeavesOutWhatHasNoNodeOfItsOwn) {
  const auto offered = [](const std::string& type, const std::string& sampling) {
    std::string text =
        edited(space({sampling}), "elements: [3, 2, 2]", "elements: [3, 2, 2], type: " + type);
    const Built3 built = built_from(text);
    model::System3 system(built.model, 1);
    system.begin_step(built.model.steps.front(), system.initial_state());
    return system.condensable().size();
  };
  EXPECT_EQ(offered("hex8", "mortar"), 12u);
  EXPECT_EQ(offered("hex27", "mortar"), 35u);
  EXPECT_EQ(offered("hex20", "mortar"), 0u);
  const Built rigid = build_text(edited(plane({}), "steps:",
                                        "rigid: {punch: {set: up.bottom, reference: [2, 1]}}\n"
                                        "steps:"));
  model::System system(rigid.model, 1);
  system.begin_step(rigid.model.steps.front(), system.initial_state());
  EXPECT_TRUE(system.condensable().empty()) << "the slave nodes follow a rigid body";
}

}  // namespace
}  // namespace osculate::deck
