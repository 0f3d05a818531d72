// Vibrations that swing with loads and supports.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "deck_test.hpp"
#include "osculate/deck/build.hpp"

namespace osculate::deck {
namespace {

using Complex = std::complex<double>;

/// Amplitude and velocity of the end of a bar, and the force at its other end, by frequency.
struct Sweep {
  model::AnalysisResult result;
  std::vector<double> frequency;
  std::vector<Complex> place, rate, reaction;
  int states = 0;
};

Sweep swept(const std::string& text) {
  const Description d = parse_model(text, "m.yaml");
  const Built built = build(d, load_mesh(d));
  const Index end = built.model.mesh.find_set("bar.right")->nodes.front();
  Sweep out;
  model::AnalysisObserver observer;
  observer.converged = [&](model::System&, const model::State&, const model::Progress&,
                           const solve::IncrementRecord*) {
    ++out.states;
    return true;
  };
  observer.harmonic = [&](model::System& system, const model::State& state,
                          const model::Progress& p, const model::HarmonicPart& part) {
    const model::Forces& f = system.forces();
    double sum = 0;
    for (const Index n : built.model.mesh.find_set("bar.left")->nodes)
      sum += f.internal[2 * n] - f.external[2 * n] + f.inertia[2 * n];
    if (!part.imaginary) {
      out.frequency.push_back(p.time);
      out.place.emplace_back(state.u[2 * end], 0);
      out.rate.emplace_back(state.rates.velocity[2 * end], 0);
      out.reaction.emplace_back(sum, 0);
    } else {
      out.place.back().imag(state.u[2 * end]);
      out.rate.back().imag(state.rates.velocity[2 * end]);
      out.reaction.back().imag(sum);
    }
    return true;
  };
  out.result = model::run(built.model, built.options, observer);
  return out;
}

/// A bar of 1 x 0.1, E A = 10, rho A = 0.1: vibrations at 2.5, 7.5, 12.5.
const std::string bar =
    "osculate: 1\n"
    "mesh: {generate: {bar: {box: {x: [0, 1], y: [0, 0.1], elements: [8, 1], type: quad8}}}}\n"
    "materials: {m: {linear_elastic: {E: 100, nu: 0, density: 1}}}\n"
    "sections: [{on: bar, material: m, element: plane_strain}]\n"
    "amplitudes: {falls: [[0, 1], [1, 0.5]]}\n"
    "steps:\n";
const std::string held =
    "  - {name: hold, increments: 1, prescribe: [{on: bar.left, ux: 0}, {on: bar, uy: 0}]}\n";
const std::string vibrations = "  - {name: free, modes: 15}\n";
std::string swing_step(const std::string& more, const std::string& range = "from: 1, to: 6",
                       const std::string& name = "swing") {
  return "  - {name: " + name + ", harmonic: {" + range +
         ", points: 4, damping: {mass: 2, ratio: 0.01}}, " + more + "}\n";
}
const std::string pulled = "total_force: [{on: bar.right, fx: 2}]";

void expect_near(Complex a, Complex b, double within) {
  EXPECT_NEAR(a.real(), b.real(), within);
  EXPECT_NEAR(a.imag(), b.imag(), within);
}

/// u(t) = Re(q exp(i w t)) is the motion in time that begins with it, by the same vibrations: after
/// many periods of the load a motion from rest has come to it.
TEST(Harmonic, IsWhereMotionsInTimeEnd) {
  const Sweep s = swept(bar + held + vibrations + swing_step(pulled, "from: 2, to: 2"));
  ASSERT_EQ(s.result.outcome, solve::Outcome::converged) << s.result.message;
  ASSERT_EQ(s.frequency.size(), 1U);
  std::string table = "wave: [";
  const double w = 2 * std::numbers::pi * 2, duration = 12;
  constexpr int points = 24 * 64;  // of 24 periods
  for (int i = 0; i <= points; ++i)
    table += (i ? ", [" : "[") + std::to_string(static_cast<double>(i) / points) + ", " +
             std::to_string(std::cos(w * duration * i / points)) + "]";
  const std::string text =
      edited(bar, "amplitudes: {", "amplitudes: {" + table + "], ") + held + vibrations +
      "  - {name: ring, increments: 1, duration: 12, modal: {damping: {mass: 2, ratio: 0.01}}, "
      "total_force: [{on: bar.right, fx: 2, amplitude: wave}]}\n";
  const Description d = parse_model(text, "m.yaml");
  const Built built = build(d, load_mesh(d));
  const Index end = built.model.mesh.find_set("bar.right")->nodes.front();
  double last = 0;
  model::AnalysisObserver observer;
  observer.converged = [&](model::System&, const model::State& state, const model::Progress&,
                           const solve::IncrementRecord*) {
    last = state.u[2 * end];
    return true;
  };
  ASSERT_EQ(model::run(built.model, built.options, observer).outcome, solve::Outcome::converged);
  // straight pieces have (sin x / x)^2 of the wave, x = pi / 64
  const double x = std::numbers::pi / 64, share = std::pow(std::sin(x) / x, 2);
  EXPECT_NEAR(last, share * s.place[0].real(), 2e-4 * std::abs(s.place[0]));
  EXPECT_GT(std::abs(s.place[0].imag()), 0.02 * std::abs(s.place[0]));
}

/// Slow swings are those of statics but for the vibrations that are missing; velocities are i w
/// times the places; the support takes the load less what accelerates the bar.
TEST(Harmonic, SlowSwingsAreStatic) {
  const Sweep s =
      swept(bar + held + "  - {name: free, modes: 30}\n" + swing_step(pulled, "from: 0, to: 0.01"));
  ASSERT_EQ(s.result.outcome, solve::Outcome::converged) << s.result.message;
  EXPECT_NEAR(s.place[0].real(), 0.2, 0.2 * 0.02);
  EXPECT_EQ(s.place[0].imag(), 0);
  for (std::size_t i = 0; i < s.frequency.size(); ++i)
    expect_near(s.rate[i], Complex(0, 2 * std::numbers::pi * s.frequency[i]) * s.place[i], 1e-14);
  EXPECT_EQ(s.states, 2);  // the first one and that of `hold`
}

/// Phases turn, amplitudes are over the frequencies, parts add up, steps do not.
TEST(Harmonic, LoadsAddUp) {
  const auto run = [](const std::string& more) { return swept(bar + held + vibrations + more); };
  const Sweep one = run(swing_step(pulled));
  ASSERT_EQ(one.result.outcome, solve::Outcome::converged) << one.result.message;
  ASSERT_EQ(one.frequency.size(), 7U);  // from 1 by 2.5 to 6
  const Sweep ahead = run(swing_step("total_force: [{on: bar.right, fx: 2, phase: 60}]"));
  const Sweep two =
      run(swing_step("total_force: [{on: bar.right, fx: 2}, {on: bar.right, fx: 2, phase: 90, "
                     "amplitude: falls}]"));
  const Sweep stretched =
      run("  - {name: pull, increments: 1, " + pulled + "}\n" +
          "  - {name: again, modes: {count: 15, about: start}}\n" + swing_step(pulled) +
          swing_step(pulled, "from: 1, to: 6", "once_more"));
  ASSERT_EQ(stretched.result.outcome, solve::Outcome::converged) << stretched.result.message;
  ASSERT_EQ(stretched.frequency.size(), 14U);
  const Complex turn = std::polar(1.0, std::numbers::pi / 3);
  for (std::size_t i = 0; i < one.frequency.size(); ++i) {
    const double place = (one.frequency[i] - 1) / 5;
    expect_near(ahead.place[i], turn * one.place[i], 1e-13);
    expect_near(two.place[i], (1.0 + Complex(0, 1 - place / 2)) * one.place[i], 1e-13);
    expect_near(stretched.place[i], one.place[i], 1e-11);
    expect_near(stretched.place[i + 7], one.place[i], 1e-11);
    expect_near(stretched.reaction[i], one.reaction[i], 1e-9);
  }
}

/// A support that swings is the body seen from it, with a force of its inertia: u = s + v, and v
/// is what the body force rho w^2 s makes of it.
TEST(Harmonic, SupportsSwing) {
  const Sweep moved =
      swept(bar + held + vibrations +
            "  - {name: swing, harmonic: {from: 3, to: 3}, prescribe: [{on: bar.left, "
            "ux: 0.5, phase: 90}]}\n");
  ASSERT_EQ(moved.result.outcome, solve::Outcome::converged) << moved.result.message;
  const double w = 6 * std::numbers::pi;
  const Sweep pushed =
      swept(bar + held + vibrations +
            "  - {name: swing, harmonic: {from: 3, to: 3}, body_force: [{on: bar, fx: " +
            std::to_string(0.5 * w * w) + ", phase: 90}]}\n");
  expect_near(moved.place[0], Complex(0, 0.5) + pushed.place[0], 1e-6);
  // forces on all of the bar: mass times acceleration
  EXPECT_NEAR(moved.reaction[0].real(), 0, 1e-12);
}

TEST(Harmonic, ResonanceWithoutDampingIsToldOf) {
  const Sweep s = swept(bar + held + vibrations + "  - {name: swing, harmonic: {from: 1, to: 3}, " +
                        pulled + "}\n");
  EXPECT_EQ(s.result.outcome, solve::Outcome::numerical_failure);
  EXPECT_NE(s.result.message.find("is that of vibration 1, which has no damping"),
            std::string::npos)
      << s.result.message;
  const Sweep free =
      swept(bar + "  - {name: free, modes: 4}\n" + swing_step(pulled, "from: 0, to: 1"));
  EXPECT_NE(free.result.message.find("is a free motion"), std::string::npos) << free.result.message;
}

std::string swing_refusal(const std::string& text) {
  try {
    const Description d = parse_model(text, "m.yaml");
    (void)build(d, load_mesh(d));
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Harmonic, Refusals) {
  const std::string good = bar + held + vibrations + swing_step(pulled);
  EXPECT_EQ(swing_refusal(good), "");
  const auto expect = [&](const std::string& from, const std::string& to, const std::string& text) {
    const std::string message = swing_refusal(edited(good, from, to));
    EXPECT_NE(message.find(text), std::string::npos) << message;
  };
  expect(vibrations, "", "the step before needs the key 'modes'");
  expect(pulled, "prescribe: [{on: bar.right, ux: 0.1}]",
         "prescribes what the vibrations leave free");
  expect(pulled, pulled + ", duration: 1", "`duration` does not go with it");
  expect(pulled, pulled + ", gravity: [0, -1]", "`gravity` does not go with it");
  expect(pulled, pulled + ", modal: {}", "it is another integration in time");
  expect("to: 6", "to: 0.5", "must not be below the first frequency, 1, got 0.5");
  expect("points: 4", "points: 1", "must be >= 2");
  expect("ratio: 0.01", "ratios: [{first: 2, last: 40, ratio: 0.1}]",
         "step 'free' looks for 15 vibrations");
  expect("uy: 0}]", "uy: 0, phase: 90}]", "only what swings, in a step with `harmonic`");
  expect(pulled, "total_force: [{on: bar.right, fx: 2}, {on: bar.right, fx: 3}]", "bar.right.fx");
  const std::string wall = edited(
      edited(good, "type: quad8}}}}",
             "type: quad8}}, wall: {line: {points: [[1.001, 1], [1.001, -1]], elements: 1}}}}"),
      "amplitudes:",
      "rigid: {stop: {set: wall}}\ncontact: [{name: end, master: stop, slave: bar.right, sampling: "
      "{gauss: 2}, normal: {penalty: 50}}]\namplitudes:");
  EXPECT_NE(swing_refusal(wall).find("contact 'end' is not tied"), std::string::npos)
      << swing_refusal(wall);
}

}  // namespace
}  // namespace osculate::deck
