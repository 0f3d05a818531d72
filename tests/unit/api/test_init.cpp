// What `osculate init` finds in a mesh.
#include <gmock/gmock.h>

#include "osculate/api/init_contact.hpp"
#include "osculate/api/init_survey.hpp"
#include "osculate/mesh/generate.hpp"

namespace osculate::api {
namespace {

using ::testing::ElementsAre;

mesh::BoxSpec box(const std::string& name, double x, double y) {
  mesh::BoxSpec spec;
  spec.name = name;
  spec.x = {x, x + 2};
  spec.y = {y, y + 1};
  spec.nx = {4};
  spec.ny = {2};
  spec.bias_x = spec.bias_y = {1};
  return spec;
}

/// Two boxes that lie on each other, and a line below them.
mesh::Mesh stack() {
  mesh::Mesh mesh;
  mesh::append_box(mesh, box("low", 0, 0));
  mesh::append_box(mesh, box("high", 0, 1));
  mesh::append_line(mesh, {"ground", {{-1, -0.1}, {3, -0.1}}, {1}, cell::CellType::line2});
  return mesh;
}

mesh::Set united(const mesh::Mesh& mesh, const std::string& name,
                 const std::vector<std::string>& parts) {
  mesh::Set set;
  set.name = name;
  set.dimension = 2;
  for (const std::string& part : parts) {
    const mesh::Set& one = *mesh.find_set(part);
    set.cells.insert(set.cells.end(), one.cells.begin(), one.cells.end());
    set.nodes.insert(set.nodes.end(), one.nodes.begin(), one.nodes.end());
  }
  return set;
}

std::vector<std::string> names_of(const std::vector<const mesh::Set*>& sets) {
  std::vector<std::string> names;
  for (const mesh::Set* const set : sets) names.push_back(set->name);
  return names;
}

TEST(InitSurvey, ASetOfEverythingGivesWayToThoseItIsMadeOf) {
  mesh::Mesh mesh = stack();
  mesh.sets.insert(mesh.sets.begin(), united(mesh, "all", {"low", "high"}));
  EXPECT_THAT(names_of(survey(mesh).sections), ElementsAre("low", "high"));
  EXPECT_EQ(survey(mesh).left_out, 0U);
}

TEST(InitSurvey, APartOfABodyDoesNotTakeItsPlace) {
  mesh::Mesh mesh = stack();
  mesh::Set part = *mesh.find_set("low");
  part.name = "one cell";
  part.cells.resize(1);
  mesh.sets.insert(mesh.sets.begin(), part);
  EXPECT_THAT(names_of(survey(mesh).sections), ElementsAre("low", "high"));
}

TEST(InitSurvey, CellsOfSetsThatOverlapAreCounted) {
  mesh::Mesh mesh = stack();
  mesh::Set both = *mesh.find_set("low");
  both.name = "both";
  both.cells.push_back(mesh.find_set("high")->cells.front());
  std::erase_if(mesh.sets, [](const mesh::Set& set) { return set.name == "low"; });
  mesh.sets.push_back(both);  // the largest, which leaves 7 of the 8 cells of `high`
  const MeshSurvey found = survey(mesh);
  EXPECT_THAT(names_of(found.sections), ElementsAre("both"));
  EXPECT_EQ(found.left_out, 7U);
}

TEST(InitSurvey, FacetsAreOfABodyOrRigid) {
  const mesh::Mesh mesh = stack();
  const MeshSurvey found = survey(mesh);
  EXPECT_EQ(found.parts, 2);
  EXPECT_EQ(found.part_of(*mesh.find_set("low.top")), 0);
  EXPECT_EQ(found.part_of(*mesh.find_set("high.bottom")), 1);
  EXPECT_EQ(found.part_of(*mesh.find_set("ground")), -1);
  int rigid = 0;
  for (const Touchable& one : found.touchables) {
    rigid += one.rigid();
    EXPECT_EQ(one.rigid(), one.set->name == "ground") << one.set->name;
    if (one.set->name == "high.bottom") {
      EXPECT_THAT(one.parts, ElementsAre(1));
      EXPECT_DOUBLE_EQ(one.facet, 0.5);
      EXPECT_NEAR((one.normal + Vec3::UnitY()).norm(), 0, 1e-14);
    }
  }
  EXPECT_EQ(rigid, 1);
}

TEST(InitContact, NamesAreQuotedWhereYamlNeedsIt) {
  EXPECT_EQ(yaml_text("block.top-2"), "block.top-2");
  EXPECT_EQ(yaml_text("bottom edge"), "\"bottom edge\"");
  EXPECT_EQ(yaml_text("12"), "\"12\"");
  EXPECT_EQ(yaml_text("No"), "\"No\"");
  EXPECT_EQ(yaml_text("a\"b\\"), "\"a\\\"b\\\\\"");
}

}  // namespace
}  // namespace osculate::api
