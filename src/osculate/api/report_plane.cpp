#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "osculate/api/report_json.hpp"
#include "osculate/api/report_view.hpp"
#include "osculate/model/fields.hpp"
#include "osculate/model/quantities.hpp"

namespace osculate::api {
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

void add_points(const geometry::Curve& curve, double from, double to, std::vector<Vec2>& points) {
  constexpr int pieces = 120;
  for (int i = 0; i <= pieces; ++i)
    points.push_back(geometry::jet(curve, from + (to - from) * i / pieces).r);
}

/// Places of the mesh's nodes where the body has its reference position.
std::vector<Vec2> seen_from(const model::Model& m, const model::State& state,
                            const body::RigidMotion& motion) {
  body::RigidMotion turned;
  turned.angle = -motion.angle;
  std::vector<Vec2> out;
  for (std::size_t n = 0; n < m.mesh.nodes.size(); ++n) {
    const Vec2 x = m.reference[n] + state.u.segment<2>(2 * static_cast<Eigen::Index>(n));
    out.push_back(motion.reference + turned.position(x - motion.center()));
  }
  return out;
}

/// A curve, or of a line without ends the piece beside all nodes, wherever they have moved.
void add_shape(const geometry::Curve& curve, const std::vector<Vec2>& nodes,
               std::vector<Vec2>& points) {
  double from = geometry::lo(curve), to = geometry::hi(curve);
  if (!std::isfinite(from)) {
    const geometry::CurveJet<2> jet = geometry::jet(curve, 0);
    Vec2 lo = nodes.front(), hi = lo;
    from = std::numeric_limits<double>::infinity(), to = -from;
    for (const Vec2& x : nodes) {
      const double at = (x - jet.r).dot(jet.r1) / jet.r1.squaredNorm();
      from = std::min(from, at);
      to = std::max(to, at);
      lo = lo.cwiseMin(x);
      hi = hi.cwiseMax(x);
    }
    const double margin = 0.2 * (hi - lo).norm();
    from -= margin;
    to += margin;
  }
  add_points(curve, from, to, points);
}

/// Boundary of a rigid body in its current place, as a polyline for the picture.
std::vector<std::array<double, 2>> rigid_outline(const model::Model& m, const model::State& state,
                                                 std::size_t b) {
  const model::RigidBody& body = m.rigid[b];
  const body::RigidMotion& motion = state.rigid[b];
  std::vector<Vec2> points;
  if (body.shape) {
    add_shape(*body.shape, seen_from(m, state, motion), points);
  } else if (!body.parts.empty()) {
    for (const geometry::Curve& part : body.parts)
      add_points(part, geometry::lo(part), geometry::hi(part), points);
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

nlohmann::json ReportView<2>::mesh() const {
  const model::Model& m = model_;
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
  return {
      {"points", vectors<2>(m.mesh.nodes.size(), [&](std::size_t i) { return m.reference[i]; })},
      {"cells", cells}};
}

nlohmann::json ReportView<2>::frame(const model::System& system, const model::State& state) const {
  const model::Model& m = model_;
  const std::size_t n = m.mesh.nodes.size();
  const model::NodalFields fields = model::nodal_fields(system, m, state);
  const std::vector<Vec2> x = system.positions(state);
  nlohmann::json contact = nlohmann::json::array();
  for (std::size_t p = 0; p < m.pairs.size(); ++p)
    if (m.pairs[p].group.empty() || touches(system.contact()[p]))
      contact.push_back(contact_json(system, m, x, p));
  nlohmann::json rigid = nlohmann::json::array();
  for (std::size_t b = 0; b < m.rigid.size(); ++b) rigid.push_back(rigid_outline(m, state, b));
  return {{"u", vectors<2>(n, [&](std::size_t i) { return fields.displacement[i]; })},
          {"fields",
           {{"von Mises stress", scalars(n, [&](std::size_t i) { return fields.mises[i]; })},
            {"stress yy", scalars(n, [&](std::size_t i) { return fields.stress[i][1]; })},
            {"stress xy", scalars(n, [&](std::size_t i) { return fields.stress[i][3]; })}}},
          {"contact", contact},
          {"rigid", rigid}};
}

nlohmann::json ReportView<2>::last_iterate(const model::State& state,
                                           const model::Failure& failure) const {
  const std::size_t n = model_.mesh.nodes.size();
  nlohmann::json motions = nlohmann::json::array(), rigid = nlohmann::json::array();
  for (const model::FreeMotion& motion : failure.motions) {
    const std::vector<Vec2> field = model::motion_field(model_, state, motion);
    motions.push_back(vectors<2>(n, [&](std::size_t i) { return field[i]; }));
  }
  for (std::size_t b = 0; b < model_.rigid.size(); ++b)
    rigid.push_back(
        {{"name", model_.rigid[b].name}, {"polyline", rigid_outline(model_, state, b)}});
  const auto u = [&](std::size_t i) -> Vec2 {
    return state.u.segment<2>(2 * static_cast<Eigen::Index>(i));
  };
  return {{"u", vectors<2>(n, u)}, {"motions", motions}, {"rigid", rigid}};
}

void ReportView<2>::finish(nlohmann::json& frames, nlohmann::json& report) const {
  nlohmann::json rigid = nlohmann::json::array();
  for (std::size_t b = 0; b < model_.rigid.size(); ++b) {
    nlohmann::json lines = nlohmann::json::array();
    for (auto& frame : frames) lines.push_back(frame["rigid"][b]);
    rigid.push_back({{"name", model_.rigid[b].name}, {"polyline", lines}});
  }
  for (auto& frame : frames) frame.erase("rigid");
  report["rigid"] = rigid;
}

}  // namespace osculate::api
