#include "osculate/model/analysis.hpp"

#include <fmt/format.h>

#include <chrono>

#include "osculate/model/diagnosis.hpp"

namespace osculate::model {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <int Dim>
std::string failure_message(BasicSystem<Dim>& system, const BasicModel<Dim>& model,
                            const Step& step, const solve::StepResult<BasicState<Dim>>& result) {
  std::string text = fmt::format(
      "step '{}' stopped at {:.4g} of its length: {}", step.name,
      result.increments.empty() ? 0.0 : result.increments.back().fraction, result.reason);
  const std::string motion = free_motion_message(system, model, result.last_attempt.state);
  if (!motion.empty()) text += "; " + motion;
  for (const OutsideDomain& found : outside_domain(system, model))
    text += "; " + outside_domain_message(model, found);
  return text;
}

}  // namespace

template <int Dim>
BasicAnalysisResult<Dim> run(const BasicModel<Dim>& model, const AnalysisOptions& options,
                             const BasicAnalysisObserver<Dim>& observer) {
  const auto start = std::chrono::steady_clock::now();
  BasicSystem<Dim> system(model, options.threads);
  la::DirectSolver solver;
  BasicAnalysisResult<Dim> result;
  result.unknowns = system.dofs().unknowns();
  result.state = system.initial_state();
  Progress progress;
  if (!model.steps.empty()) system.begin_step(model.steps.front(), result.state);
  solve::Evaluation initial;
  system.evaluate(result.state, result.state, 0.0, false, initial);
  if (observer.converged && !observer.converged(system, result.state, progress, nullptr)) {
    result.outcome = solve::Outcome::stopped;
    result.message = "stopped by the user";
    result.last_iterate = result.state;
    result.seconds = seconds_since(start);
    return result;
  }
  for (std::size_t s = 0; s < model.steps.size(); ++s) {
    const Step& step = model.steps[s];
    progress.step = static_cast<Index>(s);
    progress.increment = 0;
    system.begin_step(step, result.state);
    const auto on_increment = [&](const BasicState<Dim>& state,
                                  const solve::IncrementRecord& record) {
      ++progress.increment;
      progress.fraction = record.fraction;
      progress.time = static_cast<double>(s) + record.fraction;
      return !observer.converged || observer.converged(system, state, progress, &record);
    };
    const auto on_cutback = [&](const std::string& reason, double from, double to,
                                const std::vector<solve::IterationRecord>& iterations) {
      progress.fraction = from;
      if (observer.cutback) observer.cutback(reason, progress, to, iterations);
    };
    solve::StepResult<BasicState<Dim>> done =
        solve::run_step(system, result.state, step.increments, options.increments, solver,
                        on_increment, on_cutback);
    result.state = done.state;
    result.last_iterate = done.state;
    result.outcome = done.outcome;
    if (done.outcome == solve::Outcome::stopped) result.message = done.reason;
    if (done.outcome != solve::Outcome::converged && done.outcome != solve::Outcome::stopped) {
      result.message = failure_message(system, model, step, done);
      result.last_iterate = done.last_attempt.state;
    }
    result.steps.push_back({step.name, std::move(done.increments)});
    if (result.outcome != solve::Outcome::converged || step.name == options.until) break;
  }
  result.seconds_system = system.seconds();
  result.seconds_solver = solver.seconds();
  result.seconds = seconds_since(start);
  return result;
}

template AnalysisResult run(const Model&, const AnalysisOptions&, const AnalysisObserver&);
template AnalysisResult3 run(const Model3&, const AnalysisOptions&, const AnalysisObserver3&);

}  // namespace osculate::model
