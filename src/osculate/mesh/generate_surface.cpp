#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "osculate/mesh/generate_space.hpp"
#include "osculate/mesh/generate_support.hpp"

namespace osculate::mesh {
namespace {

using cell::CellType;

/// Order of an area cell that surfaces are made of.
int facet_order(const Context& context, CellType type) {
  const cell::CellInfo& info = cell::info(type);
  if (info.dimension != 2)
    context.fail(fmt::format("cannot be made of {} cells; expected tri3, tri6, quad4, quad8, quad9",
                             info.name));
  return info.order;
}

void check_elements(const Context& context, const Mesh& mesh, std::span<const int> elements,
                    int order) {
  double nodes = 1;
  for (const int n : elements) {
    if (n < 1) context.fail(fmt::format("{} elements; at least 1 is needed", n));
    nodes *= static_cast<double>(order) * n + 1;
  }
  check_size(context, mesh, nodes);
}

void check_radius(const Context& context, double radius) {
  if (!(radius > 0) || !std::isfinite(radius))
    context.fail(fmt::format("the radius must be a positive number, not {}", radius));
}

bool has_node(CellType type, std::size_t i, std::size_t j) {
  return type != CellType::quad8 || i % 2 == 0 || j % 2 == 0;
}

/// Nodes at place(i, j); the last column is the first one if the grid is closed.
template <class Place>
Grid place_nodes(Mesh& mesh, CellType type, std::array<int, 2> elements, bool closed,
                 const Place& place) {
  const auto order = static_cast<std::size_t>(cell::info(type).order);
  Grid grid{static_cast<int>(order),
            order * static_cast<std::size_t>(elements[0]) + 1,
            order * static_cast<std::size_t>(elements[1]) + 1,
            {}};
  grid.node.assign(grid.columns * grid.rows, -1);
  for (std::size_t j = 0; j < grid.rows; ++j) {
    for (std::size_t i = 0; i < grid.columns; ++i) {
      if (!has_node(type, i, j)) continue;
      if (closed && i + 1 == grid.columns) {
        grid.node[j * grid.columns + i] = grid.at(0, j);
        continue;
      }
      grid.node[j * grid.columns + i] = static_cast<Index>(mesh.nodes.size());
      mesh.nodes.push_back(place(i, j));
    }
  }
  return grid;
}

/// The nodes of a row (or column) of a grid.
std::vector<Index> row_of(const Grid& grid, std::size_t j) {
  std::vector<Index> nodes;
  for (std::size_t i = 0; i < grid.columns; ++i) nodes.push_back(grid.at(i, j));
  return nodes;
}
std::vector<Index> column_of(const Grid& grid, std::size_t i) {
  std::vector<Index> nodes;
  for (std::size_t j = 0; j < grid.rows; ++j) nodes.push_back(grid.at(i, j));
  return nodes;
}

void add_line(Mesh& mesh, std::string name, const std::vector<Index>& nodes, int order) {
  Set chain = add_chain(mesh, std::move(name), nodes, order);
  mesh.sets.push_back(std::move(chain));
}

/// The same grid with its columns from right to left, so that the normal changes its sign.
Grid mirrored(const Grid& grid) {
  Grid out = grid;
  for (std::size_t j = 0; j < grid.rows; ++j)
    for (std::size_t i = 0; i < grid.columns; ++i)
      out.node[j * grid.columns + i] = grid.at(grid.columns - 1 - i, j);
  return out;
}

/// Two directions across the axis of a tube, right-handed with it; the first one is that of the
/// angle zero.
std::array<Vec3, 2> tube_frame(const Context& context, const TubeSpec& spec) {
  const Vec3 axis = spec.end - spec.start;
  if (!axis.allFinite() || !(axis.norm() > 0))
    context.fail("the ends of the axis must be finite and differ");
  const Vec3 along = axis / axis.norm();
  const bool upright = std::abs(along.z()) > std::numbers::sqrt2 / 2;
  const Vec3 zero = spec.zero.value_or(upright ? Vec3(Vec3::UnitX()) : Vec3(Vec3::UnitZ()));
  const Vec3 across = zero - along * along.dot(zero);
  if (!across.allFinite() || !(across.norm() > 1e-9 * zero.norm()))
    context.fail("the direction of the angle zero must not be along the axis");
  const Vec3 first = across / across.norm();
  return {first, along.cross(first)};
}

void check_angles(const Context& context, const TubeSpec& spec) {
  if (!std::isfinite(spec.from) || !std::isfinite(spec.to) || !(spec.to > spec.from) ||
      spec.to - spec.from > 360)
    context.fail(fmt::format("the angles must grow by at most 360 degrees, not from {} to {}",
                             spec.from, spec.to));
}

/// Coordinate -1..1 of a line of a cube's face, spaced equally in angle.
double equiangular(int k, int n) {
  if (k == 0 || k == n) return k == 0 ? -1.0 : 1.0;
  return 2 * k == n ? 0.0 : std::tan(0.25 * std::numbers::pi * (2.0 * k / n - 1.0));
}

/// The nodes on the surface of a cube of n^3 steps, made when they are asked for.
class CubeNodes {
 public:
  CubeNodes(Mesh& mesh, const SphereSpec& spec, int steps)
      : mesh_(mesh), spec_(spec), steps_(steps) {}

