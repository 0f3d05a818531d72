#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "osculate/mesh/boundary.hpp"
#include "osculate/mesh/generate_bricks.hpp"
#include "osculate/mesh/generate_space.hpp"
#include "osculate/mesh/surface.hpp"

namespace osculate::mesh {
namespace {

using cell::CellType;

/// Sides of a disc or cylinder, by their bits in the mask of a node.
constexpr std::array<std::string_view, 5> disc_sides{".outer", ".from", ".to", ".bottom", ".top"};

/// A node of a disc: `p` in the core of a quarter, 0 <= p <= core steps; around it the larger of
/// both is the number of core steps, and `layer` counts the steps outwards.
struct DiscPlace {
  int quarter = 0;
  std::array<int, 2> p{};
  int layer = 0, height = 0;
};

/// Nodes by their places, and the sides that they are on.
class DiscNodes {
 public:
  DiscNodes(Mesh& mesh, const DiscSpec& spec, const Place& steps)
      : mesh_(mesh),
        spec_(spec),
        first_(mesh.nodes.size()),
        core_(axis({0, 1}, {spec.core}, {spec.core_bias}, steps[0])),
        layers_(axis({0, 1}, {spec.layers}, {spec.layer_bias}, steps[0])),
        heights_{0} {
    if (!spec.heights.empty()) heights_ = axis(spec.heights, spec.elements, spec.bias, steps[2]);
  }

  [[nodiscard]] int core_steps() const { return static_cast<int>(core_.size()) - 1; }
  [[nodiscard]] int layer_steps() const { return static_cast<int>(layers_.size()) - 1; }
  [[nodiscard]] int height_steps() const { return static_cast<int>(heights_.size()) - 1; }
  [[nodiscard]] bool closed() const { return spec_.quarters == 4; }

  Index at(DiscPlace d) {
    // The last straight edge of a quarter is the first one of the next.
    if (d.p[0] == 0) {
      d.quarter = d.p[1] == 0 ? 0 : (d.quarter + 1) % 4;
      d.p = {d.p[1], 0};
    }
    std::int64_t key = d.height;
    key = key * layers() + d.layer;
    key = key * (core_steps() + 1) + d.p[0];
    key = key * (core_steps() + 1) + d.p[1];
    key = key * 4 + d.quarter;
    const auto [place, is_new] = known_.try_emplace(key, static_cast<Index>(mesh_.nodes.size()));
    if (is_new) {
      mesh_.nodes.push_back(position(d));
      sides_.push_back(sides_of(d));
    }
    return place->second;
  }

  /// A bit for each of `disc_sides`.
  [[nodiscard]] unsigned sides(Index node) const {
    return sides_[static_cast<std::size_t>(node) - first_];
  }
  /// The nodes of one side.
  [[nodiscard]] std::vector<Index> on_side(std::size_t side) const {
    std::vector<Index> nodes;
    for (std::size_t n = 0; n < sides_.size(); ++n)
      if ((sides_[n] >> side & 1U) != 0) nodes.push_back(static_cast<Index>(first_ + n));
    return nodes;
  }

 private:
  [[nodiscard]] std::int64_t layers() const { return layer_steps() + 1; }
  [[nodiscard]] Vec3 position(const DiscPlace& d) const {
    const Vec3 square(core_[static_cast<std::size_t>(d.p[0])],
                      core_[static_cast<std::size_t>(d.p[1])], 0);
    const Vec3 x = round_place(square, layers_[static_cast<std::size_t>(d.layer)]);
    const Vec2 turned = direction(spec_.from + 90.0 * d.quarter);
    Vec3 out = spec_.center;
    out[(spec_.along + 1) % 3] += spec_.radius * (turned.x() * x.x() - turned.y() * x.y());
    out[(spec_.along + 2) % 3] += spec_.radius * (turned.y() * x.x() + turned.x() * x.y());
    out[spec_.along] += heights_[static_cast<std::size_t>(d.height)];
    return out;
  }
  [[nodiscard]] unsigned sides_of(const DiscPlace& d) const {
    const bool center = d.p[0] == 0;
    const bool straight = !closed() && d.p[1] == 0;
    const std::array<bool, 5> on{d.layer == layer_steps(), straight && d.quarter == 0,
                                 straight && (center || d.quarter == spec_.quarters), d.height == 0,
                                 d.height == height_steps()};
    unsigned mask = 0;
    for (std::size_t s = 0; s < on.size(); ++s) mask |= on[s] ? 1U << s : 0U;
    return mask;
  }

