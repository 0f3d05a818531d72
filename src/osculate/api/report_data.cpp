#include "osculate/api/report_data.hpp"

#include "osculate/api/summary.hpp"
#include "osculate/core/version.hpp"

namespace osculate::api {

template <int Dim>
ReportCollector<Dim>::ReportCollector(const deck::BasicBuilt<Dim>& built,
                                      const deck::Description& description)
    : built_(built), description_(description), view_(built.model) {}

template <int Dim>
void ReportCollector<Dim>::add_history(const std::vector<double>& row) {
  rows_.push_back(row);
}

template <int Dim>
void ReportCollector<Dim>::add_frame(const model::BasicSystem<Dim>& system,
                                     const model::BasicState<Dim>& state,
                                     const model::Progress& progress) {
  if (view_.max_frames() == 0) return;
  nlohmann::json frame = view_.frame(system, state);
  frame["step"] = progress.step + 1;  // as in the columns of the history
  frame["increment"] = progress.increment;
  frame["time"] = progress.time;
  add_frame(std::move(frame));
}

template <int Dim>
void ReportCollector<Dim>::add_frame(nlohmann::json frame) {
  const std::size_t most = view_.max_frames();
  if (most == 0) return;
  newest_ = frame;
  last_ = std::move(frame);
  if (seen_++ % stride_ != 0) return;
  frames_.push_back(std::move(last_));
  last_ = nullptr;
  if (frames_.size() < most) return;
  std::vector<nlohmann::json> kept;
  for (std::size_t i = 0; i < frames_.size(); i += 2) kept.push_back(std::move(frames_[i]));
  if (frames_.size() % 2 == 0) last_ = std::move(frames_.back());
  frames_ = std::move(kept);
  stride_ *= 2;
}

template <int Dim>
void ReportCollector<Dim>::add_failure(const model::BasicState<Dim>& state,
                                       const model::BasicFailure<Dim>& failure) {
  if (!failure.motions.empty() && state.u.allFinite())
    failure_ = view_.last_iterate(state, failure);
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
  nlohmann::json frames = frames_;
  if (!last_.is_null()) frames.push_back(last_);
  nlohmann::json data = {{"title", built_.model.title},
                         {"osculate", core::version},
                         {"status", summary["status"] == "done" ? "done" : "failed"},
                         {"message", summary["message"]},
                         {"model", facts},
                         {"summary", summary},
                         {"iterations", iterations},
                         {"history", {{"columns", columns}, {"rows", rows_}}},
                         {"mesh", view_.mesh()}};
  view_.finish(frames, data);
  data["frames"] = frames;
  if (!failure_.is_null()) data["last_iterate"] = failure_;
  if (!plots.empty()) data["plots"] = plots;
  return data.dump();
}

template class ReportCollector<2>;
template class ReportCollector<3>;

}  // namespace osculate::api
