#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../cases.hpp"
#include "../graded.hpp"
#include "../run_model.hpp"

namespace osculate::verification {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double young = 1.0, poisson = 0.3, radius = 2000.0, half_width = 1.0, mu = 0.5;
constexpr double modulus = young / (2 * (1 - poisson * poisson));  ///< E* of two equal bodies
constexpr double far = 50.0;

/// Two equal blocks, the upper one with a crowned bottom, pressed by a force and then sheared.
std::string model_text(int n, const std::string& type, double shear) {
  const double h = half_width / n, zone = 1.5 * half_width, depth = 0.5 * half_width;
  const GradedRow x = graded_row(h, far - zone, 1.2), y = graded_row(h, far - depth, 1.2);
  const double force = pi * half_width * half_width * modulus / (4 * radius);
  const int fine = 2 * (n + n / 2), below = n / 2;
  const std::string columns = fmt::format("x: [-{0}, -{1}, {1}, {0}]", far, zone);
  return fmt::format(R"(osculate: 1
title: Cattaneo and Mindlin
mesh:
  generate:
    low: {{box: {{{}, y: [-{}, -{}, 0], elements: [[{}, {}, {}], [{}, {}]], type: {},
      bias: [[{:.15g}, 1, {:.15g}], [{:.15g}, 1]]}}}}
    up: {{box: {{{}, y: [0, {}, {}], elements: [[{}, {}, {}], [{}, {}]], type: {},
      bias: [[{:.15g}, 1, {:.15g}], [1, {:.15g}]], crown: {{side: bottom, radius: {}, at: 0}}}}}}
materials: {{s: {{linear_elastic: {{E: {}, nu: {}}}}}}}
sections: [{{on: low, material: s, element: plane_strain}}, {{on: up, material: s, element: plane_strain}}]
contact: [{{name: c, master: low.top, slave: up.bottom, normal: {{penalty: {}}},
  friction: {{coulomb: {{mu: {}, penalty: {}}}}}}}]
equal: [{{on: up.top, of: uy}}]
steps:
  - {{name: press, increments: 1, prescribe: [{{on: low.bottom, ux: 0, uy: 0}}, {{on: up.top, ux: 0}}],
     forces: [{{on: up.top_left, fy: {:.15g}}}]}}
  - {{name: shear, increments: 20, prescribe: [{{on: up.top, ux: {:.15g}}}]}}
)",
                     columns, far, depth, x.elements, fine, x.elements, y.elements, below, type,
                     1 / x.bias, x.bias, 1 / y.bias, columns, depth, far, x.elements, fine,
                     x.elements, below, y.elements, type, 1 / x.bias, x.bias, y.bias, radius, young,
                     poisson, 1e3 * young / h, mu, 1e3 * young / h, -force, shear);
}

struct MindlinErrors {
  double shear_l2 = 1, stick = 0, c = 0, load_ratio = 0;
  bool done = false;
  Curve curve;
};

MindlinErrors mindlin_errors(int n, const std::string& type, double shear) {
  MindlinErrors out;
  out.curve = {fmt::format("shear_{}", n), {"x", "shear", "mindlin"}, {}};
  const model::AnalysisResult result = run_text(model_text(n, type, shear), [&](const Snapshot& s) {
    if (!s.record || s.progress.step != 1 || s.progress.fraction < 1) return;
    const auto& points = s.system.contact()[0].points;
    double p_total = 0, q_total = 0;
    for (const auto& p : points) {
      p_total -= p.weight * p.normal_traction;
      q_total += p.weight * p.shear_traction[0];
    }
    const double q_size = std::abs(q_total), sign = q_total > 0 ? 1 : -1;
    const double a = std::sqrt(4 * p_total * radius / (pi * modulus));
    const double p0 = 2 * p_total / (pi * a);
    const double c = a * std::sqrt(1 - q_size / (mu * p_total));
    const auto bump = [](double x, double w) {
      return std::abs(x) < w ? std::sqrt(1 - x * x / (w * w)) : 0.0;
    };
    double difference = 0, norm = 0;
    for (const auto& p : points) {
      const double x = p.foot.x(), exact = mu * p0 * (bump(x, a) - c / a * bump(x, c));
      const double found = sign * p.shear_traction[0];
      difference += p.weight * (found - exact) * (found - exact);
      norm += p.weight * exact * exact;
      if (p.status == contact::Status::stick) out.stick = std::max(out.stick, std::abs(x));
      if (std::abs(x) < 1.5 * a)
        out.curve.rows.push_back({x / a, found / (mu * p0), exact / (mu * p0)});
    }
    out.shear_l2 = std::sqrt(difference / norm);
    out.c = c;
    out.load_ratio = q_size / (mu * p_total);
  });
  out.done = result.outcome == solve::Outcome::converged;
  return out;
}

void add_rows(CaseResult& result, int n, double limit) {
  const std::string source = "Johnson 1985, 7.2(a)";
  const MindlinErrors e = mindlin_errors(n, "quad8", 5.0e-4);
  const std::string head = fmt::format("{} elements over a: ", n);
  result.rows.push_back({head + "finished", e.done ? 1.0 : 0.0, 1, Relation::equal, 0, ""});
  result.rows.push_back({head + "Q / (mu P)", e.load_ratio, 0, Relation::info, 0, ""});
  result.rows.push_back({head + "shear L2 error", e.shear_l2, limit, Relation::at_most, 0, source});
  result.rows.push_back({head + "stick half-width off by (elements)",
                         std::abs(e.stick - e.c) * n / half_width, 1, Relation::at_most, 0,
                         source});
  result.curves.push_back(e.curve);
}

}  // namespace

CaseResult cattaneo_mindlin(const CaseContext&) {
  CaseResult result;
  add_rows(result, 8, 0.05);
  return result;
}

CaseResult cattaneo_mindlin_fine(const CaseContext&) {
  CaseResult result;
  add_rows(result, 64, 0.03);
  return result;
}

}  // namespace osculate::verification