  Mesh& mesh_;
  const DiscSpec& spec_;
  std::size_t first_;
  std::vector<double> core_, layers_, heights_;
  std::vector<unsigned> sides_;  ///< of each node from `first_`
  std::unordered_map<std::int64_t, Index> known_;
};

/// Calls `visit` for the core and both caps of all quarters: columns, rows and the place of each of
/// their nodes, right-handed.
template <class Visit>
void for_each_patch(const DiscSpec& spec, const DiscNodes& nodes, const Visit& visit) {
  const int n = nodes.core_steps();
  const int m = nodes.layer_steps();
  for (int q = 0; q < spec.quarters; ++q) {
    visit(n, n, [=](int i, int j) { return DiscPlace{q, {i, j}, 0}; });
    visit(m, n, [=](int i, int j) { return DiscPlace{q, {n, j}, i}; });
    visit(n, m, [=](int i, int j) { return DiscPlace{q, {i, n}, j}; });
  }
}

Set disc_areas(Mesh& mesh, const DiscSpec& spec, DiscNodes& nodes) {
  Set all{spec.name, 2, {}, {}};
  const int order = cell::info(spec.type).order;
  for_each_patch(spec, nodes, [&](int columns, int rows, const auto& place) {
    Grid grid{order, static_cast<std::size_t>(columns) + 1, static_cast<std::size_t>(rows) + 1, {}};
    for (int j = 0; j <= rows; ++j)
      for (int i = 0; i <= columns; ++i) {
        const bool middle = spec.type == CellType::quad8 && i % 2 == 1 && j % 2 == 1;
        grid.node.push_back(middle ? -1 : nodes.at(place(i, j)));
      }
    const Set patch = add_areas(mesh, spec.name, spec.type, grid);
    all.cells.insert(all.cells.end(), patch.cells.begin(), patch.cells.end());
    all.nodes.insert(all.nodes.end(), patch.nodes.begin(), patch.nodes.end());
  });
  finish(all);
  return all;
}

Set cylinder_volumes(Mesh& mesh, const DiscSpec& spec, DiscNodes& nodes) {
  Set all{spec.name, 3, {}, {}};
  for_each_patch(spec, nodes, [&](int columns, int rows, const auto& place) {
    fill_bricks(mesh, all, spec.type, {columns, rows, nodes.height_steps()}, [&](const Place& p) {
      DiscPlace at = place(p[0], p[1]);
      at.height = p[2];
      return nodes.at(at);
    });
  });
  finish(all);
  return all;
}

/// The free facets, each on the side that all its nodes are on.
template <class Facet>
void add_disc_sides(Mesh& mesh, const DiscSpec& spec, const DiscNodes& nodes,
                    const std::vector<Facet>& skin) {
  std::array<Set, disc_sides.size()> sides;
  for (const Facet& facet : skin) {
    unsigned common = ~0U;
    for (const Index node : facet.nodes()) common &= nodes.sides(node);
    std::size_t side = 0;
    while ((common >> side & 1U) == 0) ++side;
    add_cell(mesh, block_index(mesh, facet.type), sides[side], facet.nodes());
  }
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (sides[s].cells.empty()) continue;
    sides[s].name = spec.name + std::string(disc_sides[s]);
    sides[s].dimension = spec.heights.empty() ? 1 : 2;
    sides[s].nodes = nodes.on_side(s);  // also those that facets of a shell18 do not have
    mesh.sets.push_back(std::move(sides[s]));
  }
}

/// The centre and the ends of the straight edges of quarters, in space lines along the axis.
void add_disc_points(Mesh& mesh, const DiscSpec& spec, DiscNodes& nodes, int order_along) {
  const auto add = [&](const std::string& name, DiscPlace at) {
    std::vector<Index> column;
    for (at.height = 0; at.height <= nodes.height_steps(); ++at.height)
      column.push_back(nodes.at(at));
    Set set =
        column.size() == 1 ? Set{name, 0, {}, column} : add_chain(mesh, name, column, order_along);
    mesh.sets.push_back(std::move(set));
  };
  add(spec.name + (spec.heights.empty() ? ".center" : ".axis"), {});
  for (int q = 0; q < std::min(4, spec.quarters + 1); ++q)
    add(fmt::format("{}.pole_{}", spec.name, 90 * q),
        {q, {nodes.core_steps(), 0}, nodes.layer_steps()});
}

void check_disc(const Context& context, const Mesh& mesh, const DiscSpec& spec,
                const Place& steps) {
  const bool solid = !spec.heights.empty();
  const cell::CellInfo& info = cell::info(spec.type);
  if (info.dimension != (solid ? 3 : 2) || (solid && info.corners == 4))
    context.fail(fmt::format("cannot be made of {} cells; expected {}", info.name,
                             solid ? "wedge6, wedge15, hex8, hex20, hex27, shell18"
                                   : "tri3, tri6, quad4, quad8, quad9"));
  if (!(spec.radius > 0) || !std::isfinite(spec.radius))
    context.fail(fmt::format("the radius must be a positive number, not {}", spec.radius));
  if (!spec.center.allFinite() || !std::isfinite(spec.from))
    context.fail("the center and the angle must be finite");
  if (spec.quarters < 1 || spec.quarters > 4)
    context.fail(fmt::format("has 1 to 4 quarters, not {}", spec.quarters));
  check_axis(context, "the core", {0, 1}, {spec.core_bias}, 1);
  check_axis(context, "the layers", {0, 1}, {spec.layer_bias}, 1);
  const double core =
      steps[0] * static_cast<double>(check_counts(context, "the core", 1, {spec.core}));
  const double layers =
      steps[0] * static_cast<double>(check_counts(context, "the layers", 1, {spec.layers}));
  double heights = 1;
  if (solid) {
    check_axis(context, "the axis", spec.heights, spec.bias, spec.elements.size());
    heights += steps[2] * static_cast<double>(check_counts(context, "the axis",
                                                           spec.heights.size() - 1, spec.elements));
  }
  check_size(context, mesh, spec.quarters * (core + 1) * (core + 1 + 2 * layers) * heights);
}

}  // namespace

