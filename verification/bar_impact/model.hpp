#pragma once
// The model of a bar that flies against a wall.
#include <fmt/format.h>

#include <string>

#include "reference.hpp"

namespace osculate::verification {

/// A bar of one row of cells that flies in -x against a rigid line at x = -gap. Without Poisson's
/// ratio its waves are those of the line.
[[nodiscard]] inline std::string bar_model(const ImpactBar& b, int cells,
                                           const std::string& dynamics, int increments,
                                           double duration) {
  return fmt::format(R"(osculate: 1
title: A bar that hits a wall
mesh: {{generate: {{bar: {{box: {{x: [0, {}], y: [0, {}], elements: [{}, 1]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: {}, nu: 0, density: {}}}}}}}
sections: [{{on: bar, material: m, element: plane_strain, kinematics: small}}]
rigid: {{wall: {{line: {{point: [{:.17g}, 0], normal: [1, 0]}}}}}}
contact: [{{name: c, master: wall, slave: bar.left, normal: {{penalty: {:.17g}}}}}]
initial_velocity: [{{on: bar, vx: {}}}]
steps: [{{name: hit, increments: {}, duration: {:.17g}, dynamics: {}}}]
)",
                     b.length, b.area, cells, b.modulus, b.density, -b.gap,
                     20 * b.modulus * cells / b.length, -b.speed, increments, duration, dynamics);
}

}  // namespace osculate::verification
