// Models that are right by themselves, but do not fit their mesh.
#include "osculate/deck/build.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <vector>

#include "deck_test.hpp"
#include "osculate/io/gmsh.hpp"

namespace osculate::deck {
namespace {

struct Edit {
  std::string from, to;
};
struct Case {
  std::vector<Edit> edits;
  std::string message;
};

std::string build_refusal(const std::string& text) {
  try {
    const Description description = parse_model(text, "model.yaml");
    (void)build(description, load_mesh(description));
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

std::string build_refusal(const std::string& text, mesh::Mesh mesh) {
  try {
    (void)build(parse_model(text, "model.yaml"), std::move(mesh));
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

void expect_refusals(const std::vector<Case>& cases) {
  const std::string model = test_file("bodies.yaml");
  ASSERT_EQ(build_refusal(model), "");
  for (const Case& c : cases) {
    std::string text = model;
    for (const Edit& e : c.edits) text = edited(text, e.from, e.to);
    SCOPED_TRACE(c.edits.front().from + " -> " + c.edits.front().to);
    EXPECT_EQ(build_refusal(text), c.message);
  }
}

TEST(Build, TheModelOfTheseTestsIsRight) {
  const Description description = parse_model(test_file("bodies.yaml"), "model.yaml");
  const Built built = build(description, load_mesh(description));
  EXPECT_EQ(built.model.sections.size(), 2u);
  EXPECT_EQ(built.model.pairs.size(), 3u);
  EXPECT_EQ(built.model.equations.size(), 3u);  // one and two of `equal`
  EXPECT_EQ(built.warnings, std::vector<std::string>{});
}

TEST(Build, SetsThatAreMissing) {
  expect_refusals({
      {{{"{on: low, material", "{on: lov, material"}},
       "model.yaml:11: sections[0].on: unknown set 'lov'; did you mean 'low'?"},
      {{{"set: rail", "set: rial"}},
       "model.yaml:14: rigid.base.set: unknown set 'rial'; did you mean 'rail'?"},
      {{{"slave: low.bottom", "slave: low.botom"}},
       "model.yaml:17: contact[0].slave: unknown set 'low.botom'; did you mean 'low.bottom'?"},
      {{{"master: high.bottom", "master: hihg.bottom"}},
       "model.yaml:18: contact[1].master: unknown set 'hihg.bottom'; did you mean 'high.bottom'?"},
      {{{"{on: low.top_left, of: ux, factor: 1}", "{on: low.topleft, of: ux, factor: 1}"}},
       "model.yaml:23: equations[0].terms[0].on: unknown set 'low.topleft'; did you mean "
       "'low.top_left'?"},
      {{{"{on: high.right, of: ux}", "{on: high.rigth, of: ux}"}},
       "model.yaml:25: equal[0].on: unknown set 'high.rigth'; did you mean 'high.right'?"},
      {{{"{on: low.left, uy: 0}", "{on: low.lefft, uy: 0}"}},
       "model.yaml:30: steps[0].prescribe[0].on: unknown set 'low.lefft'; did you mean "
       "'low.left'?"},
      {{{"{on: high.bottom_right, fy: -1}", "{on: high.bottom_rigth, fy: -1}"}},
       "model.yaml:32: steps[0].forces[0].on: unknown set 'high.bottom_rigth'; did you mean "
       "'high.bottom_right'?"},
      {{{"{on: low.right, value: 1}", "{on: low.rite, value: 1}"}},
       "model.yaml:33: steps[0].pressure[0].on: unknown set 'low.rite'; did you mean 'low.right'?"},
      {{{"{on: high.left, tx: 1}", "{on: high.laft, tx: 1}"}},
       "model.yaml:34: steps[0].traction[0].on: unknown set 'high.laft'; did you mean "
       "'high.left'?"},
      {{{"{on: low, fy: -1}", "{on: slow, fy: -1}"}},
       "model.yaml:35: steps[0].body_force[0].on: unknown set 'slow'; did you mean 'low'?"},
      {{{"{on: low.left, of: [uy]}", "{on: lowleft, of: [uy]}"}},
       "model.yaml:38: steps[1].release[0].on: unknown set 'lowleft'; did you mean 'low.left'?"},
      {{{"{on: low.bottom, of: ux}", "{on: low.bottum, of: ux}"}},
       "model.yaml:40: output.history[0].on: unknown set 'low.bottum'; did you mean 'low.bottom'?"},
      {{{"{on: low.bottom, of: ux}", "{on: something_else, of: ux}"}},
       "model.yaml:40: output.history[0].on: unknown set 'something_else'; known: low, low.left, "
       "low.right, low.bottom, low.top, low.bottom_left, low.bottom_right, low.top_right, "
       "low.top_left, high, high.left, high.right, high.bottom, high.top, high.bottom_left, "
       "high.bottom_right, high.top_right, high.top_left, rail, rail.start, ..."},
  });
}

TEST(Build, Sections) {
  expect_refusals({
      {{{"{on: high, material", "{on: low.top, material"}},
       "model.yaml:12: sections[1].on: set 'low.top' has no area cells, so it cannot be a section"},
      {{{"{on: high, material", "{on: low.top_left, material"}},
       "model.yaml:12: sections[1].on: set 'low.top_left' has no area cells, so it cannot be a "
       "section"},
      {{{"{on: high, material: steel, element: plane_strain}",
         "{on: high, material: steel, element: plane_strain, formulation: enhanced}"}},
       "model.yaml:12: sections[1].formulation: set 'high' has tri3 cells: formulation enhanced "
       "exists for quad4 cells only; use auto"},
      {{{"{on: high, material: steel, element: plane_strain}",
         "{on: high, material: steel, element: plane_strain, formulation: bbar}"}},
       "model.yaml:12: sections[1].formulation: set 'high' has tri3 cells: formulation bbar "
       "exists for quad4 and second-order cells; use auto"},
      {{{"{on: low, material: steel, element: plane_strain}",
         "{on: low, material: steel, element: plane_stress, formulation: bbar}"}},
       "model.yaml:11: sections[0].formulation: set 'low' has quad4 cells: formulation bbar has no "
       "use in plane stress; use full or enhanced"},
      {{{"{on: low, material: steel, element: plane_strain}",
         "{on: low, material: steel, element: axisymmetric}"},
        {"{on: high, material: steel, element: plane_strain}",
         "{on: high, material: steel, element: axisymmetric}"},
        {"low: {box: {x: [0, 4]", "low: {box: {x: [-1, 4]"}},
       "model.yaml:11: sections[0].element: node 1 (-1, 0) of set 'low' has a negative radius; an "
       "axisymmetric body needs x >= 0"},
  });
}

TEST(Build, RigidBodies) {
  expect_refusals({
      {{{"punch: {circle", "low: {circle"},
        {"master: punch", "master: low"},
        {"{on: punch, uy: -0.1}", "{on: low, uy: -0.1}"},
        {"{on: low, fy: -1}", "{on: high, fy: -1}"}},
       "model.yaml:15: rigid.low: rigid body 'low' has the name of a set of the mesh; choose "
       "another"},
      {{{"punch: {circle: {center: [2, 4], radius: 2}}", "punch: {set: rail.start}"}},
       "model.yaml:15: rigid.punch: rigid bodies 'base' and 'punch' share a node"},
      {{{"punch: {circle: {center: [2, 4], radius: 2}}",
         "punch: {nurbs: {degree: 1, knots: [0, 0, 0, 1], control: [[0, 3, 1], [4, 3, 1]]}}"}},
       "model.yaml:15: rigid.punch: knots: expected a range of positive length, found 0..0"},
  });
}

TEST(Build, Contact) {
  expect_refusals({
      {{{"slave: low.bottom", "slave: loose"}},
       "model.yaml:17: contact[0].slave: node 38 (-1, 5) of 'loose' belongs to no section and to "
       "no rigid body"},
      {{{"master: base, slave: low.bottom", "master: loose, slave: low.bottom"}},
       "model.yaml:17: contact[0].master: node 38 (-1, 5) of 'loose' belongs to no section and to "
       "no rigid body"},
      {{{"master: punch, slave: high.top", "master: punch, slave: base"}},
       "model.yaml:19: contact[2].name: both sides of this contact are rigid"},
      {{{"master: high.bottom, slave: low.top", "master: low.left, slave: low.top"}},
       "model.yaml:18: contact[1].slave: master 'low.left' and slave 'low.top' share node 11 (0, "
       "1)"},
      {{{"slave: low.top,", "slave: low.top_left,"}},
       "model.yaml:18: contact[1].slave: a slave node has no positive tributary area; use weight: "
       "node"},
      {{{"master: high.bottom", "master: high.bottom_left"}},
       "model.yaml:18: contact[1].master: contact set 'high.bottom_left' has no facets"},
      {{{"  punch: {circle: {center: [2, 4], radius: 2}}\n",
         "  punch: {circle: {center: [2, 4], radius: 2}}\n  air: {set: loose}\n"},
        {"master: high.bottom, slave: low.top", "master: base, slave: air"}},
       "model.yaml:19: contact[1].name: both sides of this contact are rigid"},
  });
}

TEST(Build, Constraints) {
  expect_refusals({
      {{{"{on: high.right, of: ux}", "{on: rail, of: ux}"}},
       "model.yaml:25: equal[0].on: set 'rail' has nodes of the rigid body 'base'; name the rigid "
       "body instead"},
      {{{"{on: high.right, of: ux}", "{on: loose, of: ux}"}},
       "model.yaml:25: equal[0].on: node 38 (-1, 5) of 'loose' belongs to no section and to no "
       "rigid body"},
      {{{"{on: low.top_left, of: ux, factor: 1}", "{on: base, of: rz, factor: 1}"},
        {"{on: high.bottom_left, of: ux, factor: -1}", "{on: punch, of: ux, factor: -1}"}},
       "model.yaml:23: equations[0]: no displacement of a node can be eliminated: all belong to "
       "rigid bodies"},
      {{{"{on: low.top_left, of: ux, factor: 1}", "{on: rail.start, of: ux, factor: 1}"}},
       "model.yaml:23: equations[0].terms[0].on: set 'rail.start' has nodes of the rigid body "
       "'base'; name the rigid body instead"},
      {{{"of: ux, factor: -1}]}", "of: ux, factor: -1}], value: 1}"},
        {"{on: low.left, uy: 0}", "{on: low.left, uy: 0, ux: 0}"},
        {"{on: punch, uy: -0.1}", "{on: punch, uy: -0.1}\n      - {on: high.left, ux: 0}"}},
       "model.yaml:23: equations[0]: no displacement of it is free: steps prescribe them"},
  });
}

TEST(Build, Prescriptions) {
  expect_refusals({
      {{{"{on: low.left, uy: 0}", "{on: low.left, uy: 0}\n      - {on: low.bottom, uy: 0.5}"}},
       "model.yaml:31: steps[0].prescribe[1].uy: 'low.left' and 'low.bottom' share a node and "
       "prescribe different uy (0 and 0.5)"},
      {{{"{on: low.left, uy: 0}",
         "{on: low.left, uy: 1}\n      - {on: low.bottom, uy: 1, amplitude: wave}"}},
       "model.yaml:31: steps[0].prescribe[1].uy: 'low.left' and 'low.bottom' share a node and "
       "prescribe uy with different amplitudes"},
      {{{"{on: punch, uy: -0.1}", "{on: rail.end, uy: -0.1}"}},
       "model.yaml:31: steps[0].prescribe[1].on: set 'rail.end' has nodes of the rigid body "
       "'base'; name the rigid body instead"},
      {{{"{on: punch, uy: -0.1}", "{on: loose, uy: -0.1}"}},
       "model.yaml:31: steps[0].prescribe[1].on: node 38 (-1, 5) of 'loose' belongs to no section "
       "and to no rigid body"},
      {{{"{on: low.left, of: [uy]}", "{on: low.right, of: [uy]}"}},
       "model.yaml:38: steps[1].release[0]: 'low.right.uy' is not prescribed, so it cannot be "
       "released"},
      {{{"[{on: low.left, of: [uy]}]",
         "[{on: base, of: [uy]}]\n  - {name: three, increments: 1, release: [{on: base, of: "
         "[uy]}]}"}},
       "model.yaml:39: steps[2].release[0]: 'base.uy' is not prescribed, so it cannot be released"},
  });
}

TEST(Build, Loads) {
  expect_refusals({
      {{{"{on: low.right, value: 1}", "{on: low, value: 1}"}},
       "model.yaml:33: steps[0].pressure[0].on: set 'low' has no boundary edges: a load on an edge "
       "needs a set of line cells"},
      {{{"{on: low.right, value: 1}", "{on: low.top_left, value: 1}"}},
       "model.yaml:33: steps[0].pressure[0].on: set 'low.top_left' has no boundary edges: a load "
       "on an edge needs a set of line cells"},
      {{{"{on: low.right, value: 1}", "{on: rail, value: 1}"}},
       "model.yaml:33: steps[0].pressure[0].on: the edge at node 31 (-1, 0) of set 'rail' is no "
       "boundary of a section"},
      {{{"{on: low.right, value: 1}", "{on: loose, value: 1}"}},
       "model.yaml:33: steps[0].pressure[0].on: the edge at node 38 (-1, 5) of set 'loose' is no "
       "boundary of a section"},
      {{{"{on: high.left, tx: 1}", "{on: high, tx: 1}"}},
       "model.yaml:34: steps[0].traction[0].on: set 'high' has no boundary edges: a load on an "
       "edge needs a set of line cells"},
      {{{"{on: low, fy: -1}", "{on: rail, fy: -1}"}},
       "model.yaml:35: steps[0].body_force[0].on: set 'rail' has no bulk cells with a section"},
      {{{"{on: low, fy: -1}", "{on: low.top, fy: -1}"}},
       "model.yaml:35: steps[0].body_force[0].on: set 'low.top' has no bulk cells with a section"},
      {{{"{on: high.bottom_right, fy: -1}", "{on: loose, fy: -1}"}},
       "model.yaml:32: steps[0].forces[0].on: node 38 (-1, 5) of 'loose' belongs to no section and "
       "to no rigid body"},
  });
}

TEST(Build, Generated) {
  expect_refusals({
      {{{"rail: {line: {points: [[-1, 0], [5, 0]], elements: 6}}",
         "rail: {box: {x: [-1, 5], y: [-1, 0], elements: [100000, 100000]}}"}},
       "model.yaml:7: mesh.generate.rail.box.elements: 10000000000 elements are too many; at most "
       "10000000"},
      {{{"high: {box: {x: [0, 4], y: [1.1, 2]", "high: {box: {x: [0, 4], y: [1.1, 1.1]"}},
       "model.yaml:6: mesh.generate.high.box.y[1]: breakpoints must increase, got 1.1 after 1.1"},
  });
}

// ---- meshes of files ----------------------------------------------------------------------------

constexpr const char* square_model =
    "osculate: 1\n"
    "mesh: square.msh\n"
    "materials: {steel: {linear_elastic: {E: 100, nu: 0.3}}}\n"
    "sections:\n"
    "  - {on: block, material: steel, element: plane_strain}\n"
    "steps:\n"
    "  - {name: pull, increments: 1, prescribe: [{on: left, ux: 0, uy: 0}]}\n";

/// Two quads side by side; `block` names both, `right_half` the second, `inner` the edge between.
std::string square_mesh(const std::string& nodes, const std::string& quads) {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
         "$PhysicalNames\n5\n2 1 \"block\"\n2 2 \"right_half\"\n1 3 \"left\"\n1 4 \"inner\"\n"
         "1 5 \"nothing\"\n$EndPhysicalNames\n"
         "$Nodes\n6\n" +
         nodes + "$EndNodes\n$Elements\n" + quads + "$EndElements\n";
}
const std::string good_nodes = "1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n";
const std::string good_quads =
    "5\n1 3 2 1 1 1 2 5 4\n2 3 2 1 1 2 3 6 5\n3 3 2 2 1 2 3 6 5\n4 1 2 3 1 1 4\n5 1 2 4 1 2 5\n";

TEST(Build, MeshesOfFiles) {
  const auto refused = [](const std::string& mesh, const std::string& model) {
    return build_refusal(model, io::read_gmsh(mesh, "square.msh"));
  };
  const std::string mesh = square_mesh(good_nodes, good_quads);
  ASSERT_EQ(refused(mesh, square_model), "");
  EXPECT_EQ(
      refused(square_mesh(good_nodes, edited(good_quads, "1 2 5 4\n", "1 4 5 2\n")), square_model),
      "model.yaml:5: sections[0].on: quad4 cell 1 of set 'block' has a negative or zero volume "
      "(smallest Jacobian -0.25); number its nodes counter-clockwise");
  EXPECT_EQ(
      refused(square_mesh(edited(good_nodes, "6 2 1 0", "6 2 1 0.25"), good_quads), square_model),
      "model.yaml:2: mesh: node 6 has z = 0.25; plane problems need z = 0");
  EXPECT_EQ(
      refused(square_mesh(edited(good_nodes, "6 2 1 0", "6 0.5 0.5 0"), good_quads), square_model),
      "model.yaml:5: sections[0].on: quad4 cell 2 of set 'block' has a negative or zero volume "
      "(smallest Jacobian -0.25); number its nodes counter-clockwise");
  EXPECT_EQ(refused(mesh, edited(square_model, "prescribe: [{on: left, ux: 0, uy: 0}]",
                                 "pressure: [{on: inner, value: 1}]")),
            "model.yaml:7: steps[0].pressure[0].on: set 'inner': line from node 2 (1, 0) to node 5 "
            "(1, 1) lies inside a body: it is an edge of 2 cells");
  EXPECT_EQ(
      refused(mesh, edited(square_model, "steps:\n",
                           "rigid: {wall: {line: {point: [0, -1], normal: [0, 1]}}}\ncontact:\n"
                           "  - {name: c, master: wall, slave: inner, normal: {penalty: 1}}\n"
                           "steps:\n")),
      "model.yaml:8: contact[0].slave: set 'inner': line from node 2 (1, 0) to node 5 (1, 1) lies "
      "inside a body: it is an edge of 2 cells");
  EXPECT_EQ(
      refused(mesh, edited(square_model, "steps:\n",
                           "rigid: {wall: {line: {point: [0, -1], normal: [0, 1]}}}\ncontact:\n"
                           "  - {name: c, master: wall, slave: nothing, normal: {penalty: 1}}\n"
                           "steps:\n")),
      "model.yaml:8: contact[0].slave: contact set 'nothing' is empty");
}

TEST(Build, CoordinatesThatAreNoNumber) {
  mesh::Mesh mesh = io::read_gmsh(square_mesh(good_nodes, good_quads), "square.msh");
  mesh.nodes[2].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(build_refusal(square_model, mesh),
            "model.yaml:2: mesh: 1 node(s) with coordinates that are no number, or beyond 1e100: 3 "
            "(2, nan)");
}

TEST(Build, OverlappingSections) {
  mesh::Mesh mesh = io::read_gmsh(square_mesh(good_nodes, good_quads), "square.msh");
  EXPECT_EQ(build_refusal(edited(square_model, "steps:\n",
                                 "  - {on: right_half, material: steel, element: plane_strain}\n"
                                 "steps:\n"),
                          mesh),
            "model.yaml:6: sections[1].on: cells of set 'right_half' already belong to the section "
            "on 'block'");
}

/// A body in two pieces, one of them in the air; and two sections that hang together.
TEST(Build, BodiesThatNothingHolds) {
  const std::string mesh = square_mesh("1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n",
                                       "3\n1 2 2 1 1 1 2 4\n2 2 2 2 1 2 5 4\n3 1 2 3 1 1 4\n");
  const std::string two = edited(square_model, "steps:\n",
                                 "  - {on: right_half, material: steel, element: plane_strain}\n"
                                 "steps:\n");
  EXPECT_EQ(build_refusal(two, io::read_gmsh(mesh, "square.msh")), "");
  const std::string apart = square_mesh("1 0 0 0\n2 1 0 0\n3 3 0 0\n4 0 1 0\n5 3 1 0\n6 2 1 0\n",
                                        "3\n1 2 2 1 1 1 2 4\n2 2 2 2 1 6 3 5\n3 1 2 3 1 1 4\n");
  EXPECT_EQ(build_refusal(two, io::read_gmsh(apart, "square.msh")),
            "model.yaml:6: sections[1].on: a part of body 'right_half' (1 cells, at node 6 (2, 1)) "
            "is held by nothing: no contact, no prescribed displacement, no shared node");
}

TEST(Build, WhatIsReleasedMayBeLoadedAtOnce) {
  const std::string text = edited(test_file("bodies.yaml"), "[{on: low.left, of: [uy]}]",
                                  "[{on: punch, of: [uy]}]\n    forces: [{on: punch, fy: -1}]");
  ASSERT_EQ(build_refusal(text), "");
  const Description description = parse_model(text, "model.yaml");
  const Built built = build(description, load_mesh(description));
  const model::Dof loaded = 2 * static_cast<Index>(built.model.reference.size()) + 3 + 1;
  const auto prescribes = [&](const model::Step& step) {
    return std::any_of(step.prescribed.begin(), step.prescribed.end(),
                       [&](const model::PrescribedDof& p) { return p.dof == loaded; });
  };
  EXPECT_TRUE(prescribes(built.model.steps[0]));
  EXPECT_FALSE(prescribes(built.model.steps[1]));
}

/// The pressure on an edge takes the thickness of the cell behind it, not of its first node.
TEST(Build, EdgesBelongToTheSectionBehindThem) {
  const std::string mesh = square_mesh(
      good_nodes, "4\n1 3 2 1 1 1 2 5 4\n2 3 2 2 1 2 3 6 5\n3 1 2 3 1 1 4\n4 1 2 4 1 2 3\n");
  const std::string text = edited(
      edited(
          square_model, "steps:\n",
          "  - {on: right_half, material: steel, element: plane_stress, thickness: 3}\nsteps:\n"),
      "prescribe:", "pressure: [{on: inner, value: 1}], prescribe:");
  const Built built = build(parse_model(text, "model.yaml"), io::read_gmsh(mesh, "square.msh"));
  ASSERT_EQ(built.model.steps[0].pressure.size(), 1u);
  for (const model::PressureLoad::Edge& edge : built.model.steps[0].pressure[0].facets)
    EXPECT_EQ(built.model.sections[static_cast<std::size_t>(edge.section)].name, "right_half");
}

TEST(Build, ADisplacementNamedTwiceInAnEquationIsOneTerm) {
  const std::string text =
      edited(test_file("bodies.yaml"), "{on: low.top_left, of: ux, factor: 1}",
             "{on: low.top_left, of: ux, factor: 1}, {on: low.top_left, of: ux, factor: 2}");
  const Description description = parse_model(text, "model.yaml");
  const Built built = build(description, load_mesh(description));
  const std::vector<model::Equation::Term>& terms = built.model.equations[0].terms;
  ASSERT_EQ(terms.size(), 2u);
  EXPECT_EQ(terms[0].factor, 3.0);
  EXPECT_EQ(terms[1].factor, -1.0);
}

/// A mesh file that cannot be read: the line of the model that names it, and its own.
TEST(Build, MeshFileThatCannotBeRead) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / "osculate_test_build";
  std::filesystem::create_directories(folder);
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << text;
  };
  const auto refused = [&] {
    try {
      (void)build_file((folder / "model.yaml").string());
    } catch (const core::InputError& error) {
      std::string text = error.what();
      for (std::size_t at = 0; (at = text.find(folder.string() + "/")) != std::string::npos;)
        text.erase(at, folder.string().size() + 1);
      return text;
    }
    return std::string{};
  };
  write("model.yaml", square_model);
  EXPECT_EQ(refused(), "model.yaml:2: mesh: square.msh: no such file");
  const std::string mesh = square_mesh(good_nodes, good_quads);
  write("square.msh", mesh.substr(0, mesh.find("5 1 1 0")));
  EXPECT_EQ(refused(),
            "model.yaml:2: mesh: square.msh:13: $Nodes: 6 nodes announced, but the rest of the "
            "file holds at most 4");
  write("square.msh", edited(mesh, "$Nodes\n6\n", "$Nodes\n4000000000000\n"));
  EXPECT_EQ(refused(),
            "model.yaml:2: mesh: square.msh:13: $Nodes: 4000000000000 nodes announced, but the "
            "rest of the file holds at most 20");
  write("square.msh", mesh);
  EXPECT_EQ(refused(), "");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace osculate::deck
