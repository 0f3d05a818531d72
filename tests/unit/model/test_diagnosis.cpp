// Which rigid motions of a body nothing resists.
#include "osculate/model/diagnosis.hpp"

#include <gtest/gtest.h>

#include "block.hpp"

namespace osculate::model {
namespace {

struct Case {
  Model3 m = block<3>({{0, 0, 0}, {2, 1, 1}, {2, 1, 1}}, elastic<3>(100));
  void hold(int direction, const std::function<bool(const Vec3&)>& where) {
    for (std::size_t n = 0; n < m.reference.size(); ++n)
      if (where(m.reference[n])) prescribe(m, {static_cast<Index>(n)}, direction, 0);
  }
  [[nodiscard]] std::vector<FreeMotion3> motions() const {
    System3 system(m, 1);
    const State3 state = system.initial_state();
    system.begin_step(m.steps[0], state);
    solve::Evaluation e;
    system.evaluate(state, 0.5, true, e);
    return free_motions(system, m, state);
  }
  [[nodiscard]] std::string message() const { return free_motion_message(motions()); }
};

TEST(FreeMotions3, SixOfABodyThatNothingHolds) {
  const Case c;
  const std::vector<FreeMotion3> motions = c.motions();
  ASSERT_EQ(motions.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(motions[i].body, "block");
    const auto axis = static_cast<Eigen::Index>(i % 3);
    if (i < 3) {
      EXPECT_LT((motions[i].direction - Vec3::Unit(axis)).norm(), 1e-9);
      EXPECT_EQ(motions[i].rotation, 0);
    } else {
      EXPECT_LT((motions[i].axis - Vec3::Unit(axis)).norm(), 1e-9);
      EXPECT_NEAR(motions[i].rotation, 1, 1e-9);
    }
    EXPECT_LT((motions[i].center - Vec3(1, 0.5, 0.5)).norm(), 1e-14);
    EXPECT_LT(motions[i].stiffness_ratio, 1e-12);
  }
  EXPECT_EQ(c.message(),
            "body 'block' is free to move and turn in every direction: nothing holds it");
}

/// Rigid motions of the body, and one that bends it.
TEST(FreeMotions3, AreKnownFromModesThatStrain) {
  const Case c;
  System3 system(c.m, 1);
  const State3 state = system.initial_state();
  system.begin_step(c.m.steps[0], state);
  Eigen::VectorXd move(system.displacements()), turned = move, bent = move;
  for (std::size_t n = 0; n < c.m.reference.size(); ++n) {
    const Vec3& x = c.m.reference[n];
    const auto at = 3 * static_cast<Eigen::Index>(n);
    move.segment<3>(at) = Vec3(1, -2, 0.5);
    turned.segment<3>(at) = Vec3(0.3, 0.1, -1).cross(x);
    bent.segment<3>(at) = Vec3(0, 0, x.x() * x.x());
  }
  EXPECT_TRUE(system.is_free_motion({state}, move));
  EXPECT_TRUE(system.is_free_motion({state}, turned));
  EXPECT_TRUE(system.is_free_motion({state}, move + 3 * turned));
  EXPECT_TRUE(system.is_free_motion({state}, move + 1e-6 * bent));
  EXPECT_FALSE(system.is_free_motion({state}, bent));
  EXPECT_FALSE(system.is_free_motion({state}, move + bent));
  EXPECT_TRUE(system.is_free_motion({state}, Eigen::VectorXd::Ones(3)));  // with multipliers
}

/// A correction by a tangent without digits.
TEST(FreeMotions3, NodesThatFlyApartAreNoState) {
  const Case c;
  System3 system(c.m, 1);
  const State3 state = system.initial_state();
  system.begin_step(c.m.steps[0], state);
  solve::Evaluation e;
  system.evaluate(state, 0.5, true, e);
  ASSERT_TRUE(e.ok);
  for (const double way : {1e3, 1e13}) {
    const Eigen::VectorXd du = Eigen::VectorXd::Constant(system.displacements(), way);
    system.evaluate(state, system.apply(state, du, 0.5, 1.0), 0.5, false, e);
    EXPECT_EQ(e.ok, way < 1e4) << way;
    EXPECT_EQ(e.apart, way > 1e4) << way;
  }
  EXPECT_EQ(e.message, "nodes move by 4e+12 times the size of the model");  // 1e13 / |(2, 1, 1)|
}

TEST(FreeMotions3, ThreeOfABodyOnASmoothTable) {
  Case c;
  c.hold(2, [](const Vec3& x) { return x.z() < 1e-9; });
  const std::vector<FreeMotion3> motions = c.motions();
  ASSERT_EQ(motions.size(), 3u);
  EXPECT_LT((motions[0].direction - Vec3::UnitX()).norm(), 1e-9);
  EXPECT_LT((motions[1].direction - Vec3::UnitY()).norm(), 1e-9);
  EXPECT_LT((motions[2].axis - Vec3::UnitZ()).norm(), 1e-9);
  EXPECT_EQ(c.message().find("body 'block' is free to move along (1.0000, 0.0000, 0.0000)"), 0u)
      << c.message();
  EXPECT_NE(c.message().find("turn about the axis (0.0000, 0.0000, 1.0000) through (1, 0.5, 0.5)"),
            std::string::npos)
      << c.message();
}

TEST(FreeMotions3, AHingeLeavesOne) {
  Case c;
  for (int d = 0; d < 3; ++d) c.hold(d, [](const Vec3& x) { return x.x() < 1e-9 && x.z() < 1e-9; });
  const std::vector<FreeMotion3> motions = c.motions();
  ASSERT_EQ(motions.size(), 1u);
  EXPECT_LT((motions[0].axis - Vec3::UnitY()).norm(), 1e-9);
  EXPECT_GT(motions[0].rotation, 0.1);
}

TEST(FreeMotions3, NoneOfABodyThatIsHeld) {
  Case c;
  c.hold(0, [](const Vec3& x) { return x.x() < 1e-9; });
  c.hold(1, [](const Vec3& x) { return x.y() < 1e-9; });
  c.hold(2, [](const Vec3& x) { return x.z() < 1e-9; });
  EXPECT_TRUE(c.motions().empty());
  EXPECT_EQ(c.message(), "");
}

TEST(FreeMotions3, EveryBodyHasItsOwn) {
  Case c;
  for (int d = 0; d < 3; ++d) c.hold(d, [](const Vec3& x) { return x.z() < 1e-9; });
  add_block(c.m, {{5, 0, 0}, {6, 1, 1}, {1, 1, 1}}, elastic<3>(100), "loose");
  EXPECT_EQ(c.message(),
            "body 'loose' is free to move and turn in every direction: nothing holds it");
}

TEST(FreeMotions3, AreNamedWhenAnAnalysisStops) {
  Case c;
  c.m.steps[0].dead.push_back({{{0, 1.0}}, {0, 1, {}}});
  AnalysisOptions options;
  options.increments.max_cutbacks = 1;
  const AnalysisResult3 result = run(c.m, options, {});
  EXPECT_NE(result.outcome, solve::Outcome::converged);
  EXPECT_NE(result.message.find("nothing holds it"), std::string::npos) << result.message;
}

}  // namespace
}  // namespace osculate::model
