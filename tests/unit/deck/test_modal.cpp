// Motions along vibrations.
#include <gtest/gtest.h>

#include <cmath>

#include "deck_test.hpp"
#include "osculate/deck/build.hpp"

namespace osculate::deck {
namespace {

/// Displacement and velocity of the end of a bar after each increment.
struct Swing {
  model::AnalysisResult result;
  std::vector<double> time, place, rate, reaction;
};

Swing swing(const std::string& text) {
  const Description d = parse_model(text, "m.yaml");
  const Built built = build(d, load_mesh(d));
  const Index end = built.model.mesh.find_set("bar.right")->nodes.front();
  Swing out;
  model::AnalysisObserver observer;
  observer.converged = [&](model::System& system, const model::State& state,
                           const model::Progress& p, const solve::IncrementRecord* record) {
    if (!record) return true;
    out.time.push_back(p.time);
    out.place.push_back(state.u[2 * end]);
    out.rate.push_back(state.rates.empty() ? 0 : state.rates.velocity[2 * end]);
    const model::Forces& f = system.forces();
    double sum = 0;
    for (const Index n : built.model.mesh.find_set("bar.left")->nodes)
      sum += f.internal[2 * n] - f.external[2 * n] + (f.inertia.size() ? f.inertia[2 * n] : 0.0);
    out.reaction.push_back(sum);
    return true;
  };
  out.result = model::run(built.model, built.options, observer);
  return out;
}

/// A bar of 1 x 0.1, E A = 10, rho A = 0.1.
const std::string modal_bar =
    "osculate: 1\n"
    "mesh: {generate: {bar: {box: {x: [0, 1], y: [0, 0.1], elements: [8, 1], type: quad8}}}}\n"
    "materials: {m: {linear_elastic: {E: 100, nu: 0, density: 1}}}\n"
    "sections: [{on: bar, material: m, element: plane_strain}]\n"
    "amplitudes: {at_once: [[0, 1], [1, 1]], corner: [[0, 0], [0.37, 1], [1, -0.5]]}\n"
    "steps:\n";
const std::string bar_held =
    "  - {name: hold, increments: 1, prescribe: [{on: bar.left, ux: 0}, {on: bar, uy: 0}]}\n";
const std::string bar_free = "  - {name: free, modes: 3}\n";

std::string modal_step(const std::string& increments, const std::string& more,
                       const std::string& name = "ring") {
  return "  - {name: " + name + ", increments: " + increments + ", " + more + "}\n";
}
const std::string bar_pulled = "total_force: [{on: bar.right, fx: 2, amplitude: corner}]";

/// Increments are where results are, and nothing else: corners of tables lie between them.
TEST(Modal, IncrementsDoNotMatter) {
  const std::string step = "duration: 0.3, modal: {damping: {ratio: 0.03}}, " + bar_pulled;
  const Swing few = swing(modal_bar + bar_held + bar_free + modal_step("2", step));
  const Swing many = swing(modal_bar + bar_held + bar_free + modal_step("50", step));
  ASSERT_EQ(few.result.outcome, solve::Outcome::converged) << few.result.message;
  EXPECT_GT(std::abs(few.place.back()), 1e-3);
  EXPECT_NEAR(few.place[1], many.place[25], 1e-12);
  EXPECT_NEAR(few.place.back(), many.place.back(), 1e-12);
  EXPECT_NEAR(few.rate.back(), many.rate.back(), 1e-10);
  EXPECT_DOUBLE_EQ(few.time.back(), 2.3);  // steps without inertia last 1
}

/// Velocities are those of the displacements.
TEST(Modal, RatesAreDerivatives) {
  const Swing r = swing(modal_bar + bar_held + bar_free +
                        modal_step("400", "duration: 0.3, modal: {}, " + bar_pulled));
  const double h = 0.3 / 400;
  const std::size_t i = 301;
  const double by_difference = (r.place[i + 1] - r.place[i - 1]) / (2 * h);
  EXPECT_NEAR(r.rate[i], by_difference, 1e-4 * std::abs(by_difference));
}

/// A second step goes on from the first, also where a run is cut there; a step that looks for
/// vibrations in between begins at rest.
TEST(Modal, StepsGoOn) {
  const std::string on = "forces: [{on: bar.right, fx: 1, amplitude: at_once}]";
  const std::string half = "duration: 0.15, modal: {damping: {mass: 0.2}}, " + on;
  const Swing whole = swing(modal_bar + bar_held + bar_free +
                            modal_step("2", "duration: 0.3, modal: {damping: {mass: 0.2}}, " + on));
  const Swing parts =
      swing(modal_bar + bar_held + bar_free + modal_step("1", half) + modal_step("1", half, "on"));
  EXPECT_NEAR(parts.place[2], whole.place[2], 1e-13);
  const Swing anew = swing(modal_bar + bar_held + bar_free + modal_step("1", half) +
                           "  - {name: again, modes: 3}\n" + modal_step("1", half, "on"));
  ASSERT_EQ(anew.result.outcome, solve::Outcome::converged) << anew.result.message;
  EXPECT_NEAR(anew.place[2], anew.place[1], 1e-12);
}

/// What holds the bar at the state of the vibrations does not move it; what comes on top does. A
/// step behind it goes on from that state.
TEST(Modal, LoadsCountFromTheState) {
  const std::string stretched =
      "  - {name: pull, increments: 1, total_force: [{on: bar.right, fx: 3}]}\n";
  const Swing still = swing(modal_bar + bar_held + stretched + bar_free +
                            modal_step("3", "duration: 0.2, modal: {}"));
  for (std::size_t i = 2; i < 5; ++i) EXPECT_NEAR(still.place[i], 0.3, 1e-12);
  const auto more = [](const std::string& force) {
    return "duration: 0.2, modal: {}, total_force: [{on: bar.right, fx: " + force +
           ", amplitude: at_once}]";
  };
  const std::string two =
      "duration: 0.2, modal: {}, total_force: [{on: bar.right, fx: 2, "
      "amplitude: at_once}]";
  const auto on_top = [&](const std::string& force) {
    return swing(modal_bar + bar_held + stretched + bar_free + modal_step("2", more(force)) +
                 "  - {name: after, increments: 1, total_force: [{on: bar.right, fx: 3}]}\n");
  };
  const Swing five = on_top("5"), seven = on_top("7");
  EXPECT_GT(std::abs(five.place[3] - 0.3), 0.1);
  EXPECT_NEAR(seven.place[3] - 0.3, 2 * (five.place[3] - 0.3), 1e-11);
  EXPECT_NEAR(five.place[4], 0.3, 1e-12);
  const Swing alone = swing(modal_bar + bar_held + bar_free + modal_step("2", two));
  const Swing about_start =
      swing(modal_bar + bar_held + stretched +
            "  - {name: free, modes: {count: 3, about: start}}\n" + modal_step("2", two));
  EXPECT_NEAR(about_start.place[3], alone.place[2], 1e-12);
}

/// With all vibrations it is the motion that implicit steps converge to.
TEST(Modal, IsTheMotionInTime) {
  const std::string load = "forces: [{on: bar.right, fx: 1, amplitude: corner}]";
  const Swing modal = swing(modal_bar + bar_held + "  - {name: free, modes: 40}\n" +
                            modal_step("4", "duration: 0.3, modal: {damping: {mass: 2}}, " + load));
  const Swing stepped =
      swing(modal_bar + bar_held +
            modal_step("3000", "duration: 0.3, dynamics: {damping: {mass: 2}}, " + load));
  ASSERT_EQ(modal.result.outcome, solve::Outcome::converged) << modal.result.message;
  EXPECT_NEAR(modal.place.back(), stepped.place.back(), 2e-4 * std::abs(stepped.place.back()));
  EXPECT_NEAR(modal.reaction.back(), stepped.reaction.back(), 0.02);
}

/// Gravity acts at once, and on all of a body that nothing holds.
TEST(Modal, FallsFreely) {
  const Swing r = swing(modal_bar + "  - {name: free, modes: 4}\n" +
                        modal_step("3", "duration: 0.3, modal: {}, gravity: [-10, 0]"));
  ASSERT_EQ(r.result.outcome, solve::Outcome::converged) << r.result.message;
  EXPECT_NEAR(r.place.back(), -0.45, 1e-7);
  EXPECT_NEAR(r.rate.back(), -3, 1e-6);
}

/// With a velocity: a body that nothing holds flies on, a bar that meets a wall with its held end
/// moves as it does in time.
TEST(Modal, BeginsWithGivenVelocities) {
  const std::string thrown =
      edited(modal_bar, "steps:\n", "initial_velocity: [{on: bar, vx: -0.1}]\nsteps:\n");
  const Swing free =
      swing(thrown + "  - {name: free, modes: 4}\n" + modal_step("3", "duration: 0.3, modal: {}"));
  ASSERT_EQ(free.result.outcome, solve::Outcome::converged) << free.result.message;
  EXPECT_NEAR(free.place.back(), -0.03, 1e-10);
  EXPECT_NEAR(free.rate.back(), -0.1, 1e-9);
  const Swing modal = swing(thrown + bar_held + "  - {name: free, modes: 40}\n" +
                            modal_step("4", "duration: 0.3, modal: {damping: {mass: 2}}"));
  const Swing stepped = swing(thrown + bar_held +
                              modal_step("3000", "duration: 0.3, dynamics: {damping: {mass: 2}}"));
  ASSERT_EQ(modal.result.outcome, solve::Outcome::converged) << modal.result.message;
  EXPECT_GT(std::abs(stepped.place.back()), 1e-3);
  EXPECT_NEAR(modal.place.back(), stepped.place.back(), 5e-3 * std::abs(stepped.place.back()));
}

/// A damper that is no part of one vibration alone would have to join them.
TEST(Modal, DampersMayNotJoinVibrations) {
  const std::string damped =
      edited(modal_bar, "steps:\n",
             "sets: {tip: {union: [bar.top_right]}}\nsprings: [{terms: [{on: tip, of: ux, factor: "
             "1}], damping: 0.1}]\nsteps:\n");
  const std::string step = modal_step("2", "duration: 0.3, modal: {}, " + bar_pulled);
  EXPECT_NE(swing(damped + bar_held + bar_free + step).result.message.find("dampers join"),
            std::string::npos);
  EXPECT_EQ(swing(damped + bar_held + "  - {name: free, modes: 1}\n" + step).result.message, "");
}

/// The root of the bar moves: by all vibrations it is the motion in time, damped by the mass.
TEST(Modal, SupportsMove) {
  const std::string root = "prescribe: [{on: bar.left, ux: 0.2, amplitude: shake}]";
  const std::string shaken = edited(
      modal_bar, "amplitudes: {", "amplitudes: {shake: [[0, 0], [0.4, 1], [0.7, -1], [1, 0.5]], ");
  const Swing modal =
      swing(shaken + bar_held + "  - {name: free, modes: 40}\n" +
            modal_step("40", "duration: 0.3, modal: {damping: {mass: 2}}, " + root));
  const Swing stepped =
      swing(shaken + bar_held +
            modal_step("3000", "duration: 0.3, dynamics: {damping: {mass: 2}}, " + root));
  ASSERT_EQ(modal.result.outcome, solve::Outcome::converged) << modal.result.message;
  EXPECT_GT(std::abs(modal.place.back()), 0.05);
  for (const std::size_t i : {10, 20, 35, 40})
    EXPECT_NEAR(modal.place[i], stepped.place[75 * i], 2e-3) << i;
  const Swing few = swing(shaken + bar_held + "  - {name: free, modes: 40}\n" +
                          modal_step("1", "duration: 0.3, modal: {damping: {mass: 2}}, " + root));
  EXPECT_NEAR(few.place.back(), modal.place.back(), 1e-11);
  const std::string twice = modal_step("1", "duration: 0.3, modal: {}, " + root);
  EXPECT_NE(
      swing(edited(shaken, "shake: [[0, 0]", "shake: [[0, 0.1]") + bar_held + bar_free + twice)
          .result.message.find("its amplitude must begin with 0"),
      std::string::npos);
}

/// Contacts stay as they are, or the motion ends with a message.
TEST(Modal, ContactsMayNotChange) {
  const std::string wall = edited(
      edited(modal_bar, "type: quad8}}}}",
             "type: quad8}}, wall: {line: {points: [[1.001, 1], [1.001, -1]]"
             ", elements: 1}}}}"),
      "steps:\n",
      "rigid: {stop: {set: wall}}\ncontact: [{name: end, master: stop, slave: bar.right, sampling: "
      "{gauss: 2}, normal: {penalty: 50}}]\nsteps:\n");
  const auto message = [&](double force) {
    return swing(wall + bar_held + bar_free +
                 modal_step("10", "duration: 0.2, modal: {}, total_force: [{on: bar.right, fx: " +
                                      std::to_string(force) + ", amplitude: at_once}]"))
        .result.message;
  };
  EXPECT_EQ(message(1e-3), "");
  EXPECT_NE(message(1).find("2 contact points open, close or slip, but vibrations keep contacts"),
            std::string::npos)
      << message(1);
}

std::string modal_refusal(const std::string& text) {
  try {
    const Description d = parse_model(text, "m.yaml");
    (void)build(d, load_mesh(d));
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Modal, Refusals) {
  const std::string good =
      modal_bar + bar_held + bar_free + modal_step("2", "duration: 0.3, modal: {}, " + bar_pulled);
  EXPECT_EQ(modal_refusal(good), "");
  const auto expect = [&](const std::string& from, const std::string& to, const std::string& text) {
    const std::string message = modal_refusal(edited(good, from, to));
    EXPECT_NE(message.find(text), std::string::npos) << message;
  };
  expect(bar_free, "", "the step before needs the key 'modes'");
  expect("duration: 0.3, ", "", "a step with inertia needs a duration");
  expect(bar_pulled, "prescribe: [{on: bar.right, ux: 0.1}]",
         "prescribes what the vibrations leave free");
  expect(
      bar_pulled,
      "prescribe: [{on: bar.left, ux: 0.1}]}\n  - {name: on, increments: 1, duration: 1, modal: {}",
      "supports move in the only step with `modal`");
  expect("modal: {}", "modal: {}, release: [{on: bar.left, of: [ux]}]",
         "`release` does not go with it, supports and contacts are those of the step with `modes`");
  expect("modal: {}", "modal: {}, dynamics: {}", "it is another integration in time");
  expect("modal: {}", "modal: {damping: {ratios: [{first: 2, last: 4, ratio: 0.1}]}}",
         "step 'free' looks for 3 vibrations");
  expect("modal: {}", "modal: {damping: {ratios: [{first: 3, last: 2, ratio: 0.1}]}}",
         "must not be below the first one, 3, got 2");
  const std::string message =
      modal_refusal(edited(good, "steps:\n", "initial_velocity: [{on: bar, vx: 1}]\nsteps:\n") +
                    "  - {name: after, increments: 1, duration: 1, dynamics: {}}\n");
  EXPECT_NE(message.find("which of them has the velocity is not known"), std::string::npos)
      << message;
}

}  // namespace
}  // namespace osculate::deck
