// Areas of slave nodes by fixed shares of their facets.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <numbers>
#include <regex>

#include "space_test.hpp"

namespace osculate::deck {
namespace {

std::string block(const std::string& box, const std::string& section) {
  return fmt::format(
      "osculate: 1\nmesh: {{generate: {{b: {{box: {}}}}}}}\n"
      "materials: {{m: {{linear_elastic: {{E: 100, nu: 0}}}}}}\n"
      "sections: [{{on: b, material: m, element: {}}}]\n"
      "rigid: {{floor: {}}}\n"
      "contact: [{{name: c, master: floor, slave: b.bottom, sampling: nodes, weight: {{area: "
      "middles}}, normal: {{penalty: 100}}}}]\n"
      "steps: [{{name: s, increments: 1, prescribe: [{{on: b.top, ux: 0, uy: 0}}]}}]\n",
      box, section,
      section == "solid" ? "{plane: {point: [0, 0, 0], normal: [0, 0, 1]}}"
                         : "{line: {point: [0, 0], normal: [0, 1]}}");
}

template <int Dim>
std::vector<double> areas(const std::string& text) {
  const Description description = parse_model(text, "model.yaml");
  const auto built = std::get<BasicBuilt<Dim>>(build_any(description, load_mesh(description)));
  std::vector<double> out = built.model.pairs[0].definition.reference_areas;
  std::sort(out.begin(), out.end());
  return out;
}

void expect_near(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-12);
}

/// As the forces that CalculiX prints at the nodes of a pressed face of area 2.
TEST(GivenAreas, AreThoseOfMiddles) {
  const std::string box = "{{x: [0, 2], y: [0, 1], z: [0, 1], elements: [1, 1, 1], type: {}}}";
  const auto space = [&](const char* type) {
    return areas<3>(block(fmt::format(fmt::runtime(box), type), "solid"));
  };
  expect_near(space("hex20"), {0.02, 0.02, 0.02, 0.02, 0.48, 0.48, 0.48, 0.48});
  expect_near(space("hex8"), {0.5, 0.5, 0.5, 0.5});
  const std::vector<double> tet = space("tet10");
  double sum = 0;
  for (const double area : tet) sum += area;
  EXPECT_NEAR(sum, 2, 1e-12);
  EXPECT_NEAR(tet.front(), 1.0 / 999, 1e-12);
  EXPECT_NEAR(tet.back(), 2 * 332.0 / 999, 1e-12);
}

TEST(GivenAreas, AreThoseOfExtrudedFacetsInThePlane) {
  const auto plane = [&](const char* type) {
    return areas<2>(block(fmt::format("{{x: [0, 2], y: [0, 1], elements: [1, 1], type: {}}}", type),
                          "plane_strain"));
  };
  expect_near(plane("quad8"), {0.52, 0.52, 0.96});
  expect_near(plane("quad4"), {1, 1});
  expect_near(
      areas<2>(block("{x: [0, 2], y: [0, 1], elements: [2, 1], type: quad8}", "plane_strain")),
      {0.26, 0.26, 0.48, 0.48, 0.52});
}

/// Of the nodes at x = 0, 1, 2 beside facets that end at 0, 1.5, 3; sorted.
std::vector<double> areas_of_master(const std::string& section) {
  const bool space = section == "solid";
  const char* const depth = space ? ", z: [0, 0.5]" : "";
  const char* const one = space ? ", 1" : "";
  const std::string text = fmt::format(
      "osculate: 1\nmesh: {{generate: {{a: {{box: {{x: [0, 3], y: [0, 1]{0}, elements: [2, "
      "1{1}]}}}}, "
      "b: {{box: {{x: [0, 2], y: [1, 2]{0}, elements: [2, 1{1}]}}}}}}}}\n"
      "materials: {{m: {{linear_elastic: {{E: 100, nu: 0}}}}}}\n"
      "sections: [{{on: a, material: m, {2}}}, {{on: b, material: m, {2}}}]\n"
      "contact: [{{name: c, master: {3}, slave: {4}, sampling: nodes, weight: {{area: master}}, "
      "normal: {{penalty: 100}}}}]\n"
      "steps: [{{name: s, increments: 1}}]\n",
      depth, one,
      section == "plane_strain" ? "element: plane_strain, thickness: 0.2" : "element: " + section,
      space ? "a.back" : "a.top", space ? "b.front" : "b.bottom");
  return space ? areas<3>(text) : areas<2>(text);
}

/// As in CalculiX, whose nodal surfaces in the plane have no facets: forces of two facets of 0.65
/// and 0.9 on which nodes are pressed by 10, thickness 0.5, are 3.25 and 4.5 there.
TEST(GivenAreas, AreThoseOfTheFacetsBelow) {
  constexpr double pi = std::numbers::pi;
  expect_near(areas_of_master("plane_strain"), {0.3, 0.3, 0.3});
  expect_near(areas_of_master("axisymmetric"), {2.25 * pi, 2.25 * pi, 6.75 * pi});
  expect_near(areas_of_master("solid"), std::vector<double>(6, 0.75));
  EXPECT_THAT(
      any_refusal(
          std::regex_replace(block("{x: [0, 2], y: [0, 1], elements: [1, 1]}", "plane_strain"),
                             std::regex("middles"), "master")),
      ::testing::HasSubstr("area: master is of facets of the mesh, and 'floor' is a rigid"));
}

TEST(GivenAreas, AreRefusedOfOtherFacets) {
  EXPECT_THAT(any_refusal(block("{x: [0, 2], y: [0, 1], z: [0, 1], elements: [1, 1, 1], type: "
                                "hex27}",
                                "solid")),
              ::testing::HasSubstr("area: middles is for facets of 3, 4, 6 or 8 nodes"));
}

}  // namespace
}  // namespace osculate::deck
