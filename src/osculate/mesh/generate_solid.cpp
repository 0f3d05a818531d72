#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "osculate/mesh/generate_bricks.hpp"
#include "osculate/mesh/generate_space.hpp"

namespace osculate::mesh {
namespace {

using cell::CellType;
/// The lattice of nodes that a box may have; those that its cells do not use are -1.
struct Lattice {
  std::array<std::size_t, 3> size;
  std::vector<Index> node;
  [[nodiscard]] std::size_t index(const Place& p) const {
    return (static_cast<std::size_t>(p[2]) * size[1] + static_cast<std::size_t>(p[1])) * size[0] +
           static_cast<std::size_t>(p[0]);
  }
  [[nodiscard]] int last(std::size_t axis) const { return static_cast<int>(size[axis]) - 1; }
  [[nodiscard]] Place end() const { return {last(0), last(1), last(2)}; }
};

/// Nodes that cells use, in the order of the lattice.
void number_nodes(Mesh& mesh, Lattice& lattice, const Pattern& pattern, const Place& steps,
                  const std::array<std::vector<double>, 3>& x) {
  for_each_brick(lattice.end(), steps, [&](const Place& origin) {
    for (const std::vector<Place>& cell : pattern)
      for (const Place& p : cell) lattice.node[lattice.index(origin + p)] = 0;
  });
  std::size_t at = 0;
  for (const double z : x[2])
    for (const double y : x[1])
      for (const double first : x[0]) {
        Index& node = lattice.node[at++];
        if (node < 0) continue;
        node = static_cast<Index>(mesh.nodes.size());
        mesh.nodes.emplace_back(first, y, z);
      }
}

constexpr std::array<std::string_view, 6> side_names{".left", ".right",  ".front",
                                                     ".back", ".bottom", ".top"};

/// The side of the box that a face lies on: 2 axis, plus 1 for the upper end; -1 if inside.
int side_of(const Lattice& lattice, const cell::CellFace& face, const std::vector<Place>& cell,
            const Place& origin) {
  const auto nodes = static_cast<std::size_t>(cell::info(face.type).nodes);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true}) {
      bool all = true;
      for (std::size_t k = 0; k < nodes && all; ++k) {
        const Place& local = cell[static_cast<std::size_t>(face.nodes[k])];
        all = local[axis] + origin[axis] == (upper ? lattice.last(axis) : 0);
      }
      if (all) return static_cast<int>(2 * axis) + (upper ? 1 : 0);
    }
  return -1;
}

/// All nodes on the six sides: the facets around a shell18 do not have those in the middle.
void add_side_nodes(const Lattice& lattice, std::array<Set, 6>& sides) {
  Place p{};
  for (p[2] = 0; p[2] <= lattice.last(2); ++p[2])
    for (p[1] = 0; p[1] <= lattice.last(1); ++p[1])
      for (p[0] = 0; p[0] <= lattice.last(0); ++p[0]) {
        const Index node = lattice.node[lattice.index(p)];
        for (std::size_t axis = 0; axis < 3 && node >= 0; ++axis) {
          if (p[axis] == 0) sides[2 * axis].nodes.push_back(node);
          if (p[axis] == lattice.last(axis)) sides[2 * axis + 1].nodes.push_back(node);
        }
      }
}

/// Volume cells, and area cells on the six sides.
void add_bricks(Mesh& mesh, const SolidBoxSpec& spec, const Lattice& lattice,
                const Pattern& pattern, const Place& steps) {
  const cell::CellInfo& info = cell::info(spec.type);
  Set volume{spec.name, 3, {}, {}};
  std::array<Set, 6> sides;
  const Index block = block_index(mesh, spec.type);
  std::vector<Index> nodes;
  std::vector<Index> corners;
  for_each_brick(lattice.end(), steps, [&](const Place& origin) {
    for (const std::vector<Place>& cell : pattern) {
      nodes.clear();
      for (const Place& p : cell) nodes.push_back(lattice.node[lattice.index(origin + p)]);
      add_cell(mesh, block, volume, nodes);
      for (int f = 0; f < info.face_count; ++f) {
        const cell::CellFace& face = info.faces[static_cast<std::size_t>(f)];
        const int side = side_of(lattice, face, cell, origin);
        if (side < 0) continue;
        corners.clear();
        for (int k = 0; k < cell::info(face.type).nodes; ++k)
          corners.push_back(
              nodes[static_cast<std::size_t>(face.nodes[static_cast<std::size_t>(k)])]);
        add_cell(mesh, block_index(mesh, face.type), sides[static_cast<std::size_t>(side)],
                 corners);
      }
    }
  });
  finish(volume);
  mesh.sets.push_back(std::move(volume));
  add_side_nodes(lattice, sides);
  for (std::size_t s = 0; s < 6; ++s) {
    sides[s].name = spec.name + std::string(side_names[s]);
    sides[s].dimension = 2;
    finish(sides[s]);
    mesh.sets.push_back(std::move(sides[s]));
  }
}