void append_disc(Mesh& mesh, const DiscSpec& spec, const core::SourceMark& mark) {
  const Context context{mark, fmt::format("disc '{}'", spec.name)};
  constexpr std::array<std::string_view, 11> endings{".outer",   ".from",     ".to",      ".bottom",
                                                     ".top",     ".center",   ".axis",    ".pole_0",
                                                     ".pole_90", ".pole_180", ".pole_270"};
  check_names(mesh, context, spec.name, endings);
  const Place steps = steps_of(spec.type);
  check_disc(context, mesh, spec, steps);
  DiscNodes nodes(mesh, spec, steps);
  if (spec.heights.empty()) {
    mesh.sets.push_back(disc_areas(mesh, spec, nodes));
    const Boundary skin =
        boundary_facets(mesh, edge_table(mesh, mesh.sets.back().cells), mesh.sets.back());
    add_disc_sides(mesh, spec, nodes, skin.facets);
  } else {
    mesh.sets.push_back(cylinder_volumes(mesh, spec, nodes));
    const Surface skin =
        surface_facets(mesh, face_table(mesh, mesh.sets.back().cells), mesh.sets.back());
    add_disc_sides(mesh, spec, nodes, skin.facets);
  }
  add_disc_points(mesh, spec, nodes, steps[2]);
}

}  // namespace osculate::mesh
