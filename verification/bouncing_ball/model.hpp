#pragma once
// The model of a ball that bounces on a penalty.
#include <fmt/format.h>

#include <string>

#include "reference.hpp"

namespace osculate::verification {

/// A rigid disc over a fixed row of nodes: it touches the one below its centre only.
[[nodiscard]] inline std::string ball_model(const SpringBall& b, const std::string& dynamics,
                                            int increments, double duration) {
  return fmt::format(R"(osculate: 1
title: A ball that bounces on a penalty
mesh: {{generate: {{ground: {{box: {{x: [-1, 1], y: [-1, 0], elements: [2, 1]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 1, nu: 0, density: 1}}}}}}
sections: [{{on: ground, material: m, element: plane_strain}}]
rigid: {{ball: {{circle: {{center: [0, {:.17g}], radius: 1}}, mass: {}}}}}
contact: [{{name: c, master: ball, slave: ground.top, weight: node, normal: {{penalty: {}}}}}]
steps: [{{name: fall, increments: {}, duration: {:.17g}, gravity: [0, {}], dynamics: {},
  prescribe: [{{on: ground, ux: 0, uy: 0}}]}}]
)",
                     1 + b.height, b.mass, b.stiffness, increments, duration, -b.gravity, dynamics);
}

}  // namespace osculate::verification
