// Sets that the model file makes of those of the mesh.
#include <gmock/gmock.h>

#include "space_test.hpp"
#include "system_test.hpp"

namespace osculate::deck {
namespace {

std::string model(const std::string& sets, const std::string& on) {
  return "osculate: 1\n"
         "mesh: {generate: {b: {box: {x: [0, 4], y: [0, 2], elements: [4, 2]}}, c: {box: {x: [5, "
         "6], y: [0, 1], elements: [1, 1]}}}}\n"
         "sets: " +
         sets +
         "\n"
         "materials: {m: {linear_elastic: {E: 1, nu: 0.3}}}\n"
         "sections: [{on: [b, c], material: m, element: plane_strain}]\n"
         "rigid: {wall: {line: {point: [0, -1], normal: [0, 1]}}}\n"
         "contact: [{name: k, master: wall, slave: [b.bottom, c.bottom], normal: {penalty: 1}}]\n"
         "steps: [{name: s, increments: 1, total_force: [{on: " +
         on + ", fy: -6}]}]\n";
}

mesh::Set set_of(const std::string& sets, const std::string& name) {
  const Description d = parse_model(model(sets, "b.top"), "model.yaml");
  const mesh::Mesh mesh = load_mesh(d);
  return *mesh.find_set(name);
}

TEST(Sets, Union) {
  const mesh::Set set = set_of("{u: {union: [b.left, b.top]}}", "u");
  EXPECT_EQ(set.dimension, 1);
  EXPECT_EQ(set.cells.size(), 6u);
  EXPECT_EQ(set.nodes.size(), 7u);
  const mesh::Set mixed = set_of("{u: {union: [b.left, b.top_right]}}", "u");
  EXPECT_EQ(mixed.dimension, 0);
  EXPECT_EQ(mixed.nodes.size(), 4u);
}

TEST(Sets, PartsAndWhatIsLeft) {
  const mesh::Set rest = set_of("{rest: {of: b.top, without: b.left}}", "rest");
  EXPECT_EQ(rest.dimension, 1) << "no side of one is a side of the other";
  EXPECT_EQ(rest.cells.size(), 4u);
  const mesh::Set nodes = set_of("{rest: {of: b.top, without: [b.top_left, b.top_right]}}", "rest");
  EXPECT_EQ(nodes.dimension, 0);
  EXPECT_EQ(nodes.nodes.size(), 3u);
  const mesh::Set corner = set_of("{corner: {of: b.top, within: b.left}}", "corner");
  EXPECT_EQ(corner.nodes.size(), 1u);
  const mesh::Set two = set_of("{a: {union: [b.left, b.top]}, t: {of: a, without: b.left}}", "t");
  EXPECT_EQ(two.cells.size(), 4u);
  EXPECT_EQ(two.nodes.size(), 5u);
}

TEST(Sets, AListInPlaceOfAName) {
  const Built built = build_text(model("{}", "[b.top, c.top]"));
  EXPECT_EQ(built.model.sections.at(0).cells.size(), 9u);
  EXPECT_EQ(built.model.pairs.at(0).definition.slave.nodes.size(), 7u);
  const LoadTotal& load = built.loads[0].at(0);
  EXPECT_EQ(load.on, "b.top+c.top");
  EXPECT_NEAR(load.whole.force.y(), -6, 1e-14);
  // By length: 4/5 of it acts at x = 2 and 1/5 at x = 5.5.
  EXPECT_NEAR(load.whole.moment.z(), -6 * (0.8 * 2 + 0.2 * 5.5), 1e-13);
}

TEST(Sets, Mistakes) {
  const auto refused = [](const std::string& sets) { return any_refusal(model(sets, "b.top")); };
  EXPECT_EQ(refused("{u: {union: [b.lefd]}}"),
            "model.yaml:3: sets.u.union[0]: unknown set 'b.lefd'; did you mean 'b.left'?");
  EXPECT_EQ(refused("{b.top: {union: [b.left]}}"),
            "model.yaml:3: sets: 'b.top' cannot be a name; use letters, digits, _ and -");
  EXPECT_EQ(refused("{b: {union: [b.left]}}"),
            "model.yaml:3: sets.b: the mesh has a set 'b' already");
  EXPECT_EQ(refused("{u: {union: [wall]}}"),
            "model.yaml:3: sets.u.union[0]: 'wall' is a rigid body, which is no part of a set");
  EXPECT_EQ(refused("{u: {of: b}}"), "model.yaml:3: sets.u: 'of' needs 'within' or 'without'");
  EXPECT_EQ(refused("{u: {of: b.top, without: b.top}}"),
            "model.yaml:3: sets.u: nothing is in the set 'u'");
}

}  // namespace
}  // namespace osculate::deck
