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
std::vector<io::Field> FieldFiles<Dim>::body_fields(const model::BasicReached<Dim>& reached) const {
  const model::BasicNodalFields<Dim>& f = reached.fields();
  std::vector<io::Field> fields{vector_field("U", f.displacement), vector_field("RF", f.reaction),
                                tensor_field("S", f.stress), tensor_field("E", f.strain),
                                io::scalar_field("Mises", f.mises)};
  for (const auto& [name, values] : f.memory)
    fields.push_back(io::scalar_field(std::string(name), values));
  fields.push_back(node_numbers_);
  return fields;
}

template <int Dim>
std::vector<DataSet> FieldFiles<Dim>::data_sets(const model::BasicReached<Dim>& reached) const {
  std::vector<DataSet> sets{
      {"bodies", built_.model.mesh.nodes, bodies_.blocks, body_fields(reached), bodies_.fields}};
  if (!built_.model.rigid.empty())
    sets.push_back(rigid_set(built_.model, rigid_, reached.state, bodies_.deformable));
  const auto& contact = reached.system.contact();
  for (std::size_t p = 0; p < built_.model.pairs.size(); ++p)
    if (touched_[p] || built_.model.pairs[p].group.empty() || touches(contact[p]))
      sets.push_back(contact_set(reached.system, built_.model, reached.state, p));
  return sets;
}

template <int Dim>
void FieldFiles<Dim>::write(const model::BasicReached<Dim>& reached, double time) {
  const model::BasicSystem<Dim>& system = reached.system;
  const model::BasicState<Dim>& state = reached.state;
  const std::vector<io::Field> fields = body_fields(reached);
  const std::string bodies = fmt::format("bodies_{:05d}.vtu", frame_);
  io::write_vtu(listed(bodies),
                {built_.model.mesh.nodes, bodies_.blocks, fields, bodies_.fields, bodies_.names},
                compress_, built_.options.threads);
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
      compress_, built_.options.threads);
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
  DataSet set = contact_set(system, built_.model, state, pair);
  io::write_vtu(listed(stem + ".vtu"), {set.points, set.cells, set.point_fields, {}}, compress_,
                built_.options.threads);
  if (!tables_) return;
  std::vector<io::Field>& fields = set.point_fields;
  std::swap(fields[0], fields[1]);
  fields.insert(fields.begin() + 1, io::vector_field("place", set.points));
  io::write_file(listed(stem + ".csv"), table(fields, set.points.size()));
}

template <int Dim>
void FieldFiles<Dim>::write_rigid(const model::BasicState<Dim>& state, const std::string& file) {
  const DataSet set = rigid_set(built_.model, rigid_, state, bodies_.deformable);
  io::write_vtu(
      listed(file),
      {set.points, set.cells, set.point_fields, set.cell_fields, std::span(bodies_.names).first(1)},
      compress_, built_.options.threads);
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
                compress_, built_.options.threads);
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
                compress_, built_.options.threads);
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
                compress_, built_.options.threads);
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
