#include "osculate/mesh/partition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <map>

namespace osculate::mesh {
namespace {

using Cells = std::vector<std::vector<Index>>;

/// Squares of a grid of nx times ny cells.
Cells grid(Index nx, Index ny) {
  Cells cells;
  for (Index j = 0; j < ny; ++j)
    for (Index i = 0; i < nx; ++i) {
      const Index corner = j * (nx + 1) + i;
      cells.push_back({corner, corner + 1, corner + nx + 2, corner + nx + 1});
    }
  return cells;
}

std::map<int, int> sizes(const std::vector<int>& part) {
  std::map<int, int> out;
  for (const int p : part) ++out[p];
  return out;
}

std::size_t cut(const Cells& cells, const std::vector<int>& part) {
  const auto of = [&](Index node) { return part[static_cast<std::size_t>(node)]; };
  return static_cast<std::size_t>(std::ranges::count_if(cells, [&](const auto& cell) {
    return std::ranges::any_of(cell, [&](Index node) { return of(node) != of(cell.front()); });
  }));
}

TEST(Partition, parts_have_about_as_many_nodes) {
  const Cells cells = grid(40, 30);
  for (const int parts : {2, 3, 8}) {
    const std::vector<int> part = node_parts(cells, {}, 41 * 31, parts);
    ASSERT_EQ(part.size(), 41U * 31U);
    const std::map<int, int> of = sizes(part);
    ASSERT_EQ(of.size(), static_cast<std::size_t>(parts));
    EXPECT_EQ(of.begin()->first, 0);
    EXPECT_EQ(of.rbegin()->first, parts - 1);
    for (const auto& [p, nodes] : of) EXPECT_NEAR(nodes, 41.0 * 31 / parts, 0.1 * 41 * 31 / parts);
  }
}

/// The shortest cuts of a grid of 40 by 30 cells into 2 parts go through 30 cells.
TEST(Partition, few_cells_are_between_parts) {
  const Cells cells = grid(40, 30);
  EXPECT_LE(cut(cells, node_parts(cells, {}, 41 * 31, 2)), 45U);
  EXPECT_LE(cut(cells, node_parts(cells, {}, 41 * 31, 8)), 240U);
  std::vector<int> dealt(41 * 31);  // what does not look at the cells cuts nearly all
  for (std::size_t n = 0; n < dealt.size(); ++n) dealt[n] = static_cast<int>(n) % 2;
  EXPECT_GT(cut(cells, dealt), 1000U);
}

TEST(Partition, two_bodies_apart_are_not_cut) {
  Cells cells = grid(10, 10);
  for (std::vector<Index> cell : grid(10, 10)) {
    for (Index& node : cell) node += 121;
    cells.push_back(cell);
  }
  EXPECT_EQ(cut(cells, node_parts(cells, {}, 242, 2)), 0U);
}

std::map<int, int> joints_of(const Cells& joints, const std::vector<int>& part) {
  std::map<int, int> out;
  for (const auto& joint : joints) ++out[part[static_cast<std::size_t>(joint.front())]];
  return out;
}

/// Two long bodies one upon the other: cut across both, and not between them.
TEST(Partition, partners_are_together) {
  constexpr Index across = 61, nodes = across * 7;
  Cells cells = grid(60, 6), joints;
  for (std::vector<Index> cell : grid(60, 6)) {
    for (Index& node : cell) node += nodes;
    cells.push_back(cell);
  }
  for (Index i = 0; i < across; ++i) joints.push_back({nodes + i, nodes - across + i});
  EXPECT_EQ(cut(joints, node_parts(cells, {}, 2 * nodes, 2)), joints.size());
  for (const int parts : {2, 3, 8}) {
    const std::vector<int> part = node_parts(cells, joints, 2 * nodes, parts);
    EXPECT_LE(cut(joints, part), 4U * static_cast<std::size_t>(parts - 1)) << parts;
    for (const auto& [p, count] : joints_of(joints, part))
      EXPECT_NEAR(count, 61.0 / parts, 0.25 * 61 / parts + 2) << parts;
    for (const auto& [p, count] : sizes(part))
      EXPECT_NEAR(count, 2.0 * nodes / parts, 0.15 * 2 * nodes / parts) << parts;
  }
}

/// Work at one end of a plate: every part has a piece of it.
TEST(Partition, joints_are_dealt_out_evenly) {
  const Cells cells = grid(40, 30);
  Cells joints;
  for (Index j = 0; j < 31; ++j)
    for (Index i = 0; i < 8; ++i) joints.push_back({j * 41 + i});
  for (const int parts : {2, 4}) {
    const std::vector<int> part = node_parts(cells, joints, 41 * 31, parts);
    const std::map<int, int> of = joints_of(joints, part);
    ASSERT_EQ(of.size(), static_cast<std::size_t>(parts));
    for (const auto& [p, count] : of) EXPECT_NEAR(count, 248.0 / parts, 0.1 * 248 / parts + 1);
    for (const auto& [p, nodes] : sizes(part))
      EXPECT_NEAR(nodes, 41.0 * 31 / parts, 0.1 * 41 * 31 / parts);
  }
}

/// Few joints cannot be shared, nor those of one node: nodes are, all the same, and METIS has
/// nothing to say.
TEST(Partition, nodes_are_dealt_out_evenly_whatever_the_joints) {
  const Cells cells = grid(60, 30);
  ::testing::internal::CaptureStdout();
  for (const Index count : {1, 3, 9, 200})
    for (const bool one : {false, true}) {
      Cells joints;
      for (Index i = 0; i < count; ++i) joints.push_back({i, one ? 61 * 30 : i + 61});
      for (const int parts : {2, 4, 8, 16}) {
        const std::map<int, int> of = sizes(node_parts(cells, joints, 61 * 31, parts));
        ASSERT_EQ(of.size(), static_cast<std::size_t>(parts)) << count << " " << one;
        for (const auto& [p, nodes] : of)
          EXPECT_LT(nodes, 1.5 * 61 * 31 / parts) << count << " " << one;
      }
    }
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

TEST(Partition, joints_of_nodes_without_cells_do_not_matter) {
  const Cells cells = grid(4, 4);
  const std::vector<int> part = node_parts(cells, {{26, 3}, {27, 28}}, 25 + 7, 3);
  EXPECT_EQ(std::vector<int>(part.begin() + 25, part.end()),
            (std::vector<int>{0, 1, 2, 0, 1, 2, 0}));
}

TEST(Partition, nodes_without_cells_are_dealt_out_in_turn) {
  const std::vector<int> part = node_parts(grid(4, 4), {}, 25 + 7, 3);
  EXPECT_EQ(std::vector<int>(part.begin() + 25, part.end()),
            (std::vector<int>{0, 1, 2, 0, 1, 2, 0}));
  EXPECT_EQ(node_parts({}, {}, 4, 2), (std::vector<int>{0, 1, 0, 1}));
}

TEST(Partition, more_parts_than_nodes) {
  const Cells one{{0, 1, 2, 3}};
  for (const int parts : {4, 5, 100})
    for (const int p : node_parts(one, {}, 4, parts)) {
      EXPECT_GE(p, 0);
      EXPECT_LT(p, parts);
    }
}

TEST(Partition, one_part_has_all) {
  EXPECT_EQ(node_parts(grid(3, 2), {}, 12, 1), std::vector<int>(12, 0));
}

TEST(Partition, depends_on_the_input_alone) {
  const Cells cells = grid(25, 17);
  const std::vector<int> first = node_parts(cells, {}, 26 * 18, 5);
  (void)node_parts(grid(7, 9), {}, 80, 3);
  EXPECT_EQ(node_parts(cells, {}, 26 * 18, 5), first);
}

}  // namespace
}  // namespace osculate::mesh
