#pragma once
// The helper of run_model.hpp for models in space.
#include <functional>
#include <string>

#include "osculate/deck/build.hpp"
#include "osculate/deck/parse.hpp"
#include "workers.hpp"

namespace osculate::verification {

/// One converged increment as a case sees it.
struct Snapshot3 {
  const model::Model3& model;
  const model::System3& system;
  const model::State3& state;
  const model::Progress& progress;
  const solve::IncrementRecord* record;  ///< null for the initial state
};

/// What may be changed on the way from the text to the analysis.
struct Edits3 {
  std::function<void(mesh::Mesh&)> mesh;     ///< before the model is built on it
  std::function<void(deck::Built3&)> model;  ///< before it runs
};

/// Runs a model file given as text; `look` is called after the initial state and each converged
/// increment.
inline model::AnalysisResult3 run_text3(const std::string& text, const Workers& workers,
                                        const std::function<void(const Snapshot3&)>& look,
                                        const Edits3& edits = {}) {
  const deck::Description description = deck::parse_model(text, "generated.yaml");
  mesh::Mesh mesh = deck::load_mesh(description);
  if (edits.mesh) edits.mesh(mesh);
  deck::Built3 built = deck::build3(description, std::move(mesh));
  workers.work_on(built.options);
  if (edits.model) edits.model(built);
  model::AnalysisObserver3 observer;
  observer.converged = [&](model::System3& system, const model::State3& state,
                           const model::Progress& progress, const solve::IncrementRecord* record) {
    look({built.model, system, state, progress, record});
    return true;
  };
  return model::run(built.model, built.options, observer);
}

}  // namespace osculate::verification
