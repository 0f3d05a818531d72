#pragma once
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "osculate/deck/build.hpp"
#include "osculate/result/report_view.hpp"

namespace osculate::result {

/// Collects what the report shows while an analysis runs (docs/report_data.md). Keeps at most as
/// many frames as the view allows: when there are more, every second one is dropped. The first and
/// the last frame are always there.
template <int Dim>
class ReportCollector {
 public:
  ReportCollector(const deck::BasicBuilt<Dim>& built, const deck::Description& description);
  ~ReportCollector();
  ReportCollector(const ReportCollector&) = delete;
  ReportCollector& operator=(const ReportCollector&) = delete;
  void add_frame(const model::BasicReached<Dim>& reached, const model::Progress& progress);
  /// A frame that was made before: `newest()` of another collector.
  void add_frame(const nlohmann::json& frame);
  /// The frame that was added last; null if there is none or the view wants none.
  [[nodiscard]] const nlohmann::json& newest() const;
  /// Where an increment failed for good, and what is free to move there.
  void add_failure(const model::BasicState<Dim>& state, const model::BasicFailure<Dim>& failure);
  void add_history(const std::vector<double>& row);
  /// The report data with the summary merged in.
  [[nodiscard]] std::string json(const nlohmann::json& summary) const;

  /// The report data before the first increment: all steps without any, the mesh without frames.
  [[nodiscard]] std::string first_json() const;

 private:
  const deck::BasicBuilt<Dim>& built_;
  const deck::Description& description_;
  ReportView<Dim> view_;
  struct Collected;
  std::unique_ptr<Collected> collected_;
};

}  // namespace osculate::result
