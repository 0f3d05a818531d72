// Models of the plane from the text of a model file: what their keys become.
#include <map>
#include <numbers>

#include "system_test.hpp"

namespace osculate::deck {
namespace {

struct Tool {
  std::string shape, more_mesh{};
};

/// A block under a rigid tool.
Built with_tool(const Tool& tool, const std::string& contact = "master: tool, slave: block.top",
                const std::string& law = "neo_hooke", const std::string& element = "plane_strain") {
  return build_text(
      "osculate: 1\nmesh: {generate: {block: {box: {x: [0, 2], y: [0, 1], elements: [4, 2]}}" +
      tool.more_mesh + "}}\nmaterials: {m: {" + law +
      ": {E: 100, nu: 0.3}}}\nsections: [{on: block, material: m, element: " + element +
      "}]\nrigid: {tool: {" + tool.shape + "}}\ncontact: [{name: c, " + contact +
      ", normal: {penalty: 500}}]\n"
      "equations: [{terms: [{on: block.top_left, of: ux, factor: 2}, {on: block.top_right, of: uy, "
      "factor: -1}, {on: tool, of: rz, factor: 0.5}], value: 0.02}]\n"
      "equal: [{on: block.right, of: ux}]\n"
      "steps: [{name: s, increments: 1, prescribe: [{on: block.bottom, uy: 0.02}, {on: tool, rz: "
      "0.1}], forces: [{on: tool, fx: 1, fy: -5}, {on: block.top_left, fy: 3}], pressure: [{on: "
      "block.right, value: 7}]}]\n");
}
const Tool circle{"circle: {center: [1, 3.9], radius: 3}"};

template <class Curve>
Curve shape_of(const Built& built) {
  return std::get<Curve>(built.model.rigid[0].shape.value());
}

TEST(BuildPlane, AnalyticTools) {
  const Built disc = with_tool(circle);
  EXPECT_EQ(shape_of<geometry::Circle>(disc).center, Vec2(1, 3.9));
  EXPECT_EQ(shape_of<geometry::Circle>(disc).radius, 3);
  EXPECT_FALSE(shape_of<geometry::Circle>(disc).inside);
  EXPECT_EQ(disc.model.rigid[0].reference, Vec2(1, 3.9));
  const Built arc = with_tool({"arc: {center: [1, 3.9], radius: 3, from: 200, to: 340}"});
  EXPECT_NEAR(shape_of<geometry::Arc>(arc).from, 200 * std::numbers::pi / 180, 1e-15);
  EXPECT_NEAR(shape_of<geometry::Arc>(arc).to, 340 * std::numbers::pi / 180, 1e-15);
  const Built nurbs =
      with_tool({"nurbs: {degree: 2, knots: [0, 0, 0, 1, 1, 1], control: [[2.5, 1.3, 1], [1, 0.4, "
                 "0.8], [-0.5, 1.3, 1]]}"});
  EXPECT_EQ(shape_of<geometry::NurbsCurve>(nurbs).weights, (std::vector<double>{1, 0.8, 1}));
  EXPECT_EQ(shape_of<geometry::NurbsCurve>(nurbs).control[1], Vec2(1, 0.4));
  EXPECT_LT((nurbs.model.rigid[0].reference - Vec2(1, 1)).norm(), 1e-15);
  const Built line = with_tool({"line: {point: [1, 0.89], normal: [0.1, -1]}"});
  const Vec2 normal = shape_of<geometry::InfiniteLine>(line).normal;
  EXPECT_LT((normal.normalized() - Vec2(0.1, -1).normalized()).norm(), 1e-15);
  EXPECT_EQ(line.model.rigid[0].reference, Vec2(1, 0.89));
  for (const Built* built : {&disc, &arc, &nurbs, &line}) {
    const model::Model& m = built->model;
    EXPECT_EQ(m.pairs[0].definition.master.facets.size(), 1u);
    const std::vector<Index>& frame = m.rigid[0].nodes;
    EXPECT_EQ(frame, (std::vector<Index>{15, 16, 17}));
    EXPECT_EQ(m.reference[15], Vec2(0, 0));
    EXPECT_EQ(m.reference[16], Vec2(1, 0));
    EXPECT_EQ(m.reference[17], Vec2(0, 1));
  }
}

TEST(BuildPlane, ToolsOfStraightLines) {
  const Built polyline =
      with_tool({"polyline: {points: [[2.5, 1.2], [1.2, 0.9], [0.3, 0.95], [-0.5, 1.3]]}"});
  const Built meshed =
      with_tool({"set: bar", ", bar: {line: {points: [[2.4, 0.93], [-0.4, 0.91]], elements: 3}}"});
  EXPECT_LT((polyline.model.rigid[0].reference - Vec2(0.875, 1.0875)).norm(), 1e-15);
  EXPECT_LT((meshed.model.rigid[0].reference - Vec2(1, 0.92)).norm(), 1e-15);
  for (const Built* built : {&polyline, &meshed}) {
    const model::Model& m = built->model;
    EXPECT_EQ(m.rigid[0].nodes, (std::vector<Index>{15, 16, 17, 18}));
    const pairing::Chain& chain = m.pairs[0].definition.master;
    ASSERT_EQ(chain.facets.size(), 3u);
    for (Index f = 0; f < 3; ++f) {
      const pairing::Facet& facet = chain.facets[static_cast<std::size_t>(f)];
      EXPECT_EQ(facet.next, f < 2 ? f + 1 : -1);
      EXPECT_GT(turn(facet_jet(facet, 0, m.reference).r1).dot(Vec2(0, -1)), 0);  // body above
    }
  }
  const pairing::SlaveSide<2> slave =
      with_tool({"set: bar", ", bar: {line: {points: [[2.4, 0.93], [-0.4, 0.91]], elements: 3}}"},
                "master: block.top, slave: tool")
          .model.pairs[0]
          .definition.slave;
  EXPECT_EQ(slave.nodes, (std::vector<Index>{15, 16, 17, 18}));
  EXPECT_EQ(slave.boundary.facets.size(), 3u);
}

TEST(BuildPlane, FormsAndLaws) {
  const std::string usual = "master: tool, slave: block.top";
  const auto pair = [&](const std::string& more) {
    return with_tool(circle, usual + more).model.pairs[0].definition;
  };
  EXPECT_EQ(pair("").residual, contact::ResidualForm::surface);
  EXPECT_EQ(pair(", residual: full").residual, contact::ResidualForm::full);
  EXPECT_EQ(pair("").weight, pairing::Weight::reference_area);
  EXPECT_EQ(pair(", weight: current_area").weight, pairing::Weight::current_area);
  EXPECT_EQ(pair(", weight: node").weight, pairing::Weight::node);
  EXPECT_EQ(contact::penalty_of(pair("").normal), 500);
  EXPECT_FALSE(pair("").friction.has_value());
  const auto friction = pair(", friction: {coulomb: {mu: 0.3, penalty: 300}}").friction;
  EXPECT_EQ(contact::text(friction.value()), "Coulomb 0.3 (penalty 300)");
  for (const std::string element : {"plane_strain", "plane_stress", "axisymmetric"}) {
    const model::Model m = with_tool(circle, usual, "neo_hooke", element).model;
    EXPECT_EQ(m.sections[0].section.assumption,
              element == "plane_strain"   ? solid::Assumption::plane_strain
              : element == "plane_stress" ? solid::Assumption::plane_stress
                                          : solid::Assumption::axisymmetric);
    EXPECT_EQ(m.sections[0].section.kinematics, solid::Kinematics::finite);
    EXPECT_EQ(m.pairs[0].definition.area.axisymmetric, element == "axisymmetric");
  }
  const solid::Section<2> small =
      with_tool(circle, usual, "linear_elastic").model.sections[0].section;
  EXPECT_EQ(small.kinematics, solid::Kinematics::small);
  EXPECT_TRUE(std::holds_alternative<material::LinearElastic>(small.law));
}

TEST(BuildPlane, StepsAndEquationsNameTheRightDofs) {
  const model::Model m = with_tool(circle).model;
  const auto node = [&](const char* set) { return m.mesh.find_set(set)->nodes.front(); };
  const auto body = static_cast<Index>(2 * m.reference.size());
  std::map<Index, double> prescribed, loads;
  for (const model::PrescribedDof& p : m.steps[0].prescribed) {
    EXPECT_FALSE(p.hold);
    prescribed.emplace(p.dof, p.ramp.target);
  }
  std::map<Index, double> expected{{body + 2, 0.1}};  // what is loaded is free
  for (const Index n : m.mesh.find_set("block.bottom")->nodes) expected.emplace(2 * n + 1, 0.02);
  EXPECT_EQ(prescribed, expected);
  for (const model::DeadLoad& load : m.steps[0].dead)
    loads[load.unit.at(0).first] = load.unit[0].second * load.ramp.target;
  EXPECT_EQ(loads, (std::map<Index, double>{
                       {body, 1}, {body + 1, -5}, {2 * node("block.top_left") + 1, 3}}));
  const std::vector<model::PressureLoad::Facet>& sides = m.steps[0].pressure.at(0).facets;
  ASSERT_EQ(sides.size(), 2u);
  for (const auto& side : sides)  // downwards, with the body on the right
    EXPECT_LT((m.reference[static_cast<std::size_t>(side.nodes[1])] -
               m.reference[static_cast<std::size_t>(side.nodes[0])] - Vec2(0, -0.5))
                  .norm(),
              1e-15);
  EXPECT_EQ(m.steps[0].pressure[0].ramp.target, 7);
  EXPECT_EQ(m.steps[0].equation_start, 0);
  ASSERT_EQ(m.equations.size(), 3u);  // one and two of `equal`
  EXPECT_EQ(m.equations[0].value, 0.02);
  std::map<Index, double> terms;
  for (const model::Equation::Term& term : m.equations[0].terms) terms[term.dof] = term.factor;
  EXPECT_EQ(terms, (std::map<Index, double>{{2 * node("block.top_left"), 2},
                                            {2 * node("block.top_right") + 1, -1},
                                            {body + 2, 0.5}}));
  for (const std::size_t k : {1u, 2u}) {
    EXPECT_EQ(m.equations[k].value, 0);
    ASSERT_EQ(m.equations[k].terms.size(), 2u);
    EXPECT_EQ(m.equations[k].terms[0].factor, -m.equations[k].terms[1].factor);
  }
}

}  // namespace
}  // namespace osculate::deck
