#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "osculate/deck/build.hpp"

namespace osculate::result {

/// Time spent outside the analysis proper.
struct RunSeconds {
  double input = 0;   ///< reading and building the model
  double output = 0;  ///< fields, histories and report data, while the analysis runs
};

/// What summary.json says (docs/results.md): status, message, steps with their increments, time per
/// phase, memory, unknowns. `curvature_shares`: one value (KSVD:60) per converged increment;
/// `notes`: an object per converged increment whose entries are added to the increment's.
template <int Dim>
[[nodiscard]] nlohmann::json summary_json(const std::string& model_file,
                                          const model::BasicAnalysisResult<Dim>& result,
                                          const std::string& status, const RunSeconds& seconds,
                                          const std::vector<double>& curvature_shares,
                                          const std::vector<nlohmann::json>& notes);

/// A converged increment as summary.json has it, but for what `notes` add and its curvature share.
/// `step_time`: how many steps are behind it.
[[nodiscard]] nlohmann::json increment_json(double step_time, const solve::IncrementRecord& record);

/// `diagnosis` of summary.json: why the analysis stopped before its end; null if it did not fail.
template <int Dim>
[[nodiscard]] nlohmann::json diagnosis_json(const model::BasicModel<Dim>& model,
                                            const model::BasicAnalysisResult<Dim>& result);

/// One line per thing the model consists of: bodies, rigid bodies, pairs, steps.
struct ModelFact {
  std::string heading, name, text;
};
template <int Dim>
[[nodiscard]] std::vector<ModelFact> model_facts(const deck::BasicBuilt<Dim>& built);

/// What the factors of the tangent need, against what the machine has [bytes].
struct MemoryNeed {
  double entries = 0;  ///< of the factors; 0: none are needed
  double needed = 0, available = 0;
  [[nodiscard]] std::string text() const;
  /// For a run that begins: a warning where it is more than there is, a line where it is much.
  [[nodiscard]] std::string notice() const;
};
template <int Dim>
[[nodiscard]] MemoryNeed memory_need(const model::BasicModel<Dim>& model, bool unsymmetric);

/// The time steps of a step that were chosen by their errors.
struct ChosenTimeSteps {
  int count = 0;  ///< 0: they were not
  double smallest = 0, largest = 0;
  int refused = 0;           ///< that were too long, and repeated
  double largest_error = 0;  ///< rate over the largest speed
};
[[nodiscard]] ChosenTimeSteps chosen_time_steps(const model::StepRecord& step);
/// Lines for log.txt, and warnings where the errors were larger than the step asks for.
[[nodiscard]] std::vector<std::string> chosen_time_steps_text(
    const std::vector<model::StepRecord>& records, const std::vector<model::Step>& steps);

/// A line for log.txt of linear systems that were solved by iterations, and a warning where some
/// were not; empty without any.
[[nodiscard]] std::vector<std::string> linear_systems_text(const la::IterativeWork& work);

/// Likewise of several processes: the slowest one, and how unevenly they have worked.
[[nodiscard]] std::vector<std::string> processes_text(
    const std::vector<model::ProcessRecord>& processes);

}  // namespace osculate::result
