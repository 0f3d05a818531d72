#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "../body_path.hpp"
#include "../cases.hpp"
#include "../run_model.hpp"

namespace osculate::verification {
namespace {

constexpr const char* bar_with_mass = "bar with a point mass";
constexpr double bar_length = 10, bar_height = 2, youngs = 100, rho = 1;
constexpr int bar_cells = 40, moved_node = 30;
constexpr double cell_length = bar_length / bar_cells;

double bar_speed() { return std::sqrt(youngs / rho); }
double bar_mass() { return rho * bar_height * bar_length; }

/// One cell of `part` of the others' length, which needs mass for their stable step.
struct ShortCell {
  double part = 1;
  bool scaled = false;
  [[nodiscard]] double length() const { return part * cell_length; }
  [[nodiscard]] double middle() const { return (moved_node + 1) * cell_length - 0.5 * length(); }
  /// Its stable step is L_e / c.
  [[nodiscard]] double added() const {
    return scaled ? (1 / (part * part) - 1) * rho * bar_height * length() : 0.0;
  }
};

deck::Built bar_of(const ShortCell& cell, const std::string& step) {
  const std::string masses = cell.scaled ? fmt::format(", mass_scaling: {{stable_step: {:.17g}}}",
                                                       cell_length / bar_speed())
                                         : std::string{};
  const std::string text =
      fmt::format(R"(osculate: 1
title: A bar with a short cell
mesh: {{generate: {{bar: {{box: {{x: [0, {}], y: [0, {}], elements: [{}, 1]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: {}, nu: 0, density: {}}}}}}}
sections: [{{on: bar, material: m, element: plane_strain, kinematics: small}}]
steps: [{{name: swing, dynamics: {{scheme: {{central_differences: {{safety: 0.9{}}}}}}}, {}}}]
)",
                  bar_length, bar_height, bar_cells, youngs, rho, masses, step);
  const deck::Description description = deck::parse_model(text, "generated.yaml");
  deck::Built built = deck::build(description, deck::load_mesh(description));
  const double old = moved_node * cell_length;
  for (Vec2& x : built.model.reference)
    if (std::abs(x.x() - old) < 1e-9) x.x() = old + cell_length - cell.length();
  return built;
}

/// The smallest root k of the equation of the frequencies.
double wave_number(const ShortCell& cell) {
  const double a = cell.middle(), b = bar_length - a, ratio = cell.added() / bar_mass();
  const auto rest = [&](double k) {
    return std::cos(k * a) - std::tan(k * b) * std::sin(k * a) -
           k * bar_length * ratio * std::sin(k * a);
  };
  double low = 0, high = std::numbers::pi / (2 * bar_length) + 1e-12;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (rest(middle) > 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

struct Swung {
  double frequency = 0;  ///< circular
  double stable = 0;
  int steps = 0;
  double added = 0;  ///< mass, as it is told
};

Swung swing(const ShortCell& cell) {
  constexpr int zeros = 5;
  const double k = wave_number(cell), omega = k * bar_speed(), a = cell.middle();
  const double end = (zeros + 0.5) * std::numbers::pi / omega;
  const int increments = static_cast<int>(end / (0.8 * cell_length / bar_speed()));
  const deck::Built built = bar_of(
      cell, fmt::format("increments: {}, duration: {:.17g}, prescribe: [{{on: bar.left, ux: 0}}]",
                        increments, end));
  model::System system(built.model, 1);
  model::State state = system.initial_state();
  const double behind = std::sin(k * a) / std::cos(k * (bar_length - a));
  for (std::size_t n = 0; n < built.model.reference.size(); ++n) {
    const double x = built.model.reference[n].x();
    state.u[2 * static_cast<Index>(n)] =
        0.01 * (x < a ? std::sin(k * x) : behind * std::cos(k * (bar_length - x)));
  }
  system.begin_step(built.model.steps.front(), state);
  Swung out;
  if (cell.scaled) out.added = system.scaled_masses().sections.front().added;
  state = system.begin_motion(state);
  double before = state.u[2 * bar_cells], first = 0, last = 0;
  int found = 0;
  for (int i = 1; i <= increments; ++i) {
    const model::ExplicitIncrement<model::State> done =
        system.advance(state, static_cast<double>(i) / increments);
    if (done.outcome != solve::TimeStepping::done) return out;
    state = done.state;
    out.steps += done.time_steps.count;
    out.stable = done.time_steps.stable;
    const double now = state.u[2 * bar_cells];
    if (before * now < 0 && ++found <= zeros) {
      last = end / increments * (i - now / (now - before));
      if (found == 1) first = last;
    }
    before = now;
  }
  if (found >= zeros) out.frequency = (zeros - 1) * std::numbers::pi / (last - first);
  return out;
}

/// Velocity of the centre of all masses that move, over g t m / (m + M).
double falls(const ShortCell& cell) {
  constexpr double g = 3, time = 2;
  const deck::Built built =
      bar_of(cell, fmt::format("increments: 1, duration: {}, gravity: [{}, 0]", time, g));
  double momentum = 0;
  const model::AnalysisResult result = run_built(built, [&](const Snapshot& now) {
    const model::BasicInertia<2> inertia(built.model, true);
    momentum = 0;
    for (std::size_t c = 0; c < inertia.cells().size(); ++c)
      for (std::size_t k = 0; k < inertia.cells()[c].nodes.size(); ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        momentum += now.system.scaled_masses().factor(c) * inertia.cells()[c].mass(i, i) *
                    now.state.rates.velocity[2 * inertia.cells()[c].nodes[k]];
      }
  });
  return result.outcome == solve::Outcome::converged ? momentum / (bar_mass() * g * time) : 0;
}

}  // namespace

CaseResult scaled_bar(const CaseContext&) {
  constexpr double of_mesh = 2e-4;  // (pi/2 L_e/L)^2/24 = 6e-5, and the time steps
  CaseResult out;
  for (const double part : {0.8, 0.6, 0.4}) {
    const ShortCell own{part, false}, with{part, true};
    const Swung plain = swing(own), scaled = swing(with);
    const std::string name = fmt::format("a cell of {:g}: ", part);
    const double exact = wave_number(own) * bar_speed(), slower = wave_number(with) * bar_speed();
    expect(out, name + "stable step / (L_e / c)", plain.stable * bar_speed() / cell_length, part,
           1e-10, "element eigenvalue");
    expect(out, name + "with mass", scaled.stable * bar_speed() / cell_length, 1, 1e-10,
           "element eigenvalue");
    expect(out, name + "mass added / mass of the bar", scaled.added / bar_mass(),
           with.added() / bar_mass(), 1e-10, bar_with_mass);
    expect(out, name + "first frequency / exact", plain.frequency / exact, 1, of_mesh,
           bar_with_mass);
    expect(out, name + "with mass, / exact", scaled.frequency / slower, 1, of_mesh, bar_with_mass);
    expect(out, name + "what mass makes of it, / exact",
           (scaled.frequency / plain.frequency) / (slower / exact), 1, 1e-4, bar_with_mass);
    inform(out, name + "it falls by (share of the mass)",
           (1 - scaled.frequency / plain.frequency) / (scaled.added / bar_mass()),
           std::pow(std::sin(exact / bar_speed() * with.middle()), 2), "Rayleigh");
    expect(out, name + "momentum of a falling bar / (m g t)", falls(with), 1, 1e-10, "Newton");
  }
  return out;
}

}  // namespace osculate::verification
