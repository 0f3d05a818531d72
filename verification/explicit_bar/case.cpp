#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../body_path.hpp"
#include "../cases.hpp"

namespace osculate::verification {
namespace {

constexpr const char* source = "d'Alembert";
constexpr double length = 10, height = 0.5, modulus = 100, density = 0.01, speed = 0.1;
constexpr int cells = 50;

double wave_speed() { return std::sqrt(modulus / density); }

/// Where a section is at a time of up to 4 L / c.
double displacement(double x, double time) {
  const double c = wave_speed(), turn = 2 * length / c;
  const bool second = time > turn;
  const double t = second ? time - turn : time;
  const double u = -speed * std::min(t, x / c) + speed * std::max(0.0, t - (2 * length - x) / c);
  return second ? -u : u;
}

std::string model_text(double safety, int increments, double duration) {
  return fmt::format(R"(osculate: 1
title: A bar that is stopped at one end
mesh: {{generate: {{bar: {{box: {{x: [0, {}], y: [0, {}], elements: [{}, 1]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: {}, nu: 0, density: {}}}}}}}
sections: [{{on: bar, material: m, element: plane_strain, kinematics: small}}]
initial_velocity: [{{on: bar, vx: {}}}]
steps:
  - name: stop
    increments: {}
    duration: {:.17g}
    dynamics: {{scheme: {{central_differences: {{safety: {}}}}}}}
    prescribe: [{{on: bar.left, ux: 0}}]
)",
                     length, height, cells, modulus, density, -speed, increments, duration, safety);
}

struct Stop {
  bool finished = false;
  double worst = 0;   ///< largest error of a displacement over the largest displacement
  double force = 0;   ///< largest error of the support's force over A rho c v
  double stable = 0;  ///< estimate of the stable step
  int steps = 0;
};

Stop stop(double safety, int increments) {
  const double duration = 4 * length / wave_speed();
  const double step = duration / increments;
  Stop out;
  const auto look = [&](const Snapshot& now) {
    if (!now.record) return;
    const double time = now.state.rates.energies.elapsed;
    for (int n = 0; n < 2 * (cells + 1); ++n) {
      const double x = length * (n % (cells + 1)) / cells;
      out.worst = std::max(out.worst, std::abs(now.state.u[2 * n] - displacement(x, time)));
    }
    double force = 0;
    for (const int n : {0, cells + 1}) force -= now.system.forces().internal[2 * n];
    const double turn = 2 * length / wave_speed();
    const double exact = height * density * wave_speed() * speed * (time < turn ? -1 : 1);
    if (std::abs(time - turn) > 0.5 * step && time < duration - 0.5 * step)
      out.force = std::max(out.force, std::abs(force - exact) / std::abs(exact));
    out.stable = now.record->time_steps.stable;
    out.steps += now.record->time_steps.count;
  };
  const model::AnalysisResult result = run_text(model_text(safety, increments, duration), look);
  out.finished = result.outcome == solve::Outcome::converged;
  out.worst /= speed * length / wave_speed();
  return out;
}

}  // namespace

CaseResult explicit_bar(const CaseContext&) {
  CaseResult out;
  const double critical = length / cells / wave_speed();
  const Stop exact = stop(1, 4 * cells);
  expect(out, "finished", exact.finished, 1, 0, source);
  expect(out, "estimate of the stable step / (L_e / c)", exact.stable / critical, 1, 1e-12,
         "element eigenvalue");
  expect(out, "time steps until 4 L / c", exact.steps, 4.0 * cells, 0, source);
  out.rows.push_back({"critical step: largest error of a displacement / (v L / c)", exact.worst,
                      1e-10, Relation::at_most, 0, source});
  out.rows.push_back({"critical step: largest error of the support's force / (A rho c v)",
                      exact.force, 1e-8, Relation::at_most, 0, source});
  const Stop half = stop(0.5, 4 * cells);
  inform(out, "half the critical step: largest error of a displacement / (v L / c)", half.worst, 0,
         source);
  const Stop beyond = stop(1.011, 1);  // equal steps: 198 of them
  expect(out, "1 % above the critical step: finished", beyond.finished, 0, 0, "instability");
  return out;
}

}  // namespace osculate::verification
