#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "../cases.hpp"
#include "../graded.hpp"
#include "../run_model.hpp"

namespace osculate::verification {
namespace {

constexpr double young = 1.0, poisson = 0.3, radius = 2000.0, contact_radius = 1.0;
constexpr double modulus = young / (1 - poisson * poisson);
constexpr double far = 400.0;  ///< size of the block in contact radii

std::string model_text(int n) {
  const double h = contact_radius / n;
  const GradedRow r = graded_row(h, far - 1.5 * contact_radius, 1.15);
  const GradedRow y = graded_row(h, far - 0.5 * contact_radius, 1.15);
  const double approach = contact_radius * contact_radius / radius;
  return fmt::format(R"(osculate: 1
title: Hertz sphere
mesh: {{generate: {{body: {{box: {{x: [0, {}, {}], y: [-{}, {}, 0], elements: [[{}, {}], [{}, {}]],
  bias: [[1, {:.15g}], [{:.15g}, 1]], type: quad4}}}}}}}}
materials: {{s: {{linear_elastic: {{E: {}, nu: {}}}}}}}
sections: [{{on: body, material: s, element: axisymmetric}}]
rigid: {{ball: {{circle: {{center: [0, {}], radius: {}}}}}}}
contact: [{{name: c, master: ball, slave: body.top, normal: {{penalty: {}}}}}]
steps: [{{name: press, increments: 1, prescribe: [{{on: ball, uy: {:.15g}}}, {{on: body.left, ux: 0}},
  {{on: body.bottom, uy: 0}}]}}]
)",
                     1.5 * contact_radius, far, far, -0.5 * contact_radius, n + n / 2, r.elements,
                     y.elements, n / 2, r.bias, 1 / y.bias, young, poisson, radius, radius,
                     1e4 * young / h, -approach);
}

}  // namespace

CaseResult hertz_sphere(const CaseContext&) {
  CaseResult result;
  const std::string source = "Johnson 1985, 4.2(a)";
  run_text(model_text(16), [&](const Snapshot& s) {
    if (!s.record) return;
    const auto& points = s.system.contact()[0].points;
    double force = 0, peak = 0;
    for (const auto& p : points) {
      force -= p.weight * p.normal_traction;
      peak = std::max(peak, -p.normal_traction);
    }
    const double approach = -s.state.rigid[0].translation.y();
    const double a = std::cbrt(3 * force * radius / (4 * modulus));
    double closed = 0;  // outermost slave node in contact
    for (const auto& p : points)
      if (p.normal_traction < 0) closed = std::max(closed, p.foot.x());
    result.rows.push_back(
        {"force / (4/3 E* sqrt(R) d^1.5)",
         force / (4.0 / 3.0 * modulus * std::sqrt(radius) * std::pow(approach, 1.5)), 1,
         Relation::equal, 0.01, source});
    result.rows.push_back({"peak pressure / (3F / 2 pi a^2)",
                           peak / (3 * force / (2 * std::numbers::pi * a * a)), 1, Relation::equal,
                           0.01, source});
    result.rows.push_back(
        {"outermost node in contact / a", closed / a, 1, Relation::equal, 0.0625, source});
  });
  return result;
}

}  // namespace osculate::verification
