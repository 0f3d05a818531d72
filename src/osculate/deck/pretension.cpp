#include "osculate/deck/pretension.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>
#include <map>
#include <set>

namespace osculate::deck {
namespace {

using mesh::CellRef;

std::span<const Index> nodes_of(const mesh::Mesh& mesh, const CellRef& ref) {
  const mesh::Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
  return {block.cell(ref.cell), static_cast<std::size_t>(cell::info(block.type).nodes)};
}
std::vector<Index> corners_of(const mesh::Mesh& mesh, const CellRef& ref) {
  const mesh::Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
  const Index* const first = block.cell(ref.cell);
  std::vector<Index> corners(first, first + cell::info(block.type).corners);
  std::sort(corners.begin(), corners.end());
  return corners;
}
Vec3 centre(const mesh::Mesh& mesh, std::span<const Index> nodes) {
  Vec3 sum = Vec3::Zero();
  for (const Index n : nodes) sum += mesh.nodes[static_cast<std::size_t>(n)];
  return sum / static_cast<double>(nodes.size());
}

const mesh::Set& section_of(const Pretension& p, const mesh::Mesh& mesh) {
  const mesh::Set* const set = mesh.find_set(p.on.value);
  if (!set) throw core::InputError(p.on.mark, fmt::format("the mesh has no set '{}'", p.on.value));
  if (set->cells.empty() || set->dimension != (mesh::has_volumes(mesh) ? 2 : 1))
    throw core::InputError(p.on.mark,
                           fmt::format("set '{}' has no facets that cut a body", p.on.value));
  return *set;
}

/// Of one facet; its length counts by the area.
Vec3 normal_of(const mesh::Mesh& mesh, const CellRef& facet) {
  const std::span<const Index> nodes = nodes_of(mesh, facet);
  const auto at = [&](std::size_t k) { return mesh.nodes[static_cast<std::size_t>(nodes[k])]; };
  const auto count = static_cast<std::size_t>(
      cell::info(mesh.blocks[static_cast<std::size_t>(facet.block)].type).corners);
  if (count == 2) return Vec3::UnitZ().cross(Vec3(at(1) - at(0)));
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < count; ++k) sum += (at(k) - at(0)).cross(at((k + 1) % count) - at(0));
  return sum;
}

Vec3 axis_of(const Pretension& p, const mesh::Mesh& mesh) {
  Vec3 sum = Vec3::Zero();
  if (p.axis) sum = p.axis->value;
  for (const CellRef& facet : section_of(p, mesh).cells) {
    if (p.axis) break;
    const Vec3 normal = normal_of(mesh, facet);
    sum += (sum.dot(normal) < 0 ? -1.0 : 1.0) * normal;
  }
  if (!(sum.norm() > 0))
    throw core::InputError(p.axis ? p.axis->mark : p.on.mark, "the axis has no direction");
  return sum.normalized();
}

/// Cells at a section, and those on the side that the axis points to.
class Sides {
 public:
  Sides(const mesh::Mesh& mesh, const mesh::Set& section, int dimension)
      : mesh_(mesh),
        dimension_(dimension),
        at_section_(section.nodes.begin(), section.nodes.end()) {
    for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
      if (cell::info(mesh.blocks[b].type).dimension != dimension) continue;
      for (Index k = 0; k < mesh.blocks[b].size(); ++k) {
        const CellRef ref{static_cast<Index>(b), k};
        const auto nodes = nodes_of(mesh, ref);
        if (std::any_of(nodes.begin(), nodes.end(), [&](Index n) { return touches(n); }))
          cells_.push_back(ref);
      }
    }
    for (const CellRef& facet : section.cells) facets_.insert(corners_of(mesh, facet));
    for (std::size_t i = 0; i < cells_.size(); ++i)
      for (const Index n : corners_of(mesh, cells_[i])) of_node_[n].push_back(i);
  }

