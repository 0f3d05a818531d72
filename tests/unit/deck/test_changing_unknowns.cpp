// What is said to be constant in the tangent is constant, and analyses that make use of it say what
// others say.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "deck_test.hpp"
#include "effort.hpp"
#include "osculate/deck/build.hpp"
#include "osculate/la/condensed.hpp"
#include "osculate/model/analysis.hpp"

namespace osculate::deck {
namespace {

/// A block on another one; what differs from model to model is filled in.
std::string blocks(const std::string& material, const std::string& pair,
                   const std::string& more = "") {
  return R"(osculate: 1
mesh:
  generate:
    low: {box: {x: [0, 4], y: [0, 2], elements: [24, 12]}}
    up: {box: {x: [1, 3], y: [2, 4], elements: [10, 10]}}
materials: {s: {linear_elastic: {E: 100, nu: 0.3}}, u: )" +
         material + R"(}
sections: [{on: low, material: s, element: plane_strain}, {on: up, material: u, element: plane_strain}]
contact: [{name: c, master: low.top, slave: up.bottom, )" +
         pair + R"(}]
)" + more +
         R"(
steps:
  - {name: press, increments: 2, prescribe: [{on: low.bottom, uy: 0, ux: 0}, {on: up.top, uy: -0.02, ux: 0}]}
  - {name: shear, increments: 3, prescribe: [{on: up.top, ux: 0.03}]}
solver: {tolerance: {residual: 1.0e-11}}
)";
}

const std::string linear = "{linear_elastic: {E: 200, nu: 0.3}}";
const std::string friction = "friction: {coulomb: {mu: 0.3}}";

/// A body of small strain beside them, which turns: its forces grow as it moves.
std::string beside_a_body_that_turns(std::string text) {
  text = edited(text, "    up: {box",
                "    ear: {box: {x: [5, 6], y: [0, 1], elements: [3, 3]}}\n    up: {box");
  text = edited(text, "materials: {",
                "materials: {e: {linear_elastic: {E: 50, nu: 0.3, density: 1}}, ");
  text = edited(text, "sections: [", "sections: [{on: ear, material: e, element: plane_strain}, ");
  return edited(
      text, "press, increments: 2, prescribe: [",
      "press, increments: 2, centrifugal: [{on: ear, speed_squared: 2, places: deformed}], "
      "prescribe: [{on: ear.left, ux: 0, uy: 0}, ");
}

std::vector<std::string> models() {
  return {blocks(linear, "normal: {penalty: 1.0e4}"),
          blocks(linear, friction),
          blocks(linear, friction + ", sampling: mortar, enforcement: lagrange_multiplier"),
          blocks(linear, friction + ", enforcement: augmented_lagrange"),
          blocks(linear, "normal: {penalty: 1.0e4}",
                 "springs: [{between: [low.top_left, up.bottom_left], stiffness: 3}]"),
          beside_a_body_that_turns(blocks(linear, friction))};
}

/// Values of the tangent by row and column.
std::map<std::pair<Index, Index>, double> entries(const la::SparseMatrix& k) {
  std::map<std::pair<Index, Index>, double> all;
  for (Index i = 0; i < k.n; ++i)
    for (Index e = k.row_start[static_cast<std::size_t>(i)];
         e < k.row_start[static_cast<std::size_t>(i) + 1]; ++e)
      all[{i, k.column[static_cast<std::size_t>(e)]}] = k.value[static_cast<std::size_t>(e)];
  return all;
}

TEST(ChangingUnknowns, AllElseIsConstant) {
  for (const std::string& text : models()) {
    SCOPED_TRACE(text);
    const Description d = parse_model(text, "model.yaml");
    const Built built = build(d, load_mesh(d));
    model::System system(built.model, 1);
    const model::State start = system.initial_state();
    system.begin_step(built.model.steps[0], start);
    const std::vector<Index> changing = system.changing_unknowns();
    ASSERT_FALSE(changing.empty());
    std::vector<bool> changes(static_cast<std::size_t>(system.unknowns()), false);
    for (const Index u : changing) changes[static_cast<std::size_t>(u)] = true;
    solve::Evaluation out;
    system.evaluate(start, 0.0, true, out);
    const auto before = entries(system.matrix());
    Eigen::VectorXd du(system.unknowns());
    for (Eigen::Index i = 0; i < du.size(); ++i)
      du[i] = 0.02 * std::sin(1.3 * static_cast<double>(i));
    const model::Trial moved = system.apply(start, du, 0.5, 1.0);
    system.evaluate(start, moved, 0.5, true, out);
    ASSERT_TRUE(out.ok) << out.message;
    int differ = 0;
    for (const auto& [at, value] : entries(system.matrix())) {
      const auto found = before.find(at);
      if (found != before.end() ? found->second == value : value == 0) continue;
      ++differ;
      EXPECT_TRUE(changes[static_cast<std::size_t>(at.first)] &&
                  changes[static_cast<std::size_t>(at.second)])
          << at.first << ", " << at.second;
    }
    EXPECT_GT(differ, 0);
  }
}

// What cells of constant stiffness add is kept in sum, as long as the same unknowns are free.
TEST(ChangingUnknowns, KeptSumsAreThoseOfAnotherSystem) {
  for (const std::string& text :
       {blocks(linear, friction), blocks("{neo_hooke: {E: 200, nu: 0.3}}", friction),
        blocks("{neo_hooke: {E: 200, nu: 0.3}}", friction, "equal: [{on: low.left, of: ux}]\n")}) {
    SCOPED_TRACE(text);
    const Description d = parse_model(text, "model.yaml");
    const Built built = build(d, load_mesh(d));
    ASSERT_NE(built.model.steps[0].prescribed.size(), 0U);
    model::Step other = built.model.steps[0];
    other.prescribed.pop_back();
    model::System used(built.model, 1);
    const model::State start = used.initial_state();
    solve::Evaluation out;
    const auto stiffness = [](model::System& system) {
      auto found = entries(system.matrix());
      std::erase_if(found, [](const auto& entry) { return entry.second == 0; });
      return found;
    };
    const auto look = [&](model::System& system, const model::Step& step, double size) {
      system.begin_step(step, start);
      Eigen::VectorXd du(system.unknowns());
      for (Eigen::Index i = 0; i < du.size(); ++i)
        du[i] = size * std::sin(1.3 * static_cast<double>(i));
      const model::Trial moved = system.apply(start, du, 0.5, 1.0);
      system.evaluate(start, moved, 0.5, true, out);
      EXPECT_TRUE(out.ok) << out.message;
      return stiffness(system);
    };
    for (const auto& [step, size] :
         {std::pair(&built.model.steps[0], 0.0), std::pair(&built.model.steps[0], 0.01),
          std::pair(&built.model.steps[0], 0.02),
          std::pair<const model::Step*, double>(&other, 0.02)}) {
      const auto once = look(used, *step, size);
      solve::Evaluation again;
      used.predict(start, 0.5, again);
      EXPECT_TRUE(again.ok);
      model::System fresh(built.model, 1);
      EXPECT_EQ(once, look(fresh, *step, size)) << size;
      solve::Evaluation predicted;
      fresh.predict(start, 0.5, predicted);
      EXPECT_EQ(stiffness(used), stiffness(fresh));
      EXPECT_EQ(again.residual, predicted.residual);
    }
  }
}

TEST(ChangingUnknowns, AnalysesGiveTheSameResults) {
  for (const std::string& model : models()) {
    // Deep enough for the elimination of its inside to pay.
    const std::string text = edited(model, "elements: [24, 12]", "elements: [24, 24]");
    SCOPED_TRACE(text);
    const Description d = parse_model(text, "model.yaml");
    Built built = build(d, load_mesh(d));
    built.options.linear_solver = [] { return std::make_unique<la::Mumps>(); };
    const model::AnalysisResult whole = model::run(built.model, built.options, {});
    ASSERT_EQ(whole.outcome, solve::Outcome::converged) << whole.message;
    la::Condensed* used = nullptr;
    la::Condensed::Count count;
    built.options.linear_solver = [&] {
      auto solver = std::make_unique<la::Condensed>();
      used = solver.get();
      return solver;
    };
    model::AnalysisObserver observer;
    observer.converged = [&](const auto&, const auto&, const auto&, const auto*) {
      if (used) count = used->count();
      return true;
    };
    const model::AnalysisResult small = model::run(built.model, built.options, observer);
    ASSERT_EQ(small.outcome, solve::Outcome::converged) << small.message;
    EXPECT_GT(count.small, 4);
    EXPECT_EQ(count.whole, 0);
    EXPECT_LT((small.state.u - whole.state.u).norm(), 1e-9 * whole.state.u.norm());
  }
}

/// Condensed, and how often all unknowns were factored for.
class Watched final : public la::LinearSolver {
 public:
  Watched(int& eliminated, int& factored) : eliminated_(eliminated), factored_(factored) {}
  void may_change(std::vector<Index> unknowns) override { solver_.may_change(unknowns); }
  la::FactorReport factor(const la::SparseMatrix& k, std::uint64_t version,
                          la::Symmetry symmetry) override {
    ++factored_;
    return solver_.factor(k, version, symmetry);
  }
  la::Eliminated* eliminate(const la::SparseMatrix& k, la::Symmetry symmetry) override {
    la::Eliminated* const few = solver_.eliminate(k, symmetry);
    eliminated_ += few ? 1 : 0;
    return few;
  }
  la::SolveStatus solve(Eigen::VectorXd& x) override { return solver_.solve(x); }
  la::SolveStatus solve(Eigen::MatrixXd& x) override { return solver_.solve(x); }
  [[nodiscard]] double seconds() const override { return solver_.seconds(); }

