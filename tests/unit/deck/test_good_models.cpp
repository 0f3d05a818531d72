#include <algorithm>

#include "deck_test.hpp"
#include "osculate/contact/law/coulomb.hpp"

namespace osculate::deck {
namespace {

TEST(GoodModels, Block) {
  const Description d = parse_model(test_file("block.yaml"), "some/where/model.yaml");
  EXPECT_EQ(d.title, "Block pressed and sheared on a rigid base");
  EXPECT_EQ(d.mesh.files.at(0).path, "some/where/block.msh");
  ASSERT_EQ(d.materials.size(), 1u);
  EXPECT_EQ(material::unloaded(d.materials[0].law.value).young, 2.1e4);
  EXPECT_EQ(d.materials[0].mark("E").line, 5);
  EXPECT_EQ(d.materials[0].mark("E").key, "materials.steel.linear_elastic.E");
  EXPECT_EQ(d.materials[0].mark("E").file, "some/where/model.yaml");
  ASSERT_EQ(d.contact.size(), 1u);
  const Contact& floor = d.contact[0];
  EXPECT_EQ(contact::penalty_of(floor.normal.law.law), 2.1e6);
  ASSERT_TRUE(floor.friction.has_value());
  EXPECT_EQ(floor.friction->law.as<contact::Coulomb>()->mu, 0.3);
  EXPECT_EQ(contact::stiffness(floor.friction->law), 2.1e6);
  ASSERT_EQ(d.steps.size(), 2u);
  const Prescription& press = d.steps[0].prescribe[0];
  EXPECT_EQ(press.values[0]->value, 0);
  EXPECT_EQ(press.values[1]->value, -0.007);
  EXPECT_FALSE(press.values[5].has_value());
  EXPECT_EQ(d.steps[1].increments.value, 80);
  EXPECT_EQ(d.steps[1].prescribe[0].amplitude->value, "wave");
  ASSERT_EQ(d.output.history.size(), 2u);
  EXPECT_EQ(d.output.history[0].column, "D.ux");
  EXPECT_EQ(d.output.history[0].target, HistoryTarget::set);
  EXPECT_EQ(d.output.history[1].column, "floor.normal_force");
  EXPECT_EQ(d.output.history[1].target, HistoryTarget::contact);
  EXPECT_EQ(d.solver.energy.value, 1e-12);
  EXPECT_EQ(d.solver.residual.value, 1e-9);
}

TEST(GoodModels, BodyForcesAreNamedAsForcesAndReadByTheirFormerNames) {
  const std::string now = test_file("full.yaml");
  ASSERT_NE(now.find("body_force: [{on: block, fx: 5, fy: 6,"), std::string::npos);
  for (const std::string& text : {now, edited(now, "fx: 5, fy: 6,", "bx: 5, by: 6,"),
                                  edited(now, "fx: 5, fy: 6,", "bx: 5, fy: 6,")}) {
    const Description d = parse_model(text, "model.yaml");
    for (const Step& step : d.steps) {
      if (step.body_force.empty()) continue;
      EXPECT_EQ(step.body_force[0].values[0]->value, 5);
      EXPECT_EQ(step.body_force[0].values[1]->value, 6);
    }
  }
  EXPECT_THROW((void)parse_model(edited(now, "fx: 5, fy: 6,", "fx: 5, bx: 6,"), "model.yaml"),
               core::InputError);
}

TEST(GoodModels, DefaultsOfTheSmallestModel) {
  const Description d = parse_model(
      "osculate: 1\nmesh: a.msh\nmaterials: {m: {linear_elastic: {E: 1, nu: 0}}, n: {neo_hooke: "
      "{E: 1, nu: 0}}}\nsections: [{on: s, material: m, element: plane_strain}, {on: t, material: "
      "n, element: plane_strain}]\ncontact: [{name: c, master: a, slave: b, normal: {penalty: "
      "1}}]\nsteps: [{name: go, increments: 1}]\n",
      "model.yaml");
  EXPECT_EQ(d.mesh.files.at(0).path, "a.msh");
  EXPECT_EQ(d.title, "");
  EXPECT_EQ(material::density(d.materials[0].law.value), 0);
  EXPECT_EQ(d.sections[0].kinematics.value, Kinematics::small);
  EXPECT_EQ(d.sections[1].kinematics.value, Kinematics::finite);
  EXPECT_EQ(d.sections[0].thickness.value, 1);
  EXPECT_EQ(d.sections[0].formulation.value, Formulation::automatic);
  const Contact& c = d.contact[0];
  EXPECT_FALSE(c.friction.has_value());
  EXPECT_EQ(c.weight.value, ContactWeight::reference_area);
  EXPECT_EQ(c.residual.value, Residual::surface);
  EXPECT_EQ(c.tangent.value.kind, TangentKind::consistent);
  EXPECT_FALSE(c.search_depth.has_value());
  EXPECT_EQ(d.solver.energy.value, 1e-12);
  EXPECT_EQ(d.solver.residual.value, 1e-9);
  EXPECT_EQ(d.solver.max_iterations.value, 25);
  EXPECT_EQ(d.solver.line_search, LineSearch::automatic);
  EXPECT_EQ(d.solver.cutbacks.value, 8);
  EXPECT_FALSE(d.solver.minimum_fraction.has_value());
  EXPECT_EQ(d.output.fields, FieldTimes::every);
  EXPECT_EQ(d.output.every, 1);
  EXPECT_TRUE(d.output.report && d.output.compress);
  EXPECT_TRUE(d.rigid.empty() && d.equations.empty() && d.equal.empty() && d.amplitudes.empty());
  EXPECT_EQ(c.weight.mark.line, 5);  // a default stands where its map stands
}

TEST(GoodModels, AStepIsOneIncrementWhereNothingIsSaid) {
  const Description d =
      parse_model(edited(test_file("block.yaml"), "    increments: 80\n", ""), "model.yaml");
  EXPECT_EQ(d.steps[1].increments.value, 1);
}

TEST(GoodModels, OneToleranceDecidesAlone) {
  const std::string block = test_file("block.yaml");
  const auto solver = [&](const std::string& tolerance) {
    return parse_model(edited(block, "{energy: 1e-12, residual: 1e-9}", tolerance), "m").solver;
  };
  EXPECT_EQ(solver("{energy: 1e-6}").energy.value, 1e-6);
  EXPECT_EQ(solver("{energy: 1e-6}").residual.value, 0);
  EXPECT_EQ(solver("{residual: 1e-6}").energy.value, 0);
  EXPECT_EQ(solver("{residual: 1e-6}").residual.value, 1e-6);
  EXPECT_EQ(solver("{}").energy.value, 1e-12);
  EXPECT_EQ(solver("{}").residual.value, 1e-9);
}

TEST(GoodModels, GeneratedMeshRepeatsPlainNumbers) {
  const Description d = parse_model(test_file("full.yaml"), "model.yaml");
  ASSERT_EQ(d.mesh.generated.size(), 3u);
  EXPECT_TRUE(d.mesh.files.empty());
  const Box& box = std::get<Box>(d.mesh.generated[0].shape);
  EXPECT_EQ(box.elements[0], (std::vector<int>{8, 4}));
  EXPECT_EQ(box.elements[1], (std::vector<int>{3}));
  EXPECT_EQ(box.bias[0], (std::vector<double>{1, 2}));
  EXPECT_EQ(box.bias[1], (std::vector<double>{0.5}));
  EXPECT_EQ(box.type.value, cell::CellType::quad8);
  EXPECT_EQ(box.crown->at.value, 1.5);
  EXPECT_EQ(box.about, Vec3(1, 2, 0));
  const Box& plate = std::get<Box>(d.mesh.generated[1].shape);
  EXPECT_EQ(plate.bias[0], (std::vector<double>{1}));
  EXPECT_EQ(plate.type.value, cell::CellType::quad4);
  EXPECT_EQ(plate.angle.value, 0);
  const LineMesh& rail = std::get<LineMesh>(d.mesh.generated[2].shape);
  EXPECT_EQ(rail.points.value.size(), 3u);
  EXPECT_EQ(rail.elements, (std::vector<int>{8, 4}));
  EXPECT_EQ(rail.type.value, cell::CellType::line3);
}

TEST(GoodModels, CrownSitsInTheMiddleUnlessToldOtherwise) {
  const std::string text = edited(test_file("full.yaml"), "radius: 50, at: 1.5", "radius: -50");
  const Description d = parse_model(text, "model.yaml");
  const Crown& crown = *std::get<Box>(d.mesh.generated[0].shape).crown;
  EXPECT_EQ(crown.at.value, 2);
  EXPECT_EQ(crown.radius.value, -50);
}

TEST(GoodModels, RigidShapes) {
  const Description d = parse_model(test_file("full.yaml"), "model.yaml");
  EXPECT_EQ(std::get<SetShape>(d.find_rigid("base")->shape).set.value, "rail");
  EXPECT_EQ(d.find_rigid("base")->reference->value, (std::vector<double>{2, -1}));
  EXPECT_TRUE(d.find_rigid("base")->flip);
  EXPECT_FALSE(d.find_rigid("disc")->reference.has_value());
  EXPECT_TRUE(std::get<CircleShape>(d.find_rigid("disc")->shape).inside);
  EXPECT_EQ(std::get<ArcShape>(d.find_rigid("bow")->shape).from.value, -90);
  EXPECT_TRUE(std::get<PolylineShape>(d.find_rigid("frame")->shape).closed);
  EXPECT_EQ(std::get<HalfPlaneShape>(d.find_rigid("wall")->shape).normal, Vec2(0, 1));
  const NurbsShape& spline = std::get<NurbsShape>(d.find_rigid("spline")->shape);
  EXPECT_EQ(spline.control.value[1], Vec3(1, 1, 0.7071067811865476));
  EXPECT_EQ(spline.knots.value.size(), 6u);
}

TEST(GoodModels, ContactChoices) {
  const Description d = parse_model(test_file("full.yaml"), "model.yaml");
  const Contact& floor = *d.find_contact("floor");
  EXPECT_EQ(floor.weight.value, ContactWeight::current_area);
  EXPECT_EQ(floor.residual.value, Residual::full);
  EXPECT_EQ(floor.tangent.value.kind, TangentKind::covariant);
  EXPECT_TRUE(floor.tangent.value.main);
  EXPECT_FALSE(floor.tangent.value.rotational || floor.tangent.value.curvature);
  EXPECT_EQ(floor.search_depth->value, 0.5);
  const Tangent& side = d.find_contact("side")->tangent.value;
  EXPECT_EQ(side.kind, TangentKind::covariant);
  EXPECT_TRUE(side.main && side.rotational && side.curvature);
}

TEST(GoodModels, StepsAndConstraints) {
  const Description d = parse_model(test_file("full.yaml"), "model.yaml");
  const Step& press = d.steps[0];
  EXPECT_EQ(press.prescribe[1].values[5]->value, 0.1);
  EXPECT_EQ(press.forces[1].values[5]->value, 3);
  EXPECT_EQ(press.forces[1].amplitude->value, "wave");
  EXPECT_EQ(press.pressure[0].values[0]->value, 12);
  EXPECT_EQ(press.traction[0].values[1]->value, 4);
  EXPECT_EQ(press.body_force[0].values[0]->value, 5);
  EXPECT_EQ(d.steps[1].release[0].of, (std::array<bool, 6>{true, true}));
  EXPECT_EQ(d.steps[1].release[1].of,
            (std::array<bool, 6>{false, false, false, false, false, true}));
  ASSERT_EQ(d.equations[0].terms.size(), 2u);
  EXPECT_EQ(d.equations[0].terms[1].of, Component::rz);
  EXPECT_EQ(d.equations[0].terms[1].factor.value, -2.5);
  EXPECT_EQ(d.equations[0].value.value, 0.1);
  EXPECT_EQ(d.equal[0].of, Component::uy);
  EXPECT_EQ(d.find_amplitude("wave")->points[1], std::pair(0.5, 1.0));
}

TEST(GoodModels, SolverAndOutput) {
  const Description d = parse_model(test_file("full.yaml"), "model.yaml");
  EXPECT_EQ(d.solver.energy.value, 1e-10);
  EXPECT_EQ(d.solver.residual.value, 0);
  EXPECT_EQ(d.solver.line_search, LineSearch::off);
  EXPECT_EQ(d.solver.cutbacks.value, 3);
  EXPECT_EQ(d.solver.minimum_fraction->value, 1e-4);
  EXPECT_EQ(d.output.fields, FieldTimes::every);
  EXPECT_EQ(d.output.every, 5);
  EXPECT_FALSE(d.output.report || d.output.compress);
  EXPECT_TRUE(d.output.contact_points);
  EXPECT_FALSE(d.output.as_given);
  EXPECT_EQ(d.output.history[0].column, "Normal force");
  EXPECT_EQ(d.output.history[1].target, HistoryTarget::rigid);
  EXPECT_EQ(d.output.plots[0].y.size(), 2u);
  EXPECT_EQ(d.output.plots[1].y[0].value, "block.top.rfy");
}

TEST(GoodModels, EveryWordStandsForItsQuantity) {
  const std::string block = test_file("block.yaml");
  const auto of = [&](const std::string& request) {
    const std::string text =
        edited(edited(block, "{on: D, of: ux}", request), "x: D.ux", "x: time");
    return parse_model(text, "m").output.history[0].of.value;
  };
  EXPECT_EQ(of("{on: roll, of: rz}"), Quantity::rz);
  EXPECT_EQ(of("{on: roll, of: rfx}"), Quantity::rfx);
  EXPECT_EQ(of("{on: floor, of: force_x}"), Quantity::force_x);
  EXPECT_EQ(of("{on: floor, of: max_penetration}"), Quantity::max_penetration);
  EXPECT_EQ(of("{on: floor, of: stick}"), Quantity::stick);
  EXPECT_EQ(of("{on: floor, of: area}"), Quantity::area);
  EXPECT_EQ(of("{on: floor, of: friction_work}"), Quantity::friction_work);
}

TEST(GoodModels, NumbersAsYamlWritesThem) {
  const std::string block = test_file("block.yaml");
  const auto mu = [&](const std::string& number) {
    return parse_model(edited(block, "mu: 0.3", "mu: " + number), "m")
        .contact[0]
        .friction->law.as<contact::Coulomb>()
        ->mu;
  };
  EXPECT_EQ(mu("+0.5"), 0.5);
  EXPECT_EQ(mu(".5"), 0.5);
  EXPECT_EQ(mu("5."), 5.0);
  EXPECT_EQ(mu("5E-1"), 0.5);
  EXPECT_EQ(mu("0.1"), 0.1);  // correctly rounded
}

TEST(GoodModels, RigidBodiesCanBeReleasedInTheFirstStep) {
  const std::string block = test_file("block.yaml");
  EXPECT_EQ(refusal(edited(block, "increments: 1,",
                           "increments: 1, release: [{on: roll, of: [uy, rz]}],")),
            "");
}

}  // namespace
}  // namespace osculate::deck
