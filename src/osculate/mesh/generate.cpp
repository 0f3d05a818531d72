#include "osculate/mesh/generate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "osculate/mesh/generate_support.hpp"

namespace osculate::mesh {
namespace {

using cell::CellType;

// ---- coordinates ------------------------------------------------------------------------------

double inward_shift(const Crown& crown, double x) {
  const double r = std::abs(crown.radius);
  const double d = x - crown.at;
  return std::copysign(d * d / (r + std::sqrt(r * r - d * d)), crown.radius);
}

void check_crown(const Context& context, const Crown& crown, const std::vector<double>& x,
                 double height) {
  if (!std::isfinite(crown.radius) || crown.radius == 0 || !std::isfinite(crown.at))
    context.fail("crown: needs a finite radius other than zero and a finite position");
  const double reach = std::max(std::abs(x.front() - crown.at), std::abs(x.back() - crown.at));
  if (reach > std::abs(crown.radius))
    context.fail(
        fmt::format("crown: radius {} is smaller than the distance {} of the farthest node",
                    crown.radius, reach));
  const double shift = std::max(inward_shift(crown, x.front()), inward_shift(crown, x.back()));
  if (!(shift < height))
    context.fail(fmt::format("crown: the side would move by {}, through the opposite side", shift));
}

double crowned(const Crown& crown, double x, double y, double y0, double y1) {
  const double s = inward_shift(crown, x);
  if (crown.side == Crown::Side::bottom) return y == y0 ? y0 + s : y + s * (y1 - y) / (y1 - y0);
  return y == y1 ? y1 - s : y - s * (y - y0) / (y1 - y0);
}

// ---- nodes and sets ---------------------------------------------------------------------------

Grid add_nodes(Mesh& mesh, const BoxSpec& spec, int order, const std::vector<double>& x,
               const std::vector<double>& y) {
  Grid grid{order, x.size(), y.size(), std::vector<Index>(x.size() * y.size(), -1)};
  const Vec2 turned = direction(spec.angle);
  for (std::size_t j = 0; j < y.size(); ++j)
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (spec.type == CellType::quad8 && i % 2 == 1 && j % 2 == 1) continue;
      Vec2 p(x[i], y[j]);
      if (spec.crown) p.y() = crowned(*spec.crown, x[i], y[j], y.front(), y.back());
      if (turned.x() != 1.0) {
        const Vec2 arm = p - spec.about;
        p = spec.about + Vec2(turned.x() * arm.x() - turned.y() * arm.y(),
                              turned.y() * arm.x() + turned.x() * arm.y());
      }
      grid.node[j * x.size() + i] = static_cast<Index>(mesh.nodes.size());
      mesh.nodes.emplace_back(p.x(), p.y(), 0.0);
    }
  return grid;
}

/// The sides, directed with the box on the right: up on the left side, to the right at the top,
/// down on the right side, to the left at the bottom.
void add_sides(Mesh& mesh, const std::string& name, const Grid& grid) {
  std::vector<Index> left, right, bottom, top;
  for (std::size_t j = 0; j < grid.rows; ++j) {
    left.push_back(grid.at(0, j));
    right.push_back(grid.at(grid.columns - 1, grid.rows - 1 - j));
  }
  for (std::size_t i = 0; i < grid.columns; ++i) {
    top.push_back(grid.at(i, grid.rows - 1));
    bottom.push_back(grid.at(grid.columns - 1 - i, 0));
  }
  mesh.sets.push_back(add_chain(mesh, name + ".left", left, grid.order));
  mesh.sets.push_back(add_chain(mesh, name + ".right", right, grid.order));
  mesh.sets.push_back(add_chain(mesh, name + ".bottom", bottom, grid.order));
  mesh.sets.push_back(add_chain(mesh, name + ".top", top, grid.order));
  mesh.sets.push_back({name + ".bottom_left", 0, {}, {left.front()}});
  mesh.sets.push_back({name + ".bottom_right", 0, {}, {right.back()}});
  mesh.sets.push_back({name + ".top_right", 0, {}, {right.front()}});
  mesh.sets.push_back({name + ".top_left", 0, {}, {left.back()}});
}

}  // namespace

