#include "problems.hpp"

#include "osculate/deck/build.hpp"

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
HardOutcome run_built(deck::BasicBuilt<Dim>& built, int threads,
                      const std::function<void(model::AnalysisOptions&)>& edit) {
  built.options.threads = threads;
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

HardOutcome run_hard(const std::string& folder, const HardProblem& problem, int threads,
                     const std::function<void(model::AnalysisOptions&)>& edit) {
  deck::AnyBuilt any = deck::build_any_file(folder + "/" + std::string(problem.name) + ".yaml");
  return std::visit([&](auto& built) { return run_built(built, threads, edit); }, any);
}

bool as_required(const HardProblem& problem, const HardOutcome& outcome) {
  if (problem.cause.empty()) return outcome.finished;
  return !outcome.finished && outcome.message.find(problem.cause) != std::string::npos;
}

}  // namespace osculate::verification
