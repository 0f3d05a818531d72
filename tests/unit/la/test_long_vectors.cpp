#include "osculate/la/long_vectors.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "osculate/la/preconditioned.hpp"

namespace osculate::la {
namespace {

const std::vector<Eigen::Index> sizes{0,     1, vector_piece - 1, vector_piece, vector_piece + 1,
                                      50'000};

TEST(LongVectors, PiecesMeetEveryNumberOnce) {
  for (const int threads : {1, 2, 5}) {
    core::Crew crew(threads);
    for (const Eigen::Index n : sizes)
      for (core::Crew* const by : {&crew, static_cast<core::Crew*>(nullptr)}) {
        Eigen::VectorXd met = Eigen::VectorXd::Zero(n);
        for_vector_pieces(n, by, [&](Eigen::Index first, Eigen::Index size) {
          EXPECT_GT(size, 0);
          met.segment(first, size).array() += 1;
        });
        EXPECT_EQ(met, Eigen::VectorXd::Ones(n));
      }
  }
}

TEST(LongVectors, SumsHaveTheSameBitsByAnyNumberOfThreads) {
  for (const Eigen::Index n : sizes) {
    const Eigen::VectorXd v = noise(n);
    const auto sum = [&](core::Crew* crew) {
      return sum_over_pieces(n, 2, crew, [&](Eigen::Index first, Eigen::Index size, auto to) {
        to[0] = v.segment(first, size).sum();
        to[1] = v.segment(first, size).squaredNorm();
      });
    };
    const Eigen::VectorXd alone = sum(nullptr);
    EXPECT_NEAR(alone[0], v.sum(), 1e-11);
    EXPECT_NEAR(alone[1], v.squaredNorm(), 1e-13 * static_cast<double>(n));
    for (const int threads : {1, 2, 5}) {
      core::Crew crew(threads);
      EXPECT_EQ(sum(&crew), alone);
      EXPECT_EQ(norm(v, &crew), norm(v, nullptr));
    }
  }
}

TEST(LongVectors, NormsOfSmallAndOfLargeNumbers) {
  for (const double size : {0.0, 1e-200, 1e-5, 1.0, 1e200}) {
    const Eigen::VectorXd v = Eigen::VectorXd::Constant(40'000, size);
    EXPECT_NEAR(norm(v, nullptr), 200 * size, 1e-14 * 200 * size);
  }
}

// A matrix of a chain, diagonal blocks as what is near to it: long enough for several runs.
TEST(LongVectors, SolutionsHaveTheSameBitsByAnyNumberOfThreads) {
  constexpr Eigen::Index n = 40'000;
  const Eigen::VectorXd b = noise(n);
  const auto multiply = [](const Eigen::VectorXd& x, Eigen::VectorXd& y) {
    y = 4 * x;
    y.head(n - 1) -= x.tail(n - 1);
    y.tail(n - 1) -= x.head(n - 1);
  };
  const auto solved = [&](core::Crew* crew) {
    PreconditionedSolutions by(
        multiply,
        [](Eigen::VectorXd& r) {
          r /= 4;
          return true;
        },
        nullptr, crew);
    Eigen::VectorXd x = b;
    const Nearby done = by.solve({.tolerance = 1e-12}, x);
    EXPECT_TRUE(done.solved);
    EXPECT_GT(done.iterations, 10);
    return x;
  };
  const Eigen::VectorXd alone = solved(nullptr);
  Eigen::VectorXd back;
  multiply(alone, back);
  EXPECT_LE((back - b).norm(), 2e-12 * b.norm());
  for (const int threads : {1, 3}) {
    core::Crew crew(threads);
    EXPECT_EQ(solved(&crew), alone);
  }
}

}  // namespace
}  // namespace osculate::la
