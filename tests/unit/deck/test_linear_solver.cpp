// A linear solver that the program does not know: one file, and analyses run on it.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "deck_test.hpp"
#include "osculate/deck/build.hpp"
#include "osculate/model/analysis.hpp"
#include "retold_solver.hpp"

namespace osculate::deck {
namespace {

/// LU of a full matrix, with pivoting; it knows nothing of negative pivots.
class FullMatrix final : public la::LinearSolver {
 public:
  explicit FullMatrix(int& factored) : factored_(factored) {}

  la::FactorReport factor(const la::SparseMatrix& k, std::uint64_t,
                          la::Symmetry symmetry) override {
    Eigen::MatrixXd full = Eigen::MatrixXd::Zero(k.n, k.n);
    for (Index i = 0; i < k.n; ++i)
      for (Index e = k.row_start[static_cast<std::size_t>(i)];
           e < k.row_start[static_cast<std::size_t>(i) + 1]; ++e) {
        const Index j = k.column[static_cast<std::size_t>(e)];
        const double value = k.value[static_cast<std::size_t>(e)];
        if (symmetry != la::Symmetry::unsymmetric && i > j) continue;
        full(i, j) = value;
        if (symmetry != la::Symmetry::unsymmetric) full(j, i) = value;
      }
    lu_.compute(full);
    ++factored_;
    la::FactorReport report;
    if (!lu_.isInvertible()) report.status = la::SolveStatus::singular;
    return report;
  }
  la::SolveStatus solve(Eigen::VectorXd& x) override {
    x = lu_.solve(x).eval();
    return la::SolveStatus::ok;
  }
  la::SolveStatus solve(Eigen::MatrixXd& x) override {
    x = lu_.solve(x).eval();
    return la::SolveStatus::ok;
  }
  [[nodiscard]] double seconds() const override { return 0; }

 private:
  int& factored_;
  Eigen::FullPivLU<Eigen::MatrixXd> lu_;
};

std::string sheared(const std::string& how) {
  return R"(osculate: 1
mesh:
  generate:
    low: {box: {x: [0, 4], y: [0, 1], elements: [6, 2]}}
    up: {box: {x: [1.03, 3.04], y: [1, 2], elements: [4, 2]}}
materials: {s: {neo_hooke: {E: 100, nu: 0.3}}}
sections: [{on: low, material: s, element: plane_strain}, {on: up, material: s, element: plane_strain}]
contact: [{name: c, master: low.top, slave: up.bottom, friction: {coulomb: {mu: 0.3}}, )" +
         how + R"(}]
steps:
  - {name: press, increments: 2, prescribe: [{on: low.bottom, uy: 0, ux: 0}, {on: up.top, uy: -0.1, ux: 0}]}
  - {name: shear, increments: 2, prescribe: [{on: up.top, ux: 0.06}]}
solver: {tolerance: {residual: 1.0e-11}}
)";
}

TEST(LinearSolver, AnotherOneGivesTheSameResults) {
  for (const char* const how :
       {"sampling: nodes", "sampling: mortar, enforcement: lagrange_multiplier"}) {
    SCOPED_TRACE(how);
    const Description d = parse_model(sheared(how), "model.yaml");
    Built built = build(d, load_mesh(d));
    built.options.linear_solver = support::factors_that_serve_once;
    const model::AnalysisResult usual = model::run(built.model, built.options, {});
    ASSERT_EQ(usual.outcome, solve::Outcome::converged) << usual.message;
    int factored = 0;
    built.options.linear_solver = [&] { return std::make_unique<FullMatrix>(factored); };
    const model::AnalysisResult other = model::run(built.model, built.options, {});
    ASSERT_EQ(other.outcome, solve::Outcome::converged) << other.message;
    EXPECT_LT((other.state.u - usual.state.u).norm(), 1e-9 * usual.state.u.norm());
    int iterations = 0;
    for (std::size_t step = 0; step < usual.steps.size(); ++step)
      for (std::size_t i = 0; i < usual.steps[step].increments.size(); ++i) {
        const std::size_t here = usual.steps[step].increments[i].iterations.size();
        EXPECT_EQ(other.steps[step].increments.at(i).iterations.size(), here);
        iterations += static_cast<int>(here);
      }
    EXPECT_GE(factored, iterations);
  }
}

}  // namespace
}  // namespace osculate::deck