  /// The cells in front, as flags by the number of the cell among `cells`.
  [[nodiscard]] std::vector<bool> in_front(const Vec3& axis, const core::SourceMark& mark) const {
    std::vector<int> side(cells_.size(), 0);
    std::vector<std::size_t> open;
    for (const std::vector<Index>& facet : facets_) {
      int found = 0;
      for (const std::size_t i : of_node_.at(facet.front())) {
        const std::vector<Index> corners = corners_of(mesh_, cells_[i]);
        if (!std::includes(corners.begin(), corners.end(), facet.begin(), facet.end())) continue;
        const Vec3 way = centre(mesh_, nodes_of(mesh_, cells_[i])) - centre(mesh_, facet);
        side[i] = way.dot(axis) > 0 ? 1 : -1;
        found |= side[i] > 0 ? 1 : 2;
        open.push_back(i);
      }
      if (found != 3)
        throw core::InputError(mark,
                               "the facets of a section lie inside of a body, with cells "
                               "before and behind them along the axis");
    }
    while (!open.empty()) {
      const std::size_t i = open.back();
      open.pop_back();
      for (const std::size_t j : neighbours(i))
        if (side[j] == 0) {
          side[j] = side[i];
          open.push_back(j);
        }
    }
    std::vector<bool> front;
    for (const int s : side) front.push_back(s > 0);
    return front;
  }
  [[nodiscard]] const std::vector<CellRef>& cells() const { return cells_; }
  [[nodiscard]] bool touches(Index node) const { return at_section_.contains(node); }

 private:
  /// Cells behind the faces (edges in the plane) that are none of the section.
  [[nodiscard]] std::vector<std::size_t> neighbours(std::size_t i) const {
    const std::vector<Index> own = corners_of(mesh_, cells_[i]);
    std::set<std::size_t> near;
    for (const Index n : own) near.insert(of_node_.at(n).begin(), of_node_.at(n).end());
    std::vector<std::size_t> out;
    for (const std::size_t j : near) {
      std::vector<Index> shared;
      const std::vector<Index> other = corners_of(mesh_, cells_[j]);
      std::set_intersection(own.begin(), own.end(), other.begin(), other.end(),
                            std::back_inserter(shared));
      if (j != i && static_cast<int>(shared.size()) >= dimension_ && !facets_.contains(shared))
        out.push_back(j);
    }
    return out;
  }

  const mesh::Mesh& mesh_;
  int dimension_;
  std::set<Index> at_section_;
  std::vector<CellRef> cells_;
  std::set<std::vector<Index>> facets_;  ///< their corners, sorted
  std::map<Index, std::vector<std::size_t>> of_node_;
};

Index add_node(const Vec3& place, mesh::Mesh& mesh) {
  mesh.nodes.push_back(place);
  if (!mesh.numbers.empty())
    mesh.numbers.push_back(*std::max_element(mesh.numbers.begin(), mesh.numbers.end()) + 1);
  return static_cast<Index>(mesh.nodes.size()) - 1;
}

void rename(const std::map<Index, Index>& fresh, const CellRef& ref, mesh::Mesh& mesh) {
  mesh::Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
  const auto count = static_cast<std::size_t>(cell::info(block.type).nodes);
  const auto first = block.connectivity.begin() +
                     static_cast<std::ptrdiff_t>(count * static_cast<std::size_t>(ref.cell));
  for (auto n = first; n != first + static_cast<std::ptrdiff_t>(count); ++n)
    if (const auto found = fresh.find(*n); found != fresh.end()) *n = found->second;
}

/// Facets and edges of the cells in front, but not those of the section itself.
std::vector<CellRef> attached(const mesh::Mesh& mesh, const Sides& sides,
                              const std::vector<bool>& front, int dimension) {
  std::map<Index, std::vector<std::vector<Index>>> bodies;  // sorted nodes of cells, by node
  for (std::size_t i = 0; i < front.size(); ++i) {
    if (!front[i]) continue;
    const auto nodes = nodes_of(mesh, sides.cells()[i]);
    std::vector<Index> sorted(nodes.begin(), nodes.end());
    std::sort(sorted.begin(), sorted.end());
    for (const Index n : sorted)
      if (sides.touches(n)) bodies[n].push_back(sorted);
  }
  std::vector<CellRef> out;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    if (cell::info(mesh.blocks[b].type).dimension >= dimension) continue;
    for (Index k = 0; k < mesh.blocks[b].size(); ++k) {
      const CellRef ref{static_cast<Index>(b), k};
      const auto span = nodes_of(mesh, ref);
      std::vector<Index> nodes(span.begin(), span.end());
      std::sort(nodes.begin(), nodes.end());
      const auto touching =
          std::find_if(nodes.begin(), nodes.end(), [&](Index n) { return sides.touches(n); });
      if (touching == nodes.end() ||
          std::all_of(nodes.begin(), nodes.end(), [&](Index n) { return sides.touches(n); }))
        continue;
      const auto& around = bodies[*touching];
      if (std::any_of(around.begin(), around.end(), [&](const std::vector<Index>& body) {
            return std::includes(body.begin(), body.end(), nodes.begin(), nodes.end());
          }))
        out.push_back(ref);
    }
  }
  return out;
}

