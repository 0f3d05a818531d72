#include "problems.hpp"

#include <fmt/format.h>

#include "osculate/deck/build.hpp"
#include "osculate/deck/parse.hpp"

namespace osculate::verification {

const std::vector<HardProblem>& hard_problems_list() {  // long: the one list
  static const std::vector<HardProblem> problems{
      {"asperities"},
      {"ball_dragged"},
      {"beam_on_rollers"},
      {"belt_on_pulley"},
      {"bouncing_block", true},
      {"buckling_strip"},
      {"closed_by_force", true},
      {"closed_by_motion", true},
      {"conforming", true},
      {"corner_on_corner", true},
      {"flat_punch"},
      {"friction_one", true},
      {"into_a_funnel"},
      {"lift_off", true},
      {"locking_wedge", true},
      {"mesh_ratio"},
      {"off_the_edge", true},
      {"over_a_step", true},
      {"pile", true},
      {"pin_in_vee", true},
      {"press_fit", true},
      {"pressed_arch"},
      {"pulled_off", true, "free to move"},
      {"quadratic_elements"},
      {"reversed_friction"},
      {"rolling_cylinder"},
      {"rubber_in_corner"},
      {"slope_too_steep", true, "free to move along (0.9397, 0.3420)"},
      {"snap_fit"},
      {"stiffness_ratio", true},
      {"strip_pulled_out"},
      {"thin_strip_between_plates"},
      {"three_blocks", true},
      {"tilted_faces"},
      {"twisted"},
  };
  return problems;
}

namespace {

template <int Dim>
HardOutcome run_built(deck::BasicBuilt<Dim>& built, const Workers& workers,
                      const std::function<void(model::AnalysisOptions&)>& edit) {
  workers.work_on(built.options);
  if (edit) edit(built.options);
  HardOutcome out;
  const model::BasicAnalysisObserver<Dim> nobody;
  const model::BasicAnalysisResult<Dim> result = model::run(built.model, built.options, nobody);
  out.finished = result.outcome == solve::Outcome::converged;
  out.message = result.message;
  out.seconds = result.seconds;
  for (const model::StepRecord& step : result.steps)
    for (const solve::IncrementRecord& record : step.increments) {
      ++out.increments;
      out.iterations += static_cast<int>(record.iterations.size()) + record.wasted_iterations;
      out.cutbacks += record.cutbacks;
    }
  return out;
}

}  // namespace

HardOutcome run_hard(const std::string& folder, const HardProblem& problem, const Workers& workers,
                     const std::function<void(model::AnalysisOptions&)>& edit) {
  deck::AnyBuilt any = deck::build_any_file(folder + "/" + std::string(problem.name) + ".yaml");
  return std::visit([&](auto& built) { return run_built(built, workers, edit); }, any);
}

UnitsOutcome run_in_units(double length, double force) {
  const double stress = force / (length * length);
  const std::string text = fmt::format(
      R"(osculate: 1
mesh:
  generate:
    low: {{box: {{x: [0, {0}], y: [0, {1}], elements: [8, 4]}}}}
    high: {{box: {{x: [{1}, {2}], y: [{1}, {2}], elements: [3, 4]}}}}
materials: {{a: {{neo_hooke: {{E: {3}, nu: 0.25}}}}, b: {{neo_hooke: {{E: {4}, nu: 0.25}}}}}}
sections:
  - {{on: low, material: a, element: plane_strain, thickness: {1}}}
  - {{on: high, material: b, element: plane_strain, thickness: {1}}}
contact: [{{name: c, master: low.top, slave: high.bottom, friction: {{coulomb: {{mu: 0.3}}}}}}]
steps:
  - {{name: press, increments: 2, prescribe: [{{on: low.bottom, ux: 0, uy: 0}}, {{on: high.top, ux: 0, uy: {5}}}]}}
  - {{name: shear, increments: 8, prescribe: [{{on: high.top, ux: {6}}}]}}
)",
      4 * length, length, 2 * length, 100 * stress, 400 * stress, -0.05 * length, 0.4 * length);
  const deck::Description description = deck::parse_model(text, "generated.yaml");
  const deck::Built built = deck::build(description, deck::load_mesh(description));
  const model::AnalysisResult result = model::run(built.model, built.options, {});
  UnitsOutcome out;
  out.finished = result.outcome == solve::Outcome::converged;
  for (const model::StepRecord& step : result.steps)
    for (const solve::IncrementRecord& record : step.increments) {
      out.iterations.push_back(static_cast<int>(record.iterations.size()));
      for (const solve::IterationRecord& it : record.iterations)
        out.states.push_back(it.counts.signature);
    }
  return out;
}

bool as_required(const HardProblem& problem, const HardOutcome& outcome) {
  if (problem.cause.empty()) return outcome.finished;
  return !outcome.finished && outcome.message.find(problem.cause) != std::string::npos;
}

}  // namespace osculate::verification
