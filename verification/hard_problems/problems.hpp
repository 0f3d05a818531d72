#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "../workers.hpp"
#include "osculate/model/analysis.hpp"

namespace osculate::verification {

/// One model file of this folder.
struct HardProblem {
  std::string_view name;
  bool quick = false;           ///< in the selection that every `verify` runs
  std::string_view cause = {};  ///< it has no solution, and its message must contain this
};

/// The one list of problems.
[[nodiscard]] const std::vector<HardProblem>& hard_problems_list();

/// How a run went.
struct HardOutcome {
  bool finished = false;
  std::string message;
  int increments = 0, iterations = 0, cutbacks = 0;
  double seconds = 0;
};

/// Runs NAME.yaml of `folder` with its own settings; `edit` may change those of the step control.
[[nodiscard]] HardOutcome run_hard(const std::string& folder, const HardProblem& problem,
                                   const Workers& workers,
                                   const std::function<void(model::AnalysisOptions&)>& edit = {});

/// Iterations of each increment and a hash of the states in each, of two blocks pressed and sheared
/// with automatic penalties, written in other units.
struct UnitsOutcome {
  bool finished = false;
  std::vector<int> iterations;
  std::vector<std::uint64_t> states;
};
[[nodiscard]] UnitsOutcome run_in_units(double length, double force);

/// As was asked of it: to the end, or stopped with the right cause.
[[nodiscard]] bool as_required(const HardProblem& problem, const HardOutcome& outcome);

}  // namespace osculate::verification
