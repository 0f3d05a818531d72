// Steps with inertia: what their keys become, and what is refused.
#include <gmock/gmock.h>

#include "space_test.hpp"
#include "system_test.hpp"

namespace osculate::deck {
namespace {

const char* const schemes[] = {"newmark", "{hht: {alpha: 0.1}}",
                               "{generalized_alpha: {radius: 0.6}}"};
const char* const impacts[] = {"dissipative", "average", "plastic"};

std::string thrown(const std::string& scheme, const std::string& impact) {
  return edited(edited(test_file("dynamics.yaml"), "scheme: newmark", "scheme: " + scheme),
                "impact: dissipative", "impact: " + impact);
}

std::string refusal_of(const std::string& from, const std::string& to) {
  try {
    (void)build_text(edited(test_file("dynamics.yaml"), from, to));
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(DynamicsKeys, BecomeTheModel) {
  const Built built = build_text(thrown(schemes[1], impacts[1]));
  const model::Step& step = built.model.steps.at(0);
  ASSERT_TRUE(step.dynamics.has_value());
  EXPECT_EQ(step.dynamics->damping_mass, 0.3);
  EXPECT_EQ(step.dynamics->damping_stiffness, 1e-3);
  EXPECT_FALSE(step.dynamics->lumped);
  EXPECT_EQ(step.duration, 0.1);
  EXPECT_EQ(step.gravity.at(0).value(0), 0.2);
  EXPECT_EQ(step.gravity.at(1).value(0), -9.81);
  EXPECT_EQ(built.model.rigid.at(0).mass, 2);
  EXPECT_NEAR(built.model.rigid.at(0).inertia(0, 0), 1, 1e-12);  // m r^2 / 2
  EXPECT_EQ(built.model.rigid.at(1).mass, 0);
  const Index body = 2 * static_cast<Index>(built.model.reference.size());
  for (const model::PrescribedDof& p : step.prescribed)
    EXPECT_TRUE(p.dof < body || p.dof >= body + 3);
  const std::vector<std::pair<model::Dof, double>>& given = built.model.initial_velocity;
  ASSERT_EQ(given.size(), 3u + 15u);
  EXPECT_EQ(given[0], std::pair(body, 0.3));
  EXPECT_EQ(given[1], std::pair(body + 1, -1.0));
  EXPECT_EQ(given[2], std::pair(body + 2, 2.0));
  for (std::size_t k = 3; k < given.size(); ++k)
    EXPECT_TRUE(given[k].first % 2 == 0 && given[k].second == 0.1);
}

TEST(DynamicsKeys, NameEverySchemeAndImpact) {
  const solve::TimeScheme meant[] = {solve::newmark(), solve::hht(0.1),
                                     solve::generalized_alpha(0.6)};
  const solve::Impact kinds[] = {solve::Impact::dissipative, solve::Impact::average,
                                 solve::Impact::plastic};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const Built built = build_text(thrown(schemes[i], impacts[k]));
      const solve::TimeScheme scheme = built.model.steps.at(0).dynamics.value().scheme;
      EXPECT_EQ(scheme.alpha_m, meant[i].alpha_m);
      EXPECT_EQ(scheme.alpha_f, meant[i].alpha_f);
      EXPECT_EQ(scheme.beta, meant[i].beta);
      EXPECT_EQ(scheme.gamma, meant[i].gamma);
      EXPECT_EQ(scheme.impact, kinds[k]);
    }
}

TEST(DynamicsKeys, BecomeTheModelInSpace) {
  const model::Model3 m = built_from(test_file("dynamics_space.yaml")).model;
  Mat<3, 3> inertia;
  inertia << 0.5, 0.05, 0.02, 0.05, 0.8, -0.1, 0.02, -0.1, 1.1;
  EXPECT_EQ(m.rigid.at(0).inertia, inertia);
  EXPECT_EQ(m.rigid[0].mass, 2);
  EXPECT_EQ(m.pairs.at(0).definition.slave.points.size(), 9u * 9u);
  const Index body = 3 * static_cast<Index>(m.reference.size());
  EXPECT_EQ(m.initial_velocity,
            (std::vector<std::pair<model::Dof, double>>{
                {body, 0.3}, {body + 2, -1}, {body + 3, 2}, {body + 4, -1}, {body + 5, 3}}));
  ASSERT_EQ(m.steps.size(), 3u);
  EXPECT_EQ(m.steps[0].gravity.at(2).value(1), -9.81);
  EXPECT_EQ(m.steps[0].dead.at(0).unit,
            (std::vector<std::pair<model::Dof, double>>{{body + 3, 1}}));
  EXPECT_EQ(m.steps[0].dead.at(1).ramp.target, -0.2);
  EXPECT_EQ(m.steps[1].dynamics.value().scheme.alpha_f, 0.05);
  const model::Dynamics& last = m.steps[2].dynamics.value();
  EXPECT_EQ(last.scheme.alpha_f, solve::generalized_alpha(0.8).alpha_f);
  EXPECT_TRUE(last.lumped);
  EXPECT_EQ(last.time_steps.value().error, 0.05);
  EXPECT_EQ(last.time_steps->smallest, 1e-4);
}

TEST(DynamicsKeys, AreRefusedWithTheReason) {
  EXPECT_THAT(refusal_of("    duration: 0.1\n", ""), ::testing::HasSubstr("needs a duration"));
  EXPECT_THAT(refusal_of(", density: 0.5", ""),
              ::testing::HasSubstr("density of material 'rubber'"));
  EXPECT_THAT(refusal_of("radius: 1}, mass: 2", "radius: 1}, inertia: 2"),
              ::testing::HasSubstr("goes with a mass"));
  EXPECT_THAT(refusal_of("normal: [0, 1]}}", "normal: [0, 1]}, mass: 1}"),
              ::testing::HasSubstr("inertia is missing"));
  EXPECT_THAT(refusal_of("[0.2, -9.81]", "[0.2, -9.81, 1]"), ::testing::HasSubstr("components"));
  EXPECT_THAT(refusal_of("wz: 2", "wx: 2"), ::testing::HasSubstr("space only"));
  EXPECT_THAT(refusal_of("{on: block, vx: 0.1}", "{on: block, wz: 0.1}"),
              ::testing::HasSubstr("needs a rigid body"));
  EXPECT_THAT(refusal_of("mass: 2}", "mass: 2, inertia: [1, 2, 3]}"),
              ::testing::HasSubstr("one moment of inertia"));
}

// The columns of the energies can be plotted, and their names are taken.
TEST(DynamicsKeys, HaveColumnsOfTheirOwn) {
  const std::string model = test_file("dynamics.yaml");
  const Built built = build_text(model + "  plots: [{x: elapsed, y: [energy.kinetic, disc.vy]}]\n");
  EXPECT_EQ(built.history.size(), 3 + model::energy_quantities.size());  // without energy.plastic
  EXPECT_EQ(built.history.back().name, "energy.residual");
  EXPECT_THAT(refusal_of("{on: disc, of: vy}", "{on: disc, of: vy, name: elapsed}"),
              ::testing::HasSubstr("column 'elapsed' is always there"));
}

// The body of a cylinder with two ends has its centre between them.
TEST(DynamicsKeys, PutTheReferenceAtTheCentreOfMass) {
  const std::string with = edited(
      edited(test_file("dynamics_space.yaml"), "sphere: {center: [0.1, 0.05, 0.9], radius: 1}",
             "cylinder: {point: [0, 0, 1], axis: [1, 0, 0], radius: 1, length: 6}"),
      ", inertia: [0.5, 0.8, 1.1, 0.05, -0.1, 0.02]", "");
  const model::RigidBody3 body = built_from(with).model.rigid.at(0);
  EXPECT_LT((body.reference - Vec3(3, 0, 1)).norm(), 1e-12);
  EXPECT_NEAR(body.inertia(0, 0), 0.5 * 2, 1e-12);              // m r^2 / 2
  EXPECT_NEAR(body.inertia(1, 1), 2 * (3 + 36) / 12.0, 1e-12);  // m (3 r^2 + l^2) / 12
  EXPECT_THAT(any_refusal(edited(with, "mass: 2", "mass: 2, reference: [0, 0, 1]")),
              ::testing::HasSubstr("centre of mass"));
}

}  // namespace
}  // namespace osculate::deck
