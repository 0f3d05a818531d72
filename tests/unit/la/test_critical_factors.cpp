// Critical factors: chains with their closed solution, loads of both signs, multipliers, and what
// is said where there are none.
#include "osculate/la/critical_factors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace osculate::la {
namespace {

/// Springs 1 between walls and n places, from row `first` on.
void add_springs(Index first, Index n, MatrixBuilder& k) {
  for (Index i = 0; i < n; ++i) {
    k.add(first + i, first + i, 2);
    if (i + 1 == n) continue;
    k.add(first + i, first + i + 1, -1);
    k.add(first + i + 1, first + i, -1);
  }
}
/// Each place is pushed away by `size` times its displacement.
void add_push(Index first, Index n, double size, MatrixBuilder& a) {
  for (Index i = 0; i < n; ++i) a.add(first + i, first + i, -size);
}

/// Of the unit push.
double factor_of_springs(int mode, Index n) {
  const double s = std::sin(mode * std::numbers::pi / (2 * (n + 1)));
  return 4 * s * s;
}

/// Chains side by side, pushed by these sizes.
CriticalFactors of_chains(Index n, const std::vector<double>& sizes, int count) {
  const auto rows = n * static_cast<Index>(sizes.size());
  MatrixBuilder k(rows), a(rows);
  for (std::size_t c = 0; c < sizes.size(); ++c) {
    add_springs(static_cast<Index>(c) * n, n, k);
    add_push(static_cast<Index>(c) * n, n, sizes[c], a);
  }
  const auto solver = make_default_solver();
  return critical_factors(k.finish(), a.finish(), 0, count, *solver);
}

TEST(CriticalFactors, OfAChainAreThoseOfItsClosedSolution) {
  for (const Index n : {20, 200}) {  // all at once, and by Lanczos' method
    const CriticalFactors found = of_chains(n, {1}, 4);
    ASSERT_EQ(found.failure, "");
    ASSERT_EQ(found.values.size(), 4);
    for (int i = 0; i < 4; ++i)
      EXPECT_NEAR(found.values[i] / factor_of_springs(i + 1, n), 1, 1e-9) << i;
    EXPECT_EQ(found.missing, 0);
    EXPECT_LT(found.residual, 1e-8);
    EXPECT_FALSE(found.reversed) << *found.reversed;
  }
}

// One of the three is pulled: it buckles by the reversed load alone.
TEST(CriticalFactors, OfLoadsOfBothSigns) {
  for (const Index n : {20, 120}) {
    const CriticalFactors found = of_chains(n, {1, -2, 1}, 6);
    ASSERT_EQ(found.failure, "");
    ASSERT_EQ(found.values.size(), 6);
    for (Eigen::Index i = 0; i < 6; ++i)  // each twice
      EXPECT_NEAR(found.values[i] / factor_of_springs(1 + static_cast<int>(i) / 2, n), 1, 1e-9);
    EXPECT_EQ(found.missing, 0);
    ASSERT_TRUE(found.reversed);
    EXPECT_NEAR(*found.reversed / (-0.5 * factor_of_springs(1, n)), 1, 1e-9);
  }
}

TEST(CriticalFactors, OfAPullThereAreNone) {
  for (const Index n : {20, 200}) {
    const CriticalFactors found = of_chains(n, {-1}, 2);
    EXPECT_EQ(found.failure, "");
    EXPECT_EQ(found.values.size(), 0);
    ASSERT_TRUE(found.reversed);
    EXPECT_NEAR(*found.reversed / -factor_of_springs(1, n), 1, 1e-9);
  }
}

// A multiplier holds the middle of an odd chain: what is left are two chains of half its length.
TEST(CriticalFactors, OfWhatAMultiplierHolds) {
  for (const Index half : {9, 99}) {
    const Index n = 2 * half + 1;
    MatrixBuilder k(n + 1), a(n + 1);
    add_springs(0, n, k);
    k.add(n, half, 1), k.add(half, n, 1);
    add_push(0, n, 1, a);
    const auto solver = make_default_solver();
    const CriticalFactors found = critical_factors(k.finish(), a.finish(), 1, 4, *solver);
    ASSERT_EQ(found.failure, "");
    ASSERT_EQ(found.values.size(), 4);
    for (Eigen::Index i = 0; i < 4; ++i)
      EXPECT_NEAR(found.values[i] / factor_of_springs(1 + static_cast<int>(i) / 2, half), 1, 1e-9);
    EXPECT_EQ(found.missing, 0);
    for (Eigen::Index i = 0; i < 4; ++i) EXPECT_NEAR(found.vectors(half, i), 0, 1e-9);
  }
}

TEST(CriticalFactors, SayWhyThereAreNone) {
  const auto solver = make_default_solver();
  MatrixBuilder loose(2), pushed(2), soft(2);
  loose.add(0, 0, 1);
  pushed.add(0, 0, -1);
  soft.add(0, 0, 1), soft.add(1, 1, -1);
  EXPECT_EQ(critical_factors(loose.finish(), pushed.finish(), 0, 1, *solver).failure,
            "something is free to move");
  EXPECT_EQ(critical_factors(soft.finish(), pushed.finish(), 0, 1, *solver).failure,
            "the state before is not stable itself");
}

}  // namespace
}  // namespace osculate::la
