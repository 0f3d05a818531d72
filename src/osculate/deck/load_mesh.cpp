#include <fmt/format.h>

#include "osculate/deck/build_context.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/deck/parse_parts.hpp"
#include "osculate/deck/pretension.hpp"
#include "osculate/io/gmsh.hpp"
#include "osculate/io/inp/deck_mesh.hpp"
#include "osculate/io/mesh_format.hpp"
#include "osculate/mesh/generate.hpp"
#include "osculate/mesh/generate_ring.hpp"
#include "osculate/mesh/generate_space.hpp"
#include "osculate/mesh/set_algebra.hpp"

namespace osculate::deck {
namespace {

mesh::BoxSpec flat_box(const std::string& name, const Box& box) {
  mesh::BoxSpec spec;
  spec.name = name;
  spec.x = box.breakpoints[0].value;
  spec.y = box.breakpoints[1].value;
  spec.nx = box.elements[0];
  spec.ny = box.elements[1];
  spec.bias_x = box.bias[0];
  spec.bias_y = box.bias[1];
  spec.type = box.type.value;
  if (box.crown)
    spec.crown = mesh::Crown{
        box.crown->side == BoxSide::top ? mesh::Crown::Side::top : mesh::Crown::Side::bottom,
        box.crown->radius.value, box.crown->at.value};
  spec.angle = box.angle.value;
  spec.about = box.about.head<2>();
  return spec;
}

mesh::SolidBoxSpec solid_box(const std::string& name, const Box& box) {
  mesh::SolidBoxSpec spec;
  spec.name = name;
  for (std::size_t k = 0; k < 3; ++k) spec.breaks[k] = box.breakpoints[k].value;
  spec.elements = box.elements;
  spec.bias = box.bias;
  spec.type = box.type.value;
  spec.angle = box.angle.value;
  spec.about = box.about;
  spec.axis = box.axis;
  return spec;
}

/// Adds one part; the shapes that the mesh layer describes itself already have their name.
struct AppendPart {
  mesh::Mesh& mesh;
  const Name& name;

  void operator()(const Box& box) const {
    if (box.solid())
      mesh::append_solid_box(mesh, solid_box(name.value, box), name.mark);
    else
      mesh::append_box(mesh, flat_box(name.value, box), name.mark);
  }
  void operator()(const Ring& ring) const {
    if (ring.box.solid())
      mesh::append_ring(mesh, solid_box(name.value, ring.box), ring.center, ring.along, name.mark);
    else
      mesh::append_ring(mesh, flat_box(name.value, ring.box), ring.center, name.mark);
  }
  void operator()(const LineMesh& line) const {
    mesh::append_line(mesh, {name.value, line.points.value, line.elements, line.type.value},
                      name.mark);
  }
  void operator()(const mesh::GridSpec& grid) const { mesh::append_grid(mesh, grid, name.mark); }
  void operator()(const mesh::TubeSpec& tube) const { mesh::append_tube(mesh, tube, name.mark); }
  void operator()(const mesh::SphereSpec& sphere) const {
    mesh::append_sphere(mesh, sphere, name.mark);
  }
  void operator()(const mesh::BallSpec& ball) const { mesh::append_ball(mesh, ball, name.mark); }
  void operator()(const mesh::DiscSpec& disc) const { mesh::append_disc(mesh, disc, name.mark); }
};

/// What a file that is put beside others may not have in a plane model.
void require_plane(const MeshFile& source, const mesh::Mesh& mesh) {
  if (mesh::has_volumes(mesh))
    throw core::InputError(
        source.file.mark,
        fmt::format("the mesh of {} has volume cells, and this model is plane: no section has the "
                    "element solid or solid_shell",
                    quoted(source.file.value)));
  require_in_plane(mesh, source.file.mark);
}

/// Of a deck that was translated, which told of what it leaves out.
mesh::Mesh mesh_of_deck(const std::string& path) {
  const std::string content = io::read_file(path);
  return io::inp::deck_mesh(io::inp::read_cards(content, path)).mesh;
}

mesh::Mesh read_file(const MeshFile& source) {
  mesh::Mesh mesh;
  try {
    mesh = names_a_deck(source.file.mark.file) ? mesh_of_deck(source.path)
                                               : io::read_mesh(source.path);
  } catch (const core::InputError& error) {
    throw core::InputError(source.file.mark, error.what());
  }
  mesh::place(mesh, source.placement);
  return mesh;
}

mesh::Mesh mesh_of(const MeshSource& source, int dimension) {
  if (source.files.size() == 1 && source.files[0].name.value.empty())
    return read_file(source.files[0]);
  mesh::Mesh mesh;
  for (const GeneratedPart& part : source.generated)
    std::visit(AppendPart{mesh, part.name}, part.shape);
  for (const MeshFile& file : source.files) {
    const mesh::Mesh part = read_file(file);
    if (dimension == 2) require_plane(file, part);
    mesh::append_mesh(mesh, part, file.name.value, file.name.mark);
  }
  return mesh;
}

const mesh::Set& find_set(const Description& description, const mesh::Mesh& mesh,
                          const Name& name) {
  if (const mesh::Set* const found = mesh.find_set(name.value)) return *found;
  if (description.find_rigid(name.value))
    throw core::InputError(
        name.mark, fmt::format("'{}' is a rigid body, which is no part of a set", name.value));
  std::vector<std::string> names;
  for (const mesh::Set& set : mesh.sets) names.push_back(set.name);
  throw unknown_set(name, names);
}

/// Adds what one entry of `sets` defines.
void add_set(const Description& description, const SetDefinition& definition, mesh::Mesh& mesh) {
  const std::string& name = definition.name.value;
  if (mesh.find_set(name))
    throw core::InputError(definition.name.mark,
                           fmt::format("the mesh has a set '{}' already", name));
  const auto find = [&](const Name& part) { return &find_set(description, mesh, part); };
  mesh::Set set;
  if (!definition.of) {
    std::vector<const mesh::Set*> parts;
    for (const Name& part : definition.all_of) parts.push_back(find(part));
    set = mesh::unite(mesh, name, parts);
  } else {
    set = *find(*definition.of);
    for (const Name& part : definition.within) set = mesh::common(mesh, name, set, *find(part));
    for (const Name& part : definition.without) set = mesh::without(mesh, name, set, *find(part));
  }
  if (set.nodes.empty())
    throw core::InputError(definition.name.mark, fmt::format("nothing is in the set '{}'", name));
  mesh.sets.push_back(std::move(set));
}

}  // namespace

mesh::Mesh load_mesh(const Description& description) {
  mesh::Mesh mesh = mesh_of(description.mesh, dimension(description));
  mesh::remember_names(mesh);
  for (const SetDefinition& definition : description.sets) add_set(description, definition, mesh);
  for (const Pretension& pretension : description.pretension) cut(pretension, mesh);
  return mesh;
}

}  // namespace osculate::deck
