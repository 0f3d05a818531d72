#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "osculate/mesh/generate_bricks.hpp"
#include "osculate/mesh/generate_space.hpp"
#include "osculate/mesh/support.hpp"
#include "osculate/mesh/surface.hpp"

namespace osculate::mesh {
namespace {

using cell::CellType;

constexpr std::array<char, 3> axis_letters{'x', 'y', 'z'};

/// Nodes of a ball. In the core |p[k]| <= core steps; around it the largest |p[k]| is the number of
/// core steps, and `layer` counts the steps outwards.
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
    const int n = core_steps();
    const std::int64_t width = 2 * n + 1;
    const std::int64_t key = ((layer * width + p[2] + n) * width + p[1] + n) * width + p[0] + n;
    const auto [place, is_new] = known_.try_emplace(key, static_cast<Index>(mesh_.nodes.size()));
    if (is_new) mesh_.nodes.push_back(position(p, layer));
    return place->second;
  }

 private:
  [[nodiscard]] Vec3 position(const Place& p, int layer) const {
    Vec3 cube;
    for (std::size_t k = 0; k < 3; ++k)
      cube[static_cast<Eigen::Index>(k)] = core_[static_cast<std::size_t>(std::abs(p[k]))];
    Vec3 x = round_place(cube, layers_[static_cast<std::size_t>(layer)]);
    for (std::size_t k = 0; k < 3; ++k)
      if (p[k] < 0) x[static_cast<Eigen::Index>(k)] *= -1;
    return spec_.center + spec_.radius * x;
  }

  Mesh& mesh_;
  const BallSpec& spec_;
  std::vector<double> core_, layers_;
  std::unordered_map<std::int64_t, Index> known_;
};

/// The signs of the octants that a ball has.
std::vector<Place> octants_of(const Place& sides) {
  std::vector<Place> octants;
  for (const int z : {1, -1})
    for (const int y : {1, -1})
      for (const int x : {1, -1})
        if (x * sides[0] >= 0 && y * sides[1] >= 0 && z * sides[2] >= 0)
          octants.push_back({x, y, z});
  return octants;
}

/// The core and the three caps of one octant.
void add_octant(Mesh& mesh, Set& volume, CellType type, const Place& octant, BallNodes& nodes) {
  const int n = nodes.core_steps();
  const int m = nodes.layer_steps();
  const bool mirror = octant[0] * octant[1] * octant[2] < 0;
  const auto node = [&](const Place& p, int layer) {
    return nodes.at({octant[0] * p[0], octant[1] * p[1], octant[2] * p[2]}, layer);
  };
  // Seen in a mirror, the first axis runs the other way.
  const auto first = [&](int p) { return mirror ? n - p : p; };
  fill_bricks(mesh, volume, type, {n, n, n}, [&](const Place& p) {
    return node({first(p[0]), p[1], p[2]}, 0);
  });
  for (std::size_t a = 0; a < 3; ++a)
    fill_bricks(mesh, volume, type, {n, n, m}, [&](const Place& p) {
      Place at{};
      at[(a + 1) % 3] = first(p[0]);
      at[(a + 2) % 3] = p[1];
      at[a] = n;
      return node(at, p[2]);
    });
}

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
  for (std::size_t s = 0; s < 4; ++s) {
    if (sides[s].cells.empty()) continue;
    sides[s].name =
        spec.name + (s == 0 ? ".surface" : fmt::format(".plane_{}", axis_letters[s - 1]));
    sides[s].dimension = 2;
    finish(sides[s]);
    mesh.sets.push_back(std::move(sides[s]));
  }
}

/// The centre, and where the surface meets the axes.
void add_ball_points(Mesh& mesh, const BallSpec& spec, BallNodes& nodes) {
  const auto add = [&](std::string name, const Place& p, int layer) {
    mesh.sets.push_back({std::move(name), 0, {}, {nodes.at(p, layer)}});
  };
  add(spec.name + ".center", {0, 0, 0}, 0);
  for (std::size_t k = 0; k < 3; ++k)
    for (const int sign : {1, -1}) {
      if (sign * spec.sides[k] < 0) continue;
      const bool other = sign < 0 && spec.sides[k] == 0;
      Place p{};
      p[k] = sign * nodes.core_steps();
      add(fmt::format("{}.pole_{}{}", spec.name, other ? "minus_" : "", axis_letters[k]), p,
          nodes.layer_steps());
    }
}

void check_ball(const Context& context, const Mesh& mesh, const BallSpec& spec) {
  if (spec.type != CellType::hex8 && spec.type != CellType::hex20 && spec.type != CellType::hex27)
    context.fail(fmt::format("cannot be made of {} cells; expected hex8, hex20, hex27",
                             cell::info(spec.type).name));
  if (!(spec.radius > 0) || !std::isfinite(spec.radius))
    context.fail(fmt::format("the radius must be a positive number, not {}", spec.radius));
  if (!spec.center.allFinite()) context.fail("the center must be finite");
  for (const int sign : spec.sides)
    if (sign < -1 || sign > 1)
      context.fail(fmt::format("the sides are given by three numbers 1, -1 or 0, not {}", sign));
  check_axis(context, "the core", {0, 1}, {spec.core_bias}, 1);
  check_axis(context, "the layers", {0, 1}, {spec.layer_bias}, 1);
  const double order = cell::info(spec.type).order;
  const double core =
      order * static_cast<double>(check_counts(context, "the core", 1, {spec.core}));
  const double layers =
      order * static_cast<double>(check_counts(context, "the layers", 1, {spec.layers}));
  check_size(context, mesh,
             static_cast<double>(octants_of(spec.sides).size()) *
                 (std::pow(core + 1, 3) + 3 * (core + 1) * (core + 1) * layers));
}

}  // namespace

void append_ball(Mesh& mesh, const BallSpec& spec, const core::SourceMark& mark) {
  const Context context{mark, fmt::format("ball '{}'", spec.name)};
  constexpr std::array<std::string_view, 11> endings{
      ".surface", ".plane_x", ".plane_y",      ".plane_z",      ".center",      ".pole_x",
      ".pole_y",  ".pole_z",  ".pole_minus_x", ".pole_minus_y", ".pole_minus_z"};
  check_names(mesh, context, spec.name, endings);
  check_ball(context, mesh, spec);
  BallNodes nodes(mesh, spec, cell::info(spec.type).order);
  Set volume{spec.name, 3, {}, {}};
  for (const Place& octant : octants_of(spec.sides))
    add_octant(mesh, volume, spec.type, octant, nodes);
  finish(volume);
  const Surface skin = surface_facets(mesh, face_table(mesh, volume.cells), volume);
  mesh.sets.push_back(std::move(volume));
  add_ball_sides(mesh, spec, skin);
  add_ball_points(mesh, spec, nodes);
}

}  // namespace osculate::mesh