 private:
  int &eliminated_, &factored_;
  la::Condensed solver_;
};

/// Of models large enough the few alone are iterated on, step by step, and nothing else is factored
/// but once a step; with corrected multipliers what comes after the first solution is.
TEST(ChangingUnknowns, IterationsOfTheFewGiveTheSameResults) {
  for (std::string text : models()) {
    const bool corrected = text.find("augmented") != std::string::npos;
    if (testing::sanitized && corrected) continue;  // the longest of them
    text = edited(text, "[24, 12]", corrected ? "[72, 36]" : "[52, 26]");
    text = edited(text, "[10, 10]", corrected ? "[30, 30]" : "[18, 20]");
    SCOPED_TRACE(text);
    const Description d = parse_model(text, "model.yaml");
    Built built = build(d, load_mesh(d));
    built.options.linear_solver = [] { return std::make_unique<la::Mumps>(); };
    const model::AnalysisResult whole = model::run(built.model, built.options, {});
    ASSERT_EQ(whole.outcome, solve::Outcome::converged) << whole.message;
    int eliminated = 0, factored = 0;
    built.options.linear_solver = [&] { return std::make_unique<Watched>(eliminated, factored); };
    const model::AnalysisResult few = model::run(built.model, built.options, {});
    ASSERT_EQ(few.outcome, solve::Outcome::converged) << few.message;
    EXPECT_EQ(eliminated, 2);
    EXPECT_EQ(factored > 0, corrected);
    EXPECT_LT((few.state.u - whole.state.u).norm(), 1e-9 * whole.state.u.norm());
    ASSERT_EQ(few.steps.size(), whole.steps.size());
    for (std::size_t i = 0; i < few.steps.size(); ++i) {
      const auto &now = few.steps[i].increments, &before = whole.steps[i].increments;
      ASSERT_EQ(now.size(), before.size());
      for (std::size_t k = 0; k < now.size() && !corrected; ++k)
        EXPECT_LE(now[k].iterations.back().residual, 1e-11);
    }
  }
}

/// Nothing is said where it is of no use: linear models, and those that change everywhere.
TEST(ChangingUnknowns, NoneWhereTheyWouldBeTooMany) {
  for (const std::string& text :
       {blocks("{neo_hooke: {E: 100, nu: 0.3}}", "normal: {penalty: 1.0e4}"),
        blocks(linear, "normal: {penalty: 1.0e4, separation: tied}")}) {
    const Description d = parse_model(text, "model.yaml");
    const Built built = build(d, load_mesh(d));
    const model::System system(built.model, 1);
    EXPECT_TRUE(system.changing_unknowns().empty());
  }
}

}  // namespace
}  // namespace osculate::deck
