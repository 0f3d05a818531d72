#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../body_path.hpp"
#include "../cases.hpp"
#include "osculate/contact/law/damping.hpp"
#include "reference.hpp"

namespace osculate::verification {
namespace {

constexpr const char* newton = "Newton's hypothesis; Walton and Braun (1986)";
constexpr const char* dashpot = "Schwager and Poeschel (2007)";
constexpr const char* momentum = "conservation of momentum";
constexpr const char* ledger = "identity";
constexpr double mass = 2, stiffness = 5e4;

/// The residual alone judges the increments: in flight the first energy of one is round-off.
constexpr const char* tail = "solver: {tolerance: {energy: 0.9}}\n";

/// A rigid disc over a fixed row of nodes: it touches the one below its centre only.
struct Drop {
  std::string damping;
  std::string impact = "average";
  double speed = 1, gap = 0, gravity = 0;
  int increments = 100;
  double duration = 1;
  double spring = stiffness;
};

std::vector<PathPoint> path_of(const Drop& d) {
  return body_path(fmt::format(R"(osculate: 1
mesh: {{generate: {{ground: {{box: {{x: [-1, 1], y: [-1, 0], elements: [2, 1]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 1, nu: 0, density: 1}}}}}}
sections: [{{on: ground, material: m, element: plane_strain}}]
rigid: {{ball: {{circle: {{center: [0, {:.17g}], radius: 1}}, mass: {}}}}}
contact: [{{name: c, master: ball, slave: ground.top, weight: node,
  normal: {{penalty: {}, damping: {{{}}}}}}}]
initial_velocity: [{{on: ball, vy: {:.17g}}}]
steps: [{{name: fall, increments: {}, duration: {:.17g}, gravity: [0, {}],
  dynamics: {{impact: {}}}, prescribe: [{{on: ground, ux: 0, uy: 0}}]}}]
{})",
                               1 + d.gap, mass, d.spring, d.damping, -d.speed, d.increments,
                               d.duration, -d.gravity, d.impact, tail));
}

/// One impact with so many increments in pi sqrt(m / k); the contact begins within an increment at
/// the place `phase` of it.
struct Impact {
  bool finished = false;
  double ratio = 0;   ///< speed after over that before
  double ledger = 0;  ///< what the energies leave, over the energy at the start
  double damped = 0;  ///< energy dissipated by the law, over the energy at the start
};

Impact impact_of(Drop d, int increments, double phase, double lasts = 1.2) {
  const double whole = std::numbers::pi * std::sqrt(mass / d.spring), h = whole / increments;
  d.gap = (2 + phase) * h * d.speed;
  d.increments = static_cast<int>(std::ceil(lasts * increments)) + 6;
  d.duration = d.increments * h;
  Impact out;
  for (const PathPoint& p : path_of(d)) {
    const model::Energies& e = p.energies;
    out.finished = true;
    out.ratio = p.velocity.y() / d.speed;
    out.damped = e.damping / e.start;
    out.ledger = (e.kinetic + e.strain + e.contact - e.start - e.external + e.friction + e.damping +
                  e.numerical) /
                 e.start;
  }
  return out;
}

/// Root mean square of the error of the rebound over places of the touch within an increment.
double error_of(const Drop& d, int increments, double exact, double lasts = 1.2) {
  constexpr int phases = 8;
  double sum = 0;
  for (int i = 0; i < phases; ++i) {
    const double error = impact_of(d, increments, (i + 0.5) / phases, lasts).ratio - exact;
    sum += error * error / phases;
  }
  return std::sqrt(sum);
}

std::string with_restitution(double e) { return fmt::format("restitution: {}", e); }

void add_restitution(CaseResult& out) {
  for (const double e : {0.3, 0.5, 0.8, 1.0}) {
    const Drop d{with_restitution(e)};
    const std::string name = fmt::format("e = {}, average: ", e);
    const double coarse = error_of(d, 20, e), middle = error_of(d, 40, e),
                 fine = error_of(d, 80, e);
    expect(out, name + "error of speed after / before, 80 increments in pi sqrt(m/k)", fine, 0,
           2e-3, newton);
    inform(out, name + "error with 40 increments", middle, 0, newton);
    if (e < 1) {
      expect(out, name + "order of the error in the increment, 20 to 80",
             0.5 * std::log2(coarse / fine), 2, 0.35, "second order");
    }
    const Impact one = impact_of(d, 80, 0.3);
    expect(out, name + "dissipated by the law / (1 - e^2) of the energy", one.damped + e * e, 1,
           3e-3, newton);
    expect(out, name + "what the ledger leaves", one.ledger, 0, 1e-12, ledger);
  }
  const Drop implicit{with_restitution(0.5), "dissipative"};
  const double coarse = error_of(implicit, 40, 0.5), fine = error_of(implicit, 160, 0.5);
  inform(out, "e = 0.5, dissipative: error with 40 increments", coarse, 0, newton);
  expect(out, "e = 0.5, dissipative: order of the error, 40 to 160", 0.5 * std::log2(coarse / fine),
         1, 0.2, "first order");
}

void add_plastic(CaseResult& out) {
  const double least = contact::Restitution::least;
  const Impact fine = impact_of({with_restitution(0)}, 640, 0.3, 0.6);
  expect(out, "e = 0 (taken as 0.02), average: speed after / before, 640 increments", fine.ratio,
         least, 0.1, newton);
  for (const int increments : {20, 40, 160}) {
    const Impact plastic = impact_of({with_restitution(0), "dissipative"}, increments, 0.3, 0.6);
    out.rows.push_back(
        {fmt::format("e = 0, dissipative, {} increments: |speed| after / before", increments),
         std::abs(plastic.ratio), least, Relation::at_most, 0, newton});
  }
}

void add_speeds(CaseResult& out) {
  double low = 2, high = 0;
  for (const double speed : {1e-2, 1.0, 100.0}) {
    Drop d{with_restitution(0.5)};
    d.speed = speed;
    const double ratio = impact_of(d, 40, 0.3).ratio;
    low = std::min(low, ratio);
    high = std::max(high, ratio);
  }
  expect(out, "e = 0.5: speeds from 0.01 to 100, largest difference of the ratio", high - low, 0,
         1e-6, newton);
}

/// Heights of successive bounces under gravity, against the closed form on the spring.
void add_bounces(CaseResult& out) {
  const double e = 0.8, gravity = 9.81, first = 0.05;
  const PlasticSpring spring{mass, stiffness, e};
  Drop d{with_restitution(e), "average", 0, first, gravity};
  const double h = contact_duration(spring) / 40;
  constexpr int bounces = 4;
  double duration = std::sqrt(2 * first / gravity), height = first;
  std::vector<double> exact, tops;
  for (int n = 0; n < bounces; ++n) {
    height = next_height(spring, gravity, height);
    exact.push_back(height);
    duration += contact_duration(spring) + 2.05 * std::sqrt(2 * height / gravity);
  }
  d.increments = static_cast<int>(std::ceil(duration / h));
  d.duration = d.increments * h;
  double before = -1, last = -1;
  for (const PathPoint& p : path_of(d)) {
    const double now = first + p.translation.y();
    if (before > 0 && last > before && last >= now && last > 0) tops.push_back(last);
    before = last;
    last = now;
  }
  expect(out, "e = 0.8: tops seen after 4 bounces", static_cast<double>(tops.size()), bounces, 0,
         newton);
  for (std::size_t n = 0; n < std::min<std::size_t>(tops.size(), bounces); ++n) {
    const std::string name = fmt::format("e = 0.8: top {} / first height", n + 1);
    expect(out, name, tops[n] / first, exact[n] / first, 0.01, newton);
    inform(out, name + " against a rigid floor", tops[n] / first,
           std::pow(e, 2 * (static_cast<double>(n) + 1)), "e^(2 n)");
  }
}

void add_viscous(CaseResult& out) {
  for (const double z : {0.1, 0.3, 0.6}) {
    const double exact = rebound(z);
    const Drop d{fmt::format("viscous: {:.17g}", 2 * z * std::sqrt(mass * stiffness))};
    const std::string name = fmt::format("viscous, c = {} of the critical one: ", z);
    const double coarse = error_of(d, 40, exact, 1.4), fine = error_of(d, 160, exact, 1.4);
    const Impact one = impact_of(d, 160, 0.3, 1.4);
    expect(out, name + "speed after / before, 160 increments", one.ratio, exact, 0.02, dashpot);
    expect(out, name + "order of the error, 40 to 160", 0.5 * std::log2(coarse / fine), 1, 0.25,
           "first order");
    expect(out, name + "what the ledger leaves", one.ledger, 0, 1e-12, ledger);
    inform(out, name + "dissipated / (1 - e^2) of the energy", one.damped / (1 - exact * exact), 1,
           dashpot);
  }
}

/// An elastic block falls flat on a line, or on another one; the ledger must close, and implicit
/// contact gives nothing.
void add_elastic(CaseResult& out) {
  for (const double e : {0.0, 0.5, 1.0}) {
    const std::string text = fmt::format(R"(osculate: 1
mesh:
  generate:
    low: {{box: {{x: [0, 1], y: [0, 1], elements: [3, 3]}}}}
    high: {{box: {{x: [0, 1], y: [1.001, 2.001], elements: [4, 4]}}}}
materials: {{m: {{linear_elastic: {{E: 1000, nu: 0.3, density: 1}}}}}}
sections: [{{on: low, material: m, element: plane_strain}}, {{on: high, material: m, element: plane_strain}}]
contact: [{{name: c, master: low.top, slave: high.bottom,
  normal: {{penalty: 2000, damping: {{restitution: {}}}}}}}]
initial_velocity: [{{on: high, vy: -1}}]
steps: [{{name: hit, increments: 300, duration: 0.15, dynamics: {{}}}}]
{})",
                                         e, tail);
    double high = 0, low = 0, all = 0, grown = 0;
    model::Energies energies;
    const model::AnalysisResult result = run_text(text, [&](const Snapshot& now) {
      const model::Rates& rates = now.state.rates;
      if (rates.empty()) return;
      const auto momentum_of = [&](int cells, int first) {  // consistent masses of equal cells
        double sum = 0;
        for (int j = 0; j <= cells; ++j)
          for (int i = 0; i <= cells; ++i) {
            const double share = (i % cells == 0 ? 0.5 : 1) * (j % cells == 0 ? 0.5 : 1);
            sum += share / (cells * cells) * rates.velocity[2 * (first + j * (cells + 1) + i) + 1];
          }
        return sum;
      };
      const model::Energies& was = energies;
      const double before = was.kinetic + was.strain + was.contact + was.damping;
      energies = rates.energies;
      const double after = energies.kinetic + energies.strain + energies.contact + energies.damping;
      if (before > 0) grown = std::max(grown, after / before - 1);
      low = momentum_of(3, 0);
      high = momentum_of(4, 16);
      all = low + high;
    });
    const std::string name = fmt::format("two elastic blocks, e = {}: ", e);
    expect(out, name + "finished", result.outcome == solve::Outcome::converged, 1, 0, momentum);
    expect(out, name + "momentum after / before", -all, 1, 1e-9, momentum);
    out.rows.push_back({name + "largest gain of energy + dissipated, relative", grown, 1e-9,
                        Relation::at_most, 0, "Kane et al. (1999)"});
    // With e = 0 the springs unload so steeply that iterations end at the rounding of coordinates:
    // the forces left by it do work.
    expect(out, name + "residual of the ledger / energy", energies.residual / energies.start, 0,
           e > 0 ? 1e-9 : 1e-5, ledger);
    inform(out, name + "speed of parting of the centres / approach", high - low, e, newton);
    inform(out, name + "dissipated by the law / energy", energies.damping / energies.start, 0,
           newton);
  }
}

}  // namespace

CaseResult impact_law(const CaseContext&) {
  CaseResult out;
  add_restitution(out);
  add_plastic(out);
  add_speeds(out);
  add_bounces(out);
  add_viscous(out);
  add_elastic(out);
  return out;
}

}  // namespace osculate::verification
