#pragma once
#include <map>
#include <string>
#include <vector>

#include "case.hpp"
#include "osculate/deck/check.hpp"

namespace osculate::verification {

/// The cases of a folder that are data: those with a case.yaml (README.md says its keys). One that
/// cannot be read is among them, and says so when it runs.
[[nodiscard]] std::vector<Case> data_cases(const std::string& folder);

/// A column of a run: what a value of case.yaml asks for.
struct DataColumn {
  std::string name;
  const deck::Value* asked = nullptr;
};

/// One model and what was asked of it, at its start and after each converged increment.
struct DataRun {
  bool finished = false;
  std::vector<double> time;       ///< since inertia began; without inertia steps completed
  std::vector<std::string> step;  ///< empty at the start
  std::map<std::string, std::vector<double>> columns;
};

/// Runs a model after the values that `changes` (a map from paths of keys such as
/// `contact.0.normal.penalty` to what shall stand there) replaces.
[[nodiscard]] DataRun run_data(const std::string& model, const deck::SourceNode& changes,
                               const std::vector<DataColumn>& columns, const Workers& workers);

}  // namespace osculate::verification
