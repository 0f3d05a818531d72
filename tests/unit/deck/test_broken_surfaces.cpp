// Mistakes in a surface file, each with its full message.
#include <limits>

#include "deck_test.hpp"
#include "osculate/deck/parse_surface.hpp"

namespace osculate::deck {
namespace {

constexpr const char* square = R"(osculate_surface: 1
dimension: 3
nodes: [[0, 0, 0], [1, 0, 0],
        [1, 1, 0], [0, 1, 0]]
facets:
  quad4: [[0, 1, 2, 3]]
)";

std::string surface_refusal(const std::string& text, const TextLimits& limits = surface_limits) {
  try {
    (void)parse_surface(text, "s.yaml", limits);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

struct Mistake {
  std::string from, to, message;
};

void expect_refusals(const std::vector<Mistake>& mistakes) {
  ASSERT_EQ(surface_refusal(square), "");
  for (const Mistake& mistake : mistakes) {
    SCOPED_TRACE(mistake.from + " -> " + mistake.to);
    EXPECT_EQ(surface_refusal(edited(square, mistake.from, mistake.to)), mistake.message);
  }
}

TEST(BrokenSurfaces, Header) {
  expect_refusals({
      {"osculate_surface: 1", "osculate_surface: 2",
       "s.yaml:1: osculate_surface: must be 1, got 2"},
      {"osculate_surface: 1\n", "", "s.yaml:1: required key 'osculate_surface' is missing"},
      {"osculate_surface: 1", "osculate: 1",
       "s.yaml:1: 'osculate' begins a model file; expected a mesh (osculate_surface, dimension, "
       "nodes, facets) or one shape"},
      {"dimension: 3", "dimension: 4", "s.yaml:2: dimension: must be >= 2 and <= 3, got 4"},
      {"dimension: 3\n", "", "s.yaml:1: required key 'dimension' is missing"},
      {"dimension: 3", "dimension: flat",
       "s.yaml:2: dimension: expected an integer, got the text 'flat'"},
      {"dimension: 3", "dimension: 3\ndimension: 3",
       "s.yaml:3: key 'dimension' is given twice, first on line 2"},
      {"dimension: 3", "dimensoin: 3",
       "s.yaml:2: unknown key 'dimensoin'; did you mean 'dimension'?"},
      {"facets:\n", "facts:\n", "s.yaml:5: unknown key 'facts'; did you mean 'facets'?"},
      {"facets:\n  quad4: [[0, 1, 2, 3]]\n", "", "s.yaml:1: required key 'facets' is missing"},
  });
}

TEST(BrokenSurfaces, Nodes) {
  expect_refusals({
      {"[1, 1, 0]", "[1, 1]", "s.yaml:4: nodes[2]: expected 3 coordinates (dimension: 3), got 2"},
      {"dimension: 3", "dimension: 2",
       "s.yaml:3: nodes[0]: expected 2 coordinates (dimension: 2), got 3"},
      {"[1, 1, 0]", "7", "s.yaml:4: nodes[2]: expected 3 coordinates (dimension: 3), got 7"},
      {"[1, 1, 0]", "[1, .nan, 0]", "s.yaml:4: nodes[2][1]: must be a finite number, got .nan"},
      {"[1, 1, 0]", "[1, nan, 0]", "s.yaml:4: nodes[2][1]: must be a finite number, got nan"},
      {"[1, 1, 0]", "[1, -inf, 0]", "s.yaml:4: nodes[2][1]: must be a finite number, got -inf"},
      {"[1, 1, 0]", "[1, 1e999, 0]",
       "s.yaml:4: nodes[2][1]: 1e999 is out of range: use numbers between 1e-300 and 1e100"},
      {"[1, 1, 0]", "[1, one, 0]", "s.yaml:4: nodes[2][1]: expected a number, got the text 'one'"},
      {"[1, 1, 0]", "[1, '1', 0]",
       "s.yaml:4: nodes[2][1]: expected a number, got the quoted text '1'"},
      {"[1, 1, 0]", "[1, [1], 0]", "s.yaml:4: nodes[2][1]: expected a number, got a list"},
  });
  EXPECT_EQ(
      surface_refusal("{osculate_surface: 1, dimension: 2, nodes: [], facets: {line2: [[0, 1]]}}"),
      "s.yaml:1: nodes: needs at least one of the nodes");
  EXPECT_EQ(surface_refusal("{osculate_surface: 1, dimension: 2, nodes: 3, facets: {line2: []}}"),
            "s.yaml:1: nodes: expected a list of nodes, got 3");
}

TEST(BrokenSurfaces, Facets) {
  expect_refusals({
      {"[[0, 1, 2, 3]]", "[[0, 1, 2, 4]]",
       "s.yaml:6: facets.quad4[0][3]: there is no node 4: the 4 nodes are numbered from 0 to 3"},
      {"[[0, 1, 2, 3]]", "[[0, 1, 2, -1]]",
       "s.yaml:6: facets.quad4[0][3]: there is no node -1: the 4 nodes are numbered from 0 to 3"},
      {"[[0, 1, 2, 3]]", "[[0, 1, 2.5, 3]]",
       "s.yaml:6: facets.quad4[0][2]: expected an integer, got 2.5"},
      {"[[0, 1, 2, 3]]", "[[0, 1, 99999999999, 3]]",
       "s.yaml:6: facets.quad4[0][2]: 99999999999 is too large for an integer"},
      {"[[0, 1, 2, 3]]", "[[0, 1, {a: 1}, 3]]",
       "s.yaml:6: facets.quad4[0][2]: expected the number of a node, got a map"},
      {"[[0, 1, 2, 3]]", "[[0, 1, 2, 3],\n  [0, 1, 2]]",
       "s.yaml:7: facets.quad4[1]: expected the 4 nodes of a quad4, got 3"},
      {"[[0, 1, 2, 3]]", "[[0, 1, 2, 3, 0]]",
       "s.yaml:6: facets.quad4[0]: expected the 4 nodes of a quad4, got 5"},
      {"[[0, 1, 2, 3]]", "[0, 1, 2, 3]",
       "s.yaml:6: facets.quad4[0]: expected the 4 nodes of a quad4, got 0"},
      {"[[0, 1, 2, 3]]", "[[0, 1, 2, 1]]",
       "s.yaml:6: facets.quad4[0][3]: the facet names node 1 twice"},
      {"[[0, 1, 2, 3]]", "[]", "s.yaml:6: facets.quad4: needs at least one of the facets"},
      {"[[0, 1, 2, 3]]", "4", "s.yaml:6: facets.quad4: expected a list of facets, got 4"},
      {"\n  quad4: [[0, 1, 2, 3]]", " {}", "s.yaml:5: facets: needs at least one facet"},
      {"\n  quad4: [[0, 1, 2, 3]]", " [[0, 1, 2, 3]]",
       "s.yaml:5: facets: expected a map from types of facets to lists of them, got a list"},
      {"quad4", "quat4", "s.yaml:6: facets: unknown facet type 'quat4'; did you mean 'quad4'?"},
      {"quad4", "hex8",
       "s.yaml:6: facets: unknown facet type 'hex8'; known: tri3, tri6, quad4, quad8, quad9"},
      {"quad4", "line2",
       "s.yaml:6: facets: 'line2' cannot be used with `dimension: 3`; use tri3, tri6, quad4, "
       "quad8, quad9"},
      {"quad4: [[0, 1, 2, 3]]", "quad4: [[0, 1, 2, 3]]\n  quad4: [[0, 1, 2, 3]]",
       "s.yaml:7: facets: key 'quad4' is given twice, first on line 6"},
  });
}

TEST(BrokenSurfaces, NeitherMeshNorShape) {
  const std::string expected = "a mesh (osculate_surface, dimension, nodes, facets) or one shape";
  EXPECT_EQ(surface_refusal(""), "s.yaml: the file is empty; expected " + expected);
  EXPECT_EQ(surface_refusal("{}"), "s.yaml:1: expected " + expected);
  EXPECT_EQ(surface_refusal("[1, 2]"), "s.yaml:1: expected " + expected + ", got a list");
  EXPECT_EQ(surface_refusal("spere: {center: [0, 0, 0], radius: 1}"),
            "s.yaml:1: unknown key 'spere'; did you mean 'sphere'?");
  EXPECT_EQ(surface_refusal("sphere: {center: [0, 0, 0], radius: 1}\n"
                            "circle: {center: [0, 0], radius: 1}"),
            "s.yaml:2: 'sphere' and 'circle' exclude each other: expected " + expected);
  EXPECT_EQ(surface_refusal("osculate_surface: 1\nsphere: {center: [0, 0, 0], radius: 1}"),
            "s.yaml:2: 'osculate_surface' and 'sphere' exclude each other: expected " + expected);
  EXPECT_EQ(surface_refusal("set: base"),
            "s.yaml:1: unknown key 'set'; known: osculate_surface, dimension, nodes, facets, "
            "circle, arc, polyline, line, nurbs, plane, sphere, cylinder, cone, torus, "
            "nurbs_patch");
}

TEST(BrokenSurfaces, Shapes) {
  const std::vector<std::pair<std::string, std::string>> mistakes{
      {"sphere: {center: [0, 0], radius: 1}", "s.yaml:1: sphere.center: expected 3 values, got 2"},
      {"sphere: {center: [0, 0, 0], radius: 0}", "s.yaml:1: sphere.radius: must be > 0, got 0"},
      {"sphere: {center: [0, 0, 0], radius: nan}",
       "s.yaml:1: sphere.radius: must be a finite number, got nan"},
      {"sphere: {center: [0, 0, 0], radios: 1}",
       "s.yaml:1: sphere: unknown key 'radios'; did you mean 'radius'?"},
      {"sphere: 3",
       "s.yaml:1: sphere: expected a map, got 3; write `sphere: {center: ..., radius: ...}`"},
      {"torus: {center: [0, 0, 0], axis: [0, 0, 1], radius: 1, tube_radius: 1}",
       "s.yaml:1: torus.tube_radius: must be below `radius` (1), got 1"},
      {"plane: {point: [0, 0, 0], normal: [0, 0, 0]}", "s.yaml:1: plane.normal: must not be zero"},
      {"polyline: {points: [[0, 0]]}",
       "s.yaml:1: polyline.points: expected at least 2 values, got 1"},
      {"polyline: {points: [[0, 0], [0, 0]]}",
       "s.yaml:1: polyline.points[1]: the point coincides with the one before it"},
      {"nurbs: {degree: [1], knots: [[0, 0, 1]], control: [[0, 0, 1], [1, 0, 1]]}",
       "s.yaml:1: nurbs.knots: expected at least 4 values, got 3"},
      {"nurbs: {degree: [1], knots: [[0, 0, 1, 1]], control: [[0, 0, 1], [1, 0, 0]]}",
       "s.yaml:1: nurbs.control[1][2]: a weight must be > 0, got 0"},
      {"nurbs: {degree: [1, 1, 1], knots: [[0, 0, 1, 1]], control: [[0, 0, 1], [1, 0, 0]]}",
       "s.yaml:1: nurbs.degree: expected 2 values, got 3"},
      {"nurbs: {degree: [1, 1], knots: [[0, 0, 1, 1], [0, 0, 1, 1]], control: [[0, 0, 1], [1, 0, "
       "0]]}",
       "s.yaml:1: nurbs.control[0][0]: expected a list of 4 numbers, got 0"},
      {"nurbs: {knots: [[0, 0, 1, 1]]}", "s.yaml:1: nurbs: required key 'degree' is missing"},
  };
  for (const auto& [text, message] : mistakes) EXPECT_EQ(surface_refusal(text), message);
}

TEST(BrokenSurfaces, TooLarge) {
  TextLimits limits;
  limits.nodes = 10;
  EXPECT_EQ(surface_refusal(square, limits),
            "s.yaml:3: nodes[0]: the file is too large: more than 10 values");
}

}  // namespace
}  // namespace osculate::deck
