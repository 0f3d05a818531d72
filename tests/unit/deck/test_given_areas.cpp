// Areas of slave nodes by fixed shares of their facets.
#include <fmt/format.h>
#include <gmock/gmock.h>

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
}

TEST(GivenAreas, AreRefusedOfOtherFacets) {
  EXPECT_THAT(any_refusal(block("{x: [0, 2], y: [0, 1], z: [0, 1], elements: [1, 1, 1], type: "
                                "hex27}",
                                "solid")),
              ::testing::HasSubstr("area: middles is for facets of 3, 4, 6 or 8 nodes"));
}

}  // namespace
}  // namespace osculate::deck
