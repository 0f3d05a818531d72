#include <fmt/format.h>

#include <cmath>

#include "../cases.hpp"
#include "../run_model.hpp"
#include "osculate/model/fields.hpp"

namespace osculate::verification {
namespace {

struct Patch {
  std::string type = "quad4", element = "plane_strain", weight = "reference_area";
  int lower = 6, upper = 6;
  bool upper_is_slave = true;
  bool confined = false;  ///< sides held, so that no node leaves the other block's end
};

/// Two blocks on top of each other under uniform pressure, free to expand sideways.
std::string model_text(const Patch& p) {
  return fmt::format(R"(osculate: 1
title: Contact patch test
mesh:
  generate:
    low: {{box: {{x: [0, 3], y: [0, 1], elements: [{}, 2], type: {}}}}}
    up: {{box: {{x: [0, 3], y: [1, 2], elements: [{}, 2], type: {}}}}}
materials: {{s: {{linear_elastic: {{E: 100, nu: 0.3}}}}}}
sections: [{{on: low, material: s, element: {}}}, {{on: up, material: s, element: {}}}]
contact: [{{name: c, master: {}, slave: {}, weight: {}, normal: {{penalty: 1.0e4}}}}]
steps: [{{name: press, increments: 1, pressure: [{{on: up.top, value: 1}}],
  prescribe: [{{on: low.bottom, uy: 0}}, {{on: low.left, ux: 0}}, {{on: up.left, ux: 0}}{}]}}]
solver: {{tolerance: {{residual: 1.0e-12}}}}
)",
                     p.lower, p.type, p.upper, p.type, p.element, p.element,
                     p.upper_is_slave ? "low.top" : "up.bottom",
                     p.upper_is_slave ? "up.bottom" : "low.top", p.weight,
                     p.confined ? ", {on: low.right, ux: 0}, {on: up.right, ux: 0}" : "");
}

/// Largest deviation of any nodal stress from (0, -1, 0) and of the contact pressure from 1.
double patch_error(const Patch& p) {
  double error = 1;
  const auto look = [&](const Snapshot& s) {
    if (!s.record) return;
    error = 0;
    for (const auto& point : s.system.contact()[0].points)
      error = std::max(error, std::abs(-point.normal_traction - 1));
  };
  deck::Built built = [&] {
    const deck::Description d = deck::parse_model(model_text(p), "patch.yaml");
    return deck::build(d, deck::load_mesh(d));
  }();
  model::AnalysisObserver observer;
  observer.converged = [&](model::System& system, const model::State& state,
                           const model::Progress& progress, const solve::IncrementRecord* record) {
    look({system, state, progress, record});
    if (!record) return true;
    const model::NodalFields f = model::nodal_fields(system, built.model, state);
    for (const auto& stress : f.stress) {
      error = std::max({error, std::abs(stress[1] + 1), std::abs(stress[3])});
      if (p.element != "axisymmetric" && !p.confined) error = std::max(error, std::abs(stress[0]));
    }
    return true;
  };
  const model::AnalysisResult result = model::run(built.model, built.options, observer);
  return result.outcome == solve::Outcome::converged ? error : 1.0;
}

}  // namespace

CaseResult contact_patch(const CaseContext&) {
  CaseResult result;
  for (const std::string type : {"quad4", "quad8", "quad9", "tri3", "tri6"})
    for (const bool upper : {true, false})
      result.rows.push_back(
          {fmt::format("{}, matching, {} slave: stress error", type, upper ? "upper" : "lower"),
           patch_error({.type = type, .upper_is_slave = upper}), 1e-10, Relation::at_most, 0,
           "uniform stress"});
  for (const std::string element : {"plane_stress", "axisymmetric"})
    result.rows.push_back({fmt::format("quad4, matching, {}: stress error", element),
                           patch_error({.element = element}), 1e-10, Relation::at_most, 0,
                           "uniform stress"});
  for (const std::string type : {"quad4", "quad8"})
    for (const bool upper : {true, false})
      result.rows.push_back(
          {fmt::format("{}, 5 against 7 elements, {} slave: stress error", type,
                       upper ? "upper" : "lower"),
           patch_error(
               {.type = type, .lower = 5, .upper = 7, .upper_is_slave = upper, .confined = true}),
           0, Relation::info, 0, "uniform stress"});
  return result;
}

}  // namespace osculate::verification
