// Mistakes in the keys and values of a model file, each with its full message.
#include <vector>

#include "deck_test.hpp"

namespace osculate::deck {
namespace {

/// One change of block.yaml and what is said about it.
struct Mistake {
  std::string from, to, message;
};

void expect_refusals(const std::vector<Mistake>& mistakes) {
  const std::string block = test_file("block.yaml");
  ASSERT_EQ(refusal(block), "");
  for (const Mistake& mistake : mistakes) {
    SCOPED_TRACE(mistake.from + " -> " + mistake.to);
    EXPECT_EQ(refusal(edited(block, mistake.from, mistake.to)), mistake.message);
  }
}

TEST(BrokenModels, UnknownKeysNameTheNearest) {
  expect_refusals({
      {"coulomb:", "coulumb:",
       "model.yaml:17: contact[0].friction: unknown key 'coulumb'; did you mean 'coulomb'?"},
      {"title:", "titel:", "model.yaml:2: unknown key 'titel'; did you mean 'title'?"},
      {"max_iterations:", "max_iteration:",
       "model.yaml:35: solver: unknown key 'max_iteration'; did you mean 'max_iterations'?"},
      {"residual: surface", "resdual: surface",
       "model.yaml:20: contact[0]: unknown key 'resdual'; did you mean 'residual'?"},
      {"amplitude: wave", "amplitud: wave",
       "model.yaml:31: steps[1].prescribe[0]: unknown key 'amplitud'; did you mean 'amplitude'?"},
      {"uy: -0.007", "zz: -0.007",
       "model.yaml:27: steps[0].prescribe[0]: unknown key 'zz'; did you mean 'uz'?"},
      {"uy: -0.007", "UY: -0.007",
       "model.yaml:27: steps[0].prescribe[0]: unknown key 'UY'; did you mean 'uy'?"},
      {"{on: roll, fy", "{\"on\\n\\e\": roll, fy",
       "model.yaml:32: steps[1].forces[0]: unknown key 'on?\?'; did you mean 'on'?"},
      {"linear_elastic:", "plastic_flow:",
       "model.yaml:5: materials.steel: unknown key 'plastic_flow'; known: linear_elastic, "
       "st_venant_kirchhoff, neo_hooke, elastoplastic, norton, deformation_plasticity, rubber, "
       "ogden, hyperfoam, arruda_boyce, "
       "orthotropic, anisotropic, viscoelastic, "
       "user, expansion, relaxation"
       "; a material is NAME: {LAW: {E: ..., nu: ...}} with one of the laws linear_elastic, "
       "st_venant_kirchhoff, neo_hooke, elastoplastic, norton, deformation_plasticity, rubber, "
       "ogden, hyperfoam, arruda_boyce, "
       "orthotropic, anisotropic, viscoelastic, "
       "user; "
       "others are not available "
       "(osculate "
       "doc "
       "limits)"},
      {"penalty: 2.1e6}\n    friction", "penalty: 2.1e6, <<: 1}\n    friction",
       "model.yaml:16: contact[0].normal: unknown key '<<'; known: penalty, exponential, table, "
       "decaying, tensile, user, "
       "damping, auto_factor, separation, tolerance, initial_gap"},
  });
}

TEST(BrokenModels, MissingKeysNameTheParent) {
  expect_refusals({
      {"osculate: 1\n", "", "model.yaml:1: required key 'osculate' is missing"},
      {"mesh: block.msh\n", "", "model.yaml:1: required key 'mesh' is missing"},
      {"    master: bottom\n", "", "model.yaml:12: contact[0]: required key 'master' is missing"},
      {", nu: 0.3", "",
       "model.yaml:5: materials.steel.linear_elastic: required key 'nu' is missing"},
      {", radius: 3", "", "model.yaml:10: rigid.roll.circle: required key 'radius' is missing"},
      {"    increments: 80\n", "    duration: 1\n    dynamics: {}\n",
       "model.yaml:28: steps[1]: required key 'increments' is missing"},
      {"{on: top, ux: 0.008,", "{ux: 0.008,",
       "model.yaml:31: steps[1].prescribe[0]: required key 'on' is missing"},
      {"{mu: 0.3, penalty: 2.1e6}", "{penalty: 2.1e6}",
       "model.yaml:17: contact[0].friction.coulomb: required key 'mu' is missing"},
      {"{coulomb: {mu: 0.3, penalty: 2.1e6}}", "{}",
       "model.yaml:17: contact[0].friction: needs one of coulomb, tresca, rough, rate_and_state, "
       "viscous, user"},
      {"{on: floor, of: normal_force}", "{on: floor}",
       "model.yaml:39: output.history[1]: required key 'of' is missing"},
  });
}

TEST(BrokenModels, OneOfSeveralKeys) {
  expect_refusals({
      {"{set: base_line}", "{flip: true}",
       "model.yaml:9: rigid.base: needs one of set, circle, arc, polyline, line, nurbs, "
       "composite, plane, sphere, cylinder, cone, torus, nurbs_patch"},
      {"{set: base_line}", "{set: base_line, circle: {center: [0, 0], radius: 1}}",
       "model.yaml:9: rigid.base: 'set' and 'circle' exclude each other"},
      {"{set: base_line}", "{set: base_line, mass: 2, kinematics: small}",
       "model.yaml:9: rigid.base.kinematics: `small` goes with a `set` without a mass or a "
       "density"},
      {", radius: 3}}", ", radius: 3}, kinematics: small}",
       "model.yaml:10: rigid.roll.kinematics: `small` goes with a `set` without a mass or a "
       "density"},
      {"{linear_elastic: {E: 2.1e4, nu: 0.3}}", "{}",
       "model.yaml:5: materials.steel: needs one of linear_elastic, st_venant_kirchhoff, "
       "neo_hooke, elastoplastic, norton, deformation_plasticity, rubber, ogden, hyperfoam, "
       "arruda_boyce, "
       "orthotropic, anisotropic, viscoelastic, user"
       "; a material is NAME: {LAW: {E: ..., nu: ...}} with one of the laws linear_elastic, "
       "st_venant_kirchhoff, neo_hooke, elastoplastic, norton, deformation_plasticity, rubber, "
       "ogden, hyperfoam, arruda_boyce, "
       "orthotropic, anisotropic, viscoelastic, "
       "user; "
       "others are not available "
       "(osculate "
       "doc "
       "limits)"},
      {"uy: -0.007, ux: 0}", "amplitude: wave}",
       "model.yaml:27: steps[0].prescribe[0]: needs at least one of ux, uy, uz, rx, ry, rz"},
      {", fy: -1", "",
       "model.yaml:32: steps[1].forces[0]: needs at least one of fx, fy, fz, mx, my, mz"},
  });
}

TEST(BrokenModels, WrongTypes) {
  expect_refusals({
      {"mu: 0.3", "mu: abc",
       "model.yaml:17: contact[0].friction.coulomb.mu: expected a number, got the text 'abc'"},
      {"mu: 0.3", "mu: \"0.3\"",
       "model.yaml:17: contact[0].friction.coulomb.mu: expected a number, got the quoted text "
       "'0.3'"},
      {"mu: 0.3", "mu: 0,3",
       "model.yaml:17: contact[0].friction.coulomb: unknown key '3'; known: "
       "mu, penalty, kinetic, decay, cap, viscous; decimals are written with a point"},
      {"mu: 0.3", "mu: 1d4",
       "model.yaml:17: contact[0].friction.coulomb.mu: expected a number, got the text '1d4'"},
      {"mu: 0.3", "mu: 0x10",
       "model.yaml:17: contact[0].friction.coulomb.mu: expected a number, got the text '0x10'"},
      {"mu: 0.3",
       "mu: ", "model.yaml:17: contact[0].friction.coulomb.mu: expected a number, got nothing"},
      {"mu: 0.3", "mu: [0.3]",
       "model.yaml:17: contact[0].friction.coulomb.mu: expected a number, got a list"},
      {"increments: 80", "increments: 80.5",
       "model.yaml:29: steps[1].increments: expected an integer, got 80.5"},
      {"increments: 80", "increments: many",
       "model.yaml:29: steps[1].increments: expected an integer, got the text 'many'"},
      {"radius: 3", "radius: 3, inside: yes",
       "model.yaml:10: rigid.roll.circle.inside: expected true or false, got the text 'yes'"},
      {"radius: 3", "radius: 3, inside: 1",
       "model.yaml:10: rigid.roll.circle.inside: expected true or false, got 1"},
      {"master: bottom", "master: {set: bottom}",
       "model.yaml:13: contact[0].master: expected a text or a list of words, got a map"},
      {"master: bottom", "master: ''", "model.yaml:13: contact[0].master: must not be empty"},
      {"{linear_elastic: {E: 2.1e4, nu: 0.3}}", "linear_elastic",
       "model.yaml:5: materials.steel: expected a map, got the text 'linear_elastic'; for "
       "example `steel: {linear_elastic: {E: 2.1e5, nu: 0.3}}`"},
      {"equal: [{on: top, of: uy}]", "equal: {on: top, of: uy}",
       "model.yaml:25: equal: expected a list of maps, got a map; every item of a list begins "
       "with `- `"},
      {"{penalty: 2.1e6}\n    friction", "2.1e6\n    friction",
       "model.yaml:16: contact[0].normal: expected a map, got 2.1e6; for example `normal: "
       "{penalty: 2.1e6}`"},
      {"friction: {coulomb: {mu: 0.3, penalty: 2.1e6}}", "friction: 0.3",
       "model.yaml:17: contact[0].friction: expected none or a map, got 0.3; for example "
       "`friction: {coulomb: {mu: 0.3, penalty: 2.1e6}}`"},
      {"friction: {coulomb: {mu: 0.3, penalty: 2.1e6}}", "friction: [coulomb]",
       "model.yaml:17: contact[0].friction: expected none or a map, got a list; for example "
       "`friction: {coulomb: {mu: 0.3, penalty: 2.1e6}}`"},
      {"tangent: consistent", "tangent: {main: 1}",
       "model.yaml:21: contact[0].tangent.main: expected true or false, got 1"},
      {"mesh: block.msh", "mesh: [block.msh]",
       "model.yaml:3: mesh: expected a text or a map, got a list"},
      {"fields: every", "fields: 2.5",
       "model.yaml:38: output.fields: expected an integer, got 2.5"},
      {"fields: every", "fields: sometimes",
       "model.yaml:38: output.fields: expected an integer, every, last or none, got the text "
       "'sometimes'"},
      {"y: floor.normal_force", "y: {a: 1}",
       "model.yaml:40: output.plots[0].y: expected a text or a list of words, got a map; for "
       "example `y: [top.rfx, top.rfy]`"},
      {"mu: 0.3", "mu: 3 kN",
       "model.yaml:17: contact[0].friction.coulomb.mu: expected a number, got the text '3 kN'; "
       "numbers have no units: all are in one consistent system"},
      {"{coulomb: {mu: 0.3, penalty: 2.1e6}}", "{coulomb: 0.3}",
       "model.yaml:17: contact[0].friction.coulomb: expected a map, got 0.3; write `coulomb: {mu: "
       "...}`"},
  });
}

TEST(BrokenModels, Ranges) {
  expect_refusals({
      {"E: 2.1e4", "E: -3", "model.yaml:5: materials.steel.linear_elastic.E: must be > 0, got -3"},
      {"nu: 0.3", "nu: 0.4999999999999",
       "model.yaml:5: materials.steel.linear_elastic.nu: is so near to 0.5 that the resistance to "
       "changes of volume leaves no digits for anything else: use at most 0.4999999999"},
      {"nu: 0.3", "nu: 0.5",
       "model.yaml:5: materials.steel.linear_elastic.nu: must be > -1 and < 0.5, got 0.5"},
      {"mu: 0.3", "mu: -1e-3",
       "model.yaml:17: contact[0].friction.coulomb.mu: must be >= 0, got -1e-3"},
      {"mu: 0.3", "mu: .nan",
       "model.yaml:17: contact[0].friction.coulomb.mu: must be a finite number, got .nan"},
      {"mu: 0.3", "mu: -.INF",
       "model.yaml:17: contact[0].friction.coulomb.mu: must be a finite number, got -.INF"},
      {"mu: 0.3", "mu: inf",
       "model.yaml:17: contact[0].friction.coulomb.mu: must be a finite number, got inf"},
      {"mu: 0.3", "mu: 1e999",
       "model.yaml:17: contact[0].friction.coulomb.mu: 1e999 is out of range: use numbers "
       "between 1e-300 and 1e100"},
      {"mu: 0.3", "mu: 1e200",
       "model.yaml:17: contact[0].friction.coulomb.mu: 1e200 is out of range: use numbers "
       "between 1e-300 and 1e100"},
      {"increments: 80", "increments: 0",
       "model.yaml:29: steps[1].increments: must be >= 1 and <= 1000000, got 0"},
      {"increments: 80", "increments: 99999999999",
       "model.yaml:29: steps[1].increments: 99999999999 is too large for an integer"},
      {"residual: 1e-9", "residual: 0",
       "model.yaml:34: solver.tolerance.residual: must be > 0 and < 1, got 0"},
      {"fields: every", "fields: 0", "model.yaml:38: output.fields: must be >= 1, got 0"},
      {"center: [0, 9]", "center: [0, 9, 2]",
       "model.yaml:10: rigid.roll.circle.center: expected 2 values, got 3"},
      {"center: [0, 9]", "center: [0, x]",
       "model.yaml:10: rigid.roll.circle.center[1]: expected a number, got the text 'x'"},
      {"[[0, 0], [0.5, 1], [1, 0]]", "[]",
       "model.yaml:24: amplitudes.wave: expected at least 1 value, got 0"},
  });
}

TEST(BrokenModels, Words) {
  expect_refusals({
      {"weight: reference_area", "weight: referenc_area",
       "model.yaml:19: contact[0].weight: unknown value 'referenc_area'; did you mean "
       "'reference_area'?"},
      {"weight: reference_area", "weight: x",
       "model.yaml:19: contact[0].weight: expected node, reference_area, current_area or a map, "
       "got "
       "the text 'x'"},
      {"weight: reference_area", "weight: current_aria",
       "model.yaml:19: contact[0].weight: unknown value 'current_aria'; did you mean "
       "'current_area'?"},
      {"weight: reference_area", "weight: [node]",
       "model.yaml:19: contact[0].weight: expected node, reference_area, current_area or a map, "
       "got "
       "a list"},
      {"fields: every", "fields: evry",
       "model.yaml:38: output.fields: unknown value 'evry'; did you mean 'every'?"},
      {"of: normal_force", "of: normal_forces",
       "model.yaml:39: output.history[1].of: unknown value 'normal_forces'; did you mean "
       "'normal_force'?"},
      {"equal: [{on: top, of: uy}]", "equal: [{on: top, of: rz}]",
       "model.yaml:25: equal[0].of: unknown value 'rz'; did you mean 'uz'?"},
  });
}

TEST(BrokenModels, KnownButNotAvailable) {
  expect_refusals({
      {"max_iterations: 25", "stabilisation: {}",
       "model.yaml:35: solver.stabilisation: is not available yet"},
      {"mesh: block.msh", "mesh: block.step",
       "model.yaml:3: mesh: expected a mesh file, Gmsh (.msh), Abaqus or CalculiX (.inp) or STL "
       "(.stl), got 'block.step'"},
      {"osculate: 1", "osculate: 2", "model.yaml:1: osculate: must be 1, got 2"},
  });
}

TEST(BrokenModels, Names) {
  expect_refusals({
      {"  steel:", "  steel 3:",
       "model.yaml:5: materials: 'steel 3' cannot be a name; use letters, digits, _ and -"},
      {"name: shear", "name: a.b",
       "model.yaml:28: steps[1].name: 'a.b' cannot be a name; use letters, digits, _ and -"},
      {"{on: D, of: ux}", "{on: D, of: ux, name: 'a,b'}",
       "model.yaml:39: output.history[0].name: 'a,b' cannot head a column; leave out commas, "
       "quotes and line breaks"},
      {"{on: D, of: ux}", "{on: 'D,E', of: ux}",
       "model.yaml:39: output.history[0].on: 'D,E' cannot head a column; give a `name`"},
  });
}

}  // namespace
}  // namespace osculate::deck
