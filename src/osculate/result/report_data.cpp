#include "osculate/result/report_data.hpp"

#include <nlohmann/json.hpp>

#include "osculate/core/version.hpp"
#include "osculate/result/result_folder.hpp"
#include "osculate/result/summary.hpp"

namespace osculate::result {

namespace {

std::string report_status(const nlohmann::json& status) {
  return status == "done" || status == "running" ? status.get<std::string>() : "failed";
}

}  // namespace

template <int Dim>
struct ReportCollector<Dim>::Collected {
  std::vector<nlohmann::json> frames{};
  nlohmann::json newest{};
  nlohmann::json last{};  ///< the latest frame, if it is not among them
  std::size_t stride = 1, seen = 0;
  nlohmann::json failure{};
  nlohmann::json rows = nlohmann::json::array();
};

template <int Dim>
ReportCollector<Dim>::ReportCollector(const deck::BasicBuilt<Dim>& built,
                                      const deck::Description& description)
    : built_(built),
      description_(description),
      view_(built.model),
      collected_(std::make_unique<Collected>()) {}
template <int Dim>
ReportCollector<Dim>::~ReportCollector() = default;

template <int Dim>
const nlohmann::json& ReportCollector<Dim>::newest() const {
  return collected_->newest;
}

template <int Dim>
void ReportCollector<Dim>::add_history(const std::vector<double>& row) {
  collected_->rows.push_back(row);
}

template <int Dim>
void ReportCollector<Dim>::add_frame(const model::BasicReached<Dim>& reached,
                                     const model::Progress& progress) {
  if (view_.max_frames() == 0) return;
  nlohmann::json frame = view_.frame(reached);
  frame["step"] = progress.step + 1;  // as in the columns of the history
  frame["increment"] = progress.increment;
  frame["time"] = progress.time;
  add_frame(std::move(frame));
}

template <int Dim>
void ReportCollector<Dim>::add_frame(const nlohmann::json& frame) {
  const std::size_t most = view_.max_frames();
  if (most == 0) return;
  Collected& c = *collected_;
  c.newest = frame;
  c.last = frame;
  if (c.seen++ % c.stride != 0) return;
  c.frames.push_back(std::move(c.last));
  c.last = nullptr;
  if (c.frames.size() < most) return;
  std::vector<nlohmann::json> kept;
  for (std::size_t i = 0; i < c.frames.size(); i += 2) kept.push_back(std::move(c.frames[i]));
  if (c.frames.size() % 2 == 0) c.last = std::move(c.frames.back());
  c.frames = std::move(kept);
  c.stride *= 2;
}

template <int Dim>
void ReportCollector<Dim>::add_failure(const model::BasicState<Dim>& state,
                                       const model::BasicFailure<Dim>& failure) {
  if (!failure.motions.empty() && state.u.allFinite())
    collected_->failure = view_.last_iterate(state, failure);
}

template <int Dim>
std::string ReportCollector<Dim>::json(const nlohmann::json& summary) const {
  nlohmann::json facts = nlohmann::json::array();
  for (const ModelFact& fact : model_facts(built_)) {
    if (facts.empty() || facts.back()["heading"] != fact.heading)
      facts.push_back({{"heading", fact.heading}, {"rows", nlohmann::json::array()}});
    facts.back()["rows"].push_back({fact.name, fact.text});
  }
  nlohmann::json columns = {"step", "increment", "time"};
  for (const model::HistoryRequest& request : built_.history) columns.push_back(request.name);
  nlohmann::json plots = nlohmann::json::array();
  for (const deck::Plot& plot : description_.output.plots) {
    nlohmann::json y = nlohmann::json::array();
    for (const deck::Name& name : plot.y) y.push_back(name.value);
    plots.push_back({{"title", plot.title}, {"x", plot.x.value}, {"y", y}});
  }
  nlohmann::json iterations = nlohmann::json::array();
  int step_number = 0;
  for (const auto& step : summary["steps"]) {
    ++step_number;
    int number = 0;
    for (const auto& inc : step["increments"])
      iterations.push_back({{"step", step_number},
                            {"increment", ++number},
                            {"residuals", inc["residuals"]},
                            {"energies", inc["energies"]}});
  }
  const Collected& c = *collected_;
  nlohmann::json frames = c.frames;
  if (!c.last.is_null()) frames.push_back(c.last);
  nlohmann::json data = {{"title", built_.model.title},
                         {"osculate", core::version},
                         {"status", report_status(summary["status"])},
                         {"message", summary["message"]},
                         {"model", facts},
                         {"summary", summary},
                         {"iterations", iterations},
                         {"history", {{"columns", columns}, {"rows", c.rows}}},
                         {"mesh", view_.mesh()}};
  view_.finish(frames, data);
  data["frames"] = frames;
  if (!c.failure.is_null()) data["last_iterate"] = c.failure;
  if (!plots.empty()) data["plots"] = plots;
  return json_text(data);
}

template <int Dim>
std::string ReportCollector<Dim>::first_json() const {
  nlohmann::json steps = nlohmann::json::array();
  for (const model::Step& step : built_.model.steps)
    steps.push_back({{"name", step.name}, {"increments", nlohmann::json::array()}});
  return json({{"status", "running"}, {"message", ""}, {"steps", steps}});
}

template class ReportCollector<2>;
template class ReportCollector<3>;

}  // namespace osculate::result
