#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "osculate/deck/build.hpp"

namespace osculate::api {

/// Collects what the report shows while an analysis runs (docs/report_data.md). Keeps at most
/// `max_frames` frames: when there are more, every second one is dropped.
class ReportCollector {
 public:
  ReportCollector(const deck::Built& built, const deck::Description& description);
  void add_frame(const model::System& system, const model::State& state,
                 const model::Progress& progress);
  void add_history(const std::vector<double>& row);
  /// The report data with the summary merged in.
  [[nodiscard]] std::string json(const nlohmann::json& summary) const;

 private:
  static constexpr std::size_t max_frames = 60;
  const deck::Built& built_;
  const deck::Description& description_;
  std::vector<nlohmann::json> frames_;
  std::size_t stride_ = 1, seen_ = 0;
  nlohmann::json rows_ = nlohmann::json::array();
};

}  // namespace osculate::api
