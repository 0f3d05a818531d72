// Four numbers at once are what they are one by one.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "osculate/core/pack.hpp"

namespace osculate::core {
namespace {

TEST(Pack, CalculatesEachNumber) {
  const Pack a(0.3, -2, 1e-9, 7), b(2, 5, -0.25, 1e3);
  for (int i = 0; i < Pack::count; ++i) {
    EXPECT_EQ((a + b)[i], a[i] + b[i]);
    EXPECT_EQ((a - b)[i], a[i] - b[i]);
    EXPECT_EQ((2 * a * b)[i], 2 * a[i] * b[i]);
    EXPECT_EQ((a / b)[i], a[i] / b[i]);
    EXPECT_EQ((-a)[i], -a[i]);
    EXPECT_EQ(abs(a)[i], std::abs(a[i]));
    EXPECT_NEAR(log(abs(b))[i], std::log(std::abs(b[i])), 1e-15 * std::abs(std::log(1e3)));
    EXPECT_DOUBLE_EQ(cube_root_of(b)[i], std::cbrt(b[i]));
    EXPECT_EQ(square_root_of(b * b)[i], std::abs(b[i]));
    EXPECT_EQ(larger_of(a, b)[i], std::max(a[i], b[i]));
  }
  Pack c = a;
  c += b;
  c -= a;
  c *= Pack(2.0);
  EXPECT_EQ(c[1], 10);
  c.set(1, 3);
  EXPECT_EQ(c[1], 3);
}

TEST(Pack, AllMeansEach) {
  const Pack a(1, 2, 3, 4);
  EXPECT_TRUE(everywhere(a > 0));
  EXPECT_FALSE(everywhere(a > 1));
  EXPECT_FALSE(everywhere(a < 4));
  EXPECT_TRUE(everywhere(a > 0 && a < 5));
  EXPECT_FALSE(everywhere(a > 0 && a < 4));
  EXPECT_FALSE(everywhere(Pack(1, 2, std::nan(""), 4) > 0));
}

TEST(Pack, EigenvaluesBelowALimit) {
  constexpr int n = 5;
  std::array<Pack, n * n> matrix;
  Eigen::Vector4d largest;
  for (int lane = 0; lane < Pack::count; ++lane) {
    Eigen::Matrix<double, n, n> m;
    for (int e = 0; e < n * n; ++e) m.data()[e] = std::sin(1.3 * e * e + lane);
    m = (m + m.transpose()).eval();
    largest[lane] = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m).eigenvalues().maxCoeff();
    for (int e = 0; e < n * n; ++e) matrix[static_cast<std::size_t>(e)].set(lane, m.data()[e]);
  }
  for (const double times : {1 - 1e-12, 1 + 1e-12})
    for (int at = 0; at < Pack::count; ++at) {
      Pack limit;  // above those of all but one
      for (int lane = 0; lane < Pack::count; ++lane)
        limit.set(lane, largest[lane] * (lane == at ? times : 1 + 1e-12));
      std::array<Pack, n* n> used = matrix;
      const Pack::Mask below = eigenvalues_below(limit, n, used.data());
      for (int lane = 0; lane < Pack::count; ++lane)
        EXPECT_EQ(below.v[lane] != 0, lane != at || times > 1) << lane;
    }
}

TEST(Pack, NothingIsNotBelow) {
  const double nothing = std::nan("");
  std::array<Pack, 4> matrix{Pack(1, nothing, 1, 1), Pack(0, 0, nothing, 0), Pack(0.0), Pack(1.0)};
  const Pack::Mask below = eigenvalues_below(Pack(2.0), 2, matrix.data());
  for (int lane = 0; lane < Pack::count; ++lane)
    EXPECT_EQ(below.v[lane] != 0, lane == 0 || lane == 3) << lane;
}

}  // namespace
}  // namespace osculate::core