void append_box(Mesh& mesh, const BoxSpec& spec, const core::SourceMark& mark) {
  const Context context{mark, fmt::format("box '{}'", spec.name)};
  constexpr std::array<std::string_view, 8> endings{".left",      ".right",       ".bottom",
                                                    ".top",       ".bottom_left", ".bottom_right",
                                                    ".top_right", ".top_left"};
  check_names(mesh, context, spec.name, endings);
  const int order = cell::info(spec.type).order;
  if (cell::info(spec.type).dimension != 2)
    context.fail(fmt::format("cannot be made of {} cells; expected tri3, tri6, quad4, quad8, quad9",
                             cell::info(spec.type).name));
  check_axis(context, "x", spec.x, spec.bias_x, spec.nx.size());
  check_axis(context, "y", spec.y, spec.bias_y, spec.ny.size());
  const std::int64_t nx = check_counts(context, "x", spec.x.size() - 1, spec.nx);
  const std::int64_t ny = check_counts(context, "y", spec.y.size() - 1, spec.ny);
  check_size(context, mesh,
             (static_cast<double>(order) * static_cast<double>(nx) + 1) *
                 (static_cast<double>(order) * static_cast<double>(ny) + 1));
  if (!std::isfinite(spec.angle) || !spec.about.allFinite())
    context.fail("the rotation must be given by finite numbers");
  const std::vector<double> x = axis(spec.x, spec.nx, spec.bias_x, order);
  const std::vector<double> y = axis(spec.y, spec.ny, spec.bias_y, order);
  if (spec.crown) check_crown(context, *spec.crown, x, y.back() - y.front());
  const Grid grid = add_nodes(mesh, spec, order, x, y);
  Set areas = add_areas(mesh, spec.name, spec.type, grid);
  mesh.sets.push_back(std::move(areas));
  add_sides(mesh, spec.name, grid);
}

void append_line(Mesh& mesh, const LineSpec& spec, const core::SourceMark& mark) {
  const Context context{mark, fmt::format("line '{}'", spec.name)};
  constexpr std::array<std::string_view, 2> endings{".start", ".end"};
  check_names(mesh, context, spec.name, endings);
  if (spec.type != CellType::line2 && spec.type != CellType::line3)
    context.fail(fmt::format("cannot be made of {} cells; expected line2, line3",
                             cell::info(spec.type).name));
  if (spec.points.size() < 2) context.fail("needs at least two points");
  const int order = cell::info(spec.type).order;
  const std::int64_t n = check_counts(context, "the line", spec.points.size() - 1, spec.elements);
  check_size(context, mesh, static_cast<double>(order) * static_cast<double>(n) + 1);
  for (std::size_t i = 0; i < spec.points.size(); ++i) {
    if (!spec.points[i].allFinite()) context.fail("the points must be finite");
    if (i > 0 && spec.points[i] == spec.points[i - 1])
      context.fail(fmt::format("points {} and {} are the same", i, i + 1));
  }
  const bool closed = spec.points.size() > 2 && spec.points.front() == spec.points.back();
  std::vector<Index> nodes;
  const auto add_node = [&](const Vec2& p) {
    nodes.push_back(static_cast<Index>(mesh.nodes.size()));
    mesh.nodes.emplace_back(p.x(), p.y(), 0.0);
  };
  add_node(spec.points.front());
  for (std::size_t i = 0; i + 1 < spec.points.size(); ++i) {
    const Vec2& a = spec.points[i];
    const Vec2& b = spec.points[i + 1];
    const int steps = order * spec.elements[i];
    for (int k = 1; k < steps; ++k) add_node(a + (b - a) * (static_cast<double>(k) / steps));
    if (closed && i + 2 == spec.points.size())
      nodes.push_back(nodes.front());
    else
      add_node(b);
  }
  const Index first = nodes.front();
  const Index last = nodes.back();
  Set chain = add_chain(mesh, spec.name, nodes, order);
  mesh.sets.push_back(std::move(chain));
  mesh.sets.push_back({spec.name + ".start", 0, {}, {first}});
  mesh.sets.push_back({spec.name + ".end", 0, {}, {last}});
}

}  // namespace osculate::mesh
