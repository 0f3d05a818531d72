#include "osculate/mesh/check.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "osculate/cell/quadrature.hpp"
#include "osculate/cell/volume_shape.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/mesh/support.hpp"

namespace osculate::mesh {
namespace {

/// Counts, and keeps the first few examples.
struct Tally {
  std::size_t count = 0;
  std::string examples;
  void add(const std::string& example) {
    if (count < 5) examples += (count > 0 ? ", " : "") + example;
    if (count == 5) examples += ", ...";
    ++count;
  }
};

void report(std::vector<Finding>& findings, Flaw flaw, bool is_error, const Tally& tally,
            std::string_view what) {
  if (tally.count == 0) return;
  findings.push_back(
      {flaw, is_error, tally.count, fmt::format("{} {}: {}", tally.count, what, tally.examples)});
}

std::string cell_name(const Mesh& mesh, const Block& block, Index c) {
  std::string nodes;
  for (int k = 0; k < cell::info(block.type).nodes; ++k)
    nodes += fmt::format("{}{}", k > 0 ? " " : "", node_number(mesh, block.cell(c)[k]));
  return fmt::format("{} on nodes {}", cell::info(block.type).name, nodes);
}

bool good_index(Index i, std::size_t size) { return i >= 0 && static_cast<std::size_t>(i) < size; }

Tally bad_indices(const Mesh& mesh) {
  Tally bad;
  for (const Block& block : mesh.blocks) {
    if (block.connectivity.size() % static_cast<std::size_t>(cell::info(block.type).nodes) != 0)
      bad.add(fmt::format("incomplete {} cell", cell::info(block.type).name));
    for (const Index node : block.connectivity)
      if (!good_index(node, mesh.nodes.size())) bad.add(fmt::format("node {}", node));
  }
  for (const Set& set : mesh.sets) {
    for (const Index node : set.nodes)
      if (!good_index(node, mesh.nodes.size()))
        bad.add(fmt::format("node {} of set '{}'", node, set.name));
    for (const CellRef ref : set.cells)
      if (!good_index(ref.block, mesh.blocks.size()) ||
          !good_index(ref.cell, static_cast<std::size_t>(
                                    mesh.blocks[static_cast<std::size_t>(ref.block)].size())))
        bad.add(fmt::format("cell {}/{} of set '{}'", ref.block, ref.cell, set.name));
  }
  return bad;
}

void check_cells(const Mesh& mesh, std::vector<Finding>& findings) {
  Tally repeated;
  std::array<Tally, 4> twice;  // by dimension
  for (const Block& block : mesh.blocks) {
    const auto n = static_cast<std::size_t>(cell::info(block.type).nodes);
    std::vector<Index> nodes = block.connectivity;
    std::vector<Index> order(static_cast<std::size_t>(block.size()));
    std::iota(order.begin(), order.end(), 0);
    const auto begin_of = [&](Index c) {
      return nodes.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(c) * n);
    };
    const auto width = static_cast<std::ptrdiff_t>(n);
    for (const Index c : order) {
      std::sort(begin_of(c), begin_of(c) + width);
      if (std::adjacent_find(begin_of(c), begin_of(c) + width) != begin_of(c) + width)
        repeated.add(cell_name(mesh, block, c));
    }
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
      const auto relation = std::lexicographical_compare_three_way(
          begin_of(a), begin_of(a) + width, begin_of(b), begin_of(b) + width);
      return relation != 0 ? relation < 0 : a < b;
    });
    for (std::size_t i = 1; i < order.size(); ++i)
      if (std::equal(begin_of(order[i - 1]), begin_of(order[i - 1]) + width, begin_of(order[i])))
        twice[static_cast<std::size_t>(cell::info(block.type).dimension)].add(
            cell_name(mesh, block, order[i]));
  }
  report(findings, Flaw::repeated_node, true, repeated, "cell(s) that name a node twice");
  report(findings, Flaw::duplicate_volume, true, twice[3], "volume cell(s) that are there twice");
  report(findings, Flaw::duplicate_area, !has_volumes(mesh), twice[2],
         "area cell(s) that are there twice");
  report(findings, Flaw::duplicate_line, false, twice[1], "line cell(s) that are there twice");
}

