// Which formulation the cells of a section have where none is given (docs/decisions/037).
#include <gtest/gtest.h>

#include "deck_test.hpp"
#include "osculate/deck/build.hpp"
#include "osculate/model/bulk.hpp"

namespace osculate::deck {
namespace {
using cell::CellType;

constexpr const char* text =
    "osculate: 1\n"
    "mesh: {generate: {a: {box: {x: [1, 2], y: [0, 1], elements: [2, 2]}},\n"
    "  b: {box: {x: [3, 4], y: [0, 1], elements: [2, 2], type: tri3}},\n"
    "  c: {box: {x: [5, 6], y: [0, 1], elements: [2, 2], type: quad8}}}}\n"
    "materials: {m: {linear_elastic: {E: 1, nu: 0.3}}}\n"
    "sections: [{on: [a, b, c], material: m, element: plane_strain}]\n"
    "steps: [{name: s, increments: 1,\n"
    "  prescribe: [{on: a, ux: 0, uy: 0}, {on: b, ux: 0, uy: 0}, {on: c, ux: 0, uy: 0}]}]\n";

auto formulation_on(const std::string& law, const std::string& element, CellType type) {
  const std::string own = edited(edited(text, "linear_elastic", law), "plane_strain", element);
  const Description description = parse_model(own, "model.yaml");
  return model::section_on(build(description, load_mesh(description)).model.sections.at(0), type)
      .formulation;
}

TEST(Formulation, ByDefaultFirstOrderQuadrilateralsDoNotLock) {
  using enum solid::Formulation;
  for (const char* const law : {"linear_elastic", "st_venant_kirchhoff"})
    for (const char* const element : {"plane_strain", "plane_stress", "axisymmetric"})
      EXPECT_EQ(formulation_on(law, element, CellType::quad4), enhanced) << law << " " << element;
  EXPECT_EQ(formulation_on("neo_hooke", "plane_strain", CellType::quad4), bbar);
  EXPECT_EQ(formulation_on("neo_hooke", "axisymmetric", CellType::quad4), bbar);
  EXPECT_EQ(formulation_on("neo_hooke", "plane_stress", CellType::quad4), full);
}

// A mesh of quadrilaterals with some triangles is one section.
TEST(Formulation, OtherCellsOfTheSectionArePlain) {
  for (const CellType type : {CellType::tri3, CellType::tri6}) {
    EXPECT_EQ(formulation_on("linear_elastic", "plane_strain", type), solid::Formulation::full);
    EXPECT_EQ(formulation_on("neo_hooke", "axisymmetric", type), solid::Formulation::full);
  }
  EXPECT_EQ(formulation_on("linear_elastic", "plane_strain", CellType::quad8),
            solid::Formulation::full);
}

// decision 064
TEST(Formulation, OfSecondOrderRubberIsBbarWhereItsVolumeRatioIsLinear) {
  for (const CellType type : {CellType::quad8, CellType::quad9}) {
    EXPECT_EQ(formulation_on("neo_hooke", "plane_strain", type), solid::Formulation::bbar);
    EXPECT_EQ(formulation_on("neo_hooke", "axisymmetric", type), solid::Formulation::bbar);
    EXPECT_EQ(formulation_on("neo_hooke", "plane_stress", type), solid::Formulation::full);
  }
}

TEST(Formulation, ThatIsAskedForIsThatOfAllCellsOfSecondOrder) {
  for (const CellType type : {CellType::tri6, CellType::quad8}) {
    std::string own =
        edited(text, "element: plane_strain", "element: plane_strain, formulation: bbar");
    own = edited(own, "type: tri3", "type: tri6");
    const Description description = parse_model(own, "model.yaml");
    EXPECT_EQ(
        model::section_on(build(description, load_mesh(description)).model.sections.at(0), type)
            .formulation,
        solid::Formulation::bbar);
  }
}

TEST(Formulation, InSpaceLikewise) {
  using enum solid::Formulation;
  const std::string space =
      "osculate: 1\n"
      "mesh: {generate: {b: {box: {x: [0, 1], y: [0, 1], z: [0, 1], elements: [1, 1, 1]}}}}\n"
      "materials: {m: {linear_elastic: {E: 1, nu: 0.3}}}\n"
      "sections: [{on: b, material: m, element: solid}]\n"
      "steps: [{name: s, increments: 1, prescribe: [{on: b, ux: 0, uy: 0, uz: 0}]}]\n";
  const auto formulation = [&](const std::string& law, const std::string& type) {
    const std::string own = edited(edited(space, "linear_elastic", law), "[1, 1, 1]}",
                                   "[1, 1, 1], type: " + type + "}");
    const Description description = parse_model(own, "model.yaml");
    const Built3 built = build3(description, load_mesh(description));
    return model::section_on(built.model.sections.at(0), built.model.mesh.blocks.at(0).type)
        .formulation;
  };
  EXPECT_EQ(formulation("linear_elastic", "hex8"), enhanced);
  EXPECT_EQ(formulation("st_venant_kirchhoff", "hex8"), enhanced);
  EXPECT_EQ(formulation("neo_hooke", "hex8"), bbar);
  EXPECT_EQ(formulation("linear_elastic", "tet4"), full);
  EXPECT_EQ(formulation("linear_elastic", "hex20"), full);
  EXPECT_EQ(formulation("neo_hooke", "hex20"), bbar);
  EXPECT_EQ(formulation("neo_hooke", "hex27"), bbar);
  EXPECT_EQ(formulation("neo_hooke", "wedge15"), full);
  EXPECT_EQ(formulation("neo_hooke", "tet10"), full);
}

}  // namespace
}  // namespace osculate::deck
