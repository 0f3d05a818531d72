#include "osculate/api/report_data.hpp"

#include <map>

#include "osculate/api/summary.hpp"
#include "osculate/core/version.hpp"
#include "osculate/io/report.hpp"
#include "osculate/model/fields.hpp"
#include "osculate/model/quantities.hpp"

namespace osculate::api {
namespace {

nlohmann::json packed(const std::vector<float>& values, std::size_t columns) {
  return {{"f32", io::base64_f32(values)}, {"shape", {values.size() / columns, columns}}};
}

template <class Get>
nlohmann::json scalars(std::size_t n, const Get& get) {
  std::vector<float> values(n);
  for (std::size_t i = 0; i < n; ++i) values[i] = static_cast<float>(get(i));
  return packed(values, 1);
}

template <class Get>
nlohmann::json vectors(std::size_t n, const Get& get) {
  std::vector<float> values;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 v = get(i);
    values.push_back(static_cast<float>(v.x()));
    values.push_back(static_cast<float>(v.y()));
  }
  return packed(values, 2);
}

nlohmann::json mesh_json(const model::Model& m) {
  nlohmann::json cells = nlohmann::json::array();
  std::map<Index, std::vector<Index>> by_block;
  for (const model::BulkSection& section : m.sections)
    for (const mesh::CellRef& ref : section.cells) {
      const mesh::Block& block = m.mesh.blocks[static_cast<std::size_t>(ref.block)];
      const int n = cell::info(block.type).nodes;
      auto& list = by_block[ref.block];
      list.insert(list.end(), block.cell(ref.cell), block.cell(ref.cell) + n);
    }
  for (const auto& entry : by_block) {
    const mesh::Block& block = m.mesh.blocks[static_cast<std::size_t>(entry.first)];
    cells.push_back({{"type", cell::info(block.type).name}, {"connectivity", entry.second}});
  }
  return {{"points", vectors(m.mesh.nodes.size(), [&](std::size_t i) { return m.reference[i]; })},
          {"cells", cells}};
}

nlohmann::json contact_json(const model::System& system, const model::Model& m,
                            const std::vector<Vec2>& x, std::size_t pair) {
  const model::ContactFields f = model::contact_fields(system, m, pair);
  const std::size_t n = f.nodes.size();
  return {{"pair", m.pairs[pair].name},
          {"x", vectors(n, [&](std::size_t i) { return x[static_cast<std::size_t>(f.nodes[i])]; })},
          {"normal", vectors(n, [&](std::size_t i) { return f.normal[i]; })},
          {"pressure", scalars(n, [&](std::size_t i) { return f.cpress[i]; })},
          {"shear", scalars(n, [&](std::size_t i) { return f.cshear[i]; })},
          {"status", f.cstatus}};
}

/// Boundary of a rigid body in its current place, as a polyline for the picture.
std::vector<std::array<double, 2>> rigid_outline(const model::Model& m, const model::State& state,
                                                 std::size_t b) {
  const model::RigidBody& body = m.rigid[b];
  const body::RigidMotion& motion = state.rigid[b];
  std::vector<Vec2> points;
  if (body.shape) {
    Vec2 lo = m.reference.front(), hi = lo;
    for (std::size_t n = 0; n < m.mesh.nodes.size(); ++n) {
      lo = lo.cwiseMin(m.reference[n]);
      hi = hi.cwiseMax(m.reference[n]);
    }
    const double reach = (hi - lo).norm();
    const double from = std::max(geometry::lo(*body.shape), -reach);
    const double to = std::min(geometry::hi(*body.shape), reach);
    constexpr int pieces = 120;
    for (int i = 0; i <= pieces; ++i)
      points.push_back(geometry::jet(*body.shape, from + (to - from) * i / pieces).r);
  } else if (!body.polyline.empty()) {
    points = body.polyline;
  } else {
    for (const Index n : body.nodes) points.push_back(m.reference[static_cast<std::size_t>(n)]);
  }
  std::vector<std::array<double, 2>> outline;
  for (const Vec2& p : points) {
    const Vec2 now = motion.position(p);
    outline.push_back({now.x(), now.y()});
  }
  return outline;
}

}  // namespace

ReportCollector::ReportCollector(const deck::Built& built, const deck::Description& description)
    : built_(built), description_(description) {}

void ReportCollector::add_history(const std::vector<double>& row) { rows_.push_back(row); }

void ReportCollector::add_frame(const model::System& system, const model::State& state,
                                const model::Progress& progress) {
  if (seen_++ % stride_ != 0) return;
  const model::Model& m = built_.model;
  const std::size_t n = m.mesh.nodes.size();
  const model::NodalFields fields = model::nodal_fields(system, m, state);
  const std::vector<Vec2> x = system.positions(state);
  nlohmann::json contact = nlohmann::json::array();
  for (std::size_t p = 0; p < m.pairs.size(); ++p) contact.push_back(contact_json(system, m, x, p));
  nlohmann::json rigid = nlohmann::json::array();
  for (std::size_t b = 0; b < m.rigid.size(); ++b) rigid.push_back(rigid_outline(m, state, b));
  frames_.push_back(
      {{"step", progress.step + 1},  // as in the columns of the history
       {"increment", progress.increment},
       {"time", progress.time},
       {"u", vectors(n, [&](std::size_t i) { return fields.displacement[i]; })},
       {"fields",
        {{"von Mises stress", scalars(n, [&](std::size_t i) { return fields.mises[i]; })},
         {"stress yy", scalars(n, [&](std::size_t i) { return fields.stress[i][1]; })},
         {"stress xy", scalars(n, [&](std::size_t i) { return fields.stress[i][3]; })}}},
       {"contact", contact},
       {"rigid", rigid}});
  if (frames_.size() < max_frames) return;
  std::vector<nlohmann::json> kept;
  for (std::size_t i = 0; i < frames_.size(); i += 2) kept.push_back(std::move(frames_[i]));
  frames_ = std::move(kept);
  stride_ *= 2;
}

std::string ReportCollector::json(const nlohmann::json& summary) const {
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
  nlohmann::json rigid = nlohmann::json::array();
  for (std::size_t b = 0; b < built_.model.rigid.size(); ++b) {
    nlohmann::json lines = nlohmann::json::array();
    for (auto& frame : frames) lines.push_back(frame["rigid"][b]);
    rigid.push_back({{"name", built_.model.rigid[b].name}, {"polyline", lines}});
  }
  for (auto& frame : frames) frame.erase("rigid");
  nlohmann::json data = {{"title", built_.model.title},
                         {"osculate", core::version},
                         {"status", summary["status"] == "done" ? "done" : "failed"},
                         {"message", summary["message"]},
                         {"model", facts},
                         {"summary", summary},
                         {"iterations", iterations},
                         {"history", {{"columns", columns}, {"rows", rows_}}},
                         {"mesh", mesh_json(built_.model)},
                         {"frames", frames},
                         {"rigid", rigid}};
  if (!plots.empty()) data["plots"] = plots;
  return data.dump();
}

}  // namespace osculate::api
