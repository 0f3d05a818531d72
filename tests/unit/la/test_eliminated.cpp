#include "osculate/la/eliminated.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "grid.hpp"
#include "osculate/la/condensed.hpp"

namespace osculate::la {
namespace {

constexpr Index across = 40, up = 30;

/// Unknowns of the lowest row of nodes.
std::vector<Index> few_of_grid() {
  std::vector<Index> all(2 * (across + 1));
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

/// Springs between `closed` neighbours of the lowest row from `from` on; with `shear` they have an
/// unsymmetric part, as friction has.
void close(MatrixBuilder& m, Index from, Index closed, double stiff, double shear) {
  for (Index i = from; i < from + closed; ++i) {
    const Index y = 2 * i + 1, x = 2 * i, next = y + 2;
    m.add(y, y, stiff);
    m.add(next, next, stiff);
    m.add(y, next, -0.5 * stiff);
    m.add(next, y, -0.5 * stiff);
    if (shear != 0) m.add(x, y, shear * stiff);
  }
}

struct Springs {
  Index from, closed;
  double stiff, shear;
};

/// The block alone, with its solver, which has eliminated all but the lowest row.
struct Block {
  MatrixBuilder alone = test::grid(across, up, true);
  std::vector<Index> few = few_of_grid();
  Condensed solver{};
  Eliminated* rest = nullptr;
  Symmetry kind;

  explicit Block(Symmetry symmetry) : kind(symmetry) {
    solver.may_change(few);
    rest = solver.eliminate(alone.finish(), kind);
    if (rest) rest->keep(alone.finish(), kind, few);
  }
  /// The solution of all unknowns with these springs beside the block.
  Eigen::VectorXd solved(const Springs& by, const Eigen::VectorXd& load) {
    MatrixBuilder springs(static_cast<Index>(few.size()));
    close(springs, by.from, by.closed, by.stiff, by.shear);
    EXPECT_EQ(rest->factor(springs.finish(), 1, kind).status, SolveStatus::ok);
    Eigen::VectorXd of_few, all;
    EXPECT_TRUE(rest->reduce(load, of_few));
    EXPECT_EQ(rest->solve(of_few), SolveStatus::ok);
    EXPECT_TRUE(rest->expand(of_few, all));
    return all;
  }
  [[nodiscard]] Eigen::VectorXd by_mumps(const Springs& by, Eigen::VectorXd load) const {
    MatrixBuilder m = test::grid(across, up, true);
    close(m, by.from, by.closed, by.stiff, by.shear);
    Mumps whole;
    EXPECT_EQ(whole.factor(m.finish(), 1, kind).status, SolveStatus::ok);
    EXPECT_EQ(whole.solve(load), SolveStatus::ok);
    return load;
  }
  [[nodiscard]] Eigen::VectorXd load() {
    return Eigen::VectorXd::LinSpaced(alone.finish().n, -1, 2);
  }
};

TEST(Eliminated, SolvesLikeMumps) {
  for (const Symmetry kind :
       {Symmetry::unsymmetric, Symmetry::positive_definite, Symmetry::indefinite})
    for (const double stiff : {1.0, 1e4, 1e9}) {
      SCOPED_TRACE(stiff);
      Block block(kind);
      ASSERT_NE(block.rest, nullptr);
      const double shear = kind == Symmetry::unsymmetric ? 0.3 : 0;
      for (const Index closed : {0, 3, 17, across}) {
        const Springs by{0, closed, stiff, shear};
        const Eigen::VectorXd expected = block.by_mumps(by, block.load());
        EXPECT_LE((block.solved(by, block.load()) - expected).norm(), 1e-10 * expected.norm());
      }
    }
}

/// Few rows that change are an update, many a factorisation. Where an update would lose digits, as
/// when a stiff spring is taken off, it is a factorisation, too.
TEST(Eliminated, RowsThatChangeAreUpdates) {
  for (const double stiff : {10.0, 1e6}) {
    Block block(Symmetry::unsymmetric);
    ASSERT_NE(block.rest, nullptr);
    for (const Springs& by :
         {Springs{5, 20, stiff, 0.2}, Springs{5, 21, stiff, 0.2}, Springs{6, 19, stiff, 0.2},
          Springs{5, 20, stiff, 0.2}, Springs{5, 18, stiff, 0.2}, Springs{0, 40, stiff, 0.2}}) {
      const Eigen::VectorXd expected = block.by_mumps(by, block.load());
      EXPECT_LE((block.solved(by, block.load()) - expected).norm(), 1e-10 * expected.norm());
    }
    const Eliminated::Count count = block.rest->count();
    if (stiff < 1e3) {
      EXPECT_EQ(count.factored, 2);  // the first and the last
      EXPECT_EQ(count.updated, 3);   // the fourth is the first again
    } else {
      EXPECT_GT(count.factored, 2);
    }
  }
}

TEST(Eliminated, BitsDependOnTheMatricesSinceItBeganAnew) {
  const Springs by{5, 20, 1e6, 0.2}, other{5, 21, 1e6, 0.2};
  Block fresh(Symmetry::unsymmetric), used(Symmetry::unsymmetric);
  ASSERT_NE(fresh.rest, nullptr);
  (void)used.solved({0, 30, 10, 0.1}, used.load());
  used.rest->begin_anew();
  for (const Springs& now : {by, other})
    EXPECT_EQ(used.solved(now, used.load()), fresh.solved(now, fresh.load()));
}

/// What the few see of a matrix stays with other entries between them, and is gone with others.
TEST(Eliminated, StandsAsLongAsTheOthersAreTheSame) {
  Block block(Symmetry::unsymmetric);
  ASSERT_NE(block.rest, nullptr);
  EXPECT_TRUE(block.rest->stands());
  MatrixBuilder m = test::grid(across, up, true);
  close(m, 3, 9, 1e3, 0.1);
  ASSERT_EQ(block.solver.factor(m.finish(), 2, block.kind).status, SolveStatus::ok);
  EXPECT_TRUE(block.rest->stands());
  const Index inside = m.finish().n / 2;
  m.add(inside, inside, 1.0);
  ASSERT_EQ(block.solver.factor(m.finish(), 2, block.kind).status, SolveStatus::ok);
  EXPECT_FALSE(block.rest->stands());
}

TEST(Eliminated, RefusesWhatHasNoDigits) {
  MatrixBuilder loose = test::grid(across, up, false);
  Condensed solver;
  const std::vector<Index> few = few_of_grid();
  solver.may_change(few);
  Eliminated* const rest = solver.eliminate(loose.finish(), Symmetry::unsymmetric);
  ASSERT_NE(rest, nullptr);  // held by the few, it has factors
  rest->keep(loose.finish(), Symmetry::unsymmetric, few);
  MatrixBuilder none(static_cast<Index>(few.size()));
  EXPECT_NE(rest->factor(none.finish(), 1, Symmetry::unsymmetric).status, SolveStatus::ok);
  Eigen::VectorXd x = Eigen::VectorXd::Ones(none.finish().n);
  EXPECT_EQ(rest->solve(x), SolveStatus::failed);
}

TEST(Eliminated, NothingWhereItDoesNotPay) {
  MatrixBuilder m = test::grid(across, up, true);
  Condensed solver;
  EXPECT_EQ(solver.eliminate(m.finish(), Symmetry::unsymmetric), nullptr);
  std::vector<Index> many(1000);
  std::iota(many.begin(), many.end(), Index{0});
  solver.may_change(many);
  EXPECT_EQ(solver.eliminate(m.finish(), Symmetry::unsymmetric), nullptr);
}

TEST(TakeOut, EntriesBetweenSomeUnknowns) {
  MatrixBuilder m(5);
  m.add(1, 3, 2.0);
  m.add(3, 1, 4.0);
  m.add(0, 3, 8.0);
  m.add(3, 3, 16.0);
  SparseMatrix few;
  take_out(m.finish(), std::vector<Index>{1, 3}, few);
  Eigen::MatrixXd expected(2, 2);
  expected << 0, 2, 4, 16;
  EXPECT_EQ(test::dense(few), expected);
}

TEST(MatrixBuilder, RowsAreClearedByThemselves) {
  MatrixBuilder m(3);
  for (Index i = 0; i < 3; ++i) m.add(i, 2, 1.0 + i);
  m.clear(std::vector<Index>{0, 2});
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(3, 3);
  expected(1, 2) = 2;
  EXPECT_EQ(test::dense(m.finish()), expected);
}

}  // namespace
}  // namespace osculate::la
