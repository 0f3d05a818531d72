#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "../cases.hpp"
#include "../run_model.hpp"

namespace osculate::verification {
namespace {

constexpr double length = 2;  ///< of the block, which is 1 high and 1 thick

/// What the points of a contact carry together.
struct Sum {
  double normal = 0, shear = 0, slid = 0, area = 0;
  double apart = 0;  ///< largest of |distance slid - way along the floor| of sliding points
  std::vector<std::array<double, 2>> sliding;  ///< T / N and distance slid, point by point
};

Sum sum_of(const Snapshot& now) {
  Sum sum;
  for (const pairing::PointResult<2>& p : now.system.contact()[0].points) {
    sum.normal -= p.weight * p.normal_traction;
    sum.shear += p.weight * std::abs(p.shear_traction[0]);
    sum.area += p.weight;
    sum.slid += p.weight * p.history.slid;
    if (p.status != contact::Status::slip) continue;
    sum.apart = std::max(sum.apart, std::abs(p.history.slid - std::abs(p.history.slip[0])));
    sum.sliding.push_back({std::abs(p.shear_traction[0] / p.normal_traction), p.history.slid});
  }
  sum.slid /= sum.area;
  return sum;
}

/// All converged increments of a model; none where it did not come to its end.
std::vector<Sum> history_of(const std::string& text) {
  std::vector<Sum> all;
  const model::AnalysisResult result = run_text(text, [&](const Snapshot& now) {
    if (now.record) all.push_back(sum_of(now));
  });
  if (result.outcome != solve::Outcome::converged) all.clear();
  return all;
}

void add(CaseResult& out, std::string what, double computed, double reference, double tolerance,
         const char* source) {
  out.rows.push_back({std::move(what), computed, reference, Relation::equal, tolerance, source});
}

/// The block of dragged.yaml, pressed by `press`, then moved along by `way`.
std::string dragged(double young, const std::string& friction, double press, double way,
                    int increments, const std::string& enforcement = "penalty") {
  return fmt::format(R"(osculate: 1
title: Block on a rigid line
mesh: {{generate: {{block: {{box: {{x: [0, {}], y: [0, 1], elements: [4, 2]}}}}}}}}
materials: {{s: {{linear_elastic: {{E: {}, nu: 0}}}}}}
sections: [{{on: block, material: s, element: plane_strain}}]
rigid: {{floor: {{line: {{point: [0, 0], normal: [0, 1]}}}}}}
contact: [{{name: c, master: floor, slave: block.bottom, normal: {{penalty: 1.0e4}},
  friction: {}, enforcement: {}}}]
steps:
  - {{name: press, increments: 1, prescribe: [{{on: block.top, uy: {}, ux: 0}}]}}
  - {{name: drag, increments: {}, prescribe: [{{on: block.top, uy: {}, ux: {}}}]}}
{}
)",
                     length, young, friction, enforcement, -press, increments, -press, way,
                     young > 1e6 ? "" : "solver: {tolerance: {residual: 1.0e-13}}");
}

void add_rough(CaseResult& out) {
  const std::vector<Sum> all =
      history_of(dragged(1000, "{rough: {penalty: 1.0e3}}", 0.01, 0.005, 10));
  add(out, "rough: distance slid", all.empty() ? 1 : all.back().slid, 0, 1e-15, "definition");
}

constexpr double mu_s = 0.5, mu_k = 0.2, scale = 0.02, eps_t = 1000, stiff = 1e7;

double coefficient(double a) { return mu_k + (mu_s - mu_k) * std::exp(-a / scale); }

/// mu(s) of a spring eps_T that is pulled by `way` under the pressure p: way = mu(s) p / eps_T + s.
double coefficient_at(double way, double p) {
  double low = 0, high = way;
  for (int i = 0; i < 200; ++i) {
    const double s = 0.5 * (low + high);
    (coefficient(s) * p / eps_t + s < way ? low : high) = s;
  }
  return coefficient(low);
}

/// A block stiff against its contact: all of it slides at once.
void add_static_and_kinetic(CaseResult& out) {
  constexpr double press = 1e-3, way = 0.2;
  const std::string law =
      fmt::format("{{coulomb: {{mu: {}, kinetic: {}, decay: {{distance: {}}}, penalty: {}}}}}",
                  mu_s, mu_k, scale, eps_t);
  const std::vector<Sum> all = history_of(dragged(stiff, law, press, way, 400));
  double peak = 0, worst = 0, analytic = 0;
  for (std::size_t i = 1; i < all.size(); ++i) {
    const double ratio = all[i].shear / all[i].normal, p = all[i].normal / length;
    peak = std::max(peak, ratio);
    if (!(all[i].slid > 0)) continue;
    for (const auto& [mu, slid] : all[i].sliding)
      worst = std::max(worst, std::abs(mu - coefficient(slid)));
    const double moved = way * static_cast<double>(i) / 400;
    analytic = std::max(analytic, std::abs(ratio - coefficient_at(moved, p)));
  }
  const double last = all.empty() ? 0 : all.back().shear / all.back().normal;
  add(out, "static to kinetic: peak of T / N over mu_s", peak / mu_s, 1, 0.01, "definition");
  add(out, "static to kinetic: T / N at the end over mu_k", last / mu_k, 1, 1e-3, "definition");
  add(out, "static to kinetic: largest error of T / N = mu(distance slid)", worst, 0, 1e-12,
      "definition");
  add(out, "static to kinetic: largest error along the way", analytic, 0, 1e-4,
      "u = mu(s) p / eps_T + s");
}

/// The same where the tractions are unknowns or corrected: no elastic slip is left, and what the
/// penalty is makes no difference.
void add_enforced(CaseResult& out) {
  struct Method {
    const char *name, *key;
    double elastic;  ///< slip that an increment may leave
  };
  constexpr double young = 1000, press = 0.002, way = 0.2, target = 1e-7;
  for (const Method& m : {Method{"multipliers", "lagrange_multiplier", 1e-12},
                          Method{"augmented", "{augmented_lagrange: {target: 1.0e-7}}", target}})
    for (const double penalty : {10.0, 1e4}) {
      const std::string what = fmt::format("{}, penalty {:g}: ", m.name, penalty);
      const std::string law =
          fmt::format("{{coulomb: {{mu: {}, kinetic: {}, decay: {{distance: {}}}, penalty: {}}}}}",
                      mu_s, mu_k, scale, penalty);
      const std::vector<Sum> all = history_of(dragged(young, law, press, way, 20, m.key));
      double worst = all.empty() ? 1 : 0, apart = worst;
      for (const Sum& now : all) {
        apart = std::max(apart, now.apart);
        for (const auto& [mu, slid] : now.sliding)
          worst = std::max(worst, std::abs(mu - coefficient(slid)));
      }
      add(out, what + "largest error of T / N = mu(distance slid)", worst, 0, 1e-12, "definition");
      add(out, what + "distance slid - way along the floor", apart, 0, 20 * m.elastic,
          "no elastic slip");
    }
}

}  // namespace

/// The rows that need the points' own distances; case.yaml has the others.
CaseResult contact_laws(const CaseContext&) {
  CaseResult out;
  add_rough(out);
  add_static_and_kinetic(out);
  add_enforced(out);
  return out;
}

}  // namespace osculate::verification
