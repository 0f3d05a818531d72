// Motions of bodies on springs between them.
#include "osculate/model/joint_motions.hpp"

#include <gtest/gtest.h>

#include <array>

namespace osculate::model {
namespace {

/// Three bodies of one unknown each: springs between the first and the second, the second and the
/// third, and from the third to the ground.
std::vector<JointMotions> on_springs(const std::array<double, 3>& c) {
  la::SparseMatrix k{3, {0, 2, 5, 7}, {0, 1, 0, 1, 2, 1, 2}, {}};
  k.value = {c[0], -c[0], -c[0], c[0] + c[1], -c[1], -c[1], c[1] + c[2]};
  std::vector<CompactModes> modes;
  for (Eigen::Index b = 0; b < 3; ++b)
    modes.push_back(compact(Eigen::MatrixXd(Eigen::Vector3d::Unit(b))));
  return joint_motions(RigidStiffness(k, modes, 1.0));
}

TEST(JointMotions, OfBodiesThatAreTiedToEachOtherAlone) {
  const std::vector<JointMotions> found = on_springs({1, 1, 0});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].bodies, (std::vector<std::size_t>{0, 1, 2}));
  for (const Eigen::MatrixXd& motions : found[0].motions) {
    ASSERT_EQ(motions.cols(), 1);
    EXPECT_NEAR(std::abs(motions(0, 0)), 1, 1e-12);
  }
  EXPECT_LT(found[0].ratio, 1e-12);
}

TEST(JointMotions, NoneOfBodiesThatAreHeldOrFreeAlone) {
  EXPECT_TRUE(on_springs({1, 1, 1}).empty());
  EXPECT_TRUE(on_springs({0, 0, 0}).empty());
  EXPECT_TRUE(on_springs({0, 1, 1}).empty());  // the first is free alone
  const std::vector<JointMotions> two = on_springs({1, 0, 1});
  ASSERT_EQ(two.size(), 1u);
  EXPECT_EQ(two[0].bodies, (std::vector<std::size_t>{0, 1}));
}

}  // namespace
}  // namespace osculate::model
