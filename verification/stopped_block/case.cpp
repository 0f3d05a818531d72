#include <fmt/format.h>

#include <cmath>

#include "../body_path.hpp"
#include "../cases.hpp"
#include "reference.hpp"

namespace osculate::verification {
namespace {

constexpr const char* source = "Coulomb: v / (mu g), v^2 / (2 mu g), m v^2 / 2";
constexpr double width = 2, height = 0.5;
constexpr int across = 8, high = 2, nodes = (across + 1) * (high + 1);  // the first of the model

/// An elastic block that rests under its weight and is given the speed all at once.
std::string model_text(const StoppedBlock& b, const std::string& sampling, int increments,
                       double duration) {
  return fmt::format(R"(osculate: 1
title: A block stopped by friction
mesh: {{generate: {{block: {{box: {{x: [0, {0}], y: [0, {1}], elements: [{9}, {10}]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 1.0e6, nu: 0.3, density: {2:.17g}}}}}}}
sections: [{{on: block, material: m, element: plane_strain}}]
rigid: {{floor: {{line: {{point: [0, 0], normal: [0, 1]}}}}}}
contact: [{{name: c, master: floor, slave: block.bottom, sampling: {3},
  normal: {{penalty: 1.0e6}}, friction: {{coulomb: {{mu: {4}, penalty: 1.0e6}}}}}}]
initial_velocity: [{{on: block, vx: {5}}}]
steps:
  - {{name: rest, increments: 1, gravity: [0, {6}]}}
  - {{name: slide, increments: {7}, duration: {8:.17g}, dynamics: {{}}}}
)",
                     width, height, b.mass / (width * height), sampling, b.friction, b.speed,
                     -b.gravity, increments, duration, across, high);
}

struct Slide {
  double way = 0, speed = 0, most = 0, dissipated = 0, kinetic = 0, after = 0;
};

/// Means over the nodes of the block; `most`: the largest error of the speed, `after` the largest
/// way from the place at the end once it should rest.
Slide slide(const StoppedBlock& b, const std::string& sampling, int increments) {
  Slide out;
  std::vector<Vec2> path;
  const auto look = [&](const Snapshot& now) {
    const model::Rates& rates = now.state.rates;
    if (rates.empty()) return;
    double way = 0, speed = 0;
    for (int n = 0; n < nodes; ++n) {
      way += now.state.u[2 * n] / nodes;
      speed += rates.velocity[2 * n] / nodes;
    }
    out.way = way;
    out.speed = speed;
    out.most = std::max(out.most, std::abs(speed - slide_at(b, rates.energies.elapsed).speed));
    out.dissipated = rates.energies.friction;
    out.kinetic = rates.energies.kinetic;
    path.emplace_back(rates.energies.elapsed, way);
  };
  const model::AnalysisResult result =
      run_text(model_text(b, sampling, increments, 1.25 * stop_time(b)), look);
  if (result.outcome != solve::Outcome::converged) return {};
  for (const Vec2& p : path)
    if (p.x() > 1.05 * stop_time(b)) out.after = std::max(out.after, std::abs(p.y() - out.way));
  return out;
}

}  // namespace

CaseResult stopped_block(const CaseContext&) {
  CaseResult out;
  const StoppedBlock b{2, 3, 0.25, 9.81};
  const double energy = 0.5 * b.mass * b.speed * b.speed;
  for (const std::string sampling : {"nodes", "{gauss: 2}"}) {
    const Slide s = slide(b, sampling, 400);
    expect(out, sampling + ": way / (v^2 / (2 mu g))", s.way / stop_distance(b), 1, 5e-3, source);
    expect(out, sampling + ": largest error of the speed / v", s.most / b.speed, 0, 0.02, source);
    expect(out, sampling + ": dissipated / (m v^2 / 2)", s.dissipated / energy, 1, 5e-3, source);
    expect(out, sampling + ": moves after it has stopped / way", s.after / stop_distance(b), 0,
           1e-3, source);
    inform(out, sampling + ": kinetic energy left / (m v^2 / 2)", s.kinetic / energy, 0, source);
  }
  return out;
}

}  // namespace osculate::verification
