#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../body_path.hpp"
#include "../cases.hpp"

namespace osculate::verification {
namespace {

constexpr const char* source = "the other scheme";
constexpr double duration = 0.24, speed = 2;

std::string model_text(const std::string& dynamics, int increments) {
  return fmt::format(R"(osculate: 1
title: A soft block hits another one
mesh:
  generate:
    lower: {{box: {{x: [-1, 1], y: [-1, 0], elements: [5, 3]}}}}
    upper: {{box: {{x: [-0.6, 0.6], y: [0.01, 1.01], elements: [4, 3]}}}}
materials: {{rubber: {{neo_hooke: {{E: 1000, nu: 0.3, density: 1}}}}}}
sections:
  - {{on: lower, material: rubber, element: plane_strain, formulation: full}}
  - {{on: upper, material: rubber, element: plane_strain, formulation: full}}
contact: [{{name: c, master: lower.top, slave: upper.bottom, normal: {{penalty: 2000}}}}]
initial_velocity: [{{on: upper, vy: {}}}]
steps:
  - name: hit
    increments: {}
    duration: {}
    dynamics: {}
    prescribe: [{{on: lower.bottom, ux: 0, uy: 0}}]
)",
                     -speed, increments, duration, dynamics);
}

struct Hit {
  bool finished = false;
  Eigen::VectorXd u;
  double rebound = 0;       ///< mean velocity of the upper block's nodes at the end
  double deepest = 0;       ///< largest force of the contact
  double residual = 0;      ///< of the ledger at the end, over the energy at the start
  double numerical = 0;     ///< likewise
  int most_time_steps = 0;  ///< in an increment
};

Hit hit(const std::string& dynamics, int increments) {
  Hit out;
  const auto look = [&](const Snapshot& now) {
    if (!now.record) return;
    out.u = now.state.u;
    const auto lower = 6 * 4, upper = 5 * 4;
    out.rebound = 0;
    for (int n = lower; n < lower + upper; ++n)
      out.rebound += now.state.rates.velocity[2 * n + 1] / upper;
    double force = 0;
    for (const auto& p : now.system.contact()[0].points) force -= p.weight * p.normal_traction;
    out.deepest = std::max(out.deepest, force);
    const model::Energies& e = now.state.rates.energies;
    out.residual = e.residual / e.start;
    out.numerical = e.numerical / e.start;
    out.most_time_steps = std::max(out.most_time_steps, now.record->time_steps.count);
  };
  const model::AnalysisResult result = run_text(model_text(dynamics, increments), look);
  out.finished = result.outcome == solve::Outcome::converged;
  return out;
}

}  // namespace

CaseResult soft_impact(const CaseContext&) {
  CaseResult out;
  double difference = 0, before = 0;
  Hit last, beside;
  for (const int increments : {100, 200, 400}) {
    last = hit("{scheme: central_differences}", increments);
    beside = hit("{scheme: newmark, impact: average, mass: lumped}", increments);
    before = difference;
    difference = (last.u - beside.u).lpNorm<Eigen::Infinity>() / beside.u.lpNorm<Eigen::Infinity>();
    inform(out, fmt::format("{} steps: difference of the displacements, relative", increments),
           difference, 0, source);
  }
  expect(out, "finished", last.finished && beside.finished, 1, 0, source);
  expect(out, "explicit time steps in an increment", last.most_time_steps, 1, 0, source);
  out.rows.push_back({"400 steps: difference of the displacements, relative", difference, 1e-3,
                      Relation::at_most, 0, source});
  expect(out, "order of the difference", std::log2(before / difference), 2, 0.15, source);
  expect(out, "velocity of the upper block at the end / v", last.rebound / speed,
         beside.rebound / speed, 1e-3, source);
  expect(out, "largest force of the contact", last.deepest, beside.deepest, 1e-3, source);
  out.rows.push_back({"residual of the energies, explicit", std::abs(last.residual), 1e-4,
                      Relation::at_most, 0, "energy"});
  inform(out, "energy lost by the time integration, explicit", last.numerical, 0, "energy");
  return out;
}

}  // namespace osculate::verification
