// Entries and operations of factors that are told of before there is a matrix, against those that
// there are.
#include "osculate/model/factor_estimate.hpp"

#include "block.hpp"
#include "osculate/la/mumps.hpp"

namespace osculate::model {
namespace {

template <int Dim>
void expect_about(const BlockSpec& spec) {
  const BasicModel<Dim> m = block<Dim>(spec, elastic<Dim>(100));
  BasicSystem<Dim> system(m, 1);
  const BasicState<Dim> state = system.initial_state();
  system.begin_step(m.steps[0], state);
  solve::Evaluation out;
  system.evaluate(state, 0, true, out);
  la::SparseMatrix k = system.matrix();
  for (Index i = 0; i < k.n; ++i)  // held by springs
    for (Index e = k.row_start[static_cast<std::size_t>(i)];
         e < k.row_start[static_cast<std::size_t>(i) + 1]; ++e)
      if (k.column[static_cast<std::size_t>(e)] == i) k.value[static_cast<std::size_t>(e)] *= 1.1;
  la::Mumps solver;
  const la::FactorReport report = solver.factor(k, 1, la::Symmetry::indefinite);
  ASSERT_EQ(report.status, la::SolveStatus::ok) << report.message;
  const FactorEstimate estimate = factor_estimate(m);
  const double entries = estimate.entries / static_cast<double>(report.factor_entries);
  EXPECT_GT(entries, 0.7);
  EXPECT_LT(entries, 1.5);
  const double operations = estimate.operations / report.operations;
  EXPECT_GT(operations, 0.5);
  EXPECT_LT(operations, 2.25);
}

TEST(FactorEstimate, IsAboutWhatTheSolverNeedsInThePlane) {
  expect_about<2>({{0, 0, 0}, {1, 1, 1}, {60, 1, 60}});
  expect_about<2>({{0, 0, 0}, {1, 1, 1}, {40, 1, 40}, 0, true});
  expect_about<2>({{0, 0, 0}, {10, 1, 1}, {400, 1, 10}});
}

TEST(FactorEstimate, IsAboutWhatTheSolverNeedsInSpace) {
  expect_about<3>({{0, 0, 0}, {1, 1, 1}, {14, 14, 14}});
  expect_about<3>({{0, 0, 0}, {10, 10, 1}, {40, 40, 2}});
  expect_about<3>({{0, 0, 0}, {1, 1, 1}, {7, 7, 7}, 0, true});
}

}  // namespace
}  // namespace osculate::model
