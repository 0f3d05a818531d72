#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "osculate/model/fields.hpp"
#include "osculate/model/quantities.hpp"
#include "osculate/result/report_json.hpp"
#include "osculate/result/report_view.hpp"

namespace osculate::result {
namespace {

nlohmann::json contact_json(const model::System& system, const model::Model& m,
                            const std::vector<Vec2>& x, std::size_t pair) {
  const model::ContactFields f = model::contact_fields(system, m, pair);
  const std::size_t n = f.nodes.size();
  return {
      {"pair", m.pairs[pair].name},
      {"x", vectors<2>(n, [&](std::size_t i) { return x[static_cast<std::size_t>(f.nodes[i])]; })},
      {"normal", vectors<2>(n, [&](std::size_t i) { return f.normal[i]; })},
      {"pressure", scalars(n, [&](std::size_t i) { return f.cpress[i]; })},
      {"shear", scalars(n, [&](std::size_t i) { return f.cshear[i]; })},
      {"status", f.cstatus}};
}

}  // namespace

ReportView<2>::ReportView(const model::Model& model)
    : model_(model), bodies_(body_numbers(model)), rigid_(model) {}

nlohmann::json ReportView<2>::mesh() const {
  const model::Model& m = model_;
  std::map<std::pair<Index, Index>, std::vector<Index>> lists;  // by body and block
  for (const model::BulkSection& section : m.sections)
    for (const mesh::CellRef& ref : section.cells) {
      const mesh::Block& block = m.mesh.blocks[static_cast<std::size_t>(ref.block)];
      auto& list = lists[{bodies_.of(ref), ref.block}];
      list.insert(list.end(), block.cell(ref.cell),
                  block.cell(ref.cell) + cell::info(block.type).nodes);
    }
  nlohmann::json cells = nlohmann::json::array();
  for (const auto& [key, list] : lists)
    cells.push_back(
        {{"type", cell::info(m.mesh.blocks[static_cast<std::size_t>(key.second)].type).name},
         {"connectivity", list},
         {"body", key.first}});
  std::vector<Index> place(m.mesh.nodes.size());
  std::iota(place.begin(), place.end(), 0);
  nlohmann::json mesh = {
      {"points", vectors<2>(m.mesh.nodes.size(), [&](std::size_t i) { return m.reference[i]; })},
      {"cells", cells},
      {"bodies", bodies_.names},
      {"sets", sets_json(m.mesh, place)}};
  if (!m.mesh.numbers.empty()) mesh["numbers"] = m.mesh.numbers;
  return mesh;
}

/// Polylines of all rigid bodies in their current places.
nlohmann::json ReportView<2>::rigid_json(const model::State& state) const {
  nlohmann::json rigid = nlohmann::json::array();
  for (std::size_t b = 0; b < model_.rigid.size(); ++b)
    for (const RigidLines::Polyline& line : rigid_.of(state, b)) {
      nlohmann::json points = nlohmann::json::array();
      for (const Vec2& p : line) {
        const Vec2 now = state.rigid[b].position(p);
        points.push_back({now.x(), now.y()});
      }
      rigid.push_back({{"name", model_.rigid[b].name},
                       {"body", bodies_.deformable + b},
                       {"polyline", std::move(points)}});
    }
  return rigid;
}

nlohmann::json ReportView<2>::frame(const model::Reached& reached) const {
  const model::System& system = reached.system;
  const model::State& state = reached.state;
  const model::Model& m = model_;
  const std::size_t n = m.mesh.nodes.size();
  const model::NodalFields& fields = reached.fields();
  const std::vector<Vec2> x = system.positions(state);
  nlohmann::json contact = nlohmann::json::array();
  for (std::size_t p = 0; p < m.pairs.size(); ++p)
    if (m.pairs[p].group.empty() || touches(system.contact()[p]))
      contact.push_back(contact_json(system, m, x, p));
  return {{"u", vectors<2>(n, [&](std::size_t i) { return fields.displacement[i]; })},
          {"stress", rows<4>(n, [&](std::size_t i) { return fields.stress[i]; })},
          {"contact", contact},
          {"rigid", rigid_json(state)}};
}

nlohmann::json ReportView<2>::last_iterate(const model::State& state,
                                           const model::Failure& failure) const {
  const std::size_t n = model_.mesh.nodes.size();
  nlohmann::json motions = nlohmann::json::array();
  for (const model::FreeMotion& motion : failure.motions) {
    const std::vector<Vec2> field = model::motion_field(model_, state, motion);
    motions.push_back(vectors<2>(n, [&](std::size_t i) { return field[i]; }));
  }
  const auto u = [&](std::size_t i) -> Vec2 {
    return state.u.segment<2>(2 * static_cast<Eigen::Index>(i));
  };
  return {{"u", vectors<2>(n, u)}, {"motions", motions}, {"rigid", rigid_json(state)}};
}

void ReportView<2>::finish(nlohmann::json& frames, nlohmann::json& report) const {
  nlohmann::json rigid = frames.empty() ? nlohmann::json::array() : frames[0]["rigid"];
  for (std::size_t k = 0; k < rigid.size(); ++k) {
    nlohmann::json lines = nlohmann::json::array();
    for (auto& frame : frames) lines.push_back(std::move(frame["rigid"][k]["polyline"]));
    rigid[k]["polyline"] = lines;
  }
  for (auto& frame : frames) frame.erase("rigid");
  report["rigid"] = rigid;
}

}  // namespace osculate::result
