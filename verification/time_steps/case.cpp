#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "../bar_impact/model.hpp"
#include "../body_path.hpp"
#include "../bouncing_ball/model.hpp"
#include "../cases.hpp"

namespace osculate::verification {
namespace {

constexpr const char* closed = "closed solution";
constexpr const char* spring = "piecewise: free fall and a spring that only pushes";
constexpr const char* energy = "energy";
constexpr const char* schemes[] = {"newmark", "{hht: {alpha: 0.1}}",
                                   "{generalized_alpha: {radius: 0.6}}"};

/// What a run comes to.
struct Quality {
  bool finished = false;
  double error = 0;   ///< largest of all times, relative
  double gained = 0;  ///< largest energy over the one at the start, relative
  int steps = 0, refused = 0;
  double shortest = 0, longest = 0;
};

/// `miss`: the error of a state.
Quality quality(const std::string& text, const std::function<double(const Snapshot&)>& miss) {
  Quality out;
  double start = 0, time = 0;
  const auto look = [&](const Snapshot& now) {
    const model::Energies& e = now.state.rates.energies;
    const double total = e.kinetic + e.strain + e.contact - e.external;
    if (!now.record) start = total;
    out.error = std::max(out.error, miss(now));
    out.gained = std::max(out.gained, total / start - 1);
    if (!now.record) return;
    const double length = e.elapsed - time;
    time = e.elapsed;
    out.shortest = out.steps == 0 ? length : std::min(out.shortest, length);
    out.longest = std::max(out.longest, length);
    out.refused += now.record->time_step.refused;
    ++out.steps;
  };
  out.finished = run_text(text, look).outcome == solve::Outcome::converged;
  return out;
}

std::string chosen(const std::string& scheme, double error) {
  return fmt::format("{{scheme: {}, time_steps: {{error: {}, smallest: 1.0e-9}}}}", scheme, error);
}

// ---- two time scales ---------------------------------------------------------------------------

/// A mass on a spring with damping, and another a hundred times as fast, whose vibration is soon
/// over; both are pushed at the start. Cells of height 1 on a fixed base, mass 1, damping 0.004 K:
/// u'' + 0.004 w^2 u' + w^2 u = 0.
constexpr double frequencies[] = {1, 100};
constexpr double damping = 4e-3, duration = 6;

double vibration(double w, double t) {
  const double decay = 0.5 * damping * w * w, wd = std::sqrt(w * w - decay * decay);
  return std::exp(-decay * t) * std::sin(wd * t) / wd;
}

std::string two_scales(const std::string& dynamics, int increments) {
  const std::string damped =
      fmt::format("{{damping: {{stiffness: {}}}, ", damping) + dynamics.substr(1);
  return fmt::format(R"(osculate: 1
title: A slow and a fast vibration
mesh: {{generate: {{slow: {{box: {{x: [0, 1], y: [0, 1], elements: [1, 1]}}}},
  fast: {{box: {{x: [2, 3], y: [0, 1], elements: [1, 1]}}}}}}}}
materials:
  soft: {{linear_elastic: {{E: 1, nu: 0, density: 3}}}}
  hard: {{linear_elastic: {{E: 1.0e4, nu: 0, density: 3}}}}
sections: [{{on: slow, material: soft, element: plane_strain}}, {{on: fast, material: hard, element: plane_strain}}]
initial_velocity: [{{on: slow.top, vy: 1}}, {{on: fast.top, vy: 1}}]
steps:
  - name: swing
    increments: {}
    duration: {}
    dynamics: {}
    prescribe: [{{on: slow, ux: 0}}, {{on: fast, ux: 0}}, {{on: slow.bottom, uy: 0}}, {{on: fast.bottom, uy: 0}}]
solver: {{tolerance: {{residual: 1e-12, energy: 0.9}}}}
)",
                     increments, duration, damped);
}

/// Relative to the amplitudes; in the order of the mesh the last node of each cell is at its top.
double miss_of_two(const Snapshot& now) {
  const double t = now.state.rates.energies.elapsed;
  double worst = 0;
  for (int i = 0; i < 2; ++i) {
    const double w = frequencies[i];
    worst = std::max(worst, w * std::abs(now.state.u[8 * i + 7] - vibration(w, t)));
  }
  return worst;
}

void add_two_scales(CaseResult& out) {
  for (const std::string scheme : schemes) {
    const std::string name = "two time scales, " + scheme + ": ";
    Quality runs[4];
    for (int i = 0; i < 4; ++i) {
      runs[i] = quality(two_scales(chosen(scheme, std::pow(10.0, -3 - i)), 6), miss_of_two);
      const std::string allowed = fmt::format(", error: 1e-{}", 3 + i);
      inform(out, name + "largest error / amplitude" + allowed, runs[i].error, 0, closed);
      inform(out, name + "steps" + allowed, runs[i].steps, 0, closed);
      inform(out, name + "refused" + allowed, runs[i].refused, 0, closed);
      out.rows.push_back({name + "largest gain of energy" + allowed, runs[i].gained, 1e-9,
                          Relation::at_most, 0, energy});
    }
    expect(out, name + "order in the error allowed, 1e-3 to 1e-6",
           std::log10(runs[0].error / runs[3].error) / 3, 1, 0.15, closed);
    for (int i = 0; i < 3; ++i)
      expect(out, name + fmt::format("order in the error allowed, 1e-{} to 1e-{}", 3 + i, 4 + i),
             std::log10(runs[i].error / runs[i + 1].error), 1, 0.2, closed);
    out.rows.push_back({name + "longest over shortest step, error: 1e-4",
                        runs[1].longest / runs[1].shortest, 100, Relation::at_least, 0, closed});
    const Quality even =
        quality(two_scales("{scheme: " + scheme + "}", 4 * runs[1].steps), miss_of_two);
    out.rows.push_back({name + "error of four times as many even steps / error of these, 1e-4",
                        even.error / runs[1].error, 10, Relation::at_least, 0, closed});
  }
}

// ---- a load that changes suddenly --------------------------------------------------------------

/// u'' + u = f, f from 0 to 1 within a hundredth after the time 1.
double pushed(double t) {
  constexpr double begin = 1, rise = 0.01;
  const auto ramp = [&](double since) {
    return since > 0 ? (since - std::sin(since)) / rise : 0.0;
  };
  return ramp(t - begin) - ramp(t - begin - rise);
}

std::string sudden_load(const std::string& dynamics, int increments) {
  return fmt::format(R"(osculate: 1
title: A load that comes within a hundredth of a unit of time
mesh: {{generate: {{block: {{box: {{x: [0, 1], y: [0, 1], elements: [1, 1]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 1, nu: 0, density: 3}}}}}}
sections: [{{on: block, material: m, element: plane_strain}}]
amplitudes: {{push: [[0, 0], [0.1, 0], [0.101, 1], [1, 1]]}}
steps:
  - name: push
    increments: {}
    duration: 10
    dynamics: {}
    prescribe: [{{on: block, ux: 0}}, {{on: block.bottom, uy: 0}}]
    traction: [{{on: block.top, ty: 1, amplitude: push}}]
solver: {{tolerance: {{residual: 1e-12, energy: 0.9}}}}
)",
                     increments, dynamics);
}

void add_sudden_load(CaseResult& out) {
  const auto miss = [](const Snapshot& now) {
    return std::abs(now.state.u[7] - pushed(now.state.rates.energies.elapsed));
  };
  for (const std::string scheme : schemes) {
    const std::string name = "sudden load, " + scheme + ": ";
    Quality runs[3];
    for (int i = 0; i < 3; ++i)
      runs[i] = quality(sudden_load(chosen(scheme, std::pow(10.0, -2 - i)), 8), miss);
    for (int i = 0; i < 2; ++i)
      expect(out, name + fmt::format("order in the error allowed, 1e-{} to 1e-{}", 2 + i, 3 + i),
             std::log10(runs[i].error / runs[i + 1].error), 1, 0.25, closed);
    inform(out, name + "largest error, error: 1e-3", runs[1].error, 0, closed);
    inform(out, name + "steps, error: 1e-3", runs[1].steps, 0, closed);
    inform(out, name + "refused, error: 1e-3", runs[1].refused, 0, closed);
  }
}

// ---- a ball that bounces on a spring -----------------------------------------------------------

/// Five bounces. The spring needs steps a hundred times as short as the flight.
void add_ball(CaseResult& out) {
  const SpringBall b{0.05, 9.81, 2, 5e6};
  constexpr int bounces = 5;
  const double lasts = (bounces + 0.25) * bounce_period(b);
  const auto miss = [&](const Snapshot& now) {
    const double height = b.height + now.state.rigid.front().translation.y();
    return std::abs(height - ball_at(b, now.state.rates.energies.elapsed).height) / b.height;
  };
  double errors[3];
  for (int i = 0; i < 3; ++i) {
    const double error = std::pow(10.0, -2 - i);
    const Quality run =
        quality(ball_model(b, fmt::format("{{impact: average, time_steps: {{error: {}}}}}", error),
                           50, lasts),
                miss);
    errors[i] = run.error;
    const std::string name = fmt::format("ball, average, error: 1e-{}: ", 2 + i);
    expect(out, name + "finished", run.finished, 1, 0, spring);
    inform(out, name + "largest error of the height / height", run.error, 0, spring);
    inform(out, name + "steps", run.steps, 0, spring);
    inform(out, name + "refused", run.refused, 0, spring);
    inform(out, name + "even steps of the shortest length", lasts / run.shortest, 0, spring);
  }
  out.rows.push_back({"ball, average, error: 1e-4: largest error of the height / height", errors[2],
                      0.01, Relation::at_most, 0, spring});
}

// ---- a bar that hits a wall --------------------------------------------------------------------

/// Implicit contact forces that dissipate: no step lets energy in, whatever its length.
void add_bar(CaseResult& out) {
  const ImpactBar b{10, 0.5, 100, 0.01, 0.1, 0.005};
  constexpr int cells = 50, increments = 60;
  const double lasts = touch_time(b) + 1.6 * contact_duration(b);
  const std::string text = bar_model(b, cells, "{time_steps: {error: 0.05}}", increments, lasts);
  double speed = 0;  // of all of it, at the end
  const Quality run = quality(text, [&](const Snapshot& now) {
    speed = 0;
    for (int n = 0; n < 2 * (cells + 1); ++n) {
      const bool half = n % (cells + 1) == 0 || n % (cells + 1) == cells;
      speed += (half ? 0.5 : 1.0) * now.state.rates.velocity[2 * n] / (2 * cells);
    }
    return 0.0;
  });
  expect(out, "bar: finished", run.finished, 1, 0, energy);
  out.rows.push_back(
      {"bar: largest gain of energy, relative", run.gained, 1e-9, Relation::at_most, 0, energy});
  expect(out, "bar: speed of the rebound / v", speed / b.speed, 1, 0.03, "restitution 1");
  inform(out, "bar: steps", run.steps, 0, energy);
  inform(out, "bar: refused", run.refused, 0, energy);
}

}  // namespace

CaseResult time_steps(const CaseContext&) {
  CaseResult out;
  add_two_scales(out);
  add_sudden_load(out);
  add_ball(out);
  add_bar(out);
  return out;
}

}  // namespace osculate::verification