/// Name of an end of an axis, as in bottom_front_left.
constexpr std::array<std::array<std::string_view, 2>, 3> end_names{
    {{"left", "right"}, {"front", "back"}, {"bottom", "top"}}};

/// Name of an edge along `axis` (3: a corner) at the ends given for the other axes.
std::string place_name(std::size_t axis, const std::array<std::size_t, 3>& ends) {
  std::string name;
  for (const std::size_t k : {2U, 1U, 0U})
    if (k != axis) name += (name.empty() ? "." : "_") + std::string(end_names[k][ends[k]]);
  return name;
}

template <class Visit>
void for_each_end(const Visit& visit) {
  for (std::size_t k = 0; k < 8; ++k) visit(std::array<std::size_t, 3>{k % 2, k / 2 % 2, k / 4});
}

void add_edges_and_corners(Mesh& mesh, const std::string& name, const Lattice& lattice,
                           const Place& steps) {
  for (std::size_t axis = 0; axis < 4; ++axis)
    for_each_end([&](const std::array<std::size_t, 3>& ends) {
      if (axis < 3 && ends[axis] == 1) return;
      Place p{};
      for (std::size_t k = 0; k < 3; ++k) p[k] = ends[k] == 1 ? lattice.last(k) : 0;
      if (axis == 3) {
        mesh.sets.push_back({name + place_name(3, ends), 0, {}, {lattice.node[lattice.index(p)]}});
        return;
      }
      std::vector<Index> nodes;
      for (p[axis] = 0; p[axis] <= lattice.last(axis); ++p[axis])
        nodes.push_back(lattice.node[lattice.index(p)]);
      Set chain = add_chain(mesh, name + place_name(axis, ends), nodes, steps[axis]);
      mesh.sets.push_back(std::move(chain));
    });
}

std::vector<std::string> box_endings() {
  std::vector<std::string> endings(side_names.begin(), side_names.end());
  for (std::size_t axis = 0; axis < 4; ++axis)
    for_each_end([&](const std::array<std::size_t, 3>& ends) {
      if (axis == 3 || ends[axis] == 0) endings.push_back(place_name(axis, ends));
    });
  return endings;
}

void check_box(const Context& context, const Mesh& mesh, const SolidBoxSpec& spec,
               const Place& steps) {
  constexpr std::array<std::string_view, 3> names{"x", "y", "z"};
  double nodes = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    check_axis(context, names[k], spec.breaks[k], spec.bias[k], spec.elements[k].size());
    const std::int64_t n =
        check_counts(context, names[k], spec.breaks[k].size() - 1, spec.elements[k]);
    nodes *= static_cast<double>(steps[k]) * static_cast<double>(n) + 1;
  }
  check_size(context, mesh, nodes);
  if (!std::isfinite(spec.angle) || !spec.about.allFinite() || !spec.axis.allFinite())
    context.fail("the rotation must be given by finite numbers");
  if (!(spec.axis.norm() > 0)) context.fail("the axis of the rotation must have a direction");
}

}  // namespace

void append_solid_box(Mesh& mesh, const SolidBoxSpec& spec, const core::SourceMark& mark) {
  const Context context{mark, fmt::format("box '{}'", spec.name)};
  const std::vector<std::string> endings = box_endings();
  const std::vector<std::string_view> views(endings.begin(), endings.end());
  check_names(mesh, context, spec.name, views);
  if (cell::info(spec.type).dimension != 3)
    context.fail(
        fmt::format("cannot be made of {} cells with three coordinates; expected hex8, "
                    "hex20, hex27, tet4, tet10, wedge6, wedge15, shell18",
                    cell::info(spec.type).name));
  const Place steps = steps_of(spec.type);
  check_box(context, mesh, spec, steps);
  std::array<std::vector<double>, 3> x;
  Lattice lattice{};
  for (std::size_t k = 0; k < 3; ++k) {
    x[k] = axis(spec.breaks[k], spec.elements[k], spec.bias[k], steps[k]);
    lattice.size[k] = x[k].size();
  }
  lattice.node.assign(x[0].size() * x[1].size() * x[2].size(), -1);
  const std::size_t first = mesh.nodes.size();
  const Pattern pattern = pattern_of(spec.type);
  number_nodes(mesh, lattice, pattern, steps, x);
  turn(std::span(mesh.nodes).subspan(first), spec.angle, spec.about, spec.axis);
  add_bricks(mesh, spec, lattice, pattern, steps);
  add_edges_and_corners(mesh, spec.name, lattice, steps);
}

}  // namespace osculate::mesh
