#include "osculate/result/data_set.hpp"

#include <limits>
#include <map>

#include "osculate/model/quantities.hpp"

namespace osculate::result {
namespace {

Vec3 in_space(const Vec2& v) { return {v.x(), v.y(), 0.0}; }
Vec3 in_space(const Vec3& v) { return v; }

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

/// Edge-edge contacts as single points.
void add_edge_contacts(const pairing::PairDefinition<3>& pair, const std::vector<Vec3>& reference,
                       const std::vector<Vec3>& x,
                       const std::vector<model::EdgeEdgeSite>& edge_contacts,
                       std::vector<Vec3>& points, std::vector<Vec3>& u,
                       std::vector<mesh::Block>& cells) {
  if (edge_contacts.empty()) return;
  mesh::Block block{cell::CellType::point1, {}};
  for (const model::EdgeEdgeSite& site : edge_contacts) {
    const pairing::SharpEdge& edge =
        pairing::edges_of(pair)->slave[static_cast<std::size_t>(site.edge)];
    block.connectivity.push_back(static_cast<Index>(points.size()));
    points.push_back(pairing::edge_position(edge, site.xi, reference));
    u.emplace_back(pairing::edge_position(edge, site.xi, x) - points.back());
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

/// Rigid bodies as one data set.
struct RigidGrid {
  struct Cells {
    mesh::Block block;
    std::vector<std::size_t> body;  ///< of each cell
  };
  std::vector<Vec3> points, u;
  std::map<cell::CellType, Cells> cells;

  void add(cell::CellType type, std::size_t body, const std::vector<Index>& nodes) {
    Cells& list = cells.try_emplace(type, Cells{{type, {}}, {}}).first->second;
    list.block.connectivity.insert(list.block.connectivity.end(), nodes.begin(), nodes.end());
    list.body.push_back(body);
  }
};

void add_rigid(const RigidLines& lines, const model::Model&, const model::State& state,
               std::size_t body, RigidGrid& grid) {
  for (const RigidLines::Polyline& line : lines.of(state, body)) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      const auto at = static_cast<Index>(grid.points.size());
      grid.points.push_back(in_space(line[i]));
      if (i > 0) grid.add(cell::CellType::line2, body, {at - 1, at});
    }
    if (line.size() == 1)
      grid.add(cell::CellType::point1, body, {static_cast<Index>(grid.points.size()) - 1});
  }
}

void add_rigid(const RigidFaces& faces, const model::Model3& m, const model::State3&,
               std::size_t body, RigidGrid& grid) {
  std::map<Index, Index> place;
  for (const mesh::SurfaceFacet& facet : faces.facets(body)) {
    std::vector<Index> nodes;
    for (const Index node : facet.nodes()) {
      const auto [at, fresh] = place.try_emplace(node, static_cast<Index>(grid.points.size()));
      if (fresh) grid.points.push_back(m.reference[static_cast<std::size_t>(node)]);
      nodes.push_back(at->second);
    }
    grid.add(facet.type, body, nodes);
  }
  for (const RigidFaces::Quad& quad : faces.quads(body)) {
    const auto at = static_cast<Index>(grid.points.size());
    grid.points.insert(grid.points.end(), quad.begin(), quad.end());
    grid.add(cell::CellType::quad4, body, {at, at + 1, at + 2, at + 3});
  }
}

template <int Dim, class Pictures>
DataSet rigid_bodies(const model::BasicModel<Dim>& model, const Pictures& rigid,
                     const model::BasicState<Dim>& state, std::size_t deformable) {
  RigidGrid grid;
  for (std::size_t b = 0; b < model.rigid.size(); ++b) {
    const std::size_t before = grid.points.size();
    add_rigid(rigid, model, state, b, grid);
    for (std::size_t i = before; i < grid.points.size(); ++i) {
      const Vec<Dim> x = grid.points[i].template head<Dim>();
      grid.u.push_back(in_space(Vec<Dim>(state.rigid[b].position(x) - x)));
    }
  }
  DataSet set{"rigid bodies", std::move(grid.points), {}, {io::vector_field("U", grid.u)}};
  io::Field body = io::scalar_field("Body", {});
  for (auto& [type, cells] : grid.cells) {
    for (const std::size_t b : cells.body)
      body.values.push_back(static_cast<double>(deformable + b + 1));
    set.cells.push_back(std::move(cells.block));
  }
  set.cell_fields.push_back(std::move(body));
  return set;
}

}  // namespace

io::Field numbers_field(const mesh::Mesh& mesh, const std::vector<Index>& nodes) {
  io::Field field = io::scalar_field("NodeNumber", {});
  for (const Index node : nodes)
    field.values.push_back(static_cast<double>(mesh::node_number(mesh, node)));
  return field;
}

template <int Dim>
DataSet contact_set(const model::BasicSystem<Dim>& system, const model::BasicModel<Dim>& m,
                    const model::BasicState<Dim>& state, std::size_t pair) {
  const model::BasicContactFields<Dim> c = model::contact_fields(system, m, pair);
  DataSet set{m.pairs[pair].name, {}, {}, {}};
  std::map<Index, Index> local;
  std::vector<Vec<Dim>> u;
  for (const Index node : c.nodes) {
    local.emplace(node, static_cast<Index>(set.points.size()));
    set.points.push_back(in_space(m.reference[static_cast<std::size_t>(node)]));
    u.push_back(state.u.template segment<Dim>(Dim * node));
  }
  set.cells = slave_cells(m.pairs[pair].definition.slave.boundary.facets, local);
  if constexpr (Dim == 3)
    add_edge_contacts(m.pairs[pair].definition, m.reference, system.positions(state),
                      c.edge_contacts, set.points, u, set.cells);
  io::Field numbers = numbers_field(m.mesh, c.nodes);  // none of crossings
  numbers.values.resize(set.points.size(), std::numeric_limits<double>::quiet_NaN());
  set.point_fields = contact_columns(c);
  set.point_fields.insert(set.point_fields.begin(), {vector_field("U", u), numbers});
  return set;
}
template DataSet contact_set(const model::System&, const model::Model&, const model::State&,
                             std::size_t);
template DataSet contact_set(const model::System3&, const model::Model3&, const model::State3&,
                             std::size_t);

DataSet rigid_set(const model::Model& model, const RigidLines& rigid, const model::State& state,
                  std::size_t deformable) {
  return rigid_bodies(model, rigid, state, deformable);
}
DataSet rigid_set(const model::Model3& model, const RigidFaces& rigid, const model::State3& state,
                  std::size_t deformable) {
  return rigid_bodies(model, rigid, state, deformable);
}

}  // namespace osculate::result
