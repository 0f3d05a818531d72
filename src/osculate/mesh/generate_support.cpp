#include "osculate/mesh/generate_support.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace osculate::mesh {

using cell::CellType;

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

void turn(std::span<Vec3> nodes, double degrees, const Vec3& about, const Vec3& axis) {
  const Vec2 d = direction(degrees);
  if (d.x() == 1.0) return;
  const Vec3 k = axis / axis.norm();
  for (Vec3& x : nodes) {
    const Vec3 arm = x - about;
    const Vec3 along = k * k.dot(arm);
    x = about + along + (arm - along) * d.x() + k.cross(arm) * d.y();
  }
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

void add_cell(Mesh& mesh, Index block, Set& set, std::span<const Index> nodes) {
  Block& target = mesh.blocks[static_cast<std::size_t>(block)];
  set.cells.push_back({block, target.size()});
  target.connectivity.insert(target.connectivity.end(), nodes.begin(), nodes.end());
  set.nodes.insert(set.nodes.end(), nodes.begin(), nodes.end());
}

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

namespace {

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

}  // namespace

Set add_areas(Mesh& mesh, std::string name, CellType type, const Grid& grid) {
  Set set{std::move(name), 2, {}, {}};
  const Index block = block_index(mesh, type);
  const auto step = static_cast<std::size_t>(grid.order);
  for (std::size_t j = 0; j + step < grid.rows; j += step)
    for (std::size_t i = 0; i + step < grid.columns; i += step)
      add_rectangle(mesh, block, type, set, grid, i, j);
  finish(set);
  return set;
}

}  // namespace osculate::mesh
