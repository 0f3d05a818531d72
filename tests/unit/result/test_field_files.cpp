#include "osculate/result/field_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "osculate/result/body_numbers.hpp"

namespace osculate::result {
namespace {

using ::testing::ElementsAre;

/// Two squares that hang together in two sections, one apart in the second, of numbers of a file,
/// and a rigid body.
model::Model three_squares() {
  model::Model m;
  for (const double x : {0, 1, 2, 5, 6})
    for (const double y : {0, 1}) m.mesh.nodes.emplace_back(x, y, 0);
  for (const Vec3& x : m.mesh.nodes) m.reference.emplace_back(x.head<2>());
  m.mesh.blocks.push_back({cell::CellType::line2, {0, 2}, {7}});
  m.mesh.blocks.push_back(
      {cell::CellType::quad4, {6, 8, 9, 7, 0, 2, 3, 1, 2, 4, 5, 3}, {30, 10, 20}});
  model::BulkSection left, right;
  left.name = "left";
  left.material = "steel";
  left.cells = {{1, 1}};
  right.name = "right";
  right.material = "steel";
  right.cells = {{1, 2}, {1, 0}};
  m.sections = {left, right};
  m.rigid.resize(1);
  m.rigid[0].name = "base";
  return m;
}

TEST(BodyNumbers, ConnectedPartsInTheOrderOfTheirFirstCell) {
  const BodyNumbers bodies = body_numbers(three_squares());
  EXPECT_THAT(bodies.names, ElementsAre("left", "right", "base"));
  EXPECT_EQ(bodies.deformable, 2u);
  EXPECT_THAT(bodies.of_cell[0], ElementsAre(-1));
  EXPECT_THAT(bodies.of_cell[1], ElementsAre(1, 0, 0));
}

TEST(BodyNumbers, BodiesOfOneSectionAreToldApart) {
  model::Model m = three_squares();
  m.sections.erase(m.sections.begin());
  m.sections[0].cells = {{1, 1}, {1, 2}, {1, 0}};
  EXPECT_THAT(body_numbers(m).names, ElementsAre("right (1)", "right (2)", "base"));
}

TEST(FieldFiles, CellsKnowTheirBodyMaterialSectionAndNumber) {
  const BodyCells cells = body_cells(three_squares());
  ASSERT_EQ(cells.blocks.size(), 1u);
  EXPECT_EQ(cells.blocks[0].size(), 3);
  ASSERT_EQ(cells.fields.size(), 4u);
  EXPECT_EQ(cells.fields[0].name, "Body");
  EXPECT_THAT(cells.fields[0].values, ElementsAre(1, 1, 2));
  EXPECT_EQ(cells.fields[1].name, "Material");
  EXPECT_THAT(cells.fields[1].values, ElementsAre(1, 1, 1));
  EXPECT_EQ(cells.fields[2].name, "Section");
  EXPECT_THAT(cells.fields[2].values, ElementsAre(1, 2, 2));
  EXPECT_EQ(cells.fields[3].name, "CellNumber");
  EXPECT_THAT(cells.fields[3].values, ElementsAre(10, 20, 30));
  ASSERT_EQ(cells.names.size(), 3u);
  EXPECT_THAT(cells.names[0].texts, ElementsAre("left", "right", "base"));
  EXPECT_THAT(cells.names[1].texts, ElementsAre("steel"));
  EXPECT_THAT(cells.names[2].texts, ElementsAre("left", "right"));
}

}  // namespace
}  // namespace osculate::result
