// Models whose keys are all right, but that contradict themselves.
#include <vector>

#include "deck_test.hpp"

namespace osculate::deck {
namespace {

struct Mistake {
  std::string from, to, message;
};

void expect_refusals(const std::string& file, const std::vector<Mistake>& mistakes) {
  const std::string text = test_file(file);
  ASSERT_EQ(refusal(text), "");
  for (const Mistake& mistake : mistakes) {
    SCOPED_TRACE(mistake.from + " -> " + mistake.to);
    EXPECT_EQ(refusal(edited(text, mistake.from, mistake.to)), mistake.message);
  }
}

TEST(BrokenReferences, NamesOfNothing) {
  expect_refusals("block.yaml",
                  {
                      {"material: steel", "material: steal",
                       "model.yaml:7: sections[0].material: unknown material 'steal'; did you mean "
                       "'steel'?"},
                      {"amplitude: wave", "amplitude: wav",
                       "model.yaml:31: steps[1].prescribe[0].amplitude: unknown amplitude 'wav'; "
                       "did you mean 'wave'?"},
                      {"uy: -0.007", "rz: 0.1",
                       "model.yaml:27: steps[0].prescribe[0].rz: 'rz' needs a rigid body: unknown "
                       "rigid body 'top'; known: base, roll"},
                      {"{on: roll, fy: -1}", "{on: rolls, mz: -1}",
                       "model.yaml:32: steps[1].forces[0].mz: 'mz' needs a rigid body: unknown "
                       "rigid body 'rolls'; did you mean 'roll'?"},
                      {"x: D.ux", "x: D.uy",
                       "model.yaml:40: output.plots[0].x: unknown column 'D.uy'; did you mean "
                       "'D.ux'?"},
                      {"{on: floor, of: normal_force}", "{on: flor, of: normal_force}",
                       "model.yaml:39: output.history[1].of: 'normal_force' belongs to contact "
                       "pairs: unknown pair 'flor'; did you mean 'floor'?"},
                      {"{on: floor, of: normal_force}", "{on: floor, of: ux}",
                       "model.yaml:39: output.history[1].of: 'ux' belongs to sets and rigid "
                       "bodies, but 'floor' is a contact pair"},
                      {"{on: D, of: ux}", "{on: D, of: rmz}",
                       "model.yaml:39: output.history[0].of: 'rmz' needs a rigid body, and 'D' is "
                       "not one"},
                  });
}

TEST(BrokenReferences, NamesGivenTwice) {
  expect_refusals(
      "block.yaml",
      {
          {"name: shear", "name: press",
           "model.yaml:28: steps[1].name: step 'press' is given twice, first on line 27"},
          {"contact:\n",
           "contact:\n  - {name: floor, master: roll, slave: top, normal: {penalty: 1}}\n",
           "model.yaml:13: contact[1].name: contact 'floor' is given twice, first on line 12"},
          {"name: floor", "name: roll",
           "model.yaml:12: contact[0].name: the name 'roll' already belongs to the rigid body on "
           "line 10"},
          {"sections:\n", "sections:\n  - {on: block, material: steel, element: plane_stress}\n",
           "model.yaml:8: sections[1].on: section on 'block' is given twice, first on line 7"},
          {"  roll: {circle: {center: [0, 9], radius: 3}}", "  roll: {set: base_line}",
           "model.yaml:10: rigid.roll.set: set 'base_line' is given twice, first on line 9"},
          {"[{on: top, of: uy}]", "[{on: top, of: uy}, {on: top, of: uy}]",
           "model.yaml:25: equal[1]: equal 'top.uy' is given twice, first on line 25"},
          {"{on: D, of: ux}", "{on: D, of: ux, name: floor.normal_force}",
           "model.yaml:39: output.history[1]: column 'floor.normal_force' is given twice, first "
           "on line 39"},
          {"{on: D, of: ux}", "{on: D, of: ux, name: time}",
           "model.yaml:39: output.history[0]: column 'time' is always there; choose another name"},
      });
}

TEST(BrokenReferences, Contact) {
  expect_refusals("block.yaml",
                  {
                      {"slave: base", "slave: roll",
                       "model.yaml:14: contact[0].slave: rigid body 'roll' is an analytic shape, "
                       "which can only be master"},
                  });
}

TEST(BrokenReferences, Sections) {
  expect_refusals("block.yaml",
                  {
                      {"element: plane_strain", "element: plane_strain, kinematics: finite",
                       "model.yaml:7: sections[0].kinematics: material 'steel' is linear_elastic, "
                       "which needs kinematics: small"},
                      {"element: plane_strain", "element: axisymmetric, thickness: 2",
                       "model.yaml:7: sections[0].thickness: an axisymmetric body has no "
                       "thickness"},
                  });
  expect_refusals("full.yaml",
                  {{"kinematics: finite", "kinematics: small",
                    "model.yaml:23: sections[0].kinematics: material 'rubber' is hyperelastic, "
                    "which needs kinematics: finite"}});
}

TEST(BrokenReferences, ContradictionsWithinAStep) {
  const std::string prescribe = "      - {on: top, ux: 0.008, amplitude: wave}\n";
  expect_refusals(
      "block.yaml",
      {
          {prescribe, prescribe + "      - {on: top, ux: 0.01}\n",
           "model.yaml:32: steps[1].prescribe[1].ux: prescription of 'top.ux' is given twice, "
           "first on line 31"},
          {prescribe, prescribe + "    release: [{on: top, of: [ux]}]\n",
           "model.yaml:32: steps[1].release[0]: 'top.ux' is already prescribed or released in "
           "this step, on line 31"},
          {prescribe, prescribe + "    release: [{on: top, of: [uy, uy]}]\n",
           "model.yaml:32: steps[1].release[0].of[1]: 'uy' is given twice"},
          {prescribe, prescribe + "    release: [{on: top, of: [rz]}]\n",
           "model.yaml:32: steps[1].release[0]: 'rz' needs a rigid body: unknown rigid body "
           "'top'; known: base, roll"},
          {"increments: 1,", "increments: 1, release: [{on: left, of: [ux]}],",
           "model.yaml:27: steps[0].release[0]: no earlier step prescribes ux, so it cannot be "
           "released"},
          {"[{on: roll, fy: -1}]", "[{on: roll, fy: -1}, {on: roll, fy: -1}]",
           "model.yaml:32: steps[1].forces[1].fy: load on 'roll.fy' is given twice, first on line "
           "32"},
          {"[{on: roll, fy: -1}]", "[{on: top, fx: -1}]",
           "model.yaml:32: steps[1].forces[0].fx: a force cannot be given where line 31 prescribes "
           "ux of 'top'"},
          {"forces: [{on: roll, fy: -1}]", "pressure: [{on: roll, value: 1}]",
           "model.yaml:32: steps[1].pressure[0].on: 'roll' is a rigid body; only forces act on it "
           "directly"},
      });
}

TEST(BrokenReferences, Constraints) {
  expect_refusals("full.yaml",
                  {
                      {"{on: base, of: rz, factor: -2.5}", "{on: B, of: rz, factor: -2.5}",
                       "model.yaml:53: equations[0].terms[1].on: 'rz' needs a rigid body: unknown "
                       "rigid body 'B'; known: base, disc, bow, frame, wall, spline"},
                      {"factor: -2.5", "factor: 0",
                       "model.yaml:53: equations[0].terms[1].factor: must not be zero"},
                      {"{on: block.top, of: uy}", "{on: disc, of: uy}",
                       "model.yaml:55: equal[0].on: 'disc' is a rigid body; its nodes already move "
                       "as one"},
                  });
}

TEST(BrokenReferences, Amplitudes) {
  expect_refusals(
      "block.yaml",
      {
          {"[0.5, 1]", "[0, 1]",
           "model.yaml:24: amplitudes.wave[1][0]: fractions must increase, got 0 after "
           "0"},
          {"[1, 0]]", "[1.5, 0]]",
           "model.yaml:24: amplitudes.wave[2][0]: the fraction of the step must be >= 0 "
           "and <= 1, got 1.5"},
      });
}

TEST(BrokenReferences, GeneratedMesh) {
  expect_refusals(
      "full.yaml",
      {
          {"x: [0, 2, 4]", "x: [0, 2, 2]",
           "model.yaml:8: mesh.generate.block.box.x[2]: breakpoints must increase, got 2 after 2"},
          {"[[8, 4], 3]", "[[8, 4, 2], 3]",
           "model.yaml:10: mesh.generate.block.box.elements[0]: expected one value for each of the "
           "2 intervals, got 3"},
          {"[[8, 4], 3]", "[8.5, 3]",
           "model.yaml:10: mesh.generate.block.box.elements[0]: expected an integer, got 8.5"},
          {"[[8, 4], 3]", "[90000, 90000]",
           "model.yaml:10: mesh.generate.block.box.elements: 16200000000 elements are too many; at "
           "most 10000000"},
          {"[[1, 2], 0.5]", "[[1, -2], 0.5]",
           "model.yaml:11: mesh.generate.block.box.bias[0][1]: must be > 0, got -2"},
          {"type: quad8", "type: quad5",
           "model.yaml:12: mesh.generate.block.box.type: unknown value 'quad5'; did you mean "
           "'quad4'?"},
          {"radius: 50", "radius: 2",
           "model.yaml:13: mesh.generate.block.box.crown.radius: the arc does not span the box: "
           "the radius must be at least 2.5 in size, got 2"},
          {"[[0, -1], [2, -1], [4, -2]]", "[[0, -1], [0, -1], [4, -2]]",
           "model.yaml:17: mesh.generate.rail.line.points[1]: the point coincides with the one "
           "before it"},
          {"rail: {line:", "rail: {lines:",
           "model.yaml:17: mesh.generate.rail: unknown key 'lines'; did you mean 'line'?"},
      });
}

TEST(BrokenReferences, RigidShapes) {
  expect_refusals(
      "full.yaml",
      {
          {"to: 90", "to: 300",
           "model.yaml:28: rigid.bow.arc.to: must be above `from` (-90) by at most 360, got 300"},
          {"[[0, 0], [1, 0], [1, 1]]", "[[0, 0], [1, 0]]",
           "model.yaml:29: rigid.frame.polyline.points: a closed polyline needs at least 3 points"},
          {"[[0, 0], [1, 0], [1, 1]]", "[[0, 0], [1, 0], [1, 1], [0, 0]]",
           "model.yaml:29: rigid.frame.polyline.points: a closed polyline must not repeat its "
           "first point at the end"},
          {"normal: [0, 2]", "normal: [0, 0]",
           "model.yaml:30: rigid.wall.line.normal: must not be zero"},
          {"degree: 2", "degree: 3",
           "model.yaml:35: rigid.spline.nurbs.control: degree 3 needs at least 4 control points, "
           "got 3"},
          {"[0, 0, 0, 1, 1, 1]", "[0, 0, 1, 1, 1]",
           "model.yaml:34: rigid.spline.nurbs.knots: expected 6 knots (control points + degree + "
           "1), got 5"},
          {"[0, 0, 0, 1, 1, 1]", "[0, 0, 0, 1, 0.5, 1]",
           "model.yaml:34: rigid.spline.nurbs.knots[4]: knots must not decrease, got 0.5 after 1"},
          {"[0, 1, 1]]", "[0, 1, 0]]",
           "model.yaml:35: rigid.spline.nurbs.control[2][2]: a weight must be > 0, got 0"},
      });
}

TEST(BrokenReferences, UnknownSetNamesTheNearest) {
  const Name on{"topp", {"model.yaml", 7, "steps[0].prescribe[0].on"}};
  const std::vector<std::string> sets{"bottom", "top"};
  EXPECT_STREQ(unknown_set(on, sets).what(),
               "model.yaml:7: steps[0].prescribe[0].on: unknown set 'topp'; did you mean 'top'?");
  EXPECT_STREQ(unknown_set(on, {}).what(),
               "model.yaml:7: steps[0].prescribe[0].on: unknown set 'topp'; there are none");
}

}  // namespace
}  // namespace osculate::deck
