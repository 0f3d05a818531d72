#include "osculate/la/nearby.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "grid.hpp"
#include "osculate/la/mumps.hpp"

namespace osculate::la {
namespace {

constexpr Index width = 20, height = 15;

/// A block on springs, with further ones of the stiffness `stiff` at `count` nodes of its lowest
/// row: one changed unknown each. With `shear` they have an unsymmetric part.
MatrixBuilder block(Index count, double stiff, double shear = 0) {
  MatrixBuilder m = test::grid(width, height, true);
  for (Index i = 0; i < count; ++i) {
    m.add(2 * i + 1, 2 * i + 1, stiff);
    if (shear != 0) m.add(2 * i, 2 * i + 1, shear * stiff);
  }
  return m;
}

Eigen::VectorXd load(Index n) { return Eigen::VectorXd::LinSpaced(n, -1, 2); }

struct Solved {
  Eigen::VectorXd by_factors, nearby;
  Nearby report;
  SparseMatrix k;
};

/// The block with `count` springs, by its own factors and by those of the block with none.
Solved solved(Index count, double stiff, Symmetry kind, const NearbyLimits& limits,
              double shear = 0) {
  MatrixBuilder before = block(0, 0), after = block(count, stiff, shear);
  Mumps former, own;
  EXPECT_EQ(former.factor(before.finish(), 1, kind).status, SolveStatus::ok);
  Solved s;
  s.k = after.finish();
  EXPECT_EQ(own.factor(s.k, 1, kind).status, SolveStatus::ok);
  s.by_factors = s.nearby = load(s.k.n);
  EXPECT_EQ(own.solve(s.by_factors), SolveStatus::ok);
  s.report = solve_nearby(s.k, kind, former, limits, s.nearby);
  return s;
}

// K = M + a change of rank r: K M^-1 has at most r + 1 different eigenvalues.
TEST(Nearby, TakesOneIterationMoreThanUnknownsHaveChanged) {
  for (const Symmetry kind :
       {Symmetry::unsymmetric, Symmetry::positive_definite, Symmetry::indefinite})
    for (const Index count : {0, 1, 3, 6}) {
      SCOPED_TRACE(count);
      const double shear = kind == Symmetry::unsymmetric ? 0.3 : 0.0;
      const Solved s = solved(count, 5.0, kind, {20, 1e-10}, shear);
      EXPECT_TRUE(s.report.solved);
      EXPECT_LE(s.report.iterations, count + 1);
      EXPECT_LT((s.nearby - s.by_factors).norm(), 1e-8 * s.by_factors.norm());
    }
}

TEST(Nearby, KeepsItsToleranceOrChangesNothing) {
  for (const double tolerance : {1e-2, 1e-5, 1e-9}) {
    const Solved s = solved(10, 2.0, Symmetry::unsymmetric, {40, tolerance}, 0.3);
    ASSERT_TRUE(s.report.solved) << tolerance << " " << s.report.iterations << " "
                                 << (load(s.k.n) - multiply(s.k, s.nearby)).norm() /
                                        load(s.k.n).norm();
    EXPECT_LE((load(s.k.n) - multiply(s.k, s.nearby)).norm(), tolerance * load(s.k.n).norm());
  }
  const Solved few = solved(10, 2.0, Symmetry::unsymmetric, {3, 1e-9}, 0.3);
  EXPECT_FALSE(few.report.solved);
  EXPECT_EQ(few.nearby, load(few.k.n));
}

// All that a change of rank six can do has been looked along for the first right-hand side.
TEST(Nearby, DoesNotLookTwiceAlongTheSame) {
  MatrixBuilder before = block(0, 0), after = block(6, 5.0, 0.3);
  Mumps former;
  ASSERT_EQ(former.factor(before.finish(), 1, Symmetry::unsymmetric).status, SolveStatus::ok);
  const SparseMatrix& k = after.finish();
  Eigen::VectorXd first = load(k.n), second = load(k.n).cwiseAbs2(), alone = second;
  NearbySolutions by(k, Symmetry::unsymmetric, former);
  const Nearby one = by.solve({20, 1e-10}, first), two = by.solve({20, 1e-10}, second);
  const Nearby by_itself = solve_nearby(k, Symmetry::unsymmetric, former, {20, 1e-10}, alone);
  ASSERT_TRUE(one.solved && two.solved && by_itself.solved);
  EXPECT_LE(two.iterations, 2);
  EXPECT_GT(by_itself.iterations, 4);
  EXPECT_LE((load(k.n).cwiseAbs2() - multiply(k, second)).norm(),
            1.1e-10 * load(k.n).cwiseAbs2().norm());
}

/// The factors are of the block on its left side's springs; asked about is the block with all its
/// nodes on soft springs, and on those of its left side or not.
Nearby is_held(bool held, double spring) {
  MatrixBuilder before = test::grid(width, height, true), after = test::grid(width, height, held);
  for (Index i = 0; i < after.finish().n; ++i) after.add(i, i, spring);
  Mumps former;
  EXPECT_EQ(former.factor(before.finish(), 1, Symmetry::unsymmetric).status, SolveStatus::ok);
  return NearbySolutions(after.finish(), Symmetry::unsymmetric, former).resists_all(60);
}

TEST(Nearby, NoiseTellsWhatNothingHolds) {
  EXPECT_TRUE(is_held(true, 0).solved);
  EXPECT_FALSE(is_held(false, 0).solved);
  EXPECT_FALSE(is_held(false, 1e-14).solved);  // a motion without a digit
  EXPECT_TRUE(is_held(false, 1e-3).solved);
}

/// The held block with springs of this stiffness at some nodes of its lowest row, by the factors of
/// the block without them.
Nearby is_positive(Index count, double stiff, Symmetry kind) {
  MatrixBuilder before = block(0, 0), after = block(count, stiff);
  Mumps former;
  EXPECT_EQ(former.factor(before.finish(), 1, kind).status, SolveStatus::ok);
  return NearbySolutions(after.finish(), kind, former).is_positive(60);
}

/// The stiffness of such springs below which the block is unstable.
double critical(Index count) {
  double stable = 0, unstable = -1e3;
  while (stable - unstable > 1e-6) {
    const double middle = 0.5 * (stable + unstable);
    MatrixBuilder after = block(count, middle);
    Mumps own;
    const FactorReport report = own.factor(after.finish(), 1, Symmetry::indefinite);
    (report.negative_pivots > 0 ? unstable : stable) = middle;
  }
  return stable;
}

TEST(Nearby, NoiseTellsOfNegativeEigenvalues) {
  for (const Symmetry kind : {Symmetry::positive_definite, Symmetry::indefinite})
    for (const Index count : {1, 3, 6}) {
      SCOPED_TRACE(count);
      const double least = critical(count);
      ASSERT_LT(least, -0.01);
      for (const double share : {-5.0, 0.0, 0.5, 0.99, 0.9999})
        EXPECT_TRUE(is_positive(count, share * least, kind).solved) << share;
      for (const double share : {1.0001, 1.01, 1.5, 20.0})
        EXPECT_FALSE(is_positive(count, share * least, kind).solved) << share;
    }
}

TEST(Nearby, NoiseTellsOfNegativeEigenvaluesAndOfWhatIsFreeAlike) {
  for (const bool held : {false, true}) {
    MatrixBuilder before = test::grid(width, height, true), after = test::grid(width, height, held);
    Mumps former;
    ASSERT_EQ(former.factor(before.finish(), 1, Symmetry::positive_definite).status,
              SolveStatus::ok);
    NearbySolutions by(after.finish(), Symmetry::positive_definite, former);
    EXPECT_EQ(by.is_positive(60).solved, held);
  }
}

/// A held block beside a small one of another stiffness, which is held in the factors alone or in
/// both.
bool tells_of_soft(double stiffness, bool held) {
  const auto both = [&](bool small_held) {
    MatrixBuilder big = test::grid(width, height, true), small = test::grid(3, 3, small_held);
    const SparseMatrix a = big.finish(), b = small.finish();
    MatrixBuilder all(a.n + b.n);
    const auto copy = [&all](const SparseMatrix& k, Index first, double factor) {
      for (Index i = 0; i < k.n; ++i)
        for (Index e = k.row_start[static_cast<std::size_t>(i)];
             e < k.row_start[static_cast<std::size_t>(i) + 1]; ++e)
          all.add(first + i, first + k.column[static_cast<std::size_t>(e)],
                  factor * k.value[static_cast<std::size_t>(e)]);
    };
    copy(a, 0, 1);
    copy(b, a.n, stiffness);
    return all;
  };
  MatrixBuilder before = both(true), after = both(held);
  Mumps former;
  EXPECT_EQ(former.factor(before.finish(), 1, Symmetry::unsymmetric).status, SolveStatus::ok);
  return NearbySolutions(after.finish(), Symmetry::unsymmetric, former).resists_all(60).solved;
}

TEST(Nearby, NoiseTellsOfSoftBodiesBesideStiffOnes) {
  for (const double stiffness : {1.0, 1e-4, 1e-6, 1e-8}) {
    SCOPED_TRACE(stiffness);
    EXPECT_TRUE(tells_of_soft(stiffness, true));
    EXPECT_FALSE(tells_of_soft(stiffness, false));
  }
}

TEST(Nearby, NoiseTellsOfUnknownsWithoutStiffness) {
  MatrixBuilder before = block(0, 0), after = block(0, 0);
  const Index n = before.finish().n;
  Mumps former;
  EXPECT_EQ(former.factor(before.finish(), 1, Symmetry::unsymmetric).status, SolveStatus::ok);
  SparseMatrix k = after.finish();
  for (Index i = 0; i < n; ++i)
    for (Index e = k.row_start[static_cast<std::size_t>(i)];
         e < k.row_start[static_cast<std::size_t>(i) + 1]; ++e)
      if (i == 7 || k.column[static_cast<std::size_t>(e)] == 7)
        k.value[static_cast<std::size_t>(e)] = 0;
  EXPECT_FALSE(NearbySolutions(k, Symmetry::unsymmetric, former).resists_all(60).solved);
  std::ranges::fill(k.value, 0.0);
  EXPECT_FALSE(NearbySolutions(k, Symmetry::unsymmetric, former).resists_all(60).solved);
}

TEST(Nearby, RefusesWhatIsNoNumberOrHasNoFactors) {
  MatrixBuilder m = block(0, 0);
  Mumps none;
  Eigen::VectorXd b = load(m.finish().n);
  EXPECT_FALSE(solve_nearby(m.finish(), Symmetry::unsymmetric, none, {5, 1e-8}, b).solved);
  EXPECT_EQ(b, load(b.size()));
  ASSERT_EQ(none.factor(m.finish(), 1, Symmetry::unsymmetric).status, SolveStatus::ok);
  b[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(solve_nearby(m.finish(), Symmetry::unsymmetric, none, {5, 1e-8}, b).solved);
  Eigen::VectorXd shorter = load(m.finish().n - 1);
  EXPECT_FALSE(solve_nearby(m.finish(), Symmetry::unsymmetric, none, {5, 1e-8}, shorter).solved);
}

// Beside a dense solver; and they stand in for those of the whole.
TEST(Nearby, FactorsTheSymmetricPart) {
  MatrixBuilder m = block(8, 2.0, 0.01);
  m.add(50, 3, 0.02);  // no entry across
  m.add(4, 51, 0.03);
  const SparseMatrix& k = m.finish();
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(k.n, k.n);
  for (Index row = 0; row < k.n; ++row)
    for (Index e = k.row_start[static_cast<std::size_t>(row)];
         e < k.row_start[static_cast<std::size_t>(row) + 1]; ++e)
      dense(row, k.column[static_cast<std::size_t>(e)]) = k.value[static_cast<std::size_t>(e)];
  ASSERT_GT((dense - dense.transpose()).norm(), 0.01);
  Mumps half;
  ASSERT_EQ(factor_symmetric_part(k, 1, half).status, SolveStatus::ok);
  const Eigen::VectorXd b = load(k.n);
  Eigen::VectorXd x = b, whole = b;
  ASSERT_EQ(half.solve(x), SolveStatus::ok);
  EXPECT_LT((0.5 * (dense + dense.transpose()) * x - b).norm(), 1e-11 * b.norm());
  EXPECT_GT((dense * x - b).norm(), 1e-6 * b.norm());
  EXPECT_TRUE(solve_nearby(k, Symmetry::unsymmetric, half, {20, 1e-11}, whole).solved);
  EXPECT_LE((dense * whole - b).norm(), 1.1e-11 * b.norm());
}

TEST(Nearby, IsAffordableWhereFactorsAreDear) {
  MatrixBuilder m = block(0, 0);
  const SparseMatrix& k = m.finish();
  FactorReport report;
  EXPECT_EQ(affordable_iterations(report, k), 0);  // a solver that does not say
  report.operations = 1e5;
  report.factor_entries = 20'000;
  EXPECT_GT(affordable_iterations(report, k), 5);
  EXPECT_LT(affordable_iterations(report, k), 20);
  report.operations = 1.5e10;
  report.factor_entries = 22'000'000;
  EXPECT_GT(affordable_iterations(report, k), 15);
  report.operations = 1e14;
  EXPECT_EQ(affordable_iterations(report, k), 40);
}

}  // namespace
}  // namespace osculate::la