/// Sets of cells have the nodes of these; sets of nodes get the new ones where they have a whole
/// cell of those in front.
void renew_sets(const std::map<Index, Index>& fresh, const std::vector<CellRef>& front,
                mesh::Mesh& mesh) {
  std::map<Index, Index> old;
  for (const auto& [before, now] : fresh) old[now] = before;
  for (mesh::Set& set : mesh.sets) {
    std::set<Index> nodes;
    for (const CellRef& ref : set.cells)
      for (const Index n : nodes_of(mesh, ref)) nodes.insert(n);
    if (set.cells.empty()) {
      nodes.insert(set.nodes.begin(), set.nodes.end());
      for (const CellRef& ref : front) {
        const auto of_cell = nodes_of(mesh, ref);
        const bool whole = std::all_of(of_cell.begin(), of_cell.end(), [&](Index n) {
          const auto found = old.find(n);
          return std::binary_search(set.nodes.begin(), set.nodes.end(),
                                    found == old.end() ? n : found->second);
        });
        for (const Index n : of_cell)
          if (whole && old.contains(n)) nodes.insert(n);
      }
    }
    set.nodes.assign(nodes.begin(), nodes.end());
  }
}

/// The node of the mesh that carries the shortening; -1: none is named.
Index carrier_of(const Pretension& p, const mesh::Mesh& mesh) {
  if (!p.node) return -1;
  const mesh::Set* const set = mesh.find_set(p.node->value);
  if (!set)
    throw core::InputError(p.node->mark, fmt::format("the mesh has no set '{}'", p.node->value));
  if (set->nodes.size() != 1)
    throw core::InputError(p.node->mark, fmt::format("set '{}' has {} nodes, not one",
                                                     p.node->value, set->nodes.size()));
  for (const mesh::Block& block : mesh.blocks)
    if (std::find(block.connectivity.begin(), block.connectivity.end(), set->nodes[0]) !=
        block.connectivity.end())
      throw core::InputError(p.node->mark,
                             fmt::format("the node of '{}' belongs to a cell", p.node->value));
  return set->nodes[0];
}

}  // namespace

void cut(const Pretension& p, mesh::Mesh& mesh) {
  if (mesh.find_set(p.name.value))
    throw core::InputError(p.name.mark,
                           fmt::format("the mesh has a set '{}' already", p.name.value));
  const mesh::Set section = section_of(p, mesh);
  const int dimension = section.dimension + 1;
  const Vec3 axis = axis_of(p, mesh);
  const Sides sides(mesh, section, dimension);
  const std::vector<bool> front = sides.in_front(axis, p.on.mark);
  const std::vector<CellRef> facets = attached(mesh, sides, front, dimension);
  std::map<Index, Index> fresh;
  for (const Index n : section.nodes)
    fresh[n] = add_node(mesh.nodes[static_cast<std::size_t>(n)], mesh);
  std::vector<CellRef> in_front;
  for (std::size_t i = 0; i < front.size(); ++i)
    if (front[i]) in_front.push_back(sides.cells()[i]);
  for (const CellRef& ref : in_front) rename(fresh, ref, mesh);
  for (const CellRef& ref : facets) rename(fresh, ref, mesh);
  renew_sets(fresh, in_front, mesh);
  std::vector<Index> fresh_nodes;
  for (const auto& entry : fresh) fresh_nodes.push_back(entry.second);
  mesh.sets.push_back({p.name.value + ".behind", 0, {}, section.nodes});
  mesh.sets.push_back({p.name.value + ".front", 0, {}, std::move(fresh_nodes)});
  const Index node = carrier_of(p, mesh);
  mesh.sets.push_back(
      {p.name.value, 0, {}, {node >= 0 ? node : add_node(centre(mesh, section.nodes), mesh)}});
}

Vec3 mean_normal(const mesh::Mesh& mesh, const mesh::Set& set) {
  Vec3 sum = Vec3::Zero();
  for (const CellRef& facet : set.cells) sum += normal_of(mesh, facet);
  return sum;
}

Cut cut_of(const Pretension& p, const mesh::Mesh& mesh) {
  const mesh::Set* const one = mesh.find_set(p.name.value + ".behind");
  const mesh::Set* const other = mesh.find_set(p.name.value + ".front");
  const mesh::Set* const node = mesh.find_set(p.name.value);
  Cut out;
  if (!one || !other || !node) return out;
  for (std::size_t i = 0; i < one->nodes.size(); ++i)
    out.nodes.push_back({one->nodes[i], other->nodes[i]});
  out.axis = axis_of(p, mesh);
  out.node = node->nodes[0];
  return out;
}

}  // namespace osculate::deck
