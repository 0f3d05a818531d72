#include "osculate/la/condensed.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <limits>
#include <numeric>
#include <vector>

#include "grid.hpp"

namespace osculate::la {
namespace {

constexpr Index width = 40, height = 30;

/// Unknowns of the lowest row of nodes.
std::vector<Index> lowest() {
  std::vector<Index> all(2 * (width + 1));
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

/// The block with springs between neighbours of its lowest row, `stiff` where they are closed; with
/// `shear` they have an unsymmetric part, as friction has.
MatrixBuilder in_contact(int closed, double stiff, double shear = 0) {
  MatrixBuilder m = test::grid(width, height, true);
  for (Index i = 0; i < closed; ++i) {
    const Index y = 2 * i + 1, x = 2 * i, next = y + 2;
    m.add(y, y, stiff);
    m.add(next, next, stiff);
    m.add(y, next, -0.5 * stiff);
    m.add(next, y, -0.5 * stiff);
    if (shear != 0) m.add(x, y, shear * stiff);
  }
  return m;
}

Eigen::VectorXd load(Index n) { return Eigen::VectorXd::LinSpaced(n, -1, 2); }

Eigen::VectorXd solved(LinearSolver& solver, MatrixBuilder& m, Symmetry kind) {
  const SparseMatrix& k = m.finish();
  EXPECT_EQ(solver.factor(k, m.pattern_version(), kind).status, SolveStatus::ok);
  Eigen::VectorXd x = load(k.n);
  EXPECT_EQ(solver.solve(x), SolveStatus::ok);
  return x;
}

TEST(Condensed, SolvesLikeMumpsWhateverCloses) {
  for (const Symmetry kind :
       {Symmetry::unsymmetric, Symmetry::positive_definite, Symmetry::indefinite})
    for (const double stiff : {1.0, 1e4, 1e9}) {
      Condensed solver;
      solver.may_change(lowest());
      for (const int closed : {0, 3, 17, width}) {
        SCOPED_TRACE(closed);
        MatrixBuilder m = in_contact(closed, stiff, kind == Symmetry::unsymmetric ? 0.3 : 0.0);
        Mumps whole;
        const Eigen::VectorXd expected = solved(whole, m, kind), x = solved(solver, m, kind);
        EXPECT_LE((x - expected).norm(), 1e-10 * expected.norm());
        EXPECT_LE(relative_residual(m.finish(), x, load(m.finish().n)), 1e-12);
      }
      EXPECT_EQ(solver.count().small, 4);
      EXPECT_EQ(solver.count().whole, 0);
    }
}

TEST(Condensed, SaysWhatItFactored) {
  Condensed solver;
  solver.may_change(lowest());
  for (const int closed : {0, 3, width}) {
    MatrixBuilder m = in_contact(closed, 1e4, 0.0);
    const FactorReport report =
        solver.factor(m.finish(), m.pattern_version(), Symmetry::positive_definite);
    EXPECT_EQ(report.whole, closed == 0);
  }
}

TEST(Condensed, BitsDependOnTheMatrixAlone) {
  for (const Symmetry kind : {Symmetry::unsymmetric, Symmetry::indefinite}) {
    MatrixBuilder m = in_contact(9, 1e6, kind == Symmetry::unsymmetric ? 0.2 : 0.0);
    Condensed fresh, used;
    fresh.may_change(lowest());
    used.may_change(lowest());
    const Eigen::VectorXd x = solved(fresh, m, kind);
    for (const int closed : {0, 30}) {
      MatrixBuilder other = in_contact(closed, 10);
      (void)solved(used, other, kind);
    }
    EXPECT_EQ(x, solved(used, m, kind));
  }
}

TEST(Condensed, ChangesElsewhereAreSeen) {
  Condensed solver;
  solver.may_change(lowest());
  MatrixBuilder m = in_contact(5, 100);
  (void)solved(solver, m, Symmetry::indefinite);
  const Index inside = m.finish().n / 2;
  m.add(inside, inside, 1e3);
  Mumps whole;
  const Eigen::VectorXd expected = solved(whole, m, Symmetry::indefinite);
  EXPECT_LE((solved(solver, m, Symmetry::indefinite) - expected).norm(), 1e-11 * expected.norm());
  m.add(inside, inside + 40, 2.0);  // outside of the pattern so far, whose version is not told of
  const SparseMatrix& k = m.finish();
  ASSERT_EQ(solver.factor(k, 1, Symmetry::unsymmetric).status, SolveStatus::ok);
  Eigen::VectorXd x = load(k.n);
  ASSERT_EQ(solver.solve(x), SolveStatus::ok);
  EXPECT_LE(relative_residual(k, x, load(k.n)), 1e-12);
}

TEST(Condensed, IsMumpsWhereItDoesNotPay) {
  std::vector<Index> many(1000);
  std::iota(many.begin(), many.end(), Index{0});
  for (const std::vector<Index>& c : {std::vector<Index>{}, many}) {
    MatrixBuilder m = in_contact(5, 100);
    Condensed solver;
    solver.may_change(c);
    Mumps whole;
    EXPECT_EQ(solved(solver, m, Symmetry::indefinite), solved(whole, m, Symmetry::indefinite));
    EXPECT_EQ(solver.count().small, 0);
    EXPECT_EQ(solver.count().whole, 1);
  }
}

/// What a dense matrix is too dear for is factored whole, and keeps nothing of the other way.
TEST(Condensed, GoesBetweenWhatPaysAndWhatDoesNot) {
  std::vector<Index> many(600);
  std::iota(many.begin(), many.end(), Index{0});
  Condensed solver;
  int small = 0, all = 0;
  for (const bool pays : {false, false, true, true, false, true}) {
    solver.may_change(pays ? lowest() : many);
    MatrixBuilder m = in_contact(++all, 50);
    Mumps whole;
    const Eigen::VectorXd expected = solved(whole, m, Symmetry::indefinite);
    EXPECT_LE((solved(solver, m, Symmetry::indefinite) - expected).norm(), 1e-10 * expected.norm());
    small += pays ? 1 : 0;
    EXPECT_EQ(solver.count().small, small);
    EXPECT_EQ(solver.count().whole, all - small);
  }
}

/// Entries of contact come, then the others change, without a new analysis between.
TEST(Condensed, ContactComesAndThenAllElseChanges) {
  Condensed solver;
  solver.may_change(lowest());
  for (const int closed : {0, 4, 20}) {
    MatrixBuilder m = in_contact(closed, 50);
    m.add(0, static_cast<Index>(2 * closed + 20), 0.25);  // another pattern of the few
    m.add(static_cast<Index>(2 * closed + 20), 0, 0.25);
    (void)solved(solver, m, Symmetry::indefinite);
    const SparseMatrix& k = m.finish();
    for (Index u = 0; u < k.n; ++u) m.add(u, u, 0.1 * (closed + 1));
    Mumps whole;
    const Eigen::VectorXd expected = solved(whole, m, Symmetry::indefinite);
    EXPECT_LE((solved(solver, m, Symmetry::indefinite) - expected).norm(), 1e-10 * expected.norm());
  }
  EXPECT_EQ(solver.count().whole, 0);
}

TEST(Condensed, IsMumpsForMatricesOfAnotherSize) {
  Condensed solver;
  solver.may_change({100'000});
  MatrixBuilder m = in_contact(5, 100);
  Mumps whole;
  EXPECT_EQ(solved(solver, m, Symmetry::indefinite), solved(whole, m, Symmetry::indefinite));
}

/// What is singular or indefinite is looked at in the whole, so that it is reported as ever.
TEST(Condensed, ReportsOfBadMatricesAreThoseOfMumps) {
  MatrixBuilder loose = test::grid(width, height, false);
  MatrixBuilder negative = in_contact(5, -1e3);
  for (const Symmetry kind : {Symmetry::unsymmetric, Symmetry::indefinite})
    for (MatrixBuilder* const m : {&loose, &negative}) {
      Condensed solver;
      solver.may_change(lowest());
      Mumps whole;
      const SparseMatrix& k = m->finish();
      const FactorReport report = solver.factor(k, m->pattern_version(), kind);
      const FactorReport expected = whole.factor(k, m->pattern_version(), kind);
      EXPECT_EQ(report.status, expected.status);
      EXPECT_EQ(report.bad_row, expected.bad_row);
      EXPECT_EQ(report.negative_pivots, expected.negative_pivots);
      EXPECT_EQ(report.weakest, expected.weakest);
    }
}

TEST(Condensed, SeveralRightHandSidesAndNone) {
  MatrixBuilder m = in_contact(7, 50);
  const SparseMatrix& k = m.finish();
  Condensed solver;
  solver.may_change(lowest());
  ASSERT_EQ(solver.factor(k, 1, Symmetry::indefinite).status, SolveStatus::ok);
  Eigen::MatrixXd exact(k.n, 3), x(k.n, 3);
  for (Index i = 0; i < k.n; ++i) exact.row(i) << 1, i % 7, -0.01 * i;
  for (int c = 0; c < 3; ++c) x.col(c) = multiply(k, exact.col(c));
  ASSERT_EQ(solver.solve(x), SolveStatus::ok);
  EXPECT_LE((x - exact).norm(), 1e-10 * exact.norm());
  Eigen::MatrixXd none(k.n, 0);
  EXPECT_EQ(solver.solve(none), SolveStatus::ok);
  Eigen::VectorXd wrong = Eigen::VectorXd::Zero(3),
                  bad = Eigen::VectorXd::Constant(k.n, std::nan(""));
  EXPECT_EQ(solver.solve(wrong), SolveStatus::failed);
  EXPECT_EQ(solver.solve(bad), SolveStatus::failed);
}

}  // namespace
}  // namespace osculate::la
