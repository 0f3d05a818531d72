#include <fmt/format.h>

#include <cmath>

#include "../body_path.hpp"
#include "../cases.hpp"
#include "reference.hpp"

namespace osculate::verification {
namespace {

constexpr const char* source = "rigid body: m a = m g sin - F, J w' = F R";

/// A rigid cylinder on a row of fixed facets, with gravity inclined; sunk to its static depth.
std::string model_text(const InclineRoller& r, int increments, double duration) {
  constexpr double depth = 2e-4;
  const double penalty = normal_force(r) / (4.0 / 3 * depth * std::sqrt(2 * r.radius * depth));
  return fmt::format(R"(osculate: 1
title: A cylinder on an incline
mesh: {{generate: {{road: {{box: {{x: [-0.1, 0.45], y: [-0.1, 0], elements: [275, 1]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 1, nu: 0, density: 1}}}}}}
sections: [{{on: road, material: m, element: plane_strain}}]
rigid: {{cylinder: {{circle: {{center: [0, {:.17g}], radius: {}}}, mass: {}}}}}
contact: [{{name: c, master: cylinder, slave: road.top, sampling: {{gauss: 3}},
  normal: {{penalty: {:.17g}}}, friction: {{coulomb: {{mu: {}, penalty: {:.17g}}}}}}}]
steps: [{{name: roll, increments: {}, duration: {:.17g}, gravity: [{:.17g}, {:.17g}], dynamics: {{}},
  prescribe: [{{on: road, ux: 0, uy: 0}}]}}]
)",
                     r.radius - depth, r.radius, r.mass, penalty, r.friction, 30 * penalty,
                     increments, duration, r.gravity * std::sin(r.slope),
                     -r.gravity * std::cos(r.slope));
}

void add_slope(CaseResult& out, const std::string& name, double slope_over_friction) {
  InclineRoller r{1, 2, 0.5, 9.81, 0, 0.3};
  r.slope = std::atan(slope_over_friction * r.friction);
  const double duration = std::sqrt(2 * 0.35 / acceleration(r));
  const std::vector<PathPoint> path = body_path(model_text(r, 200, duration));
  if (path.empty()) {
    expect(out, name + ": finished", 0, 1, 0, source);
    return;
  }
  const PathPoint& end = path.back();
  const RollerState exact = roller_at(r, end.time);
  const double energy = r.mass * r.gravity * exact.way * std::sin(r.slope);
  expect(out, name + ": speed / exact", end.velocity.x() / exact.speed, 1, 5e-3, source);
  expect(out, name + ": rate / exact", -end.rate / exact.rate, 1, 5e-3, source);
  expect(out, name + ": way / exact", end.translation.x() / exact.way, 1, 5e-3, source);
  const double sliding = end.velocity.x() + end.rate * r.radius;
  const double exactly = rolls(r) ? 0 : exact.speed - exact.rate * r.radius;
  expect(out, name + ": error of the sliding speed / speed", (sliding - exactly) / exact.speed, 0,
         5e-3, source);
  const double work = rolls(r) ? 0 : dissipated(r, end.time);
  expect(out, name + ": error of the dissipated energy / work of gravity",
         (end.energies.friction - work) / energy, 0, 2e-3, source);
}

}  // namespace

CaseResult rolling_cylinder(const CaseContext&) {
  CaseResult out;
  add_slope(out, "tan = mu", 1);
  add_slope(out, "tan = 2.7 mu, rolls", 2.7);
  add_slope(out, "tan = 3.3 mu, slips", 3.3);
  add_slope(out, "tan = 6 mu, slips", 6);
  return out;
}

}  // namespace osculate::verification
