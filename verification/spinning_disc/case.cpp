#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "../body_path.hpp"
#include "../cases.hpp"
#include "../run_space.hpp"
#include "reference.hpp"

namespace osculate::verification {
namespace {

constexpr const char* sommerfeld = "Sommerfeld, Mechanics: sliding until it rolls";
constexpr const char* rings = "torque of uniform pressure, 2/3 mu N R";

// ---- upright on a line --------------------------------------------------------------------------

/// The depth at which a Winkler foundation under the disc carries its weight.
constexpr double depth = 2e-4;

/// A rigid disc on a row of fixed facets, sunk to its static depth.
std::string upright(const Wheel& w, int facets, int increments, double duration) {
  const double weight = w.mass * w.gravity;
  const double penalty = weight / (4.0 / 3 * depth * std::sqrt(2 * w.radius * depth));
  return fmt::format(R"(osculate: 1
title: A disc set spinning on a line
mesh: {{generate: {{road: {{box: {{x: [-0.1, 0.25], y: [-0.1, 0], elements: [{}, 1]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 1, nu: 0, density: 1}}}}}}
sections: [{{on: road, material: m, element: plane_strain}}]
rigid: {{disc: {{circle: {{center: [0, {:.17g}], radius: {}}}, mass: {}}}}}
contact: [{{name: c, master: disc, slave: road.top, sampling: {{gauss: 3}},
  normal: {{penalty: {:.17g}}}, friction: {{coulomb: {{mu: {}, penalty: {:.17g}}}}}}}]
initial_velocity: [{{on: disc, vx: {}, wz: {}}}]
steps: [{{name: spin, increments: {}, duration: {:.17g}, gravity: [0, {}], dynamics: {{}},
  prescribe: [{{on: road, ux: 0, uy: 0}}]}}]
)",
                     facets, w.radius - depth, w.radius, w.mass, penalty, w.friction, 30 * penalty,
                     w.speed, -w.rate, increments, duration, -w.gravity);
}

void add_upright(CaseResult& out) {
  const Wheel w{1, 2, 0.5, 9.81, 0.3, 0, 1.5};
  const double rolls = rolling_time(w);
  const std::vector<PathPoint> path = body_path(upright(w, 175, 200, 2 * rolls));
  if (path.empty()) {
    expect(out, "upright: finished", 0, 1, 0, sommerfeld);
    return;
  }
  const double slides = w.rate * w.radius;  // at the start
  double most = 0, at = 0;                  // the sliding, drawn on from where a tenth is left
  for (const PathPoint& p : path) {
    most = std::max(most, std::abs(p.velocity.x() - wheel_at(w, p.time).speed));
    const double sliding = -p.rate * w.radius - p.velocity.x();
    if (p.time > 0 && sliding > 0.1 * slides) at = p.time * slides / (slides - sliding);
  }
  const PathPoint& end = path.back();
  const WheelState rolling = wheel_at(w, end.time);
  const double energy = 0.25 * w.mass * w.radius * w.radius * w.rate * w.rate;
  expect(out, "upright: time until it rolls / (w R / (3 mu g))", at / rolls, 1, 5e-3, sommerfeld);
  expect(out, "upright: rolling speed / (w R / 3)", end.velocity.x() / rolling.speed, 1, 2e-3,
         sommerfeld);
  expect(out, "upright: rate / (w / 3)", -end.rate / rolling.rate, 1, 2e-3, sommerfeld);
  expect(out, "upright: largest error of the speed / (w R / 3)", most / rolling.speed, 0, 0.02,
         sommerfeld);
  expect(out, "upright: way / exact", end.translation.x() / rolling.x, 1, 5e-3, sommerfeld);
  expect(out, "upright: dissipated / initial energy", end.energies.friction / energy, 2.0 / 3, 2e-3,
         sommerfeld);
  inform(out, "upright: lost by the integration / initial energy", end.energies.numerical / energy,
         0, "energy");
}

// ---- flat on its face ---------------------------------------------------------------------------

/// A rigid plate that spins on a fixed ring of facets: rho, angle and z of a box, bent round. It is
/// sunk so far that the penalty carries the force.
std::string flat_text(const FlatDisc& d, int across, int around, int increments, double duration) {
  const double R = d.radius, r = d.hole;
  const double penalty = 1e4, area = std::numbers::pi * (R * R - r * r);
  return fmt::format(R"(osculate: 1
title: A disc that spins on its face
mesh: {{generate: {{ring: {{box: {{x: [{}, {}], y: [0, {:.17g}], z: [-1, 0], elements: [{}, {}, 1]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 1, nu: 0, density: 1}}}}}}
sections: [{{on: ring, material: m, element: solid}}]
rigid: {{plate: {{plane: {{point: [0, 0, {:.17g}], normal: [0, 0, -1]}}, mass: {}, reference: [0, 0, 0],
  inertia: [{}, {}, {:.17g}]}}}}
contact: [{{name: c, master: plate, slave: ring.top, sampling: {{gauss: 2}},
  normal: {{penalty: {}}}, friction: {{coulomb: {{mu: {}, penalty: {}}}}}}}]
initial_velocity: [{{on: plate, wz: {}}}]
steps: [{{name: spin, increments: {}, duration: {:.17g}, dynamics: {{}},
  forces: [{{on: plate, fz: {}, amplitude: on}}],
  prescribe: [{{on: ring, ux: 0, uy: 0, uz: 0}}, {{on: plate, ux: 0, uy: 0}}]}}]
amplitudes: {{on: [[0, 1], [1, 1]]}}
)",
                     r, R, 2 * std::numbers::pi, across, around, -d.force / (penalty * area),
                     d.mass, d.mass, d.mass, inertia(d), penalty, d.friction, 1e3 * penalty, d.rate,
                     increments, duration, -d.force);
}

/// Rotation and rate of the plate and the work of friction, at the start and after each increment.
struct PlateState {
  double time = 0, angle = 0, rate = 0, friction = 0;
};

std::vector<PlateState> plate_path(const std::string& text, int threads) {
  std::vector<PlateState> path;
  const Edits3 edits{[](mesh::Mesh& mesh) {
                       for (Vec3& x : mesh.nodes)
                         x = Vec3(x.x() * std::cos(x.y()), x.x() * std::sin(x.y()), x.z());
                     },
                     {}};
  const auto look = [&](const Snapshot3& now) {
    const model::Rates& rates = now.state.rates;
    if (rates.empty()) return;
    path.push_back({rates.energies.elapsed, body::total_rotation(now.state.rigid[0]).z(),
                    rates.velocity[now.state.u.size() + 5], rates.energies.friction});
  };
  if (run_text3(text, threads, look, edits).outcome != solve::Outcome::converged) path.clear();
  return path;
}

void add_flat(CaseResult& out, const std::string& name, const FlatDisc& d, int threads) {
  const double stops = stop_time(d), energy = 0.5 * inertia(d) * d.rate * d.rate;
  const std::vector<PlateState> path = plate_path(flat_text(d, 1, 64, 60, 1.2 * stops), threads);
  if (path.empty()) {
    expect(out, name + ": finished", 0, 1, 0, rings);
    return;
  }
  double most = 0;
  for (const PlateState& p : path)
    most = std::max(most, std::abs(p.rate - spin_at(d, p.time).rate) / d.rate);
  const PlateState& middle = path[path.size() / 2];
  const double torque = inertia(d) * (d.rate - middle.rate) / middle.time;
  expect(out, name + ": torque / (2/3 mu N (R^3 - r^3) / (R^2 - r^2))", torque / friction_torque(d),
         1, 3e-3, rings);
  expect(out, name + ": largest error of the rate / w", most, 0, 0.01, rings);
  expect(out, name + ": angle when it has stopped / (w t / 2)",
         path.back().angle / spin_at(d, stops).angle, 1, 0.01, rings);
  expect(out, name + ": dissipated / initial energy", path.back().friction / energy, 1, 0.01,
         rings);
}

}  // namespace

CaseResult spinning_disc(const CaseContext& context) {
  CaseResult out;
  add_upright(out);
  add_flat(out, "flat disc", {1, 0.01, 2, 5, 0.3, 1}, context.threads);
  add_flat(out, "flat ring", {1, 0.5, 2, 5, 0.3, 1}, context.threads);
  return out;
}

}  // namespace osculate::verification
