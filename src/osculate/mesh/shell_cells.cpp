#include "osculate/mesh/shell_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "osculate/cell/volume_shape.hpp"
#include "osculate/mesh/boundary.hpp"
#include "osculate/mesh/shell_direction.hpp"

namespace osculate::mesh {
namespace {

using cell::CellType;

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// The corners of the cells as hex8, numbered with the thickness as their third direction.
Mesh aligned_corners(const Mesh& mesh, std::span<const CellRef> cells) {
  Mesh corners{mesh.nodes, {{CellType::hex8, {}}}, {}};
  std::vector<CellRef> all;
  for (const CellRef& ref : cells) {
    const Index* const nodes = mesh.blocks[at(ref.block)].cell(ref.cell);
    corners.blocks[0].connectivity.insert(corners.blocks[0].connectivity.end(), nodes, nodes + 8);
    all.push_back({0, static_cast<Index>(all.size())});
  }
  (void)align_shells(corners, all);
  return corners;
}

/// The nodes of a shell18 in a hex27 whose corners are taken in another order.
std::vector<Index> shell_nodes(const Index* nodes, const Index* corners) {
  const auto place = [&](Index node) {
    return cell::volume_node(CellType::hex27,
                             static_cast<int>(std::find(nodes, nodes + 8, node) - nodes));
  };
  std::vector<Index> out;
  for (int n = 0; n < 18; ++n) {
    // Corners, middles of edges and of the face are the mean of the corners they lie between.
    const Vec3 wanted = cell::volume_node(CellType::shell18, n);
    Vec3 there = Vec3::Zero();
    double count = 0;
    for (int c = 0; c < 8; ++c) {
      if ((wanted - cell::volume_node(CellType::hex8, c)).lpNorm<Eigen::Infinity>() > 1.5) continue;
      there += place(corners[c]);
      ++count;
    }
    there /= count;
    for (int k = 0; k < 27; ++k)
      if ((cell::volume_node(CellType::hex27, k) - there).norm() < 0.1) out.push_back(nodes[k]);
  }
  return out;
}

/// What becomes of a cell that loses nodes; its own type: nothing.
CellType without_middles(CellType type) {
  return type == CellType::quad9   ? CellType::quad4
         : type == CellType::line3 ? CellType::line2
                                   : type;
}

/// Cells move to blocks of their new types.
class Renumbering {
 public:
  explicit Renumbering(Mesh& mesh) : mesh_(mesh) {}

  void take(Index block, Index c, CellType type, std::span<const Index> nodes) {
    const auto [slot, fresh] = places_.try_emplace({block, type}, blocks_.size());
    if (fresh) blocks_.push_back({type, {}});
    Block& to = blocks_[slot->second];
    moved_[{block, c}] = {static_cast<Index>(slot->second), to.size()};
    to.connectivity.insert(to.connectivity.end(), nodes.begin(), nodes.end());
    const std::vector<std::int64_t>& numbers = mesh_.blocks[at(block)].numbers;
    if (!numbers.empty()) to.numbers.push_back(numbers[at(c)]);
  }

  void finish(const std::vector<bool>& dropped) {
    mesh_.blocks = std::move(blocks_);
    for (Set& set : mesh_.sets) {
      for (CellRef& ref : set.cells) ref = moved_.at({ref.block, ref.cell});
      std::erase_if(set.nodes, [&](Index node) { return dropped[at(node)]; });
    }
  }

 private:
  Mesh& mesh_;
  std::vector<Block> blocks_;
  std::map<std::pair<Index, CellType>, std::size_t> places_;
  std::map<std::pair<Index, Index>, CellRef> moved_;
};

}  // namespace

std::string make_shell18(Mesh& mesh, std::span<const CellRef> cells) {
  std::vector<CellRef> thick;
  for (const CellRef& ref : cells)
    if (mesh.blocks[at(ref.block)].type == CellType::hex27) thick.push_back(ref);
  if (thick.empty()) return {};
  const Mesh corners = aligned_corners(mesh, thick);
  std::map<std::pair<Index, Index>, std::vector<Index>> shells;
  std::vector<bool> dropped(mesh.nodes.size(), false);
  for (std::size_t i = 0; i < thick.size(); ++i) {
    const Index* const nodes = mesh.blocks[at(thick[i].block)].cell(thick[i].cell);
    std::vector<Index>& kept = shells[{thick[i].block, thick[i].cell}];
    kept = shell_nodes(nodes, corners.blocks[0].cell(static_cast<Index>(i)));
    for (int k = 0; k < 27; ++k)
      if (std::find(kept.begin(), kept.end(), nodes[k]) == kept.end()) dropped[at(nodes[k])] = true;
  }
  for (const auto& [ref, kept] : shells)
    for (const Index node : kept)
      if (dropped[at(node)])
        return fmt::format("the thickness of a cell is not that of its neighbour at {}",
                           describe_node(mesh, node));
  Renumbering renumbering(mesh);
  for (Index b = 0; b < static_cast<Index>(mesh.blocks.size()); ++b) {
    const Block& block = mesh.blocks[at(b)];
    const auto count = static_cast<std::size_t>(cell::info(block.type).nodes);
    for (Index c = 0; c < block.size(); ++c) {
      const std::span<const Index> nodes(block.cell(c), count);
      if (const auto shell = shells.find({b, c}); shell != shells.end()) {
        renumbering.take(b, c, CellType::shell18, shell->second);
        continue;
      }
      const auto lost =
          std::find_if(nodes.begin(), nodes.end(), [&](Index node) { return dropped[at(node)]; });
      const CellType type = lost == nodes.end() ? block.type : without_middles(block.type);
      if (lost != nodes.end() && type == block.type && block.type != CellType::point1)
        return fmt::format(
            "{}, which is halfway through the thickness of a shell, belongs to a {} "
            "cell too",
            describe_node(mesh, *lost), cell::info(block.type).name);
      renumbering.take(b, c, type, nodes.first(static_cast<std::size_t>(cell::info(type).nodes)));
    }
  }
  renumbering.finish(dropped);
  return {};
}

}  // namespace osculate::mesh
