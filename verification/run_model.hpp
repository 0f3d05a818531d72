#pragma once
// Helper of the cases: run a model file in memory and look at every converged increment.
#include <functional>
#include <string>

#include "osculate/deck/build.hpp"
#include "osculate/deck/parse.hpp"

namespace osculate::verification {

/// One converged increment as a case sees it.
struct Snapshot {
  const model::System& system;
  const model::State& state;
  const model::Progress& progress;
  const solve::IncrementRecord* record;  ///< null for the initial state
};

/// Runs a built model; `look` is called after the initial state and each converged increment.
inline model::AnalysisResult run_built(const deck::Built& built,
                                       const std::function<void(const Snapshot&)>& look) {
  model::AnalysisObserver observer;
  observer.converged = [&](model::System& system, const model::State& state,
                           const model::Progress& progress, const solve::IncrementRecord* record) {
    if (look) look({system, state, progress, record});
    return true;
  };
  return model::run(built.model, built.options, observer);
}

/// Builds and runs a model; `look` is called after the initial state and each converged increment.
/// `edit` may change the built model (penalties, section, steps) before the run.
inline model::AnalysisResult run_model(const std::string& path,
                                       const std::function<void(const Snapshot&)>& look,
                                       const std::function<void(deck::Built&)>& edit = {}) {
  deck::Built built = deck::build_file(path);
  if (edit) edit(built);
  return run_built(built, look);
}

/// The same for a model file given as text (cases that refine a mesh write theirs).
inline model::AnalysisResult run_text(const std::string& text,
                                      const std::function<void(const Snapshot&)>& look) {
  const deck::Description description = deck::parse_model(text, "generated.yaml");
  return run_built(deck::build(description, deck::load_mesh(description)), look);
}

/// Iterations of all increments, those of dropped attempts included.
inline int total_iterations(const model::AnalysisResult& result) {
  int sum = 0;
  for (const model::StepRecord& step : result.steps)
    for (const solve::IncrementRecord& record : step.increments)
      sum += static_cast<int>(record.iterations.size()) + record.wasted_iterations;
  return sum;
}

}  // namespace osculate::verification
