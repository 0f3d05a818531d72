#include "osculate/mesh/generate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

namespace osculate::mesh {
namespace {

using cell::CellType;

/// What is needed to complain.
struct Context {
  const core::SourceMark& mark;
  std::string shape;
  [[noreturn]] void fail(const std::string& message) const {
    throw core::InputError(mark, fmt::format("{}: {}", shape, message));
  }
};

// ---- checks -----------------------------------------------------------------------------------

void check_names(const Mesh& mesh, const Context& context, const std::string& name,
                 std::span<const std::string_view> endings) {
  if (name.empty()) context.fail("needs a name");
  if (mesh.find_set(name) != nullptr) context.fail("there is already a set of that name");
  for (const std::string_view ending : endings) {
    const std::string full = name + std::string(ending);
    if (mesh.find_set(full) != nullptr)
      context.fail(fmt::format("there is already a set '{}'", full));
  }
}

/// Number of elements along one axis, at most max_nodes.
std::int64_t check_counts(const Context& context, std::string_view what, std::size_t intervals,
                          const std::vector<int>& elements) {
  if (elements.size() != intervals)
    context.fail(fmt::format("{} numbers of elements in {} for {} interval(s)", elements.size(),
                             what, intervals));
  std::int64_t total = 0;
  for (const int n : elements) {
    if (n < 1) context.fail(fmt::format("{} elements in {}; at least 1 is needed", n, what));
    total += n;
    if (total > max_nodes)
      context.fail(fmt::format("more than {} elements in {}", max_nodes, what));
  }
  return total;
}

void check_axis(const Context& context, std::string_view what, const std::vector<double>& breaks,
                const std::vector<double>& bias, std::size_t intervals) {
  if (breaks.size() < 2) context.fail(fmt::format("{} needs at least two values", what));
  for (std::size_t i = 0; i < breaks.size(); ++i) {
    if (!std::isfinite(breaks[i])) context.fail(fmt::format("{} must be finite numbers", what));
    if (i > 0 && !(breaks[i] > breaks[i - 1]))
      context.fail(fmt::format("{} must increase; {} follows {}", what, breaks[i], breaks[i - 1]));
  }
  if (!bias.empty() && bias.size() != intervals)
    context.fail(
        fmt::format("{} bias values in {} for {} interval(s)", bias.size(), what, intervals));
  for (const double b : bias)
    if (!(b >= 1e-6 && b <= 1e6))
      context.fail(fmt::format("bias {} in {}; expected 1e-6 to 1e6", b, what));
}

void check_size(const Context& context, const Mesh& mesh, double new_nodes) {
  if (static_cast<double>(mesh.nodes.size()) + new_nodes > static_cast<double>(max_nodes))
    context.fail(fmt::format("the mesh would have {:.3g} nodes; at most {} are possible",
                             static_cast<double>(mesh.nodes.size()) + new_nodes, max_nodes));
}

// ---- coordinates ------------------------------------------------------------------------------

/// Node coordinates along one axis, breakpoints hit exactly, element lengths in geometric
/// progression.
std::vector<double> axis(const std::vector<double>& breaks, const std::vector<int>& elements,
                         const std::vector<double>& bias, int order) {
  std::vector<double> x{breaks[0]};
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const int n = elements[i];
    const double length = breaks[i + 1] - breaks[i];
    const double ratio = bias.empty() || n == 1 ? 1.0 : bias[i];
    const double log_step = n == 1 ? 0.0 : std::log(ratio) / (n - 1);
    for (int k = 1; k <= n; ++k) {
      const double part = log_step == 0.0 ? static_cast<double>(k) / n
                                          : std::expm1(k * log_step) / std::expm1(n * log_step);
      const double end = k == n ? breaks[i + 1] : breaks[i] + length * part;
      if (order == 2) x.push_back(0.5 * (x.back() + end));
      x.push_back(end);
    }
  }
  return x;
}

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

/// (cos, sin) of an angle in degrees, exact for right angles.
Vec2 direction(double degrees) {
  const double reduced = std::fmod(degrees, 360.0);
  const double quarters = reduced / 90.0;
  if (quarters == std::floor(quarters)) {
    constexpr std::array<std::array<double, 2>, 4> right{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    const auto& d = right[static_cast<std::size_t>((static_cast<int>(quarters) + 4) % 4)];
    return {d[0], d[1]};
  }
  const double angle = reduced * std::numbers::pi / 180.0;
  return {std::cos(angle), std::sin(angle)};
}

// ---- cells and sets ---------------------------------------------------------------------------

Index block_index(Mesh& mesh, CellType type) {
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
    if (mesh.blocks[b].type == type) return static_cast<Index>(b);
  mesh.blocks.push_back({type, {}});
  return static_cast<Index>(mesh.blocks.size()) - 1;
}

void finish(Set& set) {
  std::sort(set.nodes.begin(), set.nodes.end());
  set.nodes.erase(std::unique(set.nodes.begin(), set.nodes.end()), set.nodes.end());
}

/// Adds a cell to a block and to a set.
void add_cell(Mesh& mesh, Index block, Set& set, std::span<const Index> nodes) {
  Block& target = mesh.blocks[static_cast<std::size_t>(block)];
  set.cells.push_back({block, target.size()});
  target.connectivity.insert(target.connectivity.end(), nodes.begin(), nodes.end());
  set.nodes.insert(set.nodes.end(), nodes.begin(), nodes.end());
}

/// Line cells through consecutive nodes (ends first, then the middle).
Set add_chain(Mesh& mesh, std::string name, std::span<const Index> nodes, int order) {
  Set set{std::move(name), 1, {}, {}};
  const Index block = block_index(mesh, order == 1 ? CellType::line2 : CellType::line3);
  for (std::size_t i = 0; i + 1 < nodes.size(); i += static_cast<std::size_t>(order)) {
    if (order == 1)
      add_cell(mesh, block, set, std::array{nodes[i], nodes[i + 1]});
    else
      add_cell(mesh, block, set, std::array{nodes[i], nodes[i + 2], nodes[i + 1]});
  }
  finish(set);
  return set;
}

/// The grid of nodes of a box; nodes that a quad8 mesh does not have are -1.
struct Grid {
  int order;
  std::size_t columns, rows;
  std::vector<Index> node;
  [[nodiscard]] Index at(std::size_t i, std::size_t j) const { return node[j * columns + i]; }
};

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

/// The cells of one rectangle whose lower left grid node is (i, j); counterclockwise.
void add_rectangle(Mesh& mesh, Index block, CellType type, Set& set, const Grid& g, std::size_t i,
                   std::size_t j) {
  const std::size_t s = g.order == 1 ? 1 : 2;
  const std::array<Index, 4> c{g.at(i, j), g.at(i + s, j), g.at(i + s, j + s), g.at(i, j + s)};
  if (type == CellType::quad4) return add_cell(mesh, block, set, c);
  if (type == CellType::tri3) {
    add_cell(mesh, block, set, std::array{c[0], c[1], c[2]});
    return add_cell(mesh, block, set, std::array{c[0], c[2], c[3]});
  }
  const std::array<Index, 4> m{g.at(i + 1, j), g.at(i + 2, j + 1), g.at(i + 1, j + 2),
                               g.at(i, j + 1)};
  const Index centre = g.at(i + 1, j + 1);
  if (type == CellType::tri6) {
    add_cell(mesh, block, set, std::array{c[0], c[1], c[2], m[0], m[1], centre});
    return add_cell(mesh, block, set, std::array{c[0], c[2], c[3], centre, m[2], m[3]});
  }
  const std::array<Index, 9> all{c[0], c[1], c[2], c[3], m[0], m[1], m[2], m[3], centre};
  add_cell(mesh, block, set, std::span(all).first(type == CellType::quad8 ? 8 : 9));
}

Set add_areas(Mesh& mesh, const BoxSpec& spec, const Grid& grid) {
  Set set{spec.name, 2, {}, {}};
  const Index block = block_index(mesh, spec.type);
  const auto step = static_cast<std::size_t>(grid.order);
  for (std::size_t j = 0; j + step < grid.rows; j += step)
    for (std::size_t i = 0; i + step < grid.columns; i += step)
      add_rectangle(mesh, block, spec.type, set, grid, i, j);
  finish(set);
  return set;
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
  Set areas = add_areas(mesh, spec, grid);
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
