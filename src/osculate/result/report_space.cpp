#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "osculate/model/fields.hpp"
#include "osculate/model/quantities.hpp"
#include "osculate/result/report_json.hpp"
#include "osculate/result/report_view.hpp"

namespace osculate::result {
namespace {

constexpr double most_values = 8e6;  ///< of all frames together
/// u, stress, contact pressure, shear, gap, slip, state
constexpr double values_per_point = 14;
constexpr double frames_with_cells = 20;  ///< of a picture that has the cells too
constexpr std::size_t most_frames = 60;

std::vector<mesh::SurfaceFacet> free_faces(const model::Model3& m) {
  mesh::Set bodies{"bodies", 3, {}, {}};
  for (const model::BulkSection3& section : m.sections)
    bodies.cells.insert(bodies.cells.end(), section.cells.begin(), section.cells.end());
  return mesh::surface_facets(m.mesh, mesh::face_table(m.mesh, bodies.cells), bodies).facets;
}

/// Adds faces as lists of their nodes by type; `properties` go with each list.
void add_faces(const std::vector<mesh::SurfaceFacet>& facets, const std::vector<Index>& place,
               const nlohmann::json& properties, nlohmann::json& cells) {
  std::array<std::vector<Index>, cell::cell_type_count> lists;
  for (const mesh::SurfaceFacet& facet : facets)
    for (const Index node : facet.nodes())
      lists[static_cast<std::size_t>(facet.type)].push_back(place[static_cast<std::size_t>(node)]);
  for (std::size_t type = 0; type < lists.size(); ++type) {
    if (lists[type].empty()) continue;
    cells.push_back(properties);
    cells.back()["type"] = cell::info(static_cast<cell::CellType>(type)).name;
    cells.back()["connectivity"] = lists[type];
  }
}

/// Nodal values of contact, NaN where there is none.
struct ContactValues {
  std::vector<float> pressure, shear, gap, slip, state;
};

ContactValues contact_values(const model::System3& system, const model::Model3& m,
                             const std::vector<Index>& place, std::size_t points) {
  const std::vector<float> none(points, std::numeric_limits<float>::quiet_NaN());
  ContactValues values{none, none, none, none, none};
  for (std::size_t p = 0; p < m.pairs.size(); ++p) {
    const model::ContactFields3 c = model::contact_fields(system, m, p);
    for (std::size_t i = 0; i < c.nodes.size(); ++i) {
      if (static_cast<std::size_t>(c.nodes[i]) >= place.size()) continue;
      const Index at = place[static_cast<std::size_t>(c.nodes[i])];
      if (at < 0) continue;
      const auto k = static_cast<std::size_t>(at);
      if (values.pressure[k] > c.cpress[i]) continue;  // of two pairs the one that carries more
      values.pressure[k] = static_cast<float>(c.cpress[i]);
      values.shear[k] = static_cast<float>(Vec2(c.cshear[i], c.cshear2[i]).norm());
      values.gap[k] = static_cast<float>(c.copen[i]);
      values.slip[k] = static_cast<float>(Vec2(c.cslip[i], c.cslip2[i]).norm());
      values.state[k] = static_cast<float>(c.cstatus[i]);
    }
  }
  return values;
}

}  // namespace

ReportView<3>::ReportView(const model::Model3& model)
    : model_(model), bodies_(body_numbers(model)), rigid_(model), body_faces_(free_faces(model)) {
  for (std::size_t b = 0; b < model.rigid.size(); ++b)
    for (const std::array<Vec3, 4>& corners : rigid_.quads(b)) patches_.push_back({b, corners});
  collect_nodes();
}

/// Those of all cells where that leaves enough frames, else those that can be seen.
void ReportView<3>::collect_nodes() {
  std::vector<bool> used(model_.reference.size(), false);
  const auto use = [&](std::span<const Index> nodes) {
    for (const Index node : nodes) used[static_cast<std::size_t>(node)] = true;
  };
  for (const mesh::SurfaceFacet& facet : body_faces_) use(facet.nodes());
  for (std::size_t b = 0; b < model_.rigid.size(); ++b)
    for (const mesh::SurfaceFacet& facet : rigid_faces(b)) use(facet.nodes());
  const std::vector<bool> seen = used;
  for (const model::BulkSection3& section : model_.sections)
    for (const mesh::CellRef& ref : section.cells) {
      const mesh::Block& block = model_.mesh.blocks[static_cast<std::size_t>(ref.block)];
      use({block.cell(ref.cell), static_cast<std::size_t>(cell::info(block.type).nodes)});
    }
  const auto count = static_cast<double>(std::count(used.begin(), used.end(), true)) +
                     4 * static_cast<double>(patches_.size());
  solid_ = frames_with_cells * values_per_point * count <= most_values;
  if (!solid_) used = seen;
  place_.assign(model_.reference.size(), -1);
  for (std::size_t n = 0; n < used.size(); ++n) {
    if (!used[n]) continue;
    place_[n] = static_cast<Index>(nodes_.size());
    nodes_.push_back(static_cast<Index>(n));
  }
}

/// Facets of a meshed rigid body, but for those that are faces of deformable bodies anyway.
std::vector<mesh::SurfaceFacet> ReportView<3>::rigid_faces(std::size_t body) const {
  const auto key = [](const mesh::SurfaceFacet& facet) {
    std::vector<Index> nodes(facet.nodes().begin(), facet.nodes().end());
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  };
  std::vector<mesh::SurfaceFacet> facets = rigid_.facets(body);
  if (facets.empty()) return facets;
  std::set<std::vector<Index>> seen;
  for (const mesh::SurfaceFacet& facet : body_faces_) seen.insert(key(facet));
  std::erase_if(facets, [&](const auto& facet) { return seen.contains(key(facet)); });
  return facets;
}

std::size_t ReportView<3>::max_frames() const {
  const double one = values_per_point * static_cast<double>(points());
  if (!(2 * one <= most_values)) return 0;
  return std::min(most_frames, static_cast<std::size_t>(most_values / std::max(one, 1.0)));
}

nlohmann::json ReportView<3>::mesh() const {
  if (max_frames() == 0) return {{"dimension", 3}};
  nlohmann::json cells = nlohmann::json::array();
  std::vector<std::vector<mesh::SurfaceFacet>> faces(bodies_.deformable);
  for (const mesh::SurfaceFacet& facet : body_faces_)
    faces[static_cast<std::size_t>(bodies_.of(facet.parent))].push_back(facet);
  for (std::size_t b = 0; b < faces.size(); ++b) add_faces(faces[b], place_, {{"body", b}}, cells);
  const std::size_t n = nodes_.size();
  for (std::size_t b = 0; b < model_.rigid.size(); ++b) {
    nlohmann::json properties = {{"body", bodies_.deformable + b}, {"rigid", true}};
    add_faces(rigid_faces(b), place_, properties, cells);
    std::vector<Index> squares;
    for (std::size_t i = 0; i < 4 * patches_.size(); ++i)
      if (patches_[i / 4].body == b) squares.push_back(static_cast<Index>(n + i));
    if (squares.empty()) continue;
    if (rigid_.endless(b)) properties["endless"] = true;
    properties["type"] = "quad4";
    properties["connectivity"] = squares;
    cells.push_back(properties);
  }
  const auto point = [&](std::size_t i) -> Vec3 {
    if (i < n) return model_.reference[static_cast<std::size_t>(nodes_[i])];
    return patches_[(i - n) / 4].corners[(i - n) % 4];
  };
  std::vector<std::int64_t> numbers;
  for (const Index node : nodes_) numbers.push_back(mesh::node_number(model_.mesh, node));
  nlohmann::json mesh = {{"dimension", 3},     {"points", vectors<3>(points(), point)},
                         {"cells", cells},     {"bodies", bodies_.names},
                         {"numbers", numbers}, {"sets", sets_json(model_.mesh, place_)}};
  if (solid_) mesh["volumes"] = volumes_json();
  return mesh;
}

nlohmann::json ReportView<3>::volumes_json() const {
  std::map<std::pair<Index, Index>, std::vector<Index>> lists;  // by body and block
  for (const model::BulkSection3& section : model_.sections)
    for (const mesh::CellRef& ref : section.cells) {
      const mesh::Block& block = model_.mesh.blocks[static_cast<std::size_t>(ref.block)];
      const int n = cell::info(block.type).nodes;
      auto& list = lists[{bodies_.of(ref), ref.block}];
      for (int k = 0; k < n; ++k)
        list.push_back(place_[static_cast<std::size_t>(block.cell(ref.cell)[k])]);
    }
  nlohmann::json volumes = nlohmann::json::array();
  for (const auto& [key, list] : lists)
    volumes.push_back(
        {{"type", cell::info(model_.mesh.blocks[static_cast<std::size_t>(key.second)].type).name},
         {"connectivity", list},
         {"body", key.first}});
  return volumes;
}

nlohmann::json ReportView<3>::frame(const model::Reached3& reached) const {
  const model::System3& system = reached.system;
  const model::State3& state = reached.state;
  const model::NodalFields3& f = reached.fields();
  const std::size_t n = nodes_.size();
  const auto u = [&](std::size_t i) -> Vec3 {
    if (i < n) return f.displacement[static_cast<std::size_t>(nodes_[i])];
    const Patch& patch = patches_[(i - n) / 4];
    const Vec3& x = patch.corners[(i - n) % 4];
    return state.rigid[patch.body].position(x) - x;
  };
  const auto stress = [&](std::size_t i) { return f.stress[static_cast<std::size_t>(nodes_[i])]; };
  nlohmann::json fields = nlohmann::json::object();
  if (!model_.pairs.empty()) {
    const ContactValues c = contact_values(system, model_, place_, n);
    fields["contact pressure"] = packed(c.pressure, 1);
    fields["contact shear"] = packed(c.shear, 1);
    fields["contact gap"] = packed(c.gap, 1);
    fields["contact slip"] = packed(c.slip, 1);
    fields["contact state (0 open, 1 stick, 2 slip, 3 closed)"] = packed(c.state, 1);
  }
  return {{"u", vectors<3>(points(), u)}, {"stress", rows<6>(n, stress)}, {"fields", fields}};
}

nlohmann::json ReportView<3>::last_iterate(const model::State3& state,
                                           const model::Failure3& failure) const {
  if (max_frames() == 0) return nullptr;
  const std::size_t n = nodes_.size();
  nlohmann::json motions = nlohmann::json::array();
  for (const model::FreeMotion3& motion : failure.motions) {
    if (static_cast<double>(motions.size() + 1) * 3 * static_cast<double>(points()) > most_values)
      break;
    const std::vector<Vec3> field = model::motion_field(model_, state, motion);
    motions.push_back(vectors<3>(points(), [&](std::size_t i) -> Vec3 {
      return i < n ? field[static_cast<std::size_t>(nodes_[i])] : Vec3(Vec3::Zero());
    }));
  }
  const auto u = [&](std::size_t i) -> Vec3 {
    if (i < n) return state.u.segment<3>(3 * static_cast<Eigen::Index>(nodes_[i]));
    const Patch& patch = patches_[(i - n) / 4];
    const Vec3& x = patch.corners[(i - n) % 4];
    return state.rigid[patch.body].position(x) - x;
  };
  return {{"u", vectors<3>(points(), u)}, {"motions", motions}};
}

}  // namespace osculate::result
