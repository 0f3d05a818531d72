#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "../cases.hpp"
#include "../run_model.hpp"

namespace osculate::verification {
namespace {

constexpr double mu = 0.3;

/// A 4 x 2 block with weight 8 on a rigid line inclined by atan(ratio * mu).
std::string model_text(double ratio) {
  const double angle = std::atan(ratio * mu);
  return fmt::format(R"(osculate: 1
title: Block on an incline
mesh: {{generate: {{block: {{box: {{x: [0, 4], y: [0, 2], elements: [8, 4], angle: {:.17g}, about: [0, 0]}}}}}}}}
materials: {{s: {{linear_elastic: {{E: 1.0e4, nu: 0.3}}}}}}
sections: [{{on: block, material: s, element: plane_strain}}]
rigid: {{slope: {{line: {{point: [0, 0], normal: [{:.17g}, {:.17g}]}}}}}}
contact: [{{name: c, master: slope, slave: block.bottom, normal: {{penalty: 1.0e6}},
  friction: {{coulomb: {{mu: {}, penalty: 1.0e6}}}}}}]
steps: [{{name: weight, increments: 1, body_force: [{{on: block, by: -1}}]}}]
)",
                     angle * 180 / std::numbers::pi, -std::sin(angle), std::cos(angle), mu);
}

}  // namespace

CaseResult incline(const CaseContext&) {
  CaseResult result;
  double friction = 0, normal = 0;
  const model::AnalysisResult below = run_text(model_text(0.999), [&](const Snapshot& s) {
    friction = normal = 0;
    for (const auto& p : s.system.contact()[0].points) {
      friction += p.weight * p.shear_traction[0];
      normal -= p.weight * p.normal_traction;
    }
  });
  const double angle = std::atan(0.999 * mu), weight = 8;
  result.rows.push_back({"tan = 0.999 mu: converged",
                         below.outcome == solve::Outcome::converged ? 1.0 : 0.0, 1, Relation::equal,
                         0, "statics"});
  result.rows.push_back({"tan = 0.999 mu: friction / (W sin)",
                         std::abs(friction) / (weight * std::sin(angle)), 1, Relation::equal, 1e-8,
                         "statics"});
  result.rows.push_back({"tan = 0.999 mu: normal force / (W cos)",
                         normal / (weight * std::cos(angle)), 1, Relation::equal, 1e-8, "statics"});
  const model::AnalysisResult above = run_text(model_text(1.001), {});
  result.rows.push_back({"tan = 1.001 mu: stopped",
                         above.outcome == solve::Outcome::converged ? 0.0 : 1.0, 1, Relation::equal,
                         0, "statics"});
  double dx = 0, dy = 0;
  const std::size_t at = above.message.find("free to move along (");
  if (at != std::string::npos)
    std::sscanf(above.message.c_str() + at, "free to move along (%lf, %lf)", &dx, &dy);
  const double steeper = std::atan(1.001 * mu);
  result.rows.push_back({"tan = 1.001 mu: free motion named, along the slope",
                         std::abs(dx * std::cos(steeper) + dy * std::sin(steeper)), 1,
                         Relation::equal, 1e-4, "statics"});
  return result;
}

}  // namespace osculate::verification
