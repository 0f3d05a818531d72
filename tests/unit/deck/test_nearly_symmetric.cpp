// Contact without friction by mortar, or whose areas move with it: the symmetric part of its
// tangent is factored, and iterations and results are those of factors of the whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "osculate/la/mumps.hpp"
#include "osculate/solve/newton.hpp"
#include "system_test.hpp"

namespace osculate::deck {
namespace {

std::string rubber_blocks(const std::string& pair) {
  return R"(osculate: 1
mesh:
  generate:
    low: {box: {x: [0, 4], y: [0, 2], elements: [28, 14]}}
    up: {box: {x: [1, 3], y: [2, 4], elements: [10, 10]}}
materials: {s: {neo_hooke: {E: 100, nu: 0.3}}}
sections: [{on: low, material: s, element: plane_strain}, {on: up, material: s, element: plane_strain}]
contact: [{name: c, master: low.top, slave: up.bottom, )" +
         pair + R"(}]
steps:
  - {name: press, increments: 1, prescribe: [{on: low.bottom, uy: 0, ux: 0}, {on: up.top, uy: -0.1, ux: 0.02}]}
)";
}

/// Mumps, and what was asked of it.
struct Recorder final : la::LinearSolver {
  la::Mumps solver;
  std::vector<la::Symmetry> kinds;
  bool takes_the_part = true;  ///< else symmetric factors are said to have no digits to spare
  la::FactorReport factor(const la::SparseMatrix& k, std::uint64_t version,
                          la::Symmetry symmetry) override {
    kinds.push_back(symmetry);
    la::FactorReport report = solver.factor(k, version, symmetry);
    if (!takes_the_part && symmetry != la::Symmetry::unsymmetric) report.condition = 1e14;
    return report;
  }
  la::SolveStatus solve(Eigen::VectorXd& x) override { return solver.solve(x); }
  la::SolveStatus solve(Eigen::MatrixXd& x) override { return solver.solve(x); }
  [[nodiscard]] double seconds() const override { return solver.seconds(); }
};

struct Solved {
  Eigen::VectorXd u;
  std::size_t iterations = 0;
};

Solved solved(const Built& built, Recorder& by) {
  model::System system(built.model, 1);
  const model::State start = system.initial_state();
  system.begin_step(built.model.steps.front(), start);
  EXPECT_GT(system.unknowns(), 1000);
  solve::NewtonOptions options;
  options.residual = 1e-11;
  const auto result = solve::newton(system, start, 1.0, options, by);
  EXPECT_EQ(result.outcome, solve::Outcome::converged) << result.reason;
  return {result.trial.state.u, result.iterations.size()};
}

TEST(NearlySymmetric, ContactWithoutFrictionHasItsSymmetricPartFactored) {
  for (const char* pair : {"sampling: mortar", "weight: current_area"}) {
    SCOPED_TRACE(pair);
    const Built built = build_text(rubber_blocks(pair));
    Recorder part, whole;
    whole.takes_the_part = false;
    const Solved found = solved(built, part), expected = solved(built, whole);
    EXPECT_EQ(std::ranges::count(part.kinds, la::Symmetry::unsymmetric), 0);
    EXPECT_GT(std::ranges::count(whole.kinds, la::Symmetry::unsymmetric), 0);
    EXPECT_EQ(found.iterations, expected.iterations);
    EXPECT_LT((found.u - expected.u).norm(), 1e-11 * expected.u.norm());
  }
}

TEST(NearlySymmetric, WithFrictionOrMultipliersTheWholeIsFactored) {
  for (const char* pair : {"sampling: mortar, friction: {coulomb: {mu: 0.3}}",
                           "sampling: mortar, enforcement: lagrange_multiplier"}) {
    SCOPED_TRACE(pair);
    const Built built = build_text(rubber_blocks(pair));
    Recorder by;
    solved(built, by);
    EXPECT_EQ(std::ranges::count(by.kinds, la::Symmetry::unsymmetric), std::ssize(by.kinds));
    EXPECT_GT(by.kinds.size(), 0U);
  }
}

}  // namespace
}  // namespace osculate::deck
