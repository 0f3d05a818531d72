#include <fmt/format.h>

#include <array>
#include <cmath>

#include "../cases.hpp"
#include "../run_model.hpp"
#include "osculate/model/fields.hpp"

namespace osculate::verification {
namespace {

struct Patch {
  std::string type = "quad4", upper_type = "", element = "plane_strain", weight = "reference_area";
  std::string sampling = "nodes";
  bool two_pass = false;
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
contact: [{{name: c, master: {}, slave: {}, weight: {}, sampling: {}, two_pass: {},
  normal: {{penalty: 1.0e4}}}}]
steps: [{{name: press, increments: 1, pressure: [{{on: up.top, value: 1}}],
  prescribe: [{{on: low.bottom, uy: 0}}, {{on: low.left, ux: 0}}, {{on: up.left, ux: 0}}{}]}}]
solver: {{tolerance: {{residual: 1.0e-12}}}}
)",
                     p.lower, p.type, p.upper, p.upper_type.empty() ? p.type : p.upper_type,
                     p.element, p.element, p.upper_is_slave ? "low.top" : "up.bottom",
                     p.upper_is_slave ? "up.bottom" : "low.top", p.weight, p.sampling, p.two_pass,
                     p.confined ? ", {on: low.right, ux: 0}, {on: up.right, ux: 0}" : "");
}

/// Largest deviation of any nodal stress from (0, -1, 0) and of the contact pressure from 1.
double patch_error(const Patch& p) {
  double error = 1;
  const auto look = [&](const Snapshot& s) {
    if (!s.record) return;
    error = 0;
    if (p.two_pass) return;  // the passes share the pressure; together they show in the stresses
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

/// The rule integrates the slave's shape functions exactly: its forces are those of a uniform
/// pressure.
bool exact_forces(const std::string& type, const std::string& sampling) {
  return type == "quad4" || !sampling.starts_with("{lobatto: 2");
}

/// Meshes of 5 and 7 elements, every sampling, both roles.
void add_table(CaseResult& result) {
  struct Kind {
    const char* sampling;
    bool two_pass;
    Relation relation;
    double limit;
  };
  constexpr std::array<Kind, 7> kinds{{{"nodes", false, Relation::info, 0},
                                       {"nodes", true, Relation::info, 0},
                                       {"{gauss: 2}", false, Relation::info, 0},
                                       {"{gauss: 2}", true, Relation::info, 0},
                                       {"{gauss: 5}", false, Relation::info, 0},
                                       {"{lobatto: 5, subdomains: 2}", false, Relation::info, 0},
                                       {"mortar", false, Relation::at_most, 1e-10}}};
  using Types = std::pair<std::string, std::string>;
  for (const Types& types : {Types{"quad4", ""},
                             {"quad8", ""},
                             {"quad9", ""},
                             {"tri3", ""},
                             {"tri6", ""},
                             {"quad4", "quad8"},
                             {"quad8", "tri3"}})
    for (const Kind& kind : kinds)
      for (const bool upper : {true, false}) {
        if (kind.two_pass && !upper) continue;
        const std::string name =
            types.second.empty() ? types.first : types.first + " under " + types.second;
        const std::string role = kind.two_pass ? "two passes"
                                 : upper       ? "upper slave"
                                               : "lower slave";
        result.rows.push_back(
            {fmt::format("{}, 5 against 7, {}, {}: stress error", name, kind.sampling, role),
             patch_error({.type = types.first,
                          .upper_type = types.second,
                          .sampling = kind.sampling,
                          .two_pass = kind.two_pass,
                          .lower = 5,
                          .upper = 7,
                          .upper_is_slave = upper,
                          .confined = true}),
             kind.limit, kind.relation, 0, "uniform stress"});
      }
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
    for (const std::string sampling : {"{gauss: 2}", "{lobatto: 3}", "{lobatto: 2, subdomains: 2}"})
      result.rows.push_back({fmt::format("{}, matching, {}: stress error", type, sampling),
                             patch_error({.type = type, .sampling = sampling}), 1e-10,
                             exact_forces(type, sampling) ? Relation::at_most : Relation::info, 0,
                             "uniform stress"});
  add_table(result);
  return result;
}

}  // namespace osculate::verification