/// Larger ones overflow in their powers.
bool is_number(const Vec3& x) { return (x.array().abs() <= 1e100).all(); }

void check_nodes(const Mesh& mesh, const std::vector<bool>& also_used,
                 std::vector<Finding>& findings) {
  Tally infinite;
  Tally unused;
  std::vector<bool> used = also_used;
  used.resize(mesh.nodes.size());
  for (const Block& block : mesh.blocks)
    if (cell::info(block.type).dimension > 0)
      for (const Index node : block.connectivity) used[static_cast<std::size_t>(node)] = true;
  for (const Relation& relation : mesh.relations)
    for (const Relation::Term& term : relation.terms)
      used[static_cast<std::size_t>(term.node)] = true;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    const Vec3& x = mesh.nodes[i];
    const std::string text =
        (used[i] && is_number(x)) ? "" : describe_node(mesh, static_cast<Index>(i)).substr(5);
    if (!is_number(x)) infinite.add(text);
    if (!used[i]) unused.add(text);
  }
  report(findings, Flaw::not_finite, true, infinite,
         "node(s) with coordinates that are no number, or beyond 1e100");
  report(findings, Flaw::unused_node, false, unused,
         has_volumes(mesh) ? "node(s) of no cell" : "node(s) of no line or area cell");
}

/// Shape functions where a volume cell is judged: at its nodes and their middle.
std::vector<cell::VolumeShape> judged_shapes(cell::CellType type) {
  std::vector<cell::VolumeShape> shapes;
  const int n = cell::info(type).nodes;
  Vec3 centre = Vec3::Zero();
  for (int k = 0; k < n; ++k) {
    const Vec3 xi = cell::volume_node(type, k);
    shapes.push_back(cell::volume_shape(type, xi));
    centre += xi / n;
  }
  shapes.push_back(cell::volume_shape(type, centre));
  return shapes;
}

/// Those at the points where a cell of second order is integrated fully.
std::vector<cell::VolumeShape> shapes_at_points(cell::CellType type) {
  using enum cell::CellType;
  const cell::Quadrature3D rule = type == tet10                       ? cell::gauss_tetrahedron(2)
                                  : type == wedge6 || type == wedge15 ? cell::gauss_wedge(2, 3)
                                  : type == shell18                   ? cell::gauss_hex(3, 2)
                                                                      : cell::gauss_hex(3);
  std::vector<cell::VolumeShape> shapes;
  for (const Vec3& xi : rule.points) shapes.push_back(cell::volume_shape(type, xi));
  return shapes;
}

double smallest_jacobian(const Mesh& mesh, CellRef ref,
                         const std::vector<cell::VolumeShape>& shapes) {
  const Index* const nodes = nodes_of(mesh, ref);
  double smallest = std::numeric_limits<double>::infinity();
  for (const cell::VolumeShape& shape : shapes) {
    Mat<3, 3> jacobian = Mat<3, 3>::Zero();
    for (int k = 0; k < shape.count; ++k) jacobian += point(mesh, nodes[k]) * shape.d.row(k);
    smallest = std::min(smallest, jacobian.determinant());
  }
  return smallest;
}

