#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "osculate/deck/build.hpp"

namespace osculate::api {

/// What summary.json says (docs/results.md): status, message, steps with their increments, time per
/// phase, memory, unknowns.
[[nodiscard]] nlohmann::json summary_json(const std::string& model_file,
                                          const model::AnalysisResult& result,
                                          const std::string& status, double seconds_input);

/// One line per thing the model consists of: bodies, rigid bodies, pairs, steps.
struct ModelFact {
  std::string heading, name, text;
};
[[nodiscard]] std::vector<ModelFact> model_facts(const deck::Built& built);

/// Largest resident memory of this process so far [MB].
[[nodiscard]] double peak_memory_mb();

}  // namespace osculate::api
