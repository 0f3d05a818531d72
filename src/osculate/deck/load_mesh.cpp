#include "osculate/deck/build.hpp"
#include "osculate/io/gmsh.hpp"
#include "osculate/mesh/generate.hpp"
#include "osculate/mesh/generate_space.hpp"

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
};

}  // namespace

mesh::Mesh load_mesh(const Description& description) {
  const MeshSource& source = description.mesh;
  if (source.file) {
    try {
      return io::read_gmsh(source.path);
    } catch (const core::InputError& error) {
      throw core::InputError(source.file->mark, error.what());
    }
  }
  mesh::Mesh mesh;
  for (const GeneratedPart& part : source.generated)
    std::visit(AppendPart{mesh, part.name}, part.shape);
  return mesh;
}

}  // namespace osculate::deck
