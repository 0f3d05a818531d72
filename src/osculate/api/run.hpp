#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "osculate/deck/parameters.hpp"
#include "osculate/model/analysis.hpp"
#include "osculate/result/data_set.hpp"

namespace osculate::api {

/// An increment that has just converged and been written, for who watches a run; while it is told.
struct LiveIncrement {
  std::string step;
  model::Progress progress;
  int iterations;
  const std::vector<std::string>& columns;               ///< of the history
  const std::vector<double>& row;                        ///< this increment's
  std::function<std::vector<result::DataSet>()> fields;  ///< what field files would show
};

/// One analysis from a model file to a result folder.
struct RunOptions {
  std::string model;  ///< path of the model file
  /// What stands in place of the file's content: `model` is then its name in messages, and paths in
  /// it are relative to that one's folder.
  const deck::SourceNode* document = nullptr;
  std::string folder;  ///< result folder; empty: the model's stem + `.results`
  /// Files of CalculiX (result::AnswerFiles), without their endings; empty: in the folder, where
  /// the model asks for some.
  std::string answers{};
  std::string until;           ///< last step to run, inclusive; empty: all
  int threads = 1;             ///< 0: as many as pay (threads.hpp), of a process that is alone
  model::Together together{};  ///< processes that run it, too; the first one writes
  std::vector<deck::Setting> settings;  ///< parameters of the model file that are set otherwise
  bool restart = false;                 ///< go on from the folder's last checkpoint
  std::function<void(std::string_view)> say;       ///< lines for a person (also in log.txt)
  std::function<void(std::string_view)> progress;  ///< one changing line; may be empty
  std::function<bool()> interrupted;               ///< asked between increments; may be empty
  /// Asked between two iterations; true ends the run without the increment that is under way.
  std::function<bool()> abandoned{};
  /// Told of each converged increment, but not of frequencies of harmonic steps; false ends the
  /// run.
  std::function<bool(const LiveIncrement&)> converged{};
  bool with_outlook = false;  ///< progress begins with the share that is done and the time left
  /// Without: these stand on a line of their own, so long after the last one at the earliest [s].
  double outlook_after = 10;
  int max_iterations = 0;  ///< of all increments together, then the run stops likewise; 0: no limit
  double max_minutes = 0;  ///< since its beginning; 0: no limit
};

enum class RunStatus { done, stopped };

struct RunOutcome {
  RunStatus status = RunStatus::done;
  std::string message;  ///< plain words
  std::string folder;
  std::string summary_json;
};

/// Validates the input, then runs and writes summary.json, history.csv, results.pvd with VTU files,
/// report.json, report.html, log.txt and checkpoints. Everything converged is kept whatever
/// happens; where a file cannot be written (disk full) the analysis stops.
///
/// Errors     core::InputError for bad input or a checkpoint that cannot be used, io::WriteError
///            for a folder that cannot be written to: before anything is written or replaced
[[nodiscard]] RunOutcome run(const RunOptions& options);

/// Text and JSON of `osculate check`: bodies, pairs, unknowns, initial gaps and overlaps, warnings.
struct CheckReport {
  std::string text, json;
};
[[nodiscard]] CheckReport check(const std::string& model,
                                std::span<const deck::Setting> settings = {},
                                const deck::SourceNode* document = nullptr);

/// Writes FOLDER/report.html again from FOLDER/report.json.
void rewrite_report(const std::string& folder);

}  // namespace osculate::api
