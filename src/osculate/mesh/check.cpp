#include "osculate/mesh/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

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

std::string cell_name(const Block& block, Index c) {
  std::string nodes;
  for (int k = 0; k < cell::info(block.type).nodes; ++k)
    nodes += fmt::format("{}{}", k > 0 ? " " : "", std::int64_t{block.cell(c)[k]} + 1);
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
  std::array<Tally, 3> twice;  // by dimension
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
        repeated.add(cell_name(block, c));
    }
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
      const auto relation = std::lexicographical_compare_three_way(
          begin_of(a), begin_of(a) + width, begin_of(b), begin_of(b) + width);
      return relation != 0 ? relation < 0 : a < b;
    });
    for (std::size_t i = 1; i < order.size(); ++i)
      if (std::equal(begin_of(order[i - 1]), begin_of(order[i - 1]) + width, begin_of(order[i])))
        twice[static_cast<std::size_t>(cell::info(block.type).dimension)].add(
            cell_name(block, order[i]));
  }
  report(findings, Flaw::repeated_node, true, repeated, "cell(s) that name a node twice");
  report(findings, Flaw::duplicate_area, true, twice[2], "area cell(s) that are there twice");
  report(findings, Flaw::duplicate_line, false, twice[1], "line cell(s) that are there twice");
}

void check_nodes(const Mesh& mesh, std::vector<Finding>& findings) {
  Tally infinite;
  Tally unused;
  std::vector<bool> used(mesh.nodes.size());
  for (const Block& block : mesh.blocks)
    if (cell::info(block.type).dimension > 0)
      for (const Index node : block.connectivity) used[static_cast<std::size_t>(node)] = true;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    const Vec3& x = mesh.nodes[i];
    const std::string text =
        (used[i] && x.allFinite()) ? "" : fmt::format("{} ({:.6g}, {:.6g})", i + 1, x.x(), x.y());
    if (!x.allFinite()) infinite.add(text);
    if (!used[i]) unused.add(text);
  }
  report(findings, Flaw::not_finite, true, infinite, "node(s) with coordinates that are no number");
  report(findings, Flaw::unused_node, false, unused, "node(s) of no line or area cell");
}

}  // namespace

std::vector<Finding> check_mesh(const Mesh& mesh) {
  std::vector<Finding> findings;
  report(findings, Flaw::bad_index, true, bad_indices(mesh), "reference(s) to what is not there");
  if (!findings.empty()) return findings;
  check_cells(mesh, findings);
  check_nodes(mesh, findings);
  return findings;
}

}  // namespace osculate::mesh
