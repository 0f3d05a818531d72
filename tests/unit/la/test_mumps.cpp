#include "osculate/la/mumps.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <thread>
#include <utility>
#include <vector>

#include "grid.hpp"

namespace osculate::la {
namespace {

constexpr std::array<Symmetry, 3> kinds{Symmetry::unsymmetric, Symmetry::positive_definite,
                                        Symmetry::indefinite};
constexpr std::array<Symmetry, 2> pivoted{Symmetry::unsymmetric, Symmetry::indefinite};

MatrixBuilder from_dense(const Eigen::MatrixXd& full) {
  MatrixBuilder m(static_cast<Index>(full.rows()));
  for (Index i = 0; i < full.rows(); ++i)
    for (Index j = 0; j < full.cols(); ++j)
      if (full(i, j) != 0) m.add(i, j, full(i, j));
  return m;
}

/// A block without supports and three multipliers that hold its rigid motions.
MatrixBuilder held_by_multipliers(Index nx, Index ny) {
  MatrixBuilder block = test::grid(nx, ny, false);
  const SparseMatrix& k = block.finish();
  MatrixBuilder m(k.n + 3);
  for (Index i = 0; i < k.n; ++i)
    for (Index e = k.row_start[static_cast<std::size_t>(i)];
         e < k.row_start[static_cast<std::size_t>(i) + 1]; ++e)
      m.add(i, k.column[static_cast<std::size_t>(e)], k.value[static_cast<std::size_t>(e)]);
  const std::array<Index, 3> held{0, 1, 2 * nx + 1};
  for (Index c = 0; c < 3; ++c) {
    m.add(k.n + c, held[static_cast<std::size_t>(c)], 1);
    m.add(held[static_cast<std::size_t>(c)], k.n + c, 1);
  }
  return m;
}

TEST(Mumps, solves_like_dense_elimination) {
  for (const Symmetry kind : kinds)
    for (const Index size : {1, 6, 25}) {  // minimum degree and nested dissection
      MatrixBuilder m = test::grid(size, size, true);
      const SparseMatrix& k = m.finish();
      Mumps solver;
      const FactorReport report = solver.factor(k, m.pattern_version(), kind);
      ASSERT_EQ(report.status, SolveStatus::ok) << report.message;
      EXPECT_EQ(report.negative_pivots, 0);
      EXPECT_GT(report.factor_entries, k.n);
      const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(k.n, -1, 2);
      Eigen::VectorXd x = b;
      ASSERT_EQ(solver.solve(x), SolveStatus::ok);
      EXPECT_LE(relative_residual(k, x, b), 1e-12);
      const Eigen::VectorXd expected = test::dense(k).partialPivLu().solve(b);
      EXPECT_LE((x - expected).norm(), 1e-11 * expected.norm());
    }
}

TEST(Mumps, unsymmetric_values_are_not_transposed) {
  const Eigen::Matrix3d full{{4, 1, 0}, {-2, 5, 3}, {0, 0.5, 6}};
  MatrixBuilder m = from_dense(full);
  Mumps solver;
  ASSERT_EQ(solver.factor(m.finish(), 1, Symmetry::unsymmetric).status, SolveStatus::ok);
  Eigen::VectorXd x = full * Eigen::Vector3d(1, 2, 3);
  ASSERT_EQ(solver.solve(x), SolveStatus::ok);
  EXPECT_LE((x - Eigen::Vector3d(1, 2, 3)).norm(), 1e-14);
}

TEST(Mumps, symmetric_kinds_read_the_upper_triangle_alone) {
  const Eigen::Matrix2d full{{2, 1}, {99, 3}};
  for (const Symmetry kind : {Symmetry::positive_definite, Symmetry::indefinite}) {
    MatrixBuilder m = from_dense(full);
    Mumps solver;
    ASSERT_EQ(solver.factor(m.finish(), 1, kind).status, SolveStatus::ok);
    Eigen::VectorXd x = Eigen::Vector2d(4, 7);
    ASSERT_EQ(solver.solve(x), SolveStatus::ok);
    EXPECT_LE((x - Eigen::Vector2d(1, 2)).norm(), 1e-14);
  }
}

TEST(Mumps, several_right_hand_sides) {
  MatrixBuilder m = test::grid(12, 9, true);
  const SparseMatrix& k = m.finish();
  Mumps solver;
  ASSERT_EQ(solver.factor(k, 1, Symmetry::indefinite).status, SolveStatus::ok);
  Eigen::MatrixXd exact(k.n, 3);
  for (Index i = 0; i < k.n; ++i) exact.row(i) << 1, i % 7, -0.01 * i;
  Eigen::MatrixXd x(k.n, 3);
  for (int c = 0; c < 3; ++c) x.col(c) = multiply(k, exact.col(c));
  ASSERT_EQ(solver.solve(x), SolveStatus::ok);
  EXPECT_LE((x - exact).norm(), 1e-11 * exact.norm());
  Eigen::MatrixXd none(k.n, 0);
  EXPECT_EQ(solver.solve(none), SolveStatus::ok);
}

TEST(Mumps, empty_system) {
  Mumps solver;
  EXPECT_EQ(solver.factor({}, 1, Symmetry::unsymmetric).status, SolveStatus::ok);
  Eigen::VectorXd x(0);
  EXPECT_EQ(solver.solve(x), SolveStatus::ok);
  MatrixBuilder m = test::grid(2, 2, true);
  EXPECT_EQ(solver.factor(m.finish(), 1, Symmetry::unsymmetric).status, SolveStatus::ok);
}

TEST(Mumps, analysis_is_kept_while_pattern_and_symmetry_stand) {
  MatrixBuilder m = test::grid(10, 10, true);
  Mumps solver;
  const auto factor = [&](Symmetry kind) {
    const SparseMatrix& k = m.finish();
    return solver.factor(k, m.pattern_version(), kind).seconds_analysis;
  };
  EXPECT_GT(factor(Symmetry::indefinite), 0);
  m.add(3, 3, 1.0);
  EXPECT_EQ(factor(Symmetry::indefinite), 0);
  EXPECT_GT(factor(Symmetry::unsymmetric), 0);
  m.add(0, 200, 1.0);
  EXPECT_GT(factor(Symmetry::unsymmetric), 0);
  EXPECT_EQ(factor(Symmetry::unsymmetric), 0);
}

TEST(Mumps, another_pattern_under_the_same_version_is_noticed) {
  Mumps solver;
  const Eigen::Matrix3d first{{4, 1, 0}, {1, 4, 0}, {0, 0, 4}},
      second{{4, 0, 1}, {0, 4, 0}, {1, 0, 4}};
  for (const Eigen::Matrix3d& full : {first, second, first}) {
    MatrixBuilder m = from_dense(full);
    ASSERT_EQ(solver.factor(m.finish(), 1, Symmetry::indefinite).status, SolveStatus::ok);
    Eigen::VectorXd x = full * Eigen::Vector3d(1, 2, 3);
    ASSERT_EQ(solver.solve(x), SolveStatus::ok);
    EXPECT_LE((x - Eigen::Vector3d(1, 2, 3)).norm(), 1e-14);
  }
}

TEST(Mumps, same_bits_again_and_whatever_was_factored_before) {
  for (const Symmetry kind : kinds)
    for (const Index size : {8, 30}) {
      MatrixBuilder m = test::grid(size, size, true);
      const SparseMatrix& k = m.finish();
      const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(k.n, 1, 2);
      Mumps fresh, used;
      SparseMatrix other = k;  // same pattern, wildly scaled
      for (Index i = 0; i < k.n; ++i)
        for (Index e = k.row_start[static_cast<std::size_t>(i)];
             e < k.row_start[static_cast<std::size_t>(i) + 1]; ++e)
          other.value[static_cast<std::size_t>(e)] *=
              (1 + i % 13) * (1 + k.column[static_cast<std::size_t>(e)] % 13);
      ASSERT_EQ(used.factor(other, 1, kind).status, SolveStatus::ok);
      ASSERT_EQ(used.factor(k, 1, kind).status, SolveStatus::ok);
      ASSERT_EQ(fresh.factor(k, 1, kind).status, SolveStatus::ok);
      Eigen::VectorXd x = b, again = b, from_used = b;
      ASSERT_EQ(fresh.solve(x), SolveStatus::ok);
      ASSERT_EQ(fresh.solve(again), SolveStatus::ok);
      ASSERT_EQ(used.solve(from_used), SolveStatus::ok);
      EXPECT_EQ(x, again);
      EXPECT_EQ(x, from_used);
    }
}

TEST(Mumps, zero_row_is_named) {
  for (const Symmetry kind : kinds) {
    MatrixBuilder m(4);
    for (const Index i : {0, 1, 3}) m.add(i, i, 2.0 + i);
    Mumps solver;
    const FactorReport report = solver.factor(m.finish(), 1, kind);
    EXPECT_EQ(report.status, SolveStatus::singular);
    EXPECT_EQ(report.bad_row, 2);
    EXPECT_FALSE(report.message.empty());
    Eigen::VectorXd x = Eigen::VectorXd::Ones(4);
    EXPECT_EQ(solver.solve(x), SolveStatus::failed);  // no factors, no solution
    m.add(2, 2, 1.0);
    EXPECT_EQ(solver.factor(m.finish(), 1, kind).status, SolveStatus::ok);  // and it recovers
  }
}

TEST(Mumps, a_block_without_supports_is_singular_at_every_size) {
  for (const Symmetry kind : kinds)
    for (const Index size : {1, 4, 20, 60}) {
      MatrixBuilder m = test::grid(size, size, false);
      Mumps solver;
      const FactorReport report = solver.factor(m.finish(), 1, kind);
      EXPECT_EQ(report.status, SolveStatus::singular) << size;
      EXPECT_GE(report.bad_row, 0) << size;
    }
}

TEST(Mumps, one_free_block_beside_a_held_one_is_named) {
  MatrixBuilder held = test::grid(6, 6, true), loose = test::grid(3, 3, false);
  const Eigen::MatrixXd a = test::dense(held.finish()), b = test::dense(loose.finish());
  Eigen::MatrixXd both = Eigen::MatrixXd::Zero(a.rows() + b.rows(), a.rows() + b.rows());
  both.topLeftCorner(a.rows(), a.rows()) = a;
  both.bottomRightCorner(b.rows(), b.rows()) = b;
  MatrixBuilder m = from_dense(both);
  for (const Symmetry kind : kinds) {
    Mumps solver;
    const FactorReport report = solver.factor(m.finish(), 1, kind);
    EXPECT_EQ(report.status, SolveStatus::singular);
    EXPECT_GE(report.bad_row, a.rows());
  }
}

TEST(Mumps, stiff_penalties_and_slender_beams_are_not_singular) {
  for (const Symmetry kind : kinds) {
    MatrixBuilder penalty = test::grid(20, 20, true);
    for (const Index i : {700, 800})
      for (const Index j : {700, 800}) penalty.add(i, j, i == j ? 1e10 : -1e10);
    MatrixBuilder beam = test::grid(500, 1, true);
    Mumps solver;
    EXPECT_EQ(solver.factor(penalty.finish(), 1, kind).status, SolveStatus::ok);
    EXPECT_EQ(solver.factor(beam.finish(), 1, kind).status, SolveStatus::ok);
  }
}

/// A free block on a bed of next to nothing: what it resists least are its rigid motions.
TEST(Mumps, what_is_hardly_held_is_told_with_its_weakest_mode) {
  MatrixBuilder m = test::grid(6, 6, false);
  const SparseMatrix free = m.finish();
  MatrixBuilder bed = test::grid(6, 6, false);
  for (Index i = 0; i < free.n; ++i) bed.add(i, i, 1e-16 * test::dense(free).norm());
  for (const Symmetry kind : kinds) {
    Mumps solver;
    const FactorReport report = solver.factor(bed.finish(), 1, kind);
    ASSERT_EQ(report.status, SolveStatus::singular);
    EXPECT_GT(report.condition, 1e12);
    ASSERT_EQ(report.weakest.size(), free.n);
    EXPECT_LT(multiply(free, report.weakest).norm(),
              1e-10 * test::dense(free).norm() * report.weakest.norm());
    EXPECT_GE(report.bad_row, 0);
    Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(free.n, -1, 2);
    EXPECT_EQ(solver.solve(x), SolveStatus::ok);  // for those who know that it is held
  }
}

TEST(Mumps, units_do_not_decide_what_is_singular) {
  for (const double unit : {1e-30, 1e-9, 1e12, 1e30}) {
    MatrixBuilder held = test::grid(8, 8, true), loose = test::grid(8, 8, false);
    SparseMatrix k = held.finish(), free = loose.finish();
    for (double& v : k.value) v *= unit;
    for (double& v : free.value) v *= unit;
    for (const Symmetry kind : kinds) {
      Mumps solver;
      EXPECT_EQ(solver.factor(k, 1, kind).status, SolveStatus::ok) << unit;
      EXPECT_EQ(solver.factor(free, 2, kind).status, SolveStatus::singular) << unit;
    }
  }
}

TEST(Mumps, multipliers_are_counted_as_negative_pivots) {
  for (const Index size : {4, 25}) {
    MatrixBuilder m = held_by_multipliers(size, size);
    const SparseMatrix& k = m.finish();
    for (const Symmetry kind : pivoted) {
      Mumps solver;
      const FactorReport report = solver.factor(k, 1, kind);
      ASSERT_EQ(report.status, SolveStatus::ok) << report.message;
      EXPECT_EQ(report.negative_pivots, kind == Symmetry::indefinite ? 3 : 0);
      const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(k.n, -1, 1);
      Eigen::VectorXd x = b;
      ASSERT_EQ(solver.solve(x), SolveStatus::ok);
      EXPECT_LE(relative_residual(k, x, b), 1e-11);
    }
  }
}

TEST(Mumps, a_wrong_promise_of_definiteness_is_told) {
  MatrixBuilder swap = from_dense(Eigen::Matrix2d{{0, 1}, {1, 0}});
  Mumps solver;
  const FactorReport report = solver.factor(swap.finish(), 1, Symmetry::positive_definite);
  EXPECT_EQ(report.status, SolveStatus::failed);
  EXPECT_NE(report.message.find("positive definite"), std::string::npos);
  MatrixBuilder negative = from_dense(Eigen::Matrix2d{{1, 0}, {0, -1}});
  EXPECT_EQ(solver.factor(negative.finish(), 1, Symmetry::positive_definite).negative_pivots, 1);
}

TEST(Mumps, what_is_not_finite_fails_with_a_message) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
    for (const Symmetry kind : kinds) {
      MatrixBuilder m = test::grid(3, 3, true);
      SparseMatrix k = m.finish();
      Mumps solver;
      const SparseMatrix good = k;
      k.value[static_cast<std::size_t>(k.row_start[8])] = bad;  // in the lower triangle
      const FactorReport report = solver.factor(k, 1, kind);
      EXPECT_EQ(report.status, SolveStatus::failed);
      EXPECT_EQ(report.bad_row, 8);
      EXPECT_FALSE(report.message.empty());
      ASSERT_EQ(solver.factor(good, 1, kind).status, SolveStatus::ok);
      Eigen::VectorXd x = Eigen::VectorXd::Constant(k.n, bad);
      EXPECT_EQ(solver.solve(x), SolveStatus::failed);
      Eigen::VectorXd wrong_size = Eigen::VectorXd::Ones(k.n + 1);
      EXPECT_EQ(solver.solve(wrong_size), SolveStatus::failed);
    }
}

TEST(Mumps, outlives_its_matrix) {
  Mumps solver;
  Eigen::VectorXd x;
  {
    MatrixBuilder m = test::grid(6, 6, true);
    const SparseMatrix& k = m.finish();
    ASSERT_EQ(solver.factor(k, 1, Symmetry::unsymmetric).status, SolveStatus::ok);
    x = Eigen::VectorXd::Ones(k.n);
    ASSERT_EQ(solver.solve(x), SolveStatus::ok);
  }
  Eigen::VectorXd y = Eigen::VectorXd::Ones(x.size());
  EXPECT_EQ(solver.solve(y), SolveStatus::ok);
  EXPECT_EQ(y, x);
}

TEST(Mumps, factors_alone_solve_once) {
  MatrixBuilder m = test::grid(25, 25, true);
  const SparseMatrix& k = m.finish();
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(k.n, -1, 2);
  Mumps solver;
  ASSERT_EQ(solver.factor(k, 0, Symmetry::unsymmetric).status, SolveStatus::ok);
  Eigen::VectorXd before = b, after = b, refined = b;
  ASSERT_EQ(solver.solve_once(before), SolveStatus::ok);
  solver.keep_factors_alone();
  ASSERT_EQ(solver.solve_once(after), SolveStatus::ok);
  EXPECT_EQ(after, before);
  EXPECT_EQ(solver.solve(refined), SolveStatus::failed);  // there is no matrix for its residual
  Eigen::MatrixXd several = b;
  EXPECT_EQ(solver.solve(several), SolveStatus::failed);
  ASSERT_EQ(solver.factor(k, 0, Symmetry::unsymmetric).status, SolveStatus::ok);
  ASSERT_EQ(solver.solve(refined), SolveStatus::ok);
  EXPECT_LT((refined - before).norm(), 1e-9 * before.norm());
}

TEST(Mumps, several_live_at_once_on_several_threads) {
  MatrixBuilder m = test::grid(20, 20, true);
  const SparseMatrix& k = m.finish();
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(k.n);
  const auto work = [&](Eigen::VectorXd& x) {
    for (int repeat = 0; repeat < 5; ++repeat) {
      Mumps solver;
      x = b;
      if (solver.factor(k, 1, Symmetry::indefinite).status != SolveStatus::ok ||
          solver.solve(x) != SolveStatus::ok)
        x.setZero();
    }
  };
  std::array<Eigen::VectorXd, 3> x;
  std::vector<std::thread> threads;
  for (Eigen::VectorXd& own : x) threads.emplace_back(work, std::ref(own));
  for (std::thread& thread : threads) thread.join();
  EXPECT_GT(x[0].norm(), 0);
  EXPECT_EQ(x[0], x[1]);
  EXPECT_EQ(x[0], x[2]);
}

}  // namespace
}  // namespace osculate::la
