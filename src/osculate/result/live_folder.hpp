#pragma once
#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace osculate::result {

/// Bytes of a file from number `from` on, at most so many. None: there is no such file, or it
/// cannot be read, or is no plain file: links are not followed, which could lead out of a folder.
///
/// Tested by  tests/system/test_view.py
[[nodiscard]] std::optional<std::string> own_text(const std::string& path, std::uint64_t from = 0,
                                                  std::uint64_t most = UINT64_MAX);

/// The folder of a run as it is now, whether it goes on, has ended or was killed: what the page of
/// `osculate view` asks for again and again (docs/view.md). Only what has come since is read.
///
/// Input      files that every run writes: summary.json, journal.bin, iterations.csv, history.csv,
///            log.txt. Nothing is written
/// Tested by  tests/system/test_view.py
class LiveFolder {
 public:
  /// Errors     core::InputError: there is no folder, or no run in it
  explicit LiveFolder(std::string folder);
  ~LiveFolder();
  LiveFolder(const LiveFolder&) = delete;
  LiveFolder& operator=(const LiveFolder&) = delete;

  /// `run` (a text that changes when another run begins here), `model`, `status` (`running`,
  /// `done`, `stopped`, `killed`), `message` (of the run; else why its increments cannot be read),
  /// `columns` of the history, `entries` from number `from` on if `run` is the one given (else
  /// all), `iterations` of the increment under way, and the last lines of `log`.
  [[nodiscard]] nlohmann::json state(const std::string& run, std::size_t from);
  /// The report's frame of an entry (docs/report_data.md) as JSON; none: it has no frame.
  [[nodiscard]] std::optional<std::string> frame(std::size_t entry);

 private:
  struct Known;
  void look_at_run();
  void read_journal();
  void read_iterations();
  std::string folder_;
  std::unique_ptr<Known> known_;
};

}  // namespace osculate::result
