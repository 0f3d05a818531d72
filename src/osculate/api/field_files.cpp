#include "osculate/api/field_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>

#include "osculate/api/result_folder.hpp"
#include "osculate/model/fields.hpp"
#include "osculate/model/quantities.hpp"

namespace osculate::api {
namespace {

Vec3 in_space(const Vec2& v) { return {v.x(), v.y(), 0.0}; }
Vec3 in_space(const Vec3& v) { return v; }

template <int Rows>
io::Field vector_field(const std::string& name, const std::vector<Vec<Rows>>& values) {
  io::Field field{name, 3, {}, {}};
  for (const Vec<Rows>& value : values) {
    const Vec3 v = in_space(value);
    field.values.insert(field.values.end(), {v.x(), v.y(), v.z()});
  }
  return field;
}

template <std::size_t N>
io::Field tensor_field(const std::string& name, const std::vector<std::array<double, N>>& values) {
  io::Field field{name, static_cast<int>(N), {}, {"XX", "YY", "ZZ", "XY", "YZ", "XZ"}};
  field.component_names.resize(N);
  for (const auto& v : values) field.values.insert(field.values.end(), v.begin(), v.end());
  return field;
}

template <int Dim>
std::vector<mesh::Block> section_blocks(const model::BasicModel<Dim>& m) {
  std::map<cell::CellType, mesh::Block> blocks;
  for (const model::BasicBulkSection<Dim>& section : m.sections)
    for (const mesh::CellRef& ref : section.cells) {
      const mesh::Block& from = m.mesh.blocks[static_cast<std::size_t>(ref.block)];
      mesh::Block& to = blocks.try_emplace(from.type, mesh::Block{from.type, {}}).first->second;
      const Index* const nodes = from.cell(ref.cell);
      to.connectivity.insert(to.connectivity.end(), nodes, nodes + cell::info(from.type).nodes);
    }
  std::vector<mesh::Block> list;
  for (auto& entry : blocks) list.push_back(std::move(entry.second));
  return list;
}

cell::CellType type_of(const pairing::Facet& facet) {
  return facet.count == 2   ? cell::CellType::line2
         : facet.count == 3 ? cell::CellType::line3
                            : cell::CellType::line4;
}
cell::CellType type_of(const pairing::SurfaceFacet& facet) { return facet.type; }

/// Slave facets as cells of their own points; single points where the slave has no facets.
template <class Facets>
std::vector<mesh::Block> slave_cells(const Facets& facets, const std::map<Index, Index>& local) {
  std::map<cell::CellType, mesh::Block> blocks;
  for (const auto& facet : facets) {
    const cell::CellType type = type_of(facet);
    mesh::Block& block = blocks.try_emplace(type, mesh::Block{type, {}}).first->second;
    for (int k = 0; k < facet.count; ++k)
      block.connectivity.push_back(local.at(facet.nodes[static_cast<std::size_t>(k)]));
  }
  std::vector<mesh::Block> list;
  for (auto& entry : blocks) list.push_back(std::move(entry.second));
  if (list.empty()) {
    list.push_back({cell::CellType::point1, {}});
    for (const auto& entry : local) list[0].connectivity.push_back(entry.second);
  }
  return list;
}

/// Crossings of edges as single points.
void add_crossings(const pairing::PairDefinition<3>& pair, const std::vector<Vec3>& reference,
                   const std::vector<Vec3>& x, const std::vector<model::CrossingSite>& crossings,
                   std::vector<Vec3>& points, std::vector<Vec3>& u,
                   std::vector<mesh::Block>& cells) {
  if (crossings.empty()) return;
  mesh::Block block{cell::CellType::point1, {}};
  for (const model::CrossingSite& site : crossings) {
    const pairing::SharpEdge& edge = pair.edges.slave[static_cast<std::size_t>(site.edge)];
    block.connectivity.push_back(static_cast<Index>(points.size()));
    points.push_back(pairing::crossing_place(edge, site.xi, reference));
    u.emplace_back(pairing::crossing_place(edge, site.xi, x) - points.back());
  }
  cells.push_back(std::move(block));
}

template <int Dim>
std::vector<io::Field> contact_columns(const model::BasicContactFields<Dim>& c) {
  using io::scalar_field;
  std::vector<io::Field> fields{vector_field("normal", c.normal), scalar_field("COPEN", c.copen),
                                scalar_field("CPRESS", c.cpress),
                                scalar_field("CSHEAR1", c.cshear)};
  if (Dim == 3) fields.push_back(scalar_field("CSHEAR2", c.cshear2));
  fields.push_back(scalar_field("CSLIP1", c.cslip));
  if (Dim == 3) fields.push_back(scalar_field("CSLIP2", c.cslip2));
  fields.push_back(scalar_field("CSTATUS", c.cstatus));
  fields.push_back(scalar_field("CFEATURE", c.cfeature));
  fields.push_back(scalar_field("CAREA", c.carea));
  fields.push_back(scalar_field("CNFORCE", c.cnforce));
  fields.push_back(scalar_field("CSFORCE", c.csforce));
  return fields;
}

}  // namespace

template <int Dim>
FieldFiles<Dim>::FieldFiles(std::string folder, const deck::BasicBuilt<Dim>& built, bool compress)
    : folder_(std::move(folder)),
      built_(built),
      compress_(compress),
      bodies_(section_blocks(built.model)),
      touched_(built.model.pairs.size(), false) {}

template <int Dim>
void FieldFiles<Dim>::write(const model::BasicSystem<Dim>& system,
                            const model::BasicState<Dim>& state, double time) {
  const model::BasicNodalFields<Dim> f = model::nodal_fields(system, built_.model, state);
  const std::vector<io::Field> fields{
      vector_field("U", f.displacement), vector_field("RF", f.reaction),
      tensor_field("S", f.stress), tensor_field("E", f.strain), io::scalar_field("Mises", f.mises)};
  const std::string bodies = fmt::format("bodies_{:05d}.vtu", frame_);
  io::write_vtu(folder_ + "/" + bodies, {built_.model.mesh.nodes, bodies_, fields, {}}, compress_);
  const std::size_t before = entries_.size();
  entries_.push_back({time, "bodies", bodies});
  const auto& contact = system.contact();
  for (std::size_t p = 0; p < built_.model.pairs.size(); ++p) {
    touched_[p] = touched_[p] || built_.model.pairs[p].group.empty() || touches(contact[p]);
    if (!touched_[p]) continue;
    const std::string file = fmt::format("contact{}_{:05d}.vtu", p, frame_);
    write_contact(system, state, p, file);
    entries_.push_back({time, built_.model.pairs[p].name, file});
  }
  ++frame_;
  if (!pvd_) pvd_.emplace(folder_ + "/results.pvd", std::span(entries_).first(before));
  pvd_->add(std::span(entries_).subspan(before));
}

template <int Dim>
void FieldFiles<Dim>::write_contact(const model::BasicSystem<Dim>& system,
                                    const model::BasicState<Dim>& state, std::size_t pair,
                                    const std::string& file) {
  const model::BasicModel<Dim>& m = built_.model;
  const model::BasicContactFields<Dim> c = model::contact_fields(system, m, pair);
  std::map<Index, Index> local;
  std::vector<Vec3> points;
  std::vector<Vec<Dim>> u;
  for (const Index node : c.nodes) {
    local.emplace(node, static_cast<Index>(points.size()));
    points.push_back(in_space(m.reference[static_cast<std::size_t>(node)]));
    u.push_back(state.u.template segment<Dim>(Dim * node));
  }
  std::vector<mesh::Block> cells =
      slave_cells(m.pairs[pair].definition.slave.boundary.facets, local);
  if constexpr (Dim == 3)
    add_crossings(m.pairs[pair].definition, m.reference, system.positions(state), c.crossings,
                  points, u, cells);
  std::vector<io::Field> fields = contact_columns(c);
  fields.insert(fields.begin(), vector_field("U", u));
  io::write_vtu(folder_ + "/" + file, {points, cells, fields, {}}, compress_);
}

template <int Dim>
void FieldFiles<Dim>::write_last_iterate(const model::BasicState<Dim>& state,
                                         const model::BasicFailure<Dim>& failure) {
  const std::size_t nodes = built_.model.mesh.nodes.size();
  std::vector<Vec<Dim>> u;
  for (std::size_t i = 0; i < nodes; ++i)
    u.push_back(state.u.template segment<Dim>(Dim * static_cast<Eigen::Index>(i)));
  std::vector<double> flips(nodes, 0.0);
  for (const model::FlippingPoint& point : failure.flips)
    if (point.node >= 0 && static_cast<std::size_t>(point.node) < nodes)
      flips[static_cast<std::size_t>(point.node)] = point.changes;
  std::vector<io::Field> fields{vector_field("U", u), io::scalar_field("flips", flips)};
  for (std::size_t k = 0; k < failure.motions.size(); ++k) {
    std::vector<Vec<Dim>> motion = model::motion_field(built_.model, state, failure.motions[k]);
    motion.resize(nodes);
    fields.push_back(vector_field(fmt::format("free_motion_{}", k + 1), motion));
  }
  io::write_vtu(folder_ + "/last_iterate.vtu", {built_.model.mesh.nodes, bodies_, fields, {}},
                compress_);
}

template <int Dim>
void FieldFiles<Dim>::resume(std::vector<io::PvdEntry> written, std::vector<bool> touched) {
  namespace fs = std::filesystem;
  std::set<std::string> kept;
  for (const io::PvdEntry& entry : written) kept.insert(entry.file);
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error))
    if (entry.path().extension() == ".vtu" && is_result_file(entry.path().filename().string()) &&
        !kept.contains(entry.path().filename().string()))
      fs::remove(entry.path(), error);
  entries_ = std::move(written);
  frame_ = static_cast<int>(std::count_if(entries_.begin(), entries_.end(),
                                          [](const auto& e) { return e.part == "bodies"; }));
  touched_ = std::move(touched);
  if (!entries_.empty()) pvd_.emplace(folder_ + "/results.pvd", entries_);
}

template class FieldFiles<2>;
template class FieldFiles<3>;

}  // namespace osculate::api
