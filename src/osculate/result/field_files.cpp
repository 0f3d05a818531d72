#include "osculate/result/field_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <system_error>

#include "osculate/io/atomic_file.hpp"
#include "osculate/io/csv.hpp"
#include "osculate/model/fields.hpp"
#include "osculate/model/quantities.hpp"
#include "osculate/result/body_numbers.hpp"
#include "osculate/result/result_folder.hpp"

namespace osculate::result {
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

io::Field numbers_field(const mesh::Mesh& mesh, const std::vector<Index>& nodes) {
  io::Field field = io::scalar_field("NodeNumber", {});
  for (const Index node : nodes)
    field.values.push_back(static_cast<double>(mesh::node_number(mesh, node)));
  return field;
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

/// A header line and one row a point: the values of all fields.
std::string table(const std::vector<io::Field>& fields, std::size_t points) {
  std::string text, comma;
  for (const io::Field& field : fields)
    for (std::size_t k = 0; k < static_cast<std::size_t>(field.components); ++k) {
      text +=
          comma + io::csv_text(field.components == 1 ? field.name : field.name + "_" + "XYZ"[k]);
      comma = ",";
    }
  for (std::size_t i = 0; i < points; ++i) {
    comma = "\n";
    for (const io::Field& field : fields)
      for (std::size_t k = 0; k < static_cast<std::size_t>(field.components); ++k) {
        const std::size_t at = i * static_cast<std::size_t>(field.components) + k;
        text += comma + io::csv_number(field.values[at]);
        comma = ",";
      }
  }
  return text + "\n";
}

}  // namespace

template <int Dim>
BodyCells body_cells(const model::BasicModel<Dim>& m) {
  struct Column {
    mesh::Block block;
    std::array<std::vector<double>, 4> values;  // body, material, section, number
  };
  BodyCells out;
  const BodyNumbers bodies = body_numbers(m);
  std::vector<std::string> sections, materials;
  std::map<cell::CellType, Column> columns;
  for (const model::BasicBulkSection<Dim>& section : m.sections) {
    sections.push_back(section.name);
    auto material = std::find(materials.begin(), materials.end(), section.material);
    if (material == materials.end()) material = materials.insert(materials.end(), section.material);
    const double number = static_cast<double>(material - materials.begin()) + 1;
    for (const mesh::CellRef& ref : section.cells) {
      const mesh::Block& from = m.mesh.blocks[static_cast<std::size_t>(ref.block)];
      Column& to = columns.try_emplace(from.type, Column{{from.type, {}}, {}}).first->second;
      const Index* const nodes = from.cell(ref.cell);
      to.block.connectivity.insert(to.block.connectivity.end(), nodes,
                                   nodes + cell::info(from.type).nodes);
      to.values[0].push_back(bodies.of(ref) + 1);
      to.values[1].push_back(number);
      to.values[2].push_back(static_cast<double>(sections.size()));
      to.values[3].push_back(static_cast<double>(mesh::cell_number(m.mesh, ref)));
    }
  }
  for (const char* const name : {"Body", "Material", "Section", "CellNumber"})
    out.fields.push_back(io::scalar_field(name, {}));
  for (auto& [type, column] : columns) {
    for (std::size_t k = 0; k < out.fields.size(); ++k)
      out.fields[k].values.insert(out.fields[k].values.end(), column.values[k].begin(),
                                  column.values[k].end());
    out.blocks.push_back(std::move(column.block));
  }
  out.names = {{"Bodies", bodies.names}, {"Materials", materials}, {"Sections", sections}};
  out.deformable = bodies.deformable;
  return out;
}

template BodyCells body_cells(const model::Model&);
template BodyCells body_cells(const model::Model3&);

template <int Dim>
FieldFiles<Dim>::FieldFiles(std::string folder, const deck::BasicBuilt<Dim>& built,
                            const deck::Output& output)
    : folder_(std::move(folder)),
      list_(folder_),
      built_(built),
      compress_(output.compress),
      tables_(output.contact_points),
      bodies_(body_cells(built.model)),
      rigid_(built.model),
      touched_(built.model.pairs.size(), false) {
  std::vector<Index> nodes(built.model.mesh.nodes.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  node_numbers_ = numbers_field(built.model.mesh, nodes);
}

template <int Dim>
std::string FieldFiles<Dim>::listed(const std::string& name) {
  list_.add(name);
  return folder_ + "/" + name;
}

template <int Dim>
void FieldFiles<Dim>::write(const model::BasicReached<Dim>& reached, double time) {
  const model::BasicSystem<Dim>& system = reached.system;
  const model::BasicState<Dim>& state = reached.state;
  const model::BasicNodalFields<Dim>& f = reached.fields();
  std::vector<io::Field> fields{vector_field("U", f.displacement), vector_field("RF", f.reaction),
                                tensor_field("S", f.stress), tensor_field("E", f.strain),
                                io::scalar_field("Mises", f.mises)};
  for (const auto& [name, values] : f.memory)
    fields.push_back(io::scalar_field(std::string(name), values));
  fields.push_back(node_numbers_);
  const std::string bodies = fmt::format("bodies_{:05d}.vtu", frame_);
  io::write_vtu(listed(bodies),
                {built_.model.mesh.nodes, bodies_.blocks, fields, bodies_.fields, bodies_.names},
                compress_);
  const std::size_t before = entries_.size();
  entries_.push_back({time, "bodies", bodies});
  if (!built_.model.rigid.empty()) {
    const std::string rigid = fmt::format("rigid_{:05d}.vtu", frame_);
    write_rigid(state, rigid);
    entries_.push_back({time, "rigid bodies", rigid});
  }
  const auto& contact = system.contact();
  for (std::size_t p = 0; p < built_.model.pairs.size(); ++p) {
    touched_[p] = touched_[p] || built_.model.pairs[p].group.empty() || touches(contact[p]);
    if (!touched_[p]) continue;
    const std::string stem = fmt::format("contact{}_{:05d}", p, frame_);
    write_contact(system, state, p, stem);
    entries_.push_back({time, built_.model.pairs[p].name, stem + ".vtu"});
  }
  ++frame_;
  if (!pvd_) pvd_.emplace(folder_ + "/results.pvd", std::span(entries_).first(before));
  pvd_->add(std::span(entries_).subspan(before));
}

template <int Dim>
void FieldFiles<Dim>::swings(const model::BasicReached<Dim>& reached, double frequency,
                             bool imaginary) {
  const model::BasicNodalFields<Dim>& f = reached.fields();
  const std::string ending = imaginary ? "_imaginary" : "";
  std::vector<io::Field> fields{
      vector_field("U" + ending, f.displacement), vector_field("RF" + ending, f.reaction),
      tensor_field("S" + ending, f.stress), tensor_field("E" + ending, f.strain)};
  if (!imaginary) {
    real_part_ = std::move(fields);
    return;
  }
  io::Field amplitude = fields[0];
  amplitude.name = "U_amplitude";
  for (std::size_t i = 0; i < amplitude.values.size(); ++i)
    amplitude.values[i] = std::hypot(amplitude.values[i], real_part_[0].values[i]);
  real_part_.insert(real_part_.end(), fields.begin(), fields.end());
  real_part_.push_back(std::move(amplitude));
  real_part_.push_back(node_numbers_);
  const std::string bodies = fmt::format("bodies_{:05d}.vtu", frame_);
  io::write_vtu(
      listed(bodies),
      {built_.model.mesh.nodes, bodies_.blocks, real_part_, bodies_.fields, bodies_.names},
      compress_);
  const std::size_t before = entries_.size();
  entries_.push_back({frequency, "bodies", bodies});
  ++frame_;
  if (!pvd_) pvd_.emplace(folder_ + "/results.pvd", std::span(entries_).first(before));
  pvd_->add(std::span(entries_).subspan(before));
}

template <int Dim>
void FieldFiles<Dim>::write_contact(const model::BasicSystem<Dim>& system,
                                    const model::BasicState<Dim>& state, std::size_t pair,
                                    const std::string& stem) {
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
    add_edge_contacts(m.pairs[pair].definition, m.reference, system.positions(state),
                      c.edge_contacts, points, u, cells);
  std::vector<io::Field> fields = contact_columns(c);
  io::Field numbers = numbers_field(m.mesh, c.nodes);  // none of crossings
  numbers.values.resize(points.size(), std::numeric_limits<double>::quiet_NaN());
  fields.insert(fields.begin(), {vector_field("U", u), numbers});
  io::write_vtu(listed(stem + ".vtu"), {points, cells, fields, {}}, compress_);
  if (!tables_) return;
  std::swap(fields[0], fields[1]);
  fields.insert(fields.begin() + 1, io::vector_field("place", points));
  io::write_file(listed(stem + ".csv"), table(fields, points.size()));
}

/// Rigid bodies in reference coordinates with their displacement.
template <int Dim>
void FieldFiles<Dim>::write_rigid(const model::BasicState<Dim>& state, const std::string& file) {
  RigidGrid grid;
  for (std::size_t b = 0; b < built_.model.rigid.size(); ++b) {
    const std::size_t before = grid.points.size();
    add_rigid(rigid_, built_.model, state, b, grid);
    for (std::size_t i = before; i < grid.points.size(); ++i) {
      const Vec<Dim> x = grid.points[i].template head<Dim>();
      grid.u.push_back(in_space(Vec<Dim>(state.rigid[b].position(x) - x)));
    }
  }
  io::Field body = io::scalar_field("Body", {});
  std::vector<mesh::Block> blocks;
  for (auto& [type, cells] : grid.cells) {
    for (const std::size_t b : cells.body)
      body.values.push_back(static_cast<double>(bodies_.deformable + b + 1));
    blocks.push_back(std::move(cells.block));
  }
  const std::array fields{io::vector_field("U", grid.u)};
  const std::array cell_fields{body};
  io::write_vtu(listed(file),
                {grid.points, blocks, fields, cell_fields, std::span(bodies_.names).first(1)},
                compress_);
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
  io::write_vtu(folder_ + "/last_iterate.vtu",
                {built_.model.mesh.nodes, bodies_.blocks, fields, bodies_.fields, bodies_.names},
                compress_);
}

namespace {

/// Displacements of the nodes of the mesh, times a factor.
template <int Dim>
std::vector<Vec<Dim>> of_mesh(std::size_t nodes, const Eigen::VectorXd& of_all, double factor) {
  std::vector<Vec<Dim>> u;
  for (std::size_t i = 0; i < nodes; ++i)
    u.push_back(factor * of_all.template segment<Dim>(Dim * static_cast<Eigen::Index>(i)));
  return u;
}

/// A field NAME_1, ... for each column, its largest displacement 1.
template <int Dim>
void add_shapes(std::size_t nodes, const std::string& name, const Eigen::MatrixXd& shapes,
                std::vector<io::Field>& fields) {
  for (Eigen::Index i = 0; i < shapes.cols(); ++i) {
    const Eigen::VectorXd shape = shapes.col(i);
    double largest = 0;
    for (const Vec<Dim>& u : of_mesh<Dim>(nodes, shape, 1)) largest = std::max(largest, u.norm());
    fields.push_back(vector_field(fmt::format("{}_{}", name, i + 1),
                                  of_mesh<Dim>(nodes, shape, largest > 0 ? 1 / largest : 1)));
  }
}

}  // namespace

template <int Dim>
void FieldFiles<Dim>::write_modes(const std::string& step, const model::BasicState<Dim>& state,
                                  const model::Vibrations& modes) {
  const std::size_t nodes = built_.model.mesh.nodes.size();
  const auto field = [&](const Eigen::VectorXd& of_all, double factor) {
    return of_mesh<Dim>(nodes, of_all, factor);
  };
  std::vector<io::Field> fields{vector_field("U", field(state.u, 1)), node_numbers_};
  const bool of_ring = !modes.diameters.empty();
  std::string rows = fmt::format("number,omega_squared,frequency{}\n", of_ring ? ",diameters" : "");
  for (Eigen::Index i = 0; i < modes.omega_squared.size(); ++i) {
    const Eigen::VectorXd shape = modes.shapes.col(i);
    double largest = 0;
    for (const Vec<Dim>& u : field(shape, 1)) largest = std::max(largest, u.norm());
    if (of_ring)
      for (const Vec<Dim>& u : field(modes.imaginary.col(i), 1))
        largest = std::max(largest, u.norm());
    const double factor = largest > 0 ? 1 / largest : 1;
    fields.push_back(vector_field(fmt::format("mode_{}", i + 1), field(shape, factor)));
    const double omega_squared = modes.omega_squared[i];
    rows += fmt::format("{},{},{}", i + 1, omega_squared, model::frequency(omega_squared));
    if (of_ring) {
      fields.push_back(vector_field(fmt::format("mode_{}_imaginary", i + 1),
                                    field(modes.imaginary.col(i), factor)));
      rows += fmt::format(",{}", modes.diameters[static_cast<std::size_t>(i)]);
    }
    rows += "\n";
  }
  io::write_vtu(listed(fmt::format("modes_{}.vtu", step)),
                {built_.model.mesh.nodes, bodies_.blocks, fields, bodies_.fields, bodies_.names},
                compress_);
  io::write_file(listed(fmt::format("modes_{}.csv", step)), rows);
}

template <int Dim>
void FieldFiles<Dim>::write_buckling(const std::string& step, const model::BasicState<Dim>& state,
                                     const model::Buckling& found) {
  const std::size_t nodes = built_.model.mesh.nodes.size();
  std::vector<io::Field> fields{vector_field("U", of_mesh<Dim>(nodes, state.u, 1)),
                                vector_field("added", of_mesh<Dim>(nodes, found.added, 1)),
                                node_numbers_};
  add_shapes<Dim>(nodes, "shape", found.shapes, fields);
  std::string rows = "number,factor\n";
  for (Eigen::Index i = 0; i < found.factors.size(); ++i)
    rows += fmt::format("{},{}\n", i + 1, found.factors[i]);
  io::write_vtu(listed(fmt::format("buckling_{}.vtu", step)),
                {built_.model.mesh.nodes, bodies_.blocks, fields, bodies_.fields, bodies_.names},
                compress_);
  io::write_file(listed(fmt::format("buckling_{}.csv", step)), rows);
}

template <int Dim>
void FieldFiles<Dim>::resume(std::vector<io::PvdEntry> written, std::vector<bool> touched) {
  namespace fs = std::filesystem;
  std::set<std::string> kept;
  for (const io::PvdEntry& entry : written) kept.insert(entry.file);
  std::error_code error;
  for (const std::string& name : list_.names())
    if ((name.ends_with(".vtu") || name.ends_with(".csv")) && !name.starts_with("modes_") &&
        !name.starts_with("buckling_") &&
        !kept.contains(fs::path(name).replace_extension(".vtu").string()))
      fs::remove(fs::path(folder_) / name, error);
  fs::remove(fs::path(folder_) / "last_iterate.vtu", error);
  entries_ = std::move(written);
  frame_ = static_cast<int>(std::count_if(entries_.begin(), entries_.end(),
                                          [](const auto& e) { return e.part == "bodies"; }));
  touched_ = std::move(touched);
  if (!entries_.empty()) pvd_.emplace(folder_ + "/results.pvd", entries_);
}

template class FieldFiles<2>;
template class FieldFiles<3>;

}  // namespace osculate::result
