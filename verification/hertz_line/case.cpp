#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "../cases.hpp"
#include "../graded.hpp"
#include "../run_model.hpp"

namespace osculate::verification {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double young = 1.0, poisson = 0.3, radius = 2000.0, half_width = 1.0;
constexpr double plane_modulus = young / (1 - poisson * poisson);
constexpr double far = 100.0;  ///< distance of the block's far sides, in half-widths

/// Half model: a rigid circle is pressed by a force on a block of 100 half-widths.
std::string model_text(int elements_per_half_width, const std::string& type) {
  const int fine = elements_per_half_width;
  const double h = half_width / fine;
  const GradedRow x = graded_row(h, far - 1.5 * half_width, 1.15);
  const GradedRow y = graded_row(h, far - 0.5 * half_width, 1.15);
  const double force = pi * half_width * half_width * plane_modulus / (4 * radius);
  return fmt::format(R"(osculate: 1
title: Hertz line contact
mesh: {{generate: {{body: {{box: {{x: [0, {}, {}], y: [-{}, {}, 0], elements: [[{}, {}], [{}, {}]],
  bias: [[1, {:.15g}], [{:.15g}, 1]], type: {}}}}}}}}}
materials: {{s: {{linear_elastic: {{E: {}, nu: {}}}}}}}
sections: [{{on: body, material: s, element: plane_strain}}]
rigid: {{punch: {{circle: {{center: [0, {}], radius: {}}}}}}}
contact: [{{name: c, master: punch, slave: body.top, normal: {{penalty: {}}}}}]
steps: [{{name: press, increments: 1, forces: [{{on: punch, fy: {:.15g}}}],
  prescribe: [{{on: body.left, ux: 0}}, {{on: body.bottom, uy: 0}}]}}]
)",
                     1.5 * half_width, far, far, -0.5 * half_width, fine + fine / 2, x.elements,
                     y.elements, fine / 2, x.bias, 1 / y.bias, type, young, poisson, radius, radius,
                     1e4 * young / h, -force / 2);
}

/// Errors of one mesh against the profile that belongs to the computed force.
struct HertzErrors {
  double pressure_l2 = 0, peak = 0, half_width = 0;
  Curve curve;
};

HertzErrors hertz_errors(int n, const std::string& type) {
  HertzErrors out;
  out.curve = {fmt::format("pressure_{}_{}", type, n), {"x", "pressure", "hertz"}, {}};
  run_text(model_text(n, type), [&](const Snapshot& s) {
    if (!s.record) return;
    const auto& points = s.system.contact()[0].points;
    const std::vector<Vec2> x = s.system.positions(s.state);
    double force = 0;
    for (const auto& p : points) force -= p.weight * p.normal_traction;
    force *= 2;  // the other half
    const double a = std::sqrt(4 * force * radius / (pi * plane_modulus));
    const double p0 = 2 * force / (pi * a);
    double difference = 0, norm = 0, peak = 0, edge_x = 0, edge_p = 0;
    for (const auto& p : points) {
      const double at = p.foot.x(), pressure = -p.normal_traction;
      const double exact = at < a ? p0 * std::sqrt(1 - at * at / (a * a)) : 0.0;
      difference += p.weight * (pressure - exact) * (pressure - exact);
      norm += p.weight * exact * exact;
      peak = std::max(peak, pressure);
      // p^2 is a straight line in x^2: through the nodes at 0.5 a and at the peak it meets zero at
      // a
      if (at > 0.4 * a && at < 0.8 * a && at > edge_x) {
        edge_x = at;
        edge_p = pressure;
      }
      if (at < 2 * a) out.curve.rows.push_back({at / a, pressure / p0, exact / p0});
    }
    const double found = edge_x / std::sqrt(1 - edge_p * edge_p / (peak * peak));
    out.pressure_l2 = std::sqrt(difference / norm);
    out.peak = peak / p0;
    out.half_width = found / a;
  });
  return out;
}

}  // namespace

CaseResult hertz_line(const CaseContext&) {
  CaseResult result;
  const std::string source = "Johnson 1985, 4.2(c)";
  for (const std::string type : {"quad8", "quad4"}) {
    const bool judged = type == "quad8";
    std::vector<double> errors;
    for (const int n : {4, 8, 16}) {
      const HertzErrors e = hertz_errors(n, type);
      errors.push_back(e.pressure_l2);
      const bool last = judged && n == 16;
      result.rows.push_back(
          {fmt::format("{}, {} elements per half-width: pressure L2 error", type, n), e.pressure_l2,
           last ? 0.004 : 0.0, last ? Relation::at_most : Relation::info, 0, source});
      if (n != 16) continue;
      result.rows.push_back(
          {type + ": peak pressure / (2F / pi a)", e.peak, 1, Relation::equal, 0.005, source});
      result.rows.push_back({type + ": half-width / sqrt(4FR / pi E*)", e.half_width, 1,
                             Relation::equal, 0.01, source});
      result.curves.push_back(e.curve);
    }
    result.rows.push_back({type + ": convergence rate from 4 to 16 elements",
                           0.5 * std::log2(errors[0] / errors[2]), 0, Relation::info, 0, ""});
  }
  return result;
}

}  // namespace osculate::verification
