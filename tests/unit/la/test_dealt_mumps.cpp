// Matrices of few entries are factored by the first of several processes, for all.
#include "osculate/la/dealt_mumps.hpp"

#include <gtest/gtest.h>

#include "grid.hpp"
#include "osculate/la/aggregates.hpp"
#include "ranks.hpp"

namespace osculate::la {
namespace {

constexpr Index width = 9, height = 7;

/// Rows of a block, held or not, of those that `rank` of `count` has.
MatrixBuilder part(bool held, const core::Ranks* ranks, Index extra) {
  MatrixBuilder all = test::grid(width, height, held);
  if (extra > 0) all.add(0, extra, 0.25);
  const SparseMatrix& k = all.finish();
  std::vector<bool> mine(static_cast<std::size_t>(k.n), true);
  for (std::size_t i = 0; ranks && i < mine.size(); ++i)
    mine[i] = static_cast<int>((7 * i + i / 5) % static_cast<std::size_t>(ranks->count())) ==
              ranks->rank();
  MatrixBuilder rows = ranks ? MatrixBuilder(k.n, ranks, mine) : MatrixBuilder(k.n);
  for (Index i = 0; i < k.n; ++i)
    for (Index e = k.row_start[as_size(i)]; e < k.row_start[as_size(i) + 1]; ++e)
      rows.add(i, k.column[as_size(e)], k.value[as_size(e)]);
  return rows;
}

/// What comes out of two matrices, one after the other, the second with another entry.
struct Found {
  std::vector<FactorReport> reports;
  std::vector<Eigen::VectorXd> solutions;
  std::vector<SolveStatus> status;
};
Found found(const core::Ranks* ranks, bool held, Symmetry symmetry, double fewest) {
  Found out;
  DealtMumps solver(MumpsOptions{.shared = {.fewest_entries = fewest}});
  for (const Index extra : {0, 17}) {
    MatrixBuilder rows = part(held, ranks, extra);
    const SparseMatrix& k = rows.finish();
    out.reports.push_back(solver.factor(k, 1, symmetry));
    const Eigen::VectorXd load = Eigen::VectorXd::LinSpaced(k.n, -1, 2);
    Eigen::VectorXd x = load, once = load;
    Eigen::MatrixXd both(k.n, 2);
    both << load, load.reverse();
    out.status.insert(out.status.end(),
                      {solver.solve(x), solver.solve_once(once), solver.solve(both)});
    out.solutions.insert(out.solutions.end(), {x, once, both.col(0), both.col(1)});
  }
  return out;
}

class DealtMumpsOf : public ::testing::TestWithParam<int> {};

TEST_P(DealtMumpsOf, HasTheBitsOfOneProcess) {
  for (const Symmetry symmetry :
       {Symmetry::unsymmetric, Symmetry::positive_definite, Symmetry::indefinite})
    for (const bool held : {true, false}) {
      SCOPED_TRACE(held);
      const Found alone = found(nullptr, held, symmetry, 1e9);
      EXPECT_EQ(alone.reports[0].status == SolveStatus::ok, held);
      osculate::testing::as_ranks(GetParam(), [&](const core::Ranks& ranks) {
        const Found here = found(&ranks, held, symmetry, 1e9);
        EXPECT_EQ(here.status, alone.status);
        for (std::size_t i = 0; i < alone.reports.size(); ++i) {
          const FactorReport &a = here.reports[i], &b = alone.reports[i];
          EXPECT_EQ(a.status, b.status);
          EXPECT_EQ(a.message, b.message);
          EXPECT_EQ(a.bad_row, b.bad_row);
          EXPECT_EQ(a.negative_pivots, b.negative_pivots);
          EXPECT_EQ(a.condition, b.condition);
          EXPECT_EQ(a.factor_entries, b.factor_entries);
          EXPECT_EQ(a.operations, b.operations);
          EXPECT_EQ(a.whole, b.whole);
          EXPECT_EQ(a.weakest.size(), b.weakest.size());
          if (a.weakest.size() == b.weakest.size()) {
            EXPECT_EQ(a.weakest, b.weakest);
          }
        }
        for (std::size_t i = 0; i < alone.solutions.size(); ++i)
          if (alone.status[i / 4 * 3] == SolveStatus::ok) {
            EXPECT_EQ(here.solutions[i], alone.solutions[i]);
          }
      });
    }
}

TEST_P(DealtMumpsOf, LeavesManyEntriesToAll) {
  osculate::testing::as_ranks(GetParam(), [&](const core::Ranks& ranks) {
    const Found here = found(&ranks, true, Symmetry::unsymmetric, 100);
    EXPECT_EQ(here.reports[0].status, SolveStatus::failed);
    EXPECT_EQ(here.reports[0].message, "there is no linear solver for several processes");
  });
}

INSTANTIATE_TEST_SUITE_P(Processes, DealtMumpsOf, ::testing::Values(1, 2, 5));

}  // namespace
}  // namespace osculate::la
