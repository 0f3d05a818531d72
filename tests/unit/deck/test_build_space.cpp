// Models in space: what they are built to, and what is refused.
#include <algorithm>
#include <map>

#include "deck_test.hpp"
#include "osculate/deck/build.hpp"
#include "osculate/model/bulk.hpp"
#include "space_test.hpp"

namespace osculate::deck {
namespace {

const std::vector<Index>& nodes_of(const Built3& built, const std::string& set) {
  return built.model.mesh.find_set(set)->nodes;
}

// ---- good models --------------------------------------------------------------------------------

TEST(BuildSpace, TheDimensionComesFromTheSections) {
  const std::string solid = test_file("solid.yaml"), plane = test_file("bodies.yaml");
  EXPECT_EQ(dimension(parse_model(solid, "m")), 3);
  EXPECT_EQ(dimension(parse_model(plane, "m")), 2);
  const Description d3 = parse_model(solid, "m"), d2 = parse_model(plane, "m");
  EXPECT_TRUE(std::holds_alternative<Built3>(build_any(d3, load_mesh(d3))));
  EXPECT_TRUE(std::holds_alternative<Built>(build_any(d2, load_mesh(d2))));
  EXPECT_THROW((void)build(d3, load_mesh(d3)), core::InputError);
  EXPECT_THROW((void)build3(d2, load_mesh(d2)), core::InputError);
}

TEST(BuildSpace, SectionsAndRigidBodies) {
  const Built3 built = built_from(test_file("solid.yaml"));
  const model::Model3& m = built.model;
  EXPECT_EQ(built.warnings,
            (std::vector<std::string>{
                "contact 'gap': the master 'high.bottom' has no convex edge with more than 40 "
                "degrees between its facets, so edges: has no effect",
                "contact 'gap': the slave 'low.top' has no convex edge with more than 40 degrees "
                "between its facets, so edges: has no effect",
                "contact 'press': the slave 'high.top' has quad8 faces, at whose nodes contact "
                "pressures scatter; prefer sampling: {gauss: 3}, hex27 or first-order cells there, "
                "or make it the "
                "master"}));
  ASSERT_EQ(m.sections.size(), 2u);
  EXPECT_EQ(m.sections[0].section.formulation, solid::Formulation::enhanced);
  EXPECT_EQ(m.sections[0].section.kinematics, solid::Kinematics::finite);
  EXPECT_TRUE(std::holds_alternative<material::NeoHooke>(m.sections[0].section.law));
  EXPECT_EQ(model::section_on(m.sections[1], cell::CellType::hex20).formulation,
            solid::Formulation::beam);
  EXPECT_EQ(m.sections[0].cells.size(), 4u);
  ASSERT_EQ(m.rigid.size(), 2u);
  EXPECT_EQ(m.rigid[0].reference, Vec3(1, 1, -0.5));
  EXPECT_EQ(m.rigid[0].nodes, nodes_of(built, "ground"));
  EXPECT_EQ(m.rigid[1].reference, Vec3(0, 0, 3));
  ASSERT_EQ(m.rigid[1].nodes.size(), 4u);
  ASSERT_EQ(m.reference.size(), m.mesh.nodes.size() + 4);
  EXPECT_EQ(m.reference[m.mesh.nodes.size()], Vec3(0, 0, 0));
  EXPECT_EQ(m.reference.back(), Vec3(0, 0, 1));
  EXPECT_EQ(m.body_of_node.back(), 1);
  EXPECT_EQ(std::get<geometry::Plane>(*m.rigid[1].shape).normal, Vec3(0, 0, -1));
}

/// Sum of the facets' areas times their normals.
Vec3 oriented_area(const pairing::FacetSurface& surface, const std::vector<Vec3>& x) {
  Vec3 sum = Vec3::Zero();
  for (const pairing::SurfaceFacet& f : surface.facets)
    sum += 4 * facet_normal(f, Vec2(0, 0), x).normalized() *
           pairing::facet_jet(f, Vec2(0, 0), x).r1[0].norm() *
           pairing::facet_jet(f, Vec2(0, 0), x).r1[1].norm();
  return sum;
}

TEST(BuildSpace, ContactSidesPointOutwards) {
  const Built3 built = built_from(test_file("solid.yaml"));
  const std::vector<Vec3>& x = built.model.reference;
  ASSERT_EQ(built.model.pairs.size(), 3u);
  const auto& floor = built.model.pairs[0].definition;
  EXPECT_LT((oriented_area(floor.master, x) - Vec3(0, 0, 16)).norm(), 1e-13);
  EXPECT_LT((oriented_area(floor.slave.boundary, x) - Vec3(0, 0, -4)).norm(), 1e-13);
  EXPECT_EQ(floor.slave.nodes.size(), 9u);
  const auto& gap = built.model.pairs[1].definition;
  EXPECT_LT((oriented_area(gap.master, x) - Vec3(0, 0, -4)).norm(), 1e-13);
  EXPECT_LT((oriented_area(gap.slave.boundary, x) - Vec3(0, 0, 4)).norm(), 1e-13);
  EXPECT_EQ(gap.master.facets[0].type, cell::CellType::quad8);
  EXPECT_EQ(contact::text(*gap.friction), "Coulomb 0.3 (penalty 100)");
  double area = 0;
  for (const double a : gap.reference_areas) area += a;
  EXPECT_NEAR(area, 4, 1e-13);
  const auto& press = built.model.pairs[2].definition;
  ASSERT_EQ(press.master.facets.size(), 1u);
  EXPECT_LT((facet_normal(press.master.facets[0], Vec2(1, 2), x) - Vec3(0, 0, -1)).norm(), 1e-15);
  EXPECT_EQ(press.weight, pairing::Weight::current_area);
}

TEST(BuildSpace, FlipTurnsRigidSurfacesRound) {
  const std::string model = test_file("solid.yaml");
  const Built3 meshed = built_from(edited(model, "flip: false", "flip: true"));
  EXPECT_LT((oriented_area(meshed.model.pairs[0].definition.master, meshed.model.reference) -
             Vec3(0, 0, -16))
                .norm(),
            1e-13);
  const Built3 plane =
      built_from(edited(model, "normal: [0, 0, -2]}}", "normal: [0, 0, -2]}, flip: true}"));
  EXPECT_EQ(std::get<geometry::Plane>(*plane.model.rigid[1].shape).normal, Vec3(0, 0, 1));
}

TEST(BuildSpace, NodeSetsAreSlavesWithoutFacets) {
  const Built3 built =
      built_from(edited(test_file("solid.yaml"), "slave: low.bottom, normal: {penalty: 1000}",
                        "slave: low.bottom_front_left, weight: node, normal: {penalty: 1000}"));
  const pairing::SlaveSide<3>& slave = built.model.pairs[0].definition.slave;
  EXPECT_EQ(slave.nodes, nodes_of(built, "low.bottom_front_left"));
  EXPECT_TRUE(slave.boundary.facets.empty());
}

/// The free faces of a volume set are a surface; so are those of nodes.
TEST(BuildSpace, VolumesAreMasters) {
  const Built3 built =
      built_from(edited(test_file("solid.yaml"), "master: high.bottom", "master: high"));
  const pairing::FacetSurface& master = built.model.pairs[1].definition.master;
  EXPECT_EQ(master.facets.size(), 16u);
  EXPECT_LT(oriented_area(master, built.model.reference).norm(), 1e-13);
}

TEST(BuildSpace, RigidBodiesHaveAReferenceOfTheirOwn) {
  const Built3 built = built_from(edited(test_file("solid.yaml"), ", reference: [1, 1, -0.5]", ""));
  EXPECT_LT((built.model.rigid[0].reference - Vec3(1, 1, -0.1)).norm(), 1e-15);
}

/// Resultant of a dead load per unit of its channel.
Vec3 resultant(const model::DeadLoad& load) {
  Vec3 sum = Vec3::Zero();
  for (const auto& entry : load.unit) sum[entry.first % 3] += entry.second;
  return sum;
}

TEST(BuildSpace, StepsNameTheRightDofs) {
  const Built3 built = built_from(test_file("solid.yaml"));
  const model::Model3& m = built.model;
  const auto body = [&](int b, int motion) {
    return static_cast<Index>(3 * m.reference.size()) + 6 * b + motion;
  };
  std::map<Index, model::PrescribedDof> first;
  for (const model::PrescribedDof& p : m.steps[0].prescribed) first.emplace(p.dof, p);
  for (const Index n : nodes_of(built, "low.left"))
    for (Index i = 0; i < 3; ++i) EXPECT_EQ(first.count(3 * n + i), 1u);
  for (const Index n : nodes_of(built, "high.left")) {
    EXPECT_EQ(first.count(3 * n), 0u);
    EXPECT_EQ(first.count(3 * n + 1), 1u);
  }
  EXPECT_EQ(first.at(body(1, 2)).ramp.target, -0.1);
  EXPECT_EQ(first.at(body(1, 4)).ramp.target, 0.01);
  EXPECT_TRUE(first.at(body(1, 0)).hold);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(first.count(body(0, i)), 0u) << "loaded, so free: " << i;
  std::map<Index, double> loads;
  for (const model::DeadLoad& load : m.steps[0].dead)
    if (load.unit.size() == 1) loads[load.unit[0].first] = load.ramp.target;
  for (int i = 0; i < 6; ++i) EXPECT_EQ(loads.at(body(0, i)), i + 1.0);
  EXPECT_EQ(loads.at(3 * nodes_of(built, "high.top_back_left")[0] + 2), -1);
  std::vector<Index> second;
  for (const model::PrescribedDof& p : m.steps[1].prescribed) second.push_back(p.dof);
  const auto held = [&](Index dof) {
    return std::find(second.begin(), second.end(), dof) != second.end();
  };
  const Index n = nodes_of(built, "low.left")[0];
  EXPECT_TRUE(held(3 * n));
  EXPECT_FALSE(held(3 * n + 1));
  EXPECT_FALSE(held(3 * n + 2));
  EXPECT_TRUE(held(body(1, 2)));
  for (int i = 3; i < 6; ++i) EXPECT_FALSE(held(body(1, i)));
}

TEST(BuildSpace, LoadsHaveTheRightResultants) {
  const Built3 built = built_from(test_file("solid.yaml"));
  std::map<double, Vec3> of;  // by their value: 1, 2, 3 traction on 1.8, 1, 2, -3 body force on 4
  std::vector<Vec3> sums;
  for (const model::DeadLoad& load : built.model.steps[0].dead)
    if (load.unit.size() > 1) sums.push_back(resultant(load));
  const auto has = [&](const Vec3& wanted) {
    return std::any_of(sums.begin(), sums.end(),
                       [&](const Vec3& sum) { return (sum - wanted).norm() < 1e-13; });
  };
  EXPECT_EQ(sums.size(), 6u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(has(1.8 * Vec3::Unit(i))) << i;
    EXPECT_TRUE(has(4.0 * Vec3::Unit(i))) << i;
  }
  ASSERT_EQ(built.model.steps[0].pressure.size(), 1u);
  ASSERT_EQ(built.model.steps[0].pressure[0].facets.size(), 2u);
  for (const model::PressureLoad::Facet& f : built.model.steps[0].pressure[0].facets) {
    EXPECT_EQ(f.section, 0);
    EXPECT_EQ(f.type, cell::CellType::quad4);
    const auto side = pairing::surface_facet(f.type, f.nodes);
    EXPECT_LT((facet_normal(side, Vec2(0, 0), built.model.reference) - Vec3(1, 0, 0)).norm(),
              1e-15);
  }
}

TEST(BuildSpace, EquationsOfRigidBodiesAndNodes) {
  const Built3 built = built_from(test_file("solid.yaml"));
  const model::Model3& m = built.model;
  const auto& terms = m.equations[0].terms;
  ASSERT_EQ(terms.size(), 2u);
  EXPECT_EQ(terms[0].dof, 3 * nodes_of(built, "low.top_front_right")[0] + 2);
  EXPECT_EQ(terms[1].dof, static_cast<Index>(3 * m.reference.size()) + 6 + 3);
  EXPECT_EQ(m.equations.size(), nodes_of(built, "high.right").size());  // 1 + all but one
}

TEST(BuildSpace, HistoryHasTheWordsOfTheModelLayer) {
  const Built3 built = built_from(test_file("solid.yaml"));
  std::vector<std::string> words;
  for (const model::HistoryRequest& r : built.history) words.push_back(r.quantity);
  EXPECT_EQ(words, (std::vector<std::string>{"uz", "rfz", "rx", "ry", "rmx", "rmy", "force_z"}));
  const auto known = [](const auto& list, std::string_view word) {
    return std::find(list.begin(), list.end(), word) != list.end();
  };
  for (std::size_t q = 0; q < quantity_names.size(); ++q) {
    const std::string_view word = quantity_names[q];
    const auto quantity = static_cast<Quantity>(q);
    EXPECT_EQ(known(model::pair_quantities3, word), is_contact_quantity(quantity)) << word;
    EXPECT_EQ(known(model::rigid_quantities3, word), !is_contact_quantity(quantity)) << word;
    EXPECT_EQ(known(model::pair_quantities, word) || known(model::rigid_quantities, word),
              !is_spatial(quantity))
        << word;
  }
}

// ---- broken models ------------------------------------------------------------------------------

TEST(BuildSpace, EdgesOfAPair) {
  const std::string model = test_file("solid.yaml");
  const auto with = [&](const std::string& master, const std::string& slave,
                        const std::string& edges) {
    return edited(edited(model, "master: high.bottom, slave: low.top",
                         "master: " + master + ", slave: " + slave),
                  "edges: {angle: 40}", "edges: " + edges);
  };
  const Built3 on = built_from(with("high", "low", "true"));
  const pairing::EdgeContact* const edges = pairing::edges_of(on.model.pairs[1].definition);
  ASSERT_NE(edges, nullptr);
  EXPECT_NEAR(edges->angle, std::acos(-1.0) / 6, 1e-15);
  EXPECT_EQ(edges->master.size(), 20u);  // two pieces, height one
  EXPECT_EQ(edges->slave.size(), 20u);
  EXPECT_EQ(edges->master[0].count, 3);
  EXPECT_EQ(on.warnings.size(), 1u);  // of another pair
  const Built3 off = built_from(with("high", "low", "false"));
  EXPECT_EQ(pairing::edges_of(off.model.pairs[1].definition), nullptr);
  const Built3 blunt = built_from(with("high", "low", "{angle: 91}"));
  ASSERT_EQ(blunt.warnings.size(), 3u);
  EXPECT_EQ(blunt.warnings[0],
            "contact 'gap': the master 'high' has no convex edge with more than 91 degrees between "
            "its facets, so edges: has no effect");
  expect_refusals(model, {{"edges: {angle: 40}", "edges: {angle: 4}",
                           "model.yaml:22: contact[1].edges.angle: must be > 5 and < 180, got 4"},
                          {"edges: {angle: 40}", "edges: {angel: 40}",
                           "model.yaml:22: contact[1].edges: unknown key 'angel'; did you mean "
                           "'angle'?"}});
}

TEST(BuildSpace, WhatThePlaneDoesNotHave) {
  const std::string why =
      " exists in space only, and this model is plane: no section has the element solid or "
      "solid_shell";
  expect_refusals(
      test_file("bodies.yaml"),
      {
          {"{on: low.left, uy: 0}", "{on: low.left, uz: 0}",
           "model.yaml:30: steps[0].prescribe[0].uz: 'uz'" + why},
          {"slave: low.bottom, normal", "slave: low.bottom, edges: true, normal",
           "model.yaml:17: contact[0].edges: 'edges'" + why},
          {"{on: punch, uy: -0.1}", "{on: punch, rx: -0.1}",
           "model.yaml:31: steps[0].prescribe[1].rx: 'rx'" + why},
          {"{on: high.bottom_right, fy: -1}", "{on: high.bottom_right, fz: -1}",
           "model.yaml:32: steps[0].forces[0].fz: 'fz'" + why},
          {"{on: high.bottom_right, fy: -1}", "{on: punch, my: -1}",
           "model.yaml:32: steps[0].forces[0].my: 'my'" + why},
          {"{on: high.left, tx: 1}", "{on: high.left, tx: 1, tz: 2}",
           "model.yaml:34: steps[0].traction[0].tz: 'tz'" + why},
          {"{on: low, fy: -1}", "{on: low, fz: -1}",
           "model.yaml:35: steps[0].body_force[0].fz: 'fz'" + why},
          {"{on: low.left, of: [uy]}", "{on: low.left, of: [uy, uz]}",
           "model.yaml:38: steps[1].release[0]: 'uz'" + why},
          {"{on: low.top_left, of: ux, factor: 1}", "{on: low.top_left, of: uz, factor: 1}",
           "model.yaml:23: equations[0].terms[0].on: 'uz'" + why},
          {"{on: high.right, of: ux}", "{on: high.right, of: uz}",
           "model.yaml:25: equal[0]: 'uz'" + why},
          {"{on: low.bottom, of: ux}", "{on: low.bottom, of: rfz}",
           "model.yaml:40: output.history[0].of: 'rfz'" + why},
          {"{on: low.bottom, of: ux}", "{on: floor, of: force_z}",
           "model.yaml:40: output.history[0].of: 'force_z'" + why},
          {"{circle: {center: [2, 4], radius: 2}}",
           "{plane: {point: [0, 4, 0], normal: [0, -1, 0]}}",
           "model.yaml:15: rigid.punch: 'plane'" + why},
          {"base: {set: rail}", "base: {set: rail, reference: [0, 0, 0]}",
           "model.yaml:14: rigid.base.reference: expected 2 values, because the model is plane, "
           "got 3"},
          {"{on: high, material: steel, element: plane_strain}",
           "{on: high, material: steel, element: solid}",
           "model.yaml:12: sections[1].element: the sections on 'low' and 'high' exclude each "
           "other: one is plane, one in space"},
      });
}

TEST(BuildSpace, WhatSpaceDoesNotHave) {
  const std::string model = test_file("solid.yaml");
  const std::string why =
      " is a shape of the plane, and this model is in space: a section has the element solid or "
      "solid_shell";
  const std::string wall = "{plane: {point: [0, 0, 3], normal: [0, 0, -2]}}";
  expect_refusals(
      model,
      {
          {wall, "{circle: {center: [0, 0], radius: 1}}",
           "model.yaml:19: rigid.wall: 'circle'" + why},
          {wall, "{line: {point: [0, 0], normal: [0, 1]}}",
           "model.yaml:19: rigid.wall: 'line'" + why},
          {wall, "{flip: true, polyline: {points: [[0, 0], [1, 0]]}}",
           "model.yaml:19: rigid.wall: 'polyline'" + why},
          {wall, "{plane: {point: [0, 0, 3], normal: [0, 0, 0]}}",
           "model.yaml:19: rigid.wall.plane.normal: must not be zero"},
          {wall, "{plane: {point: [0, 3], normal: [0, 0, 1]}}",
           "model.yaml:19: rigid.wall.plane.point: expected 3 values, got 2"},
          {"reference: [1, 1, -0.5]", "reference: [1, 1]",
           "model.yaml:18: rigid.base.reference: expected 3 values, because the model is in space, "
           "got 2"},
          {"element: solid, formulation: beam}", "element: plane_strain}",
           "model.yaml:16: sections[1].element: the sections on 'low' and 'high' exclude each "
           "other: one is plane, one in space"},
          {"element: solid, formulation: beam}", "element: solid, thickness: 2}",
           "model.yaml:16: sections[1].thickness: is for plane bodies; a body in space has its "
           "own"},
          {"element: solid, formulation: beam}", "element: solid_shell, formulation: bbar}",
           "model.yaml:16: sections[1].formulation: solid_shell elements have a formulation of "
           "their own"},
          {"element: solid, formulation: beam}", "element: solid, formulation: enhanced}",
           "model.yaml:16: sections[1].formulation: set 'high' has hex20 cells: formulation "
           "enhanced exists for hex8 cells only; use auto"},
      });
}

TEST(BuildSpace, SetsOfAnotherKind) {
  expect_refusals(
      test_file("solid.yaml"),
      {
          {"{on: high, material", "{on: high.top, material",
           "model.yaml:16: sections[1].on: set 'high.top' has no volume cells, so it cannot be a "
           "section in space"},
          {"{on: high, material", "{on: rail, material",
           "model.yaml:16: sections[1].on: set 'rail' has no volume cells, so it cannot be a "
           "section"},
          {"slave: high.top", "slave: high.tap",
           "model.yaml:23: contact[2].slave: unknown set 'high.tap'; did you mean 'high.top'?"},
          {"slave: high.top", "slave: loose",
           "model.yaml:23: contact[2].slave: node 79 (-1, -1, 7) of 'loose' belongs to no section "
           "and to no rigid body"},
          {"slave: high.top", "slave: high.top_front",
           "model.yaml:23: contact[2].slave: set 'high.top_front' is made of lines; a surface "
           "in space is made of areas, volumes or nodes"},
          {"master: high.bottom", "master: low.top_front_left",
           "model.yaml:22: contact[1].master: contact set 'low.top_front_left' has no facets"},
          {"{on: low.right, value: 1}", "{on: low, value: 1}",
           "model.yaml:36: steps[0].pressure[0].on: set 'low' has no boundary faces: a load on a "
           "face needs a set of area cells"},
          {"{on: low.right, value: 1}", "{on: loose, value: 1}",
           "model.yaml:36: steps[0].pressure[0].on: the face at node 79 (-1, -1, 7) of set 'loose' "
           "is no boundary of a section"},
          {"{on: high.front, tx", "{on: high.top_front_left, tx",
           "model.yaml:37: steps[0].traction[0].on: set 'high.top_front_left' has no boundary "
           "faces: a load on a face needs a set of area cells"},
          {"{on: high.left, uy: 0}", "{on: high.left, rx: 0}",
           "model.yaml:33: steps[0].prescribe[1].rx: 'rx' needs a rigid body: unknown rigid body "
           "'high.left'; known: base, wall"},
          {"{on: high.left, uy: 0}", "{on: low.back, uz: 1}",
           "model.yaml:33: steps[0].prescribe[1].uz: 'low.left' and 'low.back' share a node and "
           "prescribe different uz (0 and 1)"},
          {"{on: high.top_back_left, fz: -1}", "{on: high.top_back_left, mx: -1}",
           "model.yaml:35: steps[0].forces[0].mx: 'mx' needs a rigid body: unknown rigid body "
           "'high.top_back_left'; known: base, wall"},
          {"{on: low.bottom, of: uz}", "{on: low.bottom, of: rmx}",
           "model.yaml:44: output.history[0].of: 'rmx' needs a rigid body, and 'low.bottom' is not "
           "one"},
      });
}

TEST(BuildSpace, SolidShells) {
  const std::string model =
      "osculate: 1\n"
      "mesh: {generate: {b: {box: {x: [0, 1], y: [0, 1], z: [0, 0.1], elements: [2, 2, 1]}}}}\n"
      "materials: {m: {linear_elastic: {E: 1, nu: 0}}}\n"
      "sections:\n"
      "  - {on: b, material: m, element: solid_shell}\n"
      "steps: [{name: s, increments: 1, prescribe: [{on: b.left, ux: 0, uy: 0}]}]\n";
  EXPECT_EQ(built_from(model).model.sections[0].section.formulation,
            solid::Formulation::solid_shell);
  EXPECT_EQ(built_from(edited(model, "[2, 2, 1]", "[2, 2, 1], type: shell18"))
                .model.sections[0]
                .cells.size(),
            4u);
  expect_refusals(model,
                  {{"[2, 2, 1]", "[2, 2, 1], type: tet4",
                    "model.yaml:5: sections[0].element: set 'b' has tet4 cells: solid_shell is for "
                    "hex8, shell18 and hex27 cells; use solid"}});
}

TEST(BuildSpace, VolumesInAPlaneModel) {
  const std::string model =
      "osculate: 1\n"
      "mesh: {generate: {b: {box: {x: [0, 1], y: [0, 1], z: [0, 1], elements: [1, 1, 1]}}}}\n"
      "materials: {m: {linear_elastic: {E: 1, nu: 0}}}\n"
      "sections:\n"
      "  - {on: b, material: m, element: solid}\n"
      "steps: [{name: s, increments: 1, prescribe: [{on: b.bottom, ux: 0, uy: 0}]}]\n";
  expect_refusals(
      model,
      {
          {"element: solid", "element: plane_strain",
           "model.yaml:5: sections[0].element: set 'b' has volume cells; a body in space has the "
           "element solid or solid_shell"},
          {"z: [0, 1], elements: [1, 1, 1]", "elements: [1, 1]",
           "model.yaml:5: sections[0].on: set 'b' has no volume cells, so it cannot be a section "
           "in "
           "space"},
          {"{box: {x: [0, 1], y: [0, 1], z: [0, 1], elements: [1, 1, 1]}}",
           "{sphere: {center: [0, 0, 0], radius: 1, elements: 2}}",
           "model.yaml:5: sections[0].on: set 'b' has no volume cells, so it cannot be a section "
           "in "
           "space"},
          {"{on: b.bottom, ux: 0, uy: 0}", "",
           "model.yaml:5: sections[0].on: a part of body 'b' (1 cells, at node 1 (0, 0, 0)) is "
           "held "
           "by nothing: no contact, no prescribed displacement, no shared node"},
      });
  EXPECT_EQ(any_refusal(edited(edited(model, "{on: b, ", "{on: b.top, "), "solid", "plane_strain")),
            "model.yaml:2: mesh: node 5 has z = 1; plane problems need z = 0");
}

}  // namespace
}  // namespace osculate::deck