  Index at(const std::array<int, 3>& p) {
    const std::int64_t width = steps_ + 1;
    const auto [place, is_new] = known_.try_emplace((p[0] * width + p[1]) * width + p[2],
                                                    static_cast<Index>(mesh_.nodes.size()));
    if (is_new) {
      const Vec3 ray(equiangular(p[0], steps_), equiangular(p[1], steps_),
                     equiangular(p[2], steps_));
      mesh_.nodes.push_back(spec_.center + ray * (spec_.radius / ray.norm()));
    }
    return place->second;
  }

 private:
  Mesh& mesh_;
  const SphereSpec& spec_;
  std::int64_t steps_;
  std::unordered_map<std::int64_t, Index> known_;
};

}  // namespace

void append_grid(Mesh& mesh, const GridSpec& spec, const core::SourceMark& mark) {
  const Context context{mark, fmt::format("grid '{}'", spec.name)};
  constexpr std::array<std::string_view, 8> endings{".left",      ".right",       ".bottom",
                                                    ".top",       ".bottom_left", ".bottom_right",
                                                    ".top_right", ".top_left"};
  check_names(mesh, context, spec.name, endings);
  const int order = facet_order(context, spec.type);
  check_elements(context, mesh, spec.elements, order);
  if (!spec.origin.allFinite()) context.fail("the origin must be finite");
  const Vec3 normal = spec.u.cross(spec.v);
  if (!normal.allFinite() || !(normal.norm() > 1e-12 * spec.u.norm() * spec.v.norm()))
    context.fail("the sides u and v must be finite and not parallel");
  const Grid grid =
      place_nodes(mesh, spec.type, spec.elements, false, [&](std::size_t i, std::size_t j) {
        const double s = static_cast<double>(i) / (order * spec.elements[0]);
        const double t = static_cast<double>(j) / (order * spec.elements[1]);
        return Vec3(spec.origin + spec.u * s + spec.v * t);
      });
  Set areas = add_areas(mesh, spec.name, spec.type, grid);
  mesh.sets.push_back(std::move(areas));
  add_line(mesh, spec.name + ".left", column_of(grid, 0), order);
  add_line(mesh, spec.name + ".right", column_of(grid, grid.columns - 1), order);
  add_line(mesh, spec.name + ".bottom", row_of(grid, 0), order);
  add_line(mesh, spec.name + ".top", row_of(grid, grid.rows - 1), order);
  const std::size_t right = grid.columns - 1;
  const std::size_t top = grid.rows - 1;
  mesh.sets.push_back({spec.name + ".bottom_left", 0, {}, {grid.at(0, 0)}});
  mesh.sets.push_back({spec.name + ".bottom_right", 0, {}, {grid.at(right, 0)}});
  mesh.sets.push_back({spec.name + ".top_right", 0, {}, {grid.at(right, top)}});
  mesh.sets.push_back({spec.name + ".top_left", 0, {}, {grid.at(0, top)}});
}

void append_tube(Mesh& mesh, const TubeSpec& spec, const core::SourceMark& mark) {
  const Context context{mark, fmt::format("tube '{}'", spec.name)};
  constexpr std::array<std::string_view, 4> endings{".start", ".end", ".from", ".to"};
  check_names(mesh, context, spec.name, endings);
  const int order = facet_order(context, spec.type);
  check_elements(context, mesh, spec.elements, order);
  check_radius(context, spec.radius);
  check_angles(context, spec);
  const auto [first, second] = tube_frame(context, spec);
  const std::array<Vec3, 2> frame{first, second};
  const bool closed = spec.to - spec.from == 360;
  const int least = closed ? 3 : 1;
  if (spec.elements[0] < least)
    context.fail(
        fmt::format("{} elements around; at least 3 are needed all round", spec.elements[0]));
  const int around = order * spec.elements[0];
  const int along = order * spec.elements[1];
  const auto grid_top = static_cast<std::size_t>(along);
  const Grid grid =
      place_nodes(mesh, spec.type, spec.elements, closed, [&](std::size_t i, std::size_t j) {
        const double part = static_cast<double>(i) / around;
        const Vec2 d = direction(spec.from + (spec.to - spec.from) * part);
        const double t = static_cast<double>(j) / along;
        const Vec3 base = j == grid_top ? spec.end : Vec3(spec.start + (spec.end - spec.start) * t);
        return Vec3(base + frame[0] * (spec.radius * d.x()) + frame[1] * (spec.radius * d.y()));
      });
  Set areas = add_areas(mesh, spec.name, spec.type, spec.inside ? mirrored(grid) : grid);
  mesh.sets.push_back(std::move(areas));
  add_line(mesh, spec.name + ".start", row_of(grid, 0), order);
  add_line(mesh, spec.name + ".end", row_of(grid, grid.rows - 1), order);
  if (closed) return;
  add_line(mesh, spec.name + ".from", column_of(grid, 0), order);
  add_line(mesh, spec.name + ".to", column_of(grid, grid.columns - 1), order);
}

void append_sphere(Mesh& mesh, const SphereSpec& spec, const core::SourceMark& mark) {
  const Context context{mark, fmt::format("sphere '{}'", spec.name)};
  check_names(mesh, context, spec.name, {});
  const int order = facet_order(context, spec.type);
  check_elements(context, mesh, std::array{spec.elements, 6 * spec.elements}, order);
  check_radius(context, spec.radius);
  if (!spec.center.allFinite()) context.fail("the center must be finite");
  const int steps = order * spec.elements;
  const auto width = static_cast<std::size_t>(steps) + 1;
  CubeNodes nodes(mesh, spec, steps);
  Set sphere{spec.name, 2, {}, {}};
  for (std::size_t side = 0; side < 6; ++side) {
    const std::size_t a = side / 2;
    const bool upper = side % 2 == 1;
    std::array<std::size_t, 2> across{(a + 1) % 3, (a + 2) % 3};
    if (upper == spec.inside) std::swap(across[0], across[1]);
    Grid grid{order, width, width, std::vector<Index>(width * width, -1)};
    for (std::size_t j = 0; j < width; ++j)
      for (std::size_t i = 0; i < width; ++i) {
        if (!has_node(spec.type, i, j)) continue;
        std::array<int, 3> p{};
        p[a] = upper ? steps : 0;
        p[across[0]] = static_cast<int>(i);
        p[across[1]] = static_cast<int>(j);
        grid.node[j * width + i] = nodes.at(p);
      }
    const Set part = add_areas(mesh, spec.name, spec.type, grid);
    sphere.cells.insert(sphere.cells.end(), part.cells.begin(), part.cells.end());
    sphere.nodes.insert(sphere.nodes.end(), part.nodes.begin(), part.nodes.end());
  }
  finish(sphere);
  mesh.sets.push_back(std::move(sphere));
}

}  // namespace osculate::mesh
