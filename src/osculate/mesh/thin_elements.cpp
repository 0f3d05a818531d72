#include "osculate/mesh/thin_elements.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <ranges>
#include <set>

namespace osculate::mesh {
namespace {

/// The nodes of a cell that one of the deck has become there, with their shares.
struct CellSection {
  Index node;
  std::vector<std::pair<Index, bool>> all;  ///< whether it is a corner of the cell

  [[nodiscard]] std::vector<std::pair<Index, double>> shares() const {
    const auto corners = std::ranges::count_if(all, [](const auto& one) { return one.second; });
    const bool simpson = corners == 2 && all.size() == 3;
    std::vector<std::pair<Index, double>> out;
    for (const auto& [n, corner] : all) {
      if (simpson)
        out.emplace_back(n, corner ? 1.0 / 6 : 4.0 / 6);
      else if (corner || corners == 0)
        out.emplace_back(n, 1.0 / static_cast<double>(corners > 0 ? corners : std::ssize(all)));
    }
    return out;
  }
};

/// By node of the deck, in the order that the format of VTK names them; none: the cell is of no
/// shell or beam.
std::vector<CellSection> sections_of(const Mesh& mesh, CellRef ref,
                                     const std::vector<Index>& node_of) {
  const Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
  std::vector<CellSection> found;
  for (const int k : cell::vtk_nodes(block.type)) {
    const Index n = block.cell(ref.cell)[k], of = node_of[static_cast<std::size_t>(n)];
    if (of < 0) return {};
    auto at = std::ranges::find(found, of, &CellSection::node);
    if (at == found.end()) at = found.insert(at, {of, {}});
    at->all.emplace_back(n, k < cell::info(block.type).corners);
  }
  return found;
}

std::optional<cell::CellType> deck_type(cell::CellType solid, std::size_t nodes) {
  using enum cell::CellType;
  const bool prism = solid == wedge6 || solid == wedge15, brick = solid == hex8 || solid == hex20;
  if (prism && nodes == 3) return tri3;
  if (prism && nodes == 6) return tri6;
  if (brick && nodes == 2) return line2;
  if (brick && nodes == 3) return line3;
  if (brick && nodes == 4) return quad4;
  if (brick && nodes == 8) return quad8;
  return std::nullopt;
}

/// The sections at a node of the deck, each with the number of elements that have it.
struct Gathered {
  std::vector<std::vector<std::pair<Index, bool>>> sections;
  std::map<Index, double> sum;
  int count = 0;
  bool split = false;  ///< elements have but parts of a section

  void add(CellSection section) {
    for (const auto& [n, share] : section.shares()) sum[n] += share;
    ++count;
    std::ranges::sort(section.all);
    if (std::ranges::find(sections, section.all) != sections.end()) return;
    for (const auto& other : sections) {
      std::vector<std::pair<Index, bool>> common;
      std::ranges::set_intersection(other, section.all, std::back_inserter(common));
      split = split || !common.empty();
    }
    sections.push_back(std::move(section.all));
  }
};

}  // namespace

const SectionMean* ThinElements::mean_of(Index node) const {
  const auto at = std::ranges::lower_bound(means, node, {}, &SectionMean::node);
  return at != means.end() && at->node == node ? &*at : nullptr;
}

ThinElements thin_elements(const Mesh& mesh) {
  ThinElements out;
  if (mesh.expanded.empty()) return out;
  std::vector<Index> node_of(mesh.nodes.size(), -1);
  std::set<Index> leading;
  for (const Expanded& one : mesh.expanded) {
    node_of[static_cast<std::size_t>(one.node)] = one.of;
    if (one.follows) leading.insert(one.of);
  }
  std::map<Index, Gathered> gathered;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const Block& block = mesh.blocks[b];
    if (cell::info(block.type).dimension != 3) continue;
    for (Index c = 0; c < block.size(); ++c) {
      const CellRef ref{static_cast<Index>(b), c};
      const std::vector<CellSection> sections = sections_of(mesh, ref, node_of);
      if (sections.empty()) continue;
      const std::optional<cell::CellType> type = deck_type(block.type, sections.size());
      if (!type) {
        out.complete = false;
        continue;
      }
      ThinElement& element = out.elements.emplace_back(ThinElement{ref, *type, {}});
      for (const CellSection& section : sections) {
        element.nodes.push_back(section.node);
        gathered[section.node].add(section);
      }
    }
  }
  for (const auto& [node, all] : gathered) {
    if (all.split) {
      out.complete = false;
      continue;
    }
    SectionMean& mean = out.means.emplace_back(SectionMean{node, {}, leading.contains(node)});
    for (const auto& [n, sum] : all.sum) mean.shares.emplace_back(n, sum / all.count);
  }
  return out;
}

}  // namespace osculate::mesh
