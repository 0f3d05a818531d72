// What is kept of a master that rests is what would be made anew.
#include <gtest/gtest.h>

#include "space_test.hpp"

namespace osculate::deck {
namespace {

/// A block above another one; the pair, and how its master is smoothed, are filled in.
std::string blocks(const std::string& contact) {
  return R"(osculate: 1
mesh:
  generate:
    low: {box: {x: [0, 3], y: [0, 3], z: [0, 1], elements: [3, 3, 1]}}
    up: {box: {x: [1.1, 2.2], y: [0.9, 2.3], z: [1, 2], elements: [2, 3, 1]}}
materials: {s: {linear_elastic: {E: 100, nu: 0.3}}}
sections: [{on: low, material: s, element: solid}, {on: up, material: s, element: solid}]
)" + contact +
         R"(
steps: [{name: press, increments: 1, prescribe: [{on: low.bottom, ux: 0, uy: 0, uz: 0}, {on: up.top, ux: 0, uy: 0, uz: -0.1}]}]
)";
}

/// Motion of a body with its shape: the unknowns of the nodes of the upper or the lower block.
Eigen::VectorXd moved(const Built3& built, bool upper, const Vec3& by, double bend) {
  const std::vector<Vec3>& x = built.model.reference;
  constexpr std::size_t of_lower = 4 * 4 * 2;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(x.size()));
  for (std::size_t n = 0; n < x.size(); ++n) {
    if ((n >= of_lower) != upper) continue;
    u.segment<3>(3 * static_cast<Eigen::Index>(n)) = by + Vec3(0, 0, bend * x[n].x() * x[n].x());
  }
  return u;
}

/// States one after the other by one system, and each by a system of its own: the same bits.
TEST(RestingMaster, IsAsOneThatIsLookedAtAnew) {
  for (const char* const contact :
       {"contact: [{name: c, master: low.top, slave: up.bottom, friction: {coulomb: {mu: 0.3}}}]",
        "contact: [{name: c, master: low.top, slave: up.bottom, smoothing: hermite}]",
        "contact: [{name: c, master: low.top, slave: up.bottom, sampling: {gauss: 2}}]",
        "contact: {all: {name: c}}"}) {
    SCOPED_TRACE(contact);
    const Built3 built = built_from(blocks(contact));
    model::System3 system(built.model, 1);
    const model::State3 start = system.initial_state();
    system.begin_step(built.model.steps[0], start);
    struct Move {
      bool upper;
      Vec3 by;
      double bend;
    };
    int in_contact = 0;
    for (const Move& move :
         {Move{true, {0, 0, -0.01}, 0}, Move{true, {0.05, 0, -0.02}, 0},  // the master rests
          Move{false, {0, 0, 0.02}, 0.004},
          Move{false, {0, 0, 0.02}, 0.004},                           // it moves, and rests
          Move{true, {0, 0, 40}, 0}, Move{false, {0, 0, -40}, 0.01},  // far from each other
          Move{true, {0, 0, -0.01}, 0}, Move{false, {0, 0, 0.03}, 0.001},
          Move{false, {0, 0, -40}, 0.001}, Move{true, {0, 0.1, -0.02}, 0.002}}) {
      model::State3 state = start;
      state.u = moved(built, move.upper, move.by, move.bend);
      model::System3 fresh(built.model, 1);
      (void)fresh.initial_state();
      fresh.begin_step(built.model.steps[0], start);
      solve::Evaluation first, again, expected;
      fresh.evaluate(start, 0.0, true, first);  // gives the tree its shape, as it did in `system`
      if (in_contact == 0) system.evaluate(start, 0.0, true, first);
      fresh.evaluate(state, 0.5, true, expected);
      system.evaluate(state, 0.5, true, again);
      ASSERT_TRUE(again.ok) << again.message;
      EXPECT_EQ(again.residual, expected.residual);
      EXPECT_EQ(system.forces().contact, fresh.forces().contact);
      EXPECT_EQ(again.counts.signature, expected.counts.signature);
      in_contact += again.counts.touching() > 0 ? 1 : 0;
    }
    EXPECT_GT(in_contact, 3);
  }
}

}  // namespace
}  // namespace osculate::deck
