// Smallest eigenvalues: a chain of springs with its closed solution, several equal ones, free
// motions, rows without mass, and what is said where there are none.
#include "osculate/la/eigenpairs.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <numbers>

namespace osculate::la {
namespace {

/// Masses 1 in a row between springs 1; the first and the last one hang on walls where `held`.
void add_chain(Index first, Index n, bool held, MatrixBuilder& k) {
  for (Index i = 0; i < n; ++i) {
    k.add(first + i, first + i, held || (i > 0 && i + 1 < n) ? 2 : 1);
    if (i + 1 == n) continue;
    k.add(first + i, first + i + 1, -1);
    k.add(first + i + 1, first + i, -1);
  }
}

SparseMatrix unit(Index n, Index without_mass = -1) {
  MatrixBuilder m(n);
  for (Index i = 0; i < n; ++i) m.add(i, i, i == without_mass ? 0 : 1);
  return m.finish();
}

double of_chain(int mode, Index n) {
  const double s = std::sin(mode * std::numbers::pi / (2 * (n + 1)));
  return 4 * s * s;
}

TEST(Eigenpairs, OfAChainAreThoseOfItsClosedSolution) {
  constexpr Index n = 60;
  MatrixBuilder k(n);
  add_chain(0, n, true, k);
  const auto solver = make_default_solver();
  const Eigenpairs found = smallest_eigenpairs(k.finish(), unit(n), 6, *solver);
  ASSERT_EQ(found.failure, "");
  ASSERT_EQ(found.values.size(), 6);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(found.values[i] / of_chain(i + 1, n), 1, 1e-11);
  EXPECT_NEAR((found.vectors.transpose() * found.vectors - Eigen::MatrixXd::Identity(6, 6)).norm(),
              0, 1e-9);
  EXPECT_LT(found.residual, 1e-9);
  EXPECT_EQ(found.missing, 0);
  EXPECT_EQ(found.shift, 0);
}

// Three chains next to each other: every eigenvalue three times.
TEST(Eigenpairs, FindEqualOnesAsOftenAsTheyAre) {
  constexpr Index n = 30;
  MatrixBuilder k(3 * n);
  for (Index c = 0; c < 3; ++c) add_chain(c * n, n, true, k);
  const auto solver = make_default_solver();
  const Eigenpairs found = smallest_eigenpairs(k.finish(), unit(3 * n), 6, *solver);
  ASSERT_EQ(found.failure, "");
  EXPECT_EQ(found.missing, 0);
  for (Eigen::Index i = 0; i < 6; ++i)
    EXPECT_NEAR(found.values[i] / of_chain(1 + static_cast<int>(i) / 3, n), 1, 1e-9) << i;
}

TEST(Eigenpairs, OfFreeChainsBeginWithZeros) {
  constexpr Index n = 40;
  MatrixBuilder k(2 * n);
  for (Index c = 0; c < 2; ++c) add_chain(c * n, n, false, k);
  const auto solver = make_default_solver();
  const Eigenpairs found = smallest_eigenpairs(k.finish(), unit(2 * n), 4, *solver);
  ASSERT_EQ(found.failure, "");
  EXPECT_LT(found.shift, 0);
  EXPECT_EQ(found.missing, 0);
  const double s = std::sin(std::numbers::pi / (2 * n));
  EXPECT_EQ(found.values[0], 0);
  EXPECT_EQ(found.values[1], 0);
  EXPECT_EQ(found.without_stiffness(), 2);
  EXPECT_LT(found.residual, 1e-6);
  EXPECT_NEAR(found.values[2] / (4 * s * s), 1, 1e-8);
  EXPECT_NEAR(found.values[3] / (4 * s * s), 1, 1e-8);
}

// What rounding makes of a free motion is zero; a spring of 1e-9, or one that pushes, is not.
TEST(Eigenpairs, TellSoftFromFree) {
  constexpr Index n = 40;
  for (const double soft : {1e-9, -1e-9})
    for (const int count : {1, 2, 3, 4, 5}) {
      SCOPED_TRACE(count);
      MatrixBuilder k(n);
      add_chain(0, n, false, k);
      k.add(0, 0, soft);
      const auto solver = make_default_solver();
      const Eigenpairs found = smallest_eigenpairs(k.finish(), unit(n), count, *solver);
      ASSERT_EQ(found.failure, "");
      EXPECT_EQ(found.values.size(), count);
      EXPECT_EQ(found.without_stiffness(), 0);
      EXPECT_EQ(found.missing, 0);
      EXPECT_NEAR(found.values[0] / (soft / n), 1, 1e-3);
      EXPECT_LT(found.rounding, 1e-13);
    }
}

// Where the last one is equal to the next, as many as were asked for.
TEST(Eigenpairs, AreAsManyAsWanted) {
  constexpr Index n = 200;
  MatrixBuilder k(2 * n);
  for (Index c = 0; c < 2; ++c) add_chain(c * n, n, true, k);
  for (const int count : {1, 2, 5, 8, 9}) {
    const auto solver = make_default_solver();
    const Eigenpairs found = smallest_eigenpairs(k.finish(), unit(2 * n), count, *solver);
    ASSERT_EQ(found.failure, "");
    ASSERT_EQ(found.values.size(), count);
    EXPECT_EQ(found.vectors.cols(), count);
    EXPECT_EQ(found.missing, 0);
    EXPECT_LT(found.residual, 1e-9);
    for (Eigen::Index i = 0; i < count; ++i)
      EXPECT_NEAR(found.values[i] / of_chain(1 + static_cast<int>(i) / 2, n), 1, 1e-10) << i;
  }
}

// A point without mass between two springs follows, also one that is pushed away.
TEST(Eigenpairs, LeaveOutWhatHasNoMass) {
  for (const double own : {2.0, -5.0}) {
    MatrixBuilder k(3);
    k.add(0, 0, 2), k.add(2, 2, 2), k.add(1, 1, own);
    for (const Index i : {0, 2}) k.add(i, 1, -1), k.add(1, i, -1);
    const auto solver = make_default_solver();
    const Eigenpairs found = smallest_eigenpairs(k.finish(), unit(3, 1), 1, *solver);
    ASSERT_EQ(found.failure, "");
    EXPECT_EQ(found.missing, 0) << own;
    EXPECT_NEAR(found.values[0], std::min(2.0, 2 - 2 / own), 1e-12);
    EXPECT_NEAR(found.vectors(1, 0), (found.vectors(0, 0) + found.vectors(2, 0)) / own, 1e-12);
  }
}

// As many as there are masses, one alone among them; rows without mass follow.
TEST(Eigenpairs, AreAllThereWhereFewHaveAMass) {
  constexpr Index n = 5;
  MatrixBuilder k(n);
  add_chain(0, n, true, k);
  const auto solver = make_default_solver();
  const Eigenpairs all = smallest_eigenpairs(k.finish(), unit(n), 9, *solver);
  ASSERT_EQ(all.failure, "");
  ASSERT_EQ(all.values.size(), n);
  for (int i = 0; i < n; ++i) EXPECT_NEAR(all.values[i], of_chain(i + 1, n), 1e-13);
  EXPECT_LT(all.residual, 1e-12);
  MatrixBuilder m(n);
  for (Index i = 0; i < n; ++i) m.add(i, i, i == 2 ? 4 : 0);
  const Eigenpairs one = smallest_eigenpairs(k.finish(), m.finish(), 1, *solver);
  ASSERT_EQ(one.failure, "");
  EXPECT_NEAR(one.values[0], (2 - 4.0 / 3) / 4, 1e-14);  // two springs 1/3 beside it
  EXPECT_NEAR(one.vectors(1, 0), 2.0 / 3 * one.vectors(2, 0), 1e-14);
}

// A multiplier holds two masses together: it makes no vibration of its own.
TEST(Eigenpairs, OfFewMassesThatAMultiplierHolds) {
  MatrixBuilder k(4);
  add_chain(0, 3, true, k);
  k.add(0, 3, 1);
  k.add(3, 0, 1);
  k.add(1, 3, -1);
  k.add(3, 1, -1);
  MatrixBuilder m(4);
  for (Index i = 0; i < 3; ++i) m.add(i, i, 1);
  const auto solver = make_default_solver();
  const Eigenpairs found = smallest_eigenpairs(k.finish(), m.finish(), 4, *solver);
  ASSERT_EQ(found.failure, "");
  ASSERT_EQ(found.values.size(), 2);  // of masses 2 and 1 on springs 1, 1 and 1
  EXPECT_NEAR(found.values[0], (3 - std::sqrt(3.0)) / 2, 1e-12);
  EXPECT_NEAR(found.values[1], (3 + std::sqrt(3.0)) / 2, 1e-12);
}

/// x = T q with a complex T, beside Eigen's solver for Hermitian matrices.
TEST(Eigenpairs, OfComplexCombinations) {
  constexpr Index n = 24, columns = n - 3;
  MatrixBuilder k(n), m(n);
  add_chain(0, n, true, k);
  for (Index i = 0; i < n; ++i) m.add(i, i, 1 + 0.1 * static_cast<double>(i % 5));
  std::vector<ComplexEntry> t;
  for (Index i = 0; i < columns; ++i) t.push_back({i, i, 1.0});
  for (Index i = 0; i < 3; ++i)
    for (Index j = 0; j < 2; ++j)
      t.push_back({columns + i, 4 * i + j, std::polar(0.6 + 0.1 * j, 0.7 + 0.2 * i)});
  Eigen::MatrixXcd by = Eigen::MatrixXcd::Zero(n, columns);
  for (const ComplexEntry& e : t) by(e.row, e.column) = e.value;
  const auto dense = [](const SparseMatrix& a) {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(a.n, a.n);
    for (Index row = 0; row < a.n; ++row)
      for (Index at = a.row_start[static_cast<std::size_t>(row)];
           at < a.row_start[static_cast<std::size_t>(row) + 1]; ++at)
        out(row, a.column[static_cast<std::size_t>(at)]) = a.value[static_cast<std::size_t>(at)];
    return out;
  };
  const SparseMatrix stiffness = k.finish(), mass = m.finish();
  const Eigen::MatrixXd dk = dense(stiffness), dm = dense(mass);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXcd> exact(by.adjoint() * dk * by,
                                                                         by.adjoint() * dm * by);
  const auto solver = make_default_solver();
  const Eigenpairs found = smallest_eigenpairs(stiffness, mass, t, columns, 7, *solver);
  ASSERT_EQ(found.failure, "");
  ASSERT_EQ(found.values.size(), 7);
  EXPECT_EQ(found.missing, 0);
  for (Eigen::Index i = 0; i < 7; ++i) {
    const double value = exact.eigenvalues()[i / 2];
    EXPECT_NEAR(found.values[i], value, 1e-10);
    Eigen::VectorXcd x(n);
    x.real() = found.vectors.col(i).head(n);
    x.imag() = found.vectors.col(i).tail(n);
    EXPECT_NEAR((x.adjoint() * dm * x)(0).real(), 1, 1e-10);
    EXPECT_LT((by.adjoint() * (dk * x - value * dm * x)).norm(), 1e-9);
    EXPECT_LT((by.bottomRows(3) * x.head(columns) - x.tail(3)).norm(), 1e-12);
  }
  SparseMatrix light = mass;  // in other units
  for (double& value : light.value) value *= 1e-17;
  const Eigenpairs fast = smallest_eigenpairs(stiffness, light, t, columns, 7, *solver);
  ASSERT_EQ(fast.values.size(), 7);
  for (Eigen::Index i = 0; i < 7; ++i)
    EXPECT_NEAR(1e-17 * fast.values[i], exact.eigenvalues()[i / 2], 1e-10);
  EXPECT_LT(fast.residual, 1e-9);
  for (ComplexEntry& e : t) e.value = e.value.real();
  const Eigenpairs real = smallest_eigenpairs(stiffness, mass, t, columns, 4, *solver);
  EXPECT_EQ(real.vectors.rows(), n);
  const Eigen::MatrixXd alone = by.real();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> exact_real(
      alone.transpose() * dk * alone, alone.transpose() * dm * alone);
  for (Eigen::Index i = 0; i < 4; ++i)
    EXPECT_NEAR(real.values[i], exact_real.eigenvalues()[i], 1e-10);
}

// Masses may join unknowns that no stiffness joins.
TEST(Eigenpairs, OfSpringsOfTheirOwnThatMassesJoin) {
  constexpr Index n = 60;
  MatrixBuilder k(n), m(n);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n), mass = Eigen::MatrixXd::Identity(n, n);
  for (Index i = 0; i < n; ++i) {
    stiffness(i, i) = 1 + 0.1 * i;
    if (i + 2 < n) mass(i, i + 2) = mass(i + 2, i) = 0.3;
  }
  for (Index i = 0; i < n; ++i) {
    k.add(i, i, stiffness(i, i));
    for (Index j = 0; j < n; ++j)
      if (mass(i, j) != 0) m.add(i, j, mass(i, j));
  }
  const auto solver = make_default_solver();
  const Eigenpairs pairs = smallest_eigenpairs(k.finish(), m.finish(), 4, *solver);
  ASSERT_EQ(pairs.failure, "");
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> all(stiffness, mass);
  EXPECT_LT((pairs.values - all.eigenvalues().head(4)).norm(), 1e-10);
}

// 24 masses, each on the mean of four unknowns: Lanczos' method wants more motions than there are.
TEST(Eigenpairs, OfMassesOnMeansAreRightOrNone) {
  constexpr Index n = 120, masses = 24, each = 4;
  MatrixBuilder k(n), m(n);
  add_chain(0, n, true, k);
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(n, n);
  for (Index g = 0; g < masses; ++g)
    mass.block(each * g, each * g, each, each).setConstant(1.0 / (each * each));
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      if (mass(i, j) != 0) m.add(i, j, mass(i, j));
  const SparseMatrix stiffness = k.finish(), of_masses = m.finish();
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index e = stiffness.row_start[static_cast<std::size_t>(i)];
         e < stiffness.row_start[static_cast<std::size_t>(i) + 1]; ++e)
      dense(i, stiffness.column[static_cast<std::size_t>(e)]) =
          stiffness.value[static_cast<std::size_t>(e)];
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> inverse(mass, dense);
  int found = 0;
  for (int count = 1; count < 12; ++count) {
    const auto solver = make_default_solver();
    const Eigenpairs pairs = smallest_eigenpairs(stiffness, of_masses, count, *solver);
    if (!pairs.failure.empty()) continue;
    ++found;
    for (Eigen::Index i = 0; i < count; ++i)
      EXPECT_NEAR(pairs.values[i] * inverse.eigenvalues()[n - 1 - i], 1, 1e-9) << count << ' ' << i;
  }
  EXPECT_GE(found, 4);
}

TEST(Eigenpairs, SayWhyThereAreNone) {
  MatrixBuilder k(3);
  add_chain(0, 3, true, k);
  const auto solver = make_default_solver();
  MatrixBuilder nothing(3);
  const Eigenpairs none = smallest_eigenpairs(k.finish(), nothing.finish(), 1, *solver);
  EXPECT_NE(none.failure.find("too few"), std::string::npos) << none.failure;
}

}  // namespace
}  // namespace osculate::la
