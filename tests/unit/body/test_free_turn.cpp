#include "osculate/body/free_turn.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "osculate/body/rotation.hpp"

namespace osculate::body {
namespace {

Mat<3, 3> three_moments() { return Vec3(1, 2, 3).asDiagonal(); }

struct FreeTop {
  Mat<3, 3> inertia = three_moments();
  Mat<3, 3> orientation = rotation_matrix({0.3, -0.2, 0.5});
  Vec3 momentum{0.4, 2.1, -0.7};

  void step(double h) {
    orientation = rotation_matrix(free_turn(inertia, orientation, momentum, h)) * orientation;
  }
  [[nodiscard]] double energy() const {
    const Vec3 in_body = orientation.transpose() * momentum;
    return 0.5 * in_body.dot(inertia.inverse() * in_body);
  }
};

FreeTop after(int steps) {
  FreeTop top;
  for (int k = 0; k < steps; ++k) top.step(2.0 / steps);
  return top;
}

TEST(FreeTurn, KeepsTheEnergy) {
  FreeTop top;
  const double first = top.energy();
  for (int k = 0; k < 1000; ++k) top.step(0.1);
  EXPECT_NEAR(top.energy(), first, 1e-12 * first);
}

TEST(FreeTurn, IsOfSecondOrder) {
  const Mat<3, 3> fine = after(1600).orientation;
  const double e1 = (after(50).orientation - fine).norm();
  const double e2 = (after(100).orientation - fine).norm();
  EXPECT_NEAR(std::log2(e1 / e2), 2, 0.03);
}

TEST(FreeTurn, GoesBackTheSameWay) {
  FreeTop top;
  const Mat<3, 3> first = top.orientation;
  top.step(0.2);
  top.momentum = -top.momentum;
  top.step(0.2);
  EXPECT_LT((top.orientation - first).norm(), 1e-14);
}

TEST(FreeTurn, IsUniformAboutAPrincipalAxis) {
  const Vec3 turn = free_turn(three_moments(), Mat<3, 3>::Identity(), {0, 0, 6}, 0.1);
  EXPECT_LT((turn - Vec3(0, 0, 0.2)).norm(), 1e-15);
}

}  // namespace
}  // namespace osculate::body
