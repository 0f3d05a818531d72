#include "osculate/mesh/join.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "osculate/mesh/generate_support.hpp"

namespace osculate::mesh {
namespace {

/// All cells of the highest dimension.
Set whole_of(const Mesh& part) {
  Set all;
  for (const Block& block : part.blocks)
    if (block.size() > 0) all.dimension = std::max(all.dimension, cell::info(block.type).dimension);
  for (std::size_t b = 0; b < part.blocks.size(); ++b) {
    const Block& block = part.blocks[b];
    if (cell::info(block.type).dimension != all.dimension) continue;
    for (Index c = 0; c < block.size(); ++c) all.cells.push_back({static_cast<Index>(b), c});
    all.nodes.insert(all.nodes.end(), block.connectivity.begin(), block.connectivity.end());
  }
  finish(all);
  return all;
}

}  // namespace

void place(Mesh& mesh, const Placement& placement) {
  for (Vec3& x : mesh.nodes) x *= placement.scale;
  turn(mesh.nodes, placement.angle, placement.about, placement.axis);
  for (Vec3& x : mesh.nodes) x += placement.move;
}

namespace {

/// Numbers of a file stay what they are; places count where there are none.
void append_numbers(const std::vector<std::int64_t>& added, std::size_t before, std::size_t count,
                    std::vector<std::int64_t>& numbers) {
  if (added.empty() && numbers.empty()) return;
  for (std::size_t i = numbers.size(); i < before; ++i)
    numbers.push_back(static_cast<std::int64_t>(i) + 1);
  for (std::size_t i = 0; i < count; ++i)
    numbers.push_back(added.empty() ? static_cast<std::int64_t>(before + i) + 1 : added[i]);
}

}  // namespace

void append_mesh(Mesh& mesh, const Mesh& part, const std::string& name,
                 const core::SourceMark& mark) {
  const Context context{mark, fmt::format("mesh '{}'", name)};
  std::vector<std::string> names;
  for (const Set& set : part.sets) names.push_back("." + set.name);
  check_names(mesh, context, name, std::vector<std::string_view>(names.begin(), names.end()));
  check_size(context, mesh, static_cast<double>(part.nodes.size()));
  const auto first = static_cast<Index>(mesh.nodes.size());
  append_numbers(part.numbers, mesh.nodes.size(), part.nodes.size(), mesh.numbers);
  mesh.nodes.insert(mesh.nodes.end(), part.nodes.begin(), part.nodes.end());
  std::vector<CellRef> begin;  // of each block of the part
  for (const Block& block : part.blocks) {
    const Index at = block_index(mesh, block.type);
    Block& target = mesh.blocks[static_cast<std::size_t>(at)];
    begin.push_back({at, target.size()});
    append_numbers(block.numbers, static_cast<std::size_t>(target.size()),
                   static_cast<std::size_t>(block.size()), target.numbers);
    for (const Index node : block.connectivity) target.connectivity.push_back(first + node);
  }
  const auto add = [&](Set set, std::string full_name) {
    set.name = std::move(full_name);
    for (Index& node : set.nodes) node += first;
    for (CellRef& ref : set.cells) {
      const CellRef& start = begin[static_cast<std::size_t>(ref.block)];
      ref = {start.block, start.cell + ref.cell};
    }
    mesh.sets.push_back(std::move(set));
  };
  for (const Expanded& one : part.expanded)
    mesh.expanded.push_back({first + one.node, first + one.of, one.height, one.follows});
  for (Relation relation : part.relations) {
    for (Relation::Term& term : relation.terms) term.node += first;
    if (relation.from.node >= 0) relation.from.node += first;
    mesh.relations.push_back(std::move(relation));
  }
  add(whole_of(part), name);
  for (std::size_t s = 0; s < part.sets.size(); ++s) add(part.sets[s], name + names[s]);
}

}  // namespace osculate::mesh
