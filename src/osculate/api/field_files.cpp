#include "osculate/api/field_files.hpp"

#include <fmt/format.h>

#include <map>

#include "osculate/model/fields.hpp"
#include "osculate/model/quantities.hpp"

namespace osculate::api {
namespace {

io::Field vector_field(const std::string& name, const std::vector<Vec2>& values) {
  io::Field field{name, 3, {}, {}};
  for (const Vec2& v : values) field.values.insert(field.values.end(), {v.x(), v.y(), 0.0});
  return field;
}

io::Field tensor_field(const std::string& name, const std::vector<std::array<double, 4>>& values) {
  io::Field field{name, 4, {}, {"XX", "YY", "ZZ", "XY"}};
  for (const auto& v : values) field.values.insert(field.values.end(), v.begin(), v.end());
  return field;
}

io::Field scalar_field(const std::string& name, const std::vector<double>& values) {
  return {name, 1, values, {}};
}

std::vector<mesh::Block> section_blocks(const model::Model& m) {
  std::map<cell::CellType, mesh::Block> blocks;
  for (const model::BulkSection& section : m.sections)
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

}  // namespace

FieldFiles::FieldFiles(std::string folder, const deck::Built& built, bool compress)
    : folder_(std::move(folder)),
      built_(built),
      compress_(compress),
      bodies_(section_blocks(built.model)) {}

void FieldFiles::write(const model::System& system, const model::State& state, double time) {
  const model::NodalFields f = model::nodal_fields(system, built_.model, state);
  const std::vector<io::Field> fields{vector_field("U", f.displacement),
                                      vector_field("RF", f.reaction), tensor_field("S", f.stress),
                                      tensor_field("E", f.strain), scalar_field("Mises", f.mises)};
  const std::string bodies = fmt::format("bodies_{:05d}.vtu", frame_);
  io::write_vtu(folder_ + "/" + bodies, {built_.model.mesh.nodes, bodies_, fields, {}}, compress_);
  entries_.push_back({time, "bodies", bodies});
  for (std::size_t p = 0; p < built_.model.pairs.size(); ++p) {
    const std::string file = fmt::format("contact{}_{:05d}.vtu", p, frame_);
    write_contact(system, state, p, file);
    entries_.push_back({time, built_.model.pairs[p].name, file});
  }
  ++frame_;
  io::write_pvd(folder_ + "/results.pvd", entries_);
}

void FieldFiles::write_contact(const model::System& system, const model::State& state,
                               std::size_t pair, const std::string& file) {
  const model::Model& m = built_.model;
  const model::ContactFields c = model::contact_fields(system, m, pair);
  std::map<Index, Index> local;
  std::vector<Vec3> points;
  std::vector<Vec2> u;
  for (const Index node : c.nodes) {
    local.emplace(node, static_cast<Index>(points.size()));
    const Vec2& x = m.reference[static_cast<std::size_t>(node)];
    points.emplace_back(x.x(), x.y(), 0.0);
    u.push_back(state.u.segment<2>(2 * node));
  }
  std::map<cell::CellType, mesh::Block> blocks;
  for (const pairing::Facet& facet : m.pairs[pair].definition.slave.boundary.facets) {
    const cell::CellType type = facet.count == 2   ? cell::CellType::line2
                                : facet.count == 3 ? cell::CellType::line3
                                                   : cell::CellType::line4;
    mesh::Block& block = blocks.try_emplace(type, mesh::Block{type, {}}).first->second;
    for (int k = 0; k < facet.count; ++k)
      block.connectivity.push_back(local.at(facet.nodes[static_cast<std::size_t>(k)]));
  }
  std::vector<mesh::Block> list;
  for (auto& entry : blocks) list.push_back(std::move(entry.second));
  if (list.empty()) {
    list.push_back({cell::CellType::point1, {}});
    for (Index i = 0; i < static_cast<Index>(points.size()); ++i) list[0].connectivity.push_back(i);
  }
  const std::vector<io::Field> fields{vector_field("U", u),
                                      vector_field("normal", c.normal),
                                      scalar_field("COPEN", c.copen),
                                      scalar_field("CPRESS", c.cpress),
                                      scalar_field("CSHEAR1", c.cshear),
                                      scalar_field("CSLIP1", c.cslip),
                                      scalar_field("CSTATUS", c.cstatus),
                                      scalar_field("CFEATURE", c.cfeature),
                                      scalar_field("CAREA", c.carea),
                                      scalar_field("CNFORCE", c.cnforce),
                                      scalar_field("CSFORCE", c.csforce)};
  io::write_vtu(folder_ + "/" + file, {points, list, fields, {}}, compress_);
}

void FieldFiles::write_last_iterate(const model::State& state) {
  std::vector<Vec2> u;
  for (std::size_t i = 0; i < built_.model.mesh.nodes.size(); ++i)
    u.push_back(state.u.segment<2>(2 * static_cast<Eigen::Index>(i)));
  const std::vector<io::Field> fields{vector_field("U", u)};
  io::write_vtu(folder_ + "/last_iterate.vtu", {built_.model.mesh.nodes, bodies_, fields, {}},
                compress_);
}

void FieldFiles::close() {
  if (!entries_.empty()) io::write_pvd(folder_ + "/results.pvd", entries_);
}

}  // namespace osculate::api