/// Volume cells that are inside out or flat; only cells with finite coordinates are judged. Those
/// of second order and those at the axis of a sector may be so where they have no point of
/// integration.
void check_volumes(const Mesh& mesh, std::vector<Finding>& findings) {
  Tally bad, folded;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const Block& block = mesh.blocks[b];
    if (cell::info(block.type).dimension != 3) continue;
    const std::vector<cell::VolumeShape> shapes = judged_shapes(block.type);
    const std::vector<cell::VolumeShape> points = shapes_at_points(block.type);
    const bool curved = cell::info(block.type).nodes > cell::info(block.type).corners;
    for (Index c = 0; c < block.size(); ++c) {
      const CellRef ref{static_cast<Index>(b), c};
      const double jacobian = smallest_jacobian(mesh, ref, shapes);
      if (jacobian <= 0 && is_collapsed(mesh, ref) && smallest_jacobian(mesh, ref, points) > 0)
        continue;
      if (jacobian <= 0)
        (curved && smallest_jacobian(mesh, ref, points) > 0 ? folded : bad)
            .add(fmt::format("{} (smallest Jacobian {:.3g})", cell_name(mesh, block, c), jacobian));
    }
  }
  report(findings, Flaw::inside_out, true, bad,
         "volume cell(s) that are inside out or flat (numbered against their type's order, or too "
         "distorted)");
  report(
      findings, Flaw::folded, false, folded,
      "volume cell(s) of second order that are inside out or flat at a node or in the middle, not "
      "at their points: stresses are poor there");
}

/// Whether a contact is between a node and an edge, or another node.
bool touch(std::span<const ContactSides> contacts, Index node, std::array<Index, 2> edge) {
  const auto on = [](const std::vector<bool>& side, Index n) {
    return side[static_cast<std::size_t>(n)];
  };
  return std::any_of(contacts.begin(), contacts.end(), [&](const ContactSides& sides) {
    const auto& [master, slave] = sides;
    return (on(master, node) && on(slave, edge[0]) && on(slave, edge[1])) ||
           (on(slave, node) && on(master, edge[0]) && on(master, edge[1]));
  });
}

/// Which of the bodies of a set (cells that hang together) each node belongs to: one of its nodes.
std::vector<Index> bodies_of(const Mesh& mesh, const Set& set) {
  std::vector<Index> parent(mesh.nodes.size());
  std::iota(parent.begin(), parent.end(), Index{0});
  const auto root = [&](Index n) {
    for (; parent[static_cast<std::size_t>(n)] != n; n = parent[static_cast<std::size_t>(n)])
      parent[static_cast<std::size_t>(n)] =
          parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(n)])];
    return n;
  };
  for (const CellRef& ref : set.cells) {
    const Index* const nodes = nodes_of(mesh, ref);
    for (int k = 1; k < info_of(mesh, ref).nodes; ++k)
      parent[static_cast<std::size_t>(root(nodes[k]))] = root(nodes[0]);
  }
  for (Index& n : parent) n = root(n);
  return parent;
}

/// Which nodes of a set belong to two bodies that some contact keeps apart.
class Apart {
 public:
  Apart(const Mesh& mesh, const Set& set, std::span<const ContactSides> contacts)
      : mesh_(mesh), set_(set), contacts_(contacts) {}

  bool operator()(Index one, Index other) {
    if (contacts_.empty()) return false;
    if (bodies_.empty()) bodies_ = bodies_of(mesh_, set_);
    const std::pair two(bodies_[static_cast<std::size_t>(one)],
                        bodies_[static_cast<std::size_t>(other)]);
    const auto [known, is_new] = known_.try_emplace(two, false);
    if (is_new) known->second = two.first != two.second && in_contact(two.first, two.second);
    return known->second;
  }

 private:
  [[nodiscard]] bool in_contact(Index a, Index b) const {
    const auto has = [&](const std::vector<bool>& side, Index body) {
      for (std::size_t n = 0; n < side.size(); ++n)
        if (side[n] && bodies_[n] == body) return true;
      return false;
    };
    return std::ranges::any_of(contacts_, [&](const ContactSides& sides) {
      return (has(sides[0], a) && has(sides[1], b)) || (has(sides[0], b) && has(sides[1], a));
    });
  }

  const Mesh& mesh_;
  const Set& set_;
  std::span<const ContactSides> contacts_;
  std::vector<Index> bodies_;
  std::map<std::pair<Index, Index>, bool> known_;  ///< by two bodies
};

