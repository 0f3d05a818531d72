#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "osculate/cell/volume_shape.hpp"
#include "osculate/mesh/generate_space.hpp"
#include "osculate/mesh/generate_support.hpp"
#include "osculate/mesh/support.hpp"
#include "osculate/mesh/surface.hpp"

namespace osculate::mesh {
namespace {

using cell::CellType;
using Place = std::array<int, 3>;  ///< of a node in the lattice of a box

// ---- cells of one brick -----------------------------------------------------------------------

/// Cells that fill a brick of the lattice, each by the places of its nodes.
using Pattern = std::vector<std::vector<Place>>;

/// The linear cells that fill a brick, by their corners.
Pattern linear_pattern(CellType type) {
  switch (cell::info(type).corners) {
    case 4: {
      // Six paths along the edges from corner 000 to corner 111.
      return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}},
              {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {1, 1, 1}},
              {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}},
              {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 1, 1}},
              {{0, 0, 0}, {0, 1, 1}, {0, 0, 1}, {1, 1, 1}},
              {{0, 0, 0}, {1, 0, 1}, {1, 0, 0}, {1, 1, 1}}};
    }
    case 6:
      return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}},
              {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
    default:
      return {
          {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
  }
}

/// Steps of the lattice along one element in x, y and z.
Place steps_of(CellType type) {
  if (type == CellType::shell18) return {2, 2, 1};
  const int order = cell::info(type).order;
  return {order, order, order};
}

CellType linear_type(CellType type) {
  switch (cell::info(type).corners) {
    case 4:
      return CellType::tet4;
    case 6:
      return CellType::wedge6;
    default:
      return CellType::hex8;
  }
}

/// The cells that fill a brick: every node lies where the linear shape functions put it.
Pattern pattern_of(CellType type) {
  const Place steps = steps_of(type);
  Pattern pattern;
  for (const std::vector<Place>& corners : linear_pattern(type)) {
    std::vector<Place> nodes;
    for (int k = 0; k < cell::info(type).nodes; ++k) {
      const cell::VolumeShape shape =
          cell::volume_shape(linear_type(type), cell::volume_node(type, k));
      Vec3 x = Vec3::Zero();
      for (std::size_t c = 0; c < corners.size(); ++c)
        for (std::size_t i = 0; i < 3; ++i)
          x[static_cast<Eigen::Index>(i)] +=
              shape.n[static_cast<Eigen::Index>(c)] * corners[c][i] * steps[i];
      nodes.push_back({static_cast<int>(std::lround(x.x())), static_cast<int>(std::lround(x.y())),
                       static_cast<int>(std::lround(x.z()))});
    }
    pattern.push_back(std::move(nodes));
  }
  return pattern;
}

// ---- boxes ------------------------------------------------------------------------------------

/// The lattice of nodes that a box may have; those that its cells do not use are -1.
struct Lattice {
  std::array<std::size_t, 3> size;
  std::vector<Index> node;
  [[nodiscard]] std::size_t index(const Place& p) const {
    return (static_cast<std::size_t>(p[2]) * size[1] + static_cast<std::size_t>(p[1])) * size[0] +
           static_cast<std::size_t>(p[0]);
  }
  [[nodiscard]] int last(std::size_t axis) const { return static_cast<int>(size[axis]) - 1; }
};

/// Calls `visit` with the lowest corner of every brick of the lattice.
template <class Visit>
void for_each_brick(const Lattice& lattice, const Place& steps, const Visit& visit) {
  Place p{};
  for (p[2] = 0; p[2] < lattice.last(2); p[2] += steps[2])
    for (p[1] = 0; p[1] < lattice.last(1); p[1] += steps[1])
      for (p[0] = 0; p[0] < lattice.last(0); p[0] += steps[0]) visit(p);
}

Place sum(const Place& a, const Place& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

/// Nodes that cells use, in the order of the lattice.
void number_nodes(Mesh& mesh, Lattice& lattice, const Pattern& pattern, const Place& steps,
                  const std::array<std::vector<double>, 3>& x) {
  for_each_brick(lattice, steps, [&](const Place& origin) {
    for (const std::vector<Place>& cell : pattern)
      for (const Place& p : cell) lattice.node[lattice.index(sum(origin, p))] = 0;
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
  for_each_brick(lattice, steps, [&](const Place& origin) {
    for (const std::vector<Place>& cell : pattern) {
      nodes.clear();
      for (const Place& p : cell) nodes.push_back(lattice.node[lattice.index(sum(origin, p))]);
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

void turn_nodes(Mesh& mesh, std::size_t first, const SolidBoxSpec& spec) {
  const Vec2 d = direction(spec.angle);
  if (d.x() == 1.0) return;
  const Vec3 k = spec.axis / spec.axis.norm();
  for (std::size_t i = first; i < mesh.nodes.size(); ++i) {
    const Vec3 arm = mesh.nodes[i] - spec.about;
    const Vec3 along = k * k.dot(arm);
    mesh.nodes[i] = spec.about + along + (arm - along) * d.x() + k.cross(arm) * d.y();
  }
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

// ---- balls ------------------------------------------------------------------------------------

/// Nodes of an octant of a ball. In the core 0 <= p[k] <= core steps; around it the largest p[k]
/// is the number of core steps, and `layer` counts the steps outwards.
class BallNodes {
 public:
  BallNodes(Mesh& mesh, const BallSpec& spec, int order)
      : mesh_(mesh),
        spec_(spec),
        core_(axis({0, 1}, {spec.core}, {spec.core_bias}, order)),
        layers_(axis({0, 1}, {spec.layers}, {spec.layer_bias}, order)) {}

  [[nodiscard]] int core_steps() const { return static_cast<int>(core_.size()) - 1; }
  [[nodiscard]] int layer_steps() const { return static_cast<int>(layers_.size()) - 1; }

  Index at(const Place& p, int layer) {
    const auto width = static_cast<std::int64_t>(core_.size());
    const std::int64_t key = ((layer * width + p[2]) * width + p[1]) * width + p[0];
    const auto [place, is_new] = known_.try_emplace(key, static_cast<Index>(mesh_.nodes.size()));
    if (is_new) mesh_.nodes.push_back(position(p, layer));
    return place->second;
  }

 private:
  [[nodiscard]] Vec3 position(const Place& p, int layer) const {
    Vec3 cube, ray;
    for (Eigen::Index k = 0; k < 3; ++k) {
      cube[k] = core_[static_cast<std::size_t>(p[static_cast<std::size_t>(k)])];
      ray[k] = cube[k] == 1.0 ? 1.0 : std::tan(0.25 * std::numbers::pi * cube[k]);
    }
    const double size = cube.maxCoeff();
    const Vec3 on_sphere = size > 0 ? Vec3(ray / ray.norm()) : Vec3(Vec3::Zero());
    // Half way between a cube and a ball, so that no corner gets flat.
    const Vec3 inner = 0.25 * (cube + on_sphere * size);
    const double out = layers_[static_cast<std::size_t>(layer)];
    Vec3 x = layer == layer_steps() ? on_sphere : Vec3(inner + (on_sphere - inner) * out);
    for (Eigen::Index k = 0; k < 3; ++k)
      x[k] = spec_.center[k] + spec_.octant[static_cast<std::size_t>(k)] * (spec_.radius * x[k]);
    return x;
  }

  Mesh& mesh_;
  const BallSpec& spec_;
  std::vector<double> core_, layers_;
  std::unordered_map<std::int64_t, Index> known_;
};

/// Corners and further nodes of bricks of the core or of a cap, by nodes(i, j, k) of a local
/// lattice that is right-handed in the first octant.
struct BallCells {
  Mesh& mesh;
  const cell::CellInfo& info;
  Pattern pattern;
  Place steps;
  bool mirror;  ///< the octant turns cells inside out
  Set volume;

  template <class Node>
  void fill(const Place& size, const Node& node) {
    const Index block = block_index(mesh, info.type);
    std::vector<Index> nodes;
    const Lattice lattice{
        {static_cast<std::size_t>(size[0]) + 1, static_cast<std::size_t>(size[1]) + 1,
         static_cast<std::size_t>(size[2]) + 1},
        {}};
    for_each_brick(lattice, steps, [&](const Place& origin) {
      nodes.clear();
      for (const Place& p : pattern.front()) {
        Place at = sum(origin, p);
        // Seen in a mirror, the brick's first axis runs the other way.
        if (mirror) at[0] = origin[0] + steps[0] - p[0];
        nodes.push_back(node(at));
      }
      add_cell(mesh, block, volume, nodes);
    });
  }
};

/// Area cells of the free faces of the ball on its surface (side 0) and its planes of symmetry.
void add_ball_sides(Mesh& mesh, const BallSpec& spec, const Surface& skin) {
  std::array<Set, 4> sides;
  const double close = 1e-9 * spec.radius;
  for (const SurfaceFacet& facet : skin.facets) {
    std::size_t side = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      const bool flat = std::all_of(facet.nodes().begin(), facet.nodes().end(), [&](Index node) {
        return std::abs(point(mesh, node)[axis] - spec.center[axis]) < close;
      });
      if (flat) side = k + 1;
    }
    add_cell(mesh, block_index(mesh, facet.type), sides[side], facet.nodes());
  }
  constexpr std::array<std::string_view, 4> names{".surface", ".plane_x", ".plane_y", ".plane_z"};
  for (std::size_t s = 0; s < 4; ++s) {
    sides[s].name = spec.name + std::string(names[s]);
    sides[s].dimension = 2;
    finish(sides[s]);
    mesh.sets.push_back(std::move(sides[s]));
  }
}

void check_ball(const Context& context, const Mesh& mesh, const BallSpec& spec) {
  if (spec.type != CellType::hex8 && spec.type != CellType::hex20 && spec.type != CellType::hex27)
    context.fail(fmt::format("cannot be made of {} cells; expected hex8, hex20, hex27",
                             cell::info(spec.type).name));
  if (!(spec.radius > 0) || !std::isfinite(spec.radius))
    context.fail(fmt::format("the radius must be a positive number, not {}", spec.radius));
  if (!spec.center.allFinite()) context.fail("the center must be finite");
  for (const int sign : spec.octant)
    if (sign != 1 && sign != -1)
      context.fail(fmt::format("the octant is given by three signs 1 or -1, not {}", sign));
  check_axis(context, "the core", {0, 1}, {spec.core_bias}, 1);
  check_axis(context, "the layers", {0, 1}, {spec.layer_bias}, 1);
  const double order = cell::info(spec.type).order;
  const double core =
      order * static_cast<double>(check_counts(context, "the core", 1, {spec.core}));
  const double layers =
      order * static_cast<double>(check_counts(context, "the layers", 1, {spec.layers}));
  check_size(context, mesh, std::pow(core + 1, 3) + 3 * (core + 1) * (core + 1) * layers);
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
  turn_nodes(mesh, first, spec);
  add_bricks(mesh, spec, lattice, pattern, steps);
  add_edges_and_corners(mesh, spec.name, lattice, steps);
}

void append_ball(Mesh& mesh, const BallSpec& spec, const core::SourceMark& mark) {
  const Context context{mark, fmt::format("ball '{}'", spec.name)};
  constexpr std::array<std::string_view, 8> endings{".surface", ".plane_x", ".plane_y", ".plane_z",
                                                    ".center",  ".pole_x",  ".pole_y",  ".pole_z"};
  check_names(mesh, context, spec.name, endings);
  check_ball(context, mesh, spec);
  const Place steps = steps_of(spec.type);
  BallNodes nodes(mesh, spec, steps[0]);
  const int n = nodes.core_steps();
  const int m = nodes.layer_steps();
  BallCells cells{mesh,
                  cell::info(spec.type),
                  pattern_of(spec.type),
                  steps,
                  spec.octant[0] * spec.octant[1] * spec.octant[2] < 0,
                  {spec.name, 3, {}, {}}};
  cells.fill({n, n, n}, [&](const Place& p) { return nodes.at(p, 0); });
  for (std::size_t a = 0; a < 3; ++a)
    cells.fill({n, n, m}, [&](const Place& p) {
      Place at{};
      at[(a + 1) % 3] = p[0];
      at[(a + 2) % 3] = p[1];
      at[a] = n;
      return nodes.at(at, p[2]);
    });
  finish(cells.volume);
  const Surface skin = surface_facets(mesh, face_table(mesh, cells.volume.cells), cells.volume);
  mesh.sets.push_back(std::move(cells.volume));
  add_ball_sides(mesh, spec, skin);
  mesh.sets.push_back({spec.name + ".center", 0, {}, {nodes.at({0, 0, 0}, 0)}});
  mesh.sets.push_back({spec.name + ".pole_x", 0, {}, {nodes.at({n, 0, 0}, m)}});
  mesh.sets.push_back({spec.name + ".pole_y", 0, {}, {nodes.at({0, n, 0}, m)}});
  mesh.sets.push_back({spec.name + ".pole_z", 0, {}, {nodes.at({0, 0, n}, m)}});
}

}  // namespace osculate::mesh
