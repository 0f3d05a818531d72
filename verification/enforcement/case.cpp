#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "../cases.hpp"
#include "../run_model.hpp"

namespace osculate::verification {
namespace {

struct Setting {
  std::string method = "penalty", sampling = "nodes";
  double penalty = 1e4;
  bool friction = false;
  int increments = 1;
};

/// A small block pressed on a wide one, with meshes that do not match; with friction it is then
/// sheared until most of it slides.
std::string model_text(const Setting& s) {
  const std::string friction =
      s.friction ? fmt::format("\n  friction: {{coulomb: {{mu: 0.3, penalty: {}}}}},", s.penalty)
                 : "";
  const std::string shear =
      s.friction ? fmt::format(
                       "\n  - {{name: shear, increments: {}, prescribe: [{{on: up.top, ux: "
                       "0.06}}]}}",
                       2 * s.increments)
                 : "";
  return fmt::format(R"(osculate: 1
title: Block on block
mesh:
  generate:
    low: {{box: {{x: [0, 4], y: [0, 1], elements: [12, 3]}}}}
    up: {{box: {{x: [1.03, 3.04], y: [1, 2], elements: [5, 3]}}}}
materials: {{s: {{linear_elastic: {{E: 100, nu: 0.3}}}}}}
sections: [{{on: low, material: s, element: plane_strain}}, {{on: up, material: s, element: plane_strain}}]
contact: [{{name: c, master: low.top, slave: up.bottom, sampling: {}, enforcement: {},{}
  normal: {{penalty: {}}}}}]
steps:
  - {{name: press, increments: {}, prescribe: [{{on: low.bottom, uy: 0, ux: 0}}, {{on: up.top, uy: -0.1, ux: 0}}]}}{}
solver: {{tolerance: {{residual: 1.0e-11}}}}
)",
                     s.sampling, s.method, friction, s.penalty, s.increments, shear);
}

/// What the last increment left.
struct Answer {
  bool done = false;
  double penetration = 0,
         slip = 0;  ///< largest |gap| in contact and elastic slip of sticking points
  std::vector<double> pressure, shear;
  int stick = 0, iterations = 0, cutbacks = 0;
};

Answer solve(const Setting& s) {
  Answer a;
  const model::AnalysisResult result = run_text(model_text(s), [&](const Snapshot& snapshot) {
    a.penetration = a.slip = a.stick = 0;
    a.pressure.clear();
    a.shear.clear();
    for (const auto& point : snapshot.system.contact()[0].points) {
      a.pressure.push_back(-point.normal_traction);
      a.shear.push_back(point.shear()[0]);
      if (point.status == contact::Status::open) continue;
      a.penetration = std::max(a.penetration, std::abs(point.gap));
      if (point.status != contact::Status::stick) continue;
      ++a.stick;
      if (s.friction) a.slip = std::max(a.slip, point.slip_increment.norm());
    }
  });
  a.done = result.outcome == solve::Outcome::converged;
  a.iterations = total_iterations(result);
  for (const model::StepRecord& step : result.steps)
    for (const solve::IncrementRecord& record : step.increments) a.cutbacks += record.cutbacks;
  return a;
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return 1;
  double worst = 0, largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    worst = std::max(worst, std::abs(a[i] - b[i]));
    largest = std::max(largest, std::abs(b[i]));
  }
  return worst / largest;
}

constexpr double facet = 0.402;  // length of a slave facet
constexpr const char* multiplier = "lagrange_multiplier";

void add(CaseResult& r, std::string what, double computed, double limit, Relation relation,
         std::string source) {
  r.rows.push_back({std::move(what), computed, limit, relation, 0, std::move(source)});
}

/// Unknown tractions: nothing is left of the gap, and the pressures are those of stiffer and
/// stiffer penalties, extrapolated from two of them (the error of a penalty is of first order in
/// 1 / penalty).
void add_multipliers(CaseResult& r, const std::string& sampling, bool friction) {
  const std::string name = sampling + (friction ? ", friction" : "");
  const Answer exact = solve({multiplier, sampling, 1e3, friction});
  add(r, name + ", multipliers: largest |gap| over the facet's length",
      exact.done ? exact.penetration / facet : 1, 1e-10, Relation::at_most, "gap = 0");
  if (friction) {
    add(r, name + ", multipliers: elastic slip over the facet's length",
        exact.done ? exact.slip / facet : 1, 1e-10, Relation::at_most, "slip = 0 while sticking");
    add(r, name + ", multipliers: points that stick at the end", exact.stick, 0, Relation::info,
        "some stick, some slide");
  }
  std::array<Answer, 2> by_penalty;
  for (int i = 0; i < 2; ++i)
    by_penalty[static_cast<std::size_t>(i)] =
        solve({"penalty", sampling, i == 0 ? 1e5 : 2e5, friction, friction ? 8 : 1});
  std::vector<double> limit = by_penalty[1].pressure;
  for (std::size_t i = 0; i < limit.size(); ++i)
    limit[i] += by_penalty[1].pressure[i] - by_penalty[0].pressure[i];
  add(r, name + ": pressures of multipliers and of the limit of the penalty differ by",
      by_penalty[0].done && by_penalty[1].done ? difference(exact.pressure, limit) : 1,
      friction ? 0 : 1e-5, friction ? Relation::info : Relation::at_most,
      "Richardson extrapolation of two penalties");
  add(r, name + ": iterations of multipliers", exact.iterations, 0, Relation::info, "");
  add(r, name + ": iterations of the penalty 2e5", by_penalty[1].iterations, 0, Relation::info, "");
}

/// The target is met whatever the penalty, within six decades around the bodies' own stiffness
/// (E / height = 100).
void add_augmentation(CaseResult& r, const std::string& sampling, const std::string& loop,
                      bool friction) {
  constexpr double target = 1e-5;
  const std::string method =
      fmt::format("{{augmented_lagrange: {{target: {}, loop: {}}}}}", target, loop);
  const Answer exact = solve({multiplier, "mortar", 1e3, friction});
  double worst = 0, pressures = 0;
  int iterations = 0;
  std::string each;
  for (const double penalty : {1e-1, 1e0, 1e1, 1e2, 1e3, 1e4, 1e5}) {
    const Answer a = solve({method, sampling, penalty, friction});
    worst = std::max(worst, a.done ? a.penetration / target : 1e30);
    if (sampling == "mortar")
      pressures = std::max(pressures, difference(a.pressure, exact.pressure));
    iterations = std::max(iterations, a.iterations);
    each += fmt::format(" {:g}: {}", penalty, a.iterations);
  }
  const std::string name =
      fmt::format("{}{}, augmented Lagrangian ({})", sampling, friction ? ", friction" : "", loop);
  add(r, name + ": largest penetration over the target, penalties 0.1 to 1e5", worst, 1,
      Relation::at_most, "the target");
  if (sampling == "mortar")
    add(r, name + ": pressures differ from the multipliers' by", pressures, 0, Relation::info, "");
  add(r, name + ": most iterations (" + each.substr(1) + ")", iterations, 0, Relation::info, "");
}

}  // namespace

CaseResult enforcement(const CaseContext&) {
  CaseResult r;
  for (const std::string sampling : {"nodes", "mortar"})
    for (const bool friction : {false, true}) add_multipliers(r, sampling, friction);
  for (const std::string sampling : {"nodes", "{gauss: 2}", "mortar"})
    for (const bool friction : {false, true}) add_augmentation(r, sampling, "uzawa", friction);
  add_augmentation(r, "mortar", "single", true);
  return r;
}

}  // namespace osculate::verification
