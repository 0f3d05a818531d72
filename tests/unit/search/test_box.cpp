#include "osculate/search/box.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace osculate::search {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(Box, is_empty_until_extended) {
  Box<2> box;
  EXPECT_TRUE(box.empty());
  EXPECT_EQ(box.squared_distance(Vec2(1, 2)), infinite);
  box.extend(Box<2>{});
  EXPECT_TRUE(box.empty());
  box.extend(Vec2(1, 2));
  EXPECT_FALSE(box.empty());
  EXPECT_EQ(box.lo, Vec2(1, 2));
  EXPECT_EQ(box.hi, Vec2(1, 2));
  EXPECT_EQ(box.squared_distance(Vec2(4, 6)), 25);
}

TEST(Box, distances_to_faces_edges_corners_and_inside) {
  const Box<3> box{Vec3(0, 0, 0), Vec3(1, 2, 3)};
  EXPECT_EQ(box.squared_distance(Vec3(0.5, 1, 3)), 0);
  EXPECT_EQ(box.squared_distance(Vec3(-2, 1, 1)), 4);
  EXPECT_EQ(box.squared_distance(Vec3(3, 5, 1)), 4 + 9);
  EXPECT_EQ(box.squared_distance(Vec3(3, 5, -1)), 4 + 9 + 1);
  const Box<3> other{Vec3(3, 5, -2), Vec3(9, 9, -1)};
  EXPECT_EQ(box.squared_distance(other), 4 + 9 + 1);
  EXPECT_EQ(other.squared_distance(box), 4 + 9 + 1);
  EXPECT_EQ(box.squared_distance(Box<3>{}), infinite);
}

TEST(Box, touching_boxes_overlap) {
  const Box<2> box{Vec2(0, 0), Vec2(1, 1)};
  EXPECT_TRUE(box.overlaps({Vec2(1, 1), Vec2(2, 2)}));
  EXPECT_FALSE(box.overlaps({Vec2(1.1, 0), Vec2(2, 1)}));
  EXPECT_FALSE(box.overlaps({Vec2(0, -2), Vec2(1, -1e-9)}));
}

TEST(Box, infinite_box_overlaps_all_but_the_empty_one) {
  const Box<2> all{Vec2(-infinite, -infinite), Vec2(infinite, infinite)};
  EXPECT_TRUE(all.overlaps({Vec2(1e300, 0), Vec2(1e300, 0)}));
  EXPECT_TRUE(all.overlaps(all));
  EXPECT_FALSE(all.overlaps(Box<2>{}));
  EXPECT_FALSE(Box<2>{}.overlaps(all));
  EXPECT_EQ(all.squared_distance(Vec2(-1e300, 5)), 0);
  EXPECT_FALSE(all.bounded());
}

TEST(Box, inflate_moves_every_side) {
  Box<2> box{Vec2(0, 1), Vec2(2, 3)};
  box.inflate(0.5);
  EXPECT_EQ(box.lo, Vec2(-0.5, 0.5));
  EXPECT_EQ(box.hi, Vec2(2.5, 3.5));
  Box<2> none;
  none.inflate(1e9);
  EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace osculate::search
