#include "osculate/mesh/thin_elements.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace osculate::mesh {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

/// A triangle of second order, nodes 0 to 5 of the deck, and its wedge of nodes 6 to 20: corners of
/// bottom and top, middles of their edges, middles between corners.
Mesh wedge() {
  Mesh mesh;
  mesh.nodes.assign(21, Vec3::Zero());
  Block block{cell::CellType::wedge15, std::vector<Index>(15), {}};
  const auto vtk = cell::vtk_nodes(block.type);
  for (std::size_t k = 0; k < 15; ++k) {
    const auto n = static_cast<Index>(6 + k);
    block.connectivity[static_cast<std::size_t>(vtk[k])] = n;
    const auto of = static_cast<Index>(k < 6 ? k % 3 : k < 12 ? 3 + k % 3 : k - 12);
    mesh.expanded.push_back({n, of, Vec2::Zero()});
  }
  mesh.blocks.push_back(std::move(block));
  return mesh;
}

/// A beam from node 0 to node 1 and its brick of nodes 2 to 9.
Mesh beam() {
  Mesh mesh;
  mesh.nodes.assign(10, Vec3::Zero());
  Block block{cell::CellType::hex8, {}, {}};
  for (Index k = 0; k < 8; ++k) {
    block.connectivity.push_back(2 + k);
    mesh.expanded.push_back({2 + k, k < 4 ? 0 : 1, Vec2::Zero()});
  }
  mesh.blocks.push_back(std::move(block));
  return mesh;
}

TEST(ThinElements, AreThoseOfTheDeckInItsOrder) {
  const ThinElements plate = thin_elements(wedge()), bar = thin_elements(beam());
  ASSERT_EQ(plate.elements.size(), 1U);
  EXPECT_EQ(plate.elements[0].type, cell::CellType::tri6);
  EXPECT_THAT(plate.elements[0].nodes, ElementsAre(0, 1, 2, 3, 4, 5));
  ASSERT_EQ(bar.elements.size(), 1U);
  EXPECT_EQ(bar.elements[0].type, cell::CellType::line2);
  EXPECT_THAT(bar.elements[0].nodes, ElementsAre(0, 1));
  EXPECT_TRUE(plate.complete && bar.complete);
}

/// What is quadratic over the thickness is integrated.
TEST(ThinElements, MeansAreThoseOverTheSection) {
  const ThinElements plate = thin_elements(wedge());
  ASSERT_EQ(plate.means.size(), 6U);
  EXPECT_THAT(plate.mean_of(1)->shares,
              ElementsAre(Pair(7, 1.0 / 6), Pair(10, 1.0 / 6), Pair(19, 4.0 / 6)));
  EXPECT_THAT(plate.mean_of(4)->shares, ElementsAre(Pair(13, 0.5), Pair(16, 0.5)));
  EXPECT_EQ(plate.mean_of(6), nullptr);
  EXPECT_THAT(thin_elements(beam()).mean_of(0)->shares,
              ElementsAre(Pair(2, 0.25), Pair(3, 0.25), Pair(4, 0.25), Pair(5, 0.25)));
}

TEST(ThinElements, ElementsThatMeetInAnAngleHaveTheSameSay) {
  Mesh mesh = beam();  // and another one from node 1 to 10, whose section at node 1 is its own
  mesh.nodes.assign(19, Vec3::Zero());
  for (Index k = 0; k < 8; ++k) {
    mesh.blocks[0].connectivity.push_back(11 + k);
    mesh.expanded.push_back({11 + k, k < 4 ? 1 : 10, Vec2::Zero()});
  }
  const ThinElements thin = thin_elements(mesh);
  EXPECT_TRUE(thin.complete);
  ASSERT_EQ(thin.mean_of(1)->shares.size(), 8U);
  for (const auto& [node, share] : thin.mean_of(1)->shares) EXPECT_EQ(share, 0.125);
}

/// Two layers of one plate share the nodes between them.
TEST(ThinElements, PartsOfASectionHaveNoMean) {
  Mesh mesh;
  mesh.nodes.assign(16, Vec3::Zero());
  mesh.blocks.push_back(
      {cell::CellType::hex8, {4, 5, 6, 7, 8, 9, 10, 11, 8, 9, 10, 11, 12, 13, 14, 15}, {}});
  for (Index n = 4; n < 16; ++n) mesh.expanded.push_back({n, n % 4, Vec2::Zero()});
  const ThinElements thin = thin_elements(mesh);
  EXPECT_FALSE(thin.complete);
  EXPECT_TRUE(thin.means.empty());
}

TEST(ThinElements, SolidsAreNone) {
  Mesh mesh = beam();
  mesh.expanded.clear();
  EXPECT_TRUE(thin_elements(mesh).elements.empty());
  mesh = beam();
  mesh.expanded.pop_back();
  EXPECT_TRUE(thin_elements(mesh).elements.empty());
}

}  // namespace
}  // namespace osculate::mesh