/// Nodes of one set of volumes (in the plane of areas) that are at the same place.
void check_double_nodes(const Mesh& mesh, std::span<const ContactSides> contacts,
                        std::vector<Finding>& findings) {
  Tally doubles;
  const int dimension = has_volumes(mesh) ? 3 : 2;
  for (const Set& set : mesh.sets) {
    if (set.dimension != dimension || set.nodes.empty()) continue;
    Vec3 low = point(mesh, set.nodes[0]);
    Vec3 high = low;
    for (const Index node : set.nodes) {
      low = low.cwiseMin(point(mesh, node));
      high = high.cwiseMax(point(mesh, node));
    }
    const double step = 1e-9 * (high - low).norm();
    if (!std::isfinite(step) || step == 0) continue;
    using Spot = std::array<std::int64_t, 3>;
    std::vector<std::pair<Spot, Index>> spots;
    for (const Index node : set.nodes) {
      const Vec3 scaled = (point(mesh, node) - low) / step;
      spots.emplace_back(
          Spot{std::llround(scaled.x()), std::llround(scaled.y()), std::llround(scaled.z())}, node);
    }
    std::sort(spots.begin(), spots.end());
    Apart apart(mesh, set, contacts);
    for (std::size_t i = 1; i < spots.size(); ++i) {
      const Index one = spots[i - 1].second, other = spots[i].second;
      if (spots[i].first != spots[i - 1].first || touch(contacts, other, {one, one})) continue;
      if (apart(one, other)) continue;
      doubles.add(fmt::format("{} and {} of '{}'", node_number(mesh, one),
                              describe_node(mesh, other).substr(5), set.name));
    }
  }
  report(findings, Flaw::double_node, false, doubles,
         "pair(s) of nodes of one body at the same place, so that it may not hang together");
}

double cross(const Vec3& a, const Vec3& b) { return a.x() * b.y() - a.y() * b.x(); }

/// On which side of the line from a to b the middle of a cell is: positive on the left.
double side_of(const Mesh& mesh, CellRef ref, const Vec3& a, const Vec3& b) {
  Vec3 middle = Vec3::Zero();
  const int n = info_of(mesh, ref).corners;
  for (int k = 0; k < n; ++k) middle += point(mesh, nodes_of(mesh, ref)[k]) / n;
  return cross(b - a, middle - a);
}

/// Ends of free edges that lie on other free edges, between their ends.
void add_hanging(const Mesh& mesh, const Set& set, const std::vector<std::array<Index, 2>>& free,
                 std::span<const ContactSides> contacts, Tally& hanging) {
  constexpr double nearly = 1e-6;  // of the edge
  Apart apart(mesh, set, contacts);
  std::vector<Index> nodes;
  for (const std::array<Index, 2>& ends : free) nodes.insert(nodes.end(), ends.begin(), ends.end());
  const auto left = [&](Index n, double x) { return point(mesh, n).x() < x; };
  std::sort(nodes.begin(), nodes.end(), [&](Index a, Index b) {
    return std::pair(point(mesh, a).x(), a) < std::pair(point(mesh, b).x(), b);
  });
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  for (const std::array<Index, 2>& ends : free) {
    const Vec3 &a = point(mesh, ends[0]), along = point(mesh, ends[1]) - a;
    const double size = along.squaredNorm(), reach = nearly * std::sqrt(size);
    const double from = a.x() + std::min(0.0, along.x()) - reach;
    const double to = a.x() + std::max(0.0, along.x()) + reach;
    for (auto n = std::lower_bound(nodes.begin(), nodes.end(), from, left);
         n != nodes.end() && point(mesh, *n).x() <= to; ++n) {
      const Vec3 arm = point(mesh, *n) - a;
      const double share = arm.dot(along) / size;
      if (share > nearly && share < 1 - nearly && std::abs(cross(along, arm)) < nearly * size &&
          !touch(contacts, *n, ends) && !apart(*n, ends[0]))
        hanging.add(fmt::format("{} of '{}'", describe_node(mesh, *n).substr(5), set.name));
    }
  }
}

