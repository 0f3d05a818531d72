#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "../body_path.hpp"
#include "../cases.hpp"
#include "../run_space.hpp"
#include "reference.hpp"

namespace osculate::verification {
namespace {

constexpr const char* rings = "torque of uniform pressure, 2/3 mu N R";

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

std::vector<PlateState> plate_path(const std::string& text, const Workers& workers) {
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
  if (run_text3(text, workers, look, edits).outcome != solve::Outcome::converged) path.clear();
  return path;
}

void add_flat(CaseResult& out, const std::string& name, const FlatDisc& d, const Workers& workers) {
  const double stops = stop_time(d), energy = 0.5 * inertia(d) * d.rate * d.rate;
  const std::vector<PlateState> path = plate_path(flat_text(d, 1, 64, 60, 1.2 * stops), workers);
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
  add_flat(out, "flat disc", {1, 0.01, 2, 5, 0.3, 1}, context.workers);
  add_flat(out, "flat ring", {1, 0.5, 2, 5, 0.3, 1}, context.workers);
  return out;
}

}  // namespace osculate::verification