/// In the plane an edge has one cell on each side, and free edges have no nodes between their ends.
void check_plane(const Mesh& mesh, std::span<const ContactSides> contacts,
                 std::vector<Finding>& findings) {
  const auto is_plane = [](const Vec3& x) { return x.z() == 0 && is_number(x); };
  if (has_volumes(mesh) || !std::all_of(mesh.nodes.begin(), mesh.nodes.end(), is_plane)) return;
  Tally overlapping, hanging;
  for (const Set& set : mesh.sets) {
    if (set.dimension != 2) continue;
    const EdgeTable table = edge_table(mesh, set.cells);
    std::vector<std::array<Index, 2>> free;
    for (std::size_t i = 0, end = 0; i < table.edges.size(); i = end) {
      for (end = i + 1; end < table.edges.size() && table.edges[end].key == table.edges[i].key;)
        ++end;
      const Edge& edge = table.edges[i];
      const auto& local = info_of(mesh, edge.cell).edges[static_cast<std::size_t>(edge.local)];
      const std::array<Index, 2> ends{nodes_of(mesh, edge.cell)[local[0]],
                                      nodes_of(mesh, edge.cell)[local[1]]};
      const Vec3 &a = point(mesh, ends[0]), &b = point(mesh, ends[1]);
      if (end == i + 1) free.push_back(ends);
      const bool same_side =
          end == i + 2 &&
          side_of(mesh, edge.cell, a, b) * side_of(mesh, table.edges[i + 1].cell, a, b) > 0;
      if (end > i + 2 || same_side)
        overlapping.add(fmt::format("at the edge from {} to {} of '{}'",
                                    describe_node(mesh, ends[0]),
                                    describe_node(mesh, ends[1]).substr(5), set.name));
    }
    add_hanging(mesh, set, free, contacts, hanging);
  }
  report(findings, Flaw::overlap, false, overlapping,
         "place(s) where cells of one body lie over each other");
  report(findings, Flaw::hanging_node, false, hanging,
         "node(s) on an edge of another cell of their body, so that it may not hang together");
}

void check_sets(const Mesh& mesh, std::vector<Finding>& findings) {
  Tally empty;
  for (const Set& set : mesh.sets)
    if (set.nodes.empty() && set.cells.empty()) empty.add(fmt::format("'{}'", set.name));
  report(findings, Flaw::empty_set, false, empty, "set(s) without nodes");
}

}  // namespace

bool is_collapsed(const Mesh& mesh, CellRef ref) {
  if (mesh.expanded.empty()) return false;
  const int corners = info_of(mesh, ref).corners;
  const Index* const nodes = nodes_of(mesh, ref);
  for (int k = 0; k < corners; ++k)
    for (int j = k + 1; j < corners; ++j)
      if (point(mesh, nodes[k]) == point(mesh, nodes[j])) return true;
  return false;
}

double smallest_jacobian(const Mesh& mesh, CellRef ref) {
  return smallest_jacobian(mesh, ref, judged_shapes(block_of(mesh, ref).type));
}

std::vector<Finding> check_mesh(const Mesh& mesh, std::span<const ContactSides> contacts,
                                const std::vector<bool>& also_used) {
  std::vector<Finding> findings;
  report(findings, Flaw::bad_index, true, bad_indices(mesh), "reference(s) to what is not there");
  if (!findings.empty()) return findings;
  check_cells(mesh, findings);
  check_nodes(mesh, also_used, findings);
  check_volumes(mesh, findings);
  const auto has = [&](auto wanted) {
    return std::any_of(findings.begin(), findings.end(), wanted);
  };
  if (!has([](const Finding& f) { return f.flaw == Flaw::not_finite; }))
    check_double_nodes(mesh, contacts, findings);
  if (!has([](const Finding& f) { return f.is_error; })) check_plane(mesh, contacts, findings);
  check_sets(mesh, findings);
  return findings;
}

}  // namespace osculate::mesh
