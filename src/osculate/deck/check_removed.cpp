// Contact at the surfaces of cells that steps have removed.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "osculate/deck/build_cells.hpp"
#include "osculate/model/bulk.hpp"

namespace osculate::deck {
namespace {

/// Facets of a pair by their first node.
using FacetsAt = std::multimap<Index, std::span<const Index>>;

template <int Dim>
FacetsAt facets_of(const pairing::PairDefinition<Dim>& pair) {
  FacetsAt facets;
  for (const auto* const boundary : {&pair.slave.boundary, &pair.master})
    for (const auto& facet : boundary->facets)
      if (!facet.shape)
        facets.emplace(
            facet.nodes[0],
            std::span<const Index>(facet.nodes).first(static_cast<std::size_t>(facet.count)));
  return facets;
}

bool is_behind_one(std::span<const Index> cell, const FacetsAt& facets) {
  const auto has = [&](Index n) { return std::ranges::find(cell, n) != cell.end(); };
  return std::ranges::any_of(cell, [&](Index n) {
    const auto [first, last] = facets.equal_range(n);
    return std::any_of(first, last,
                       [&](const auto& facet) { return std::ranges::all_of(facet.second, has); });
  });
}

/// Whether the pair acts in a step.
template <int Dim>
bool acts(const model::BasicModel<Dim>& m, std::size_t pair, std::size_t step) {
  bool active = true;
  for (const model::BasicPairChange<Dim>& change : m.pair_changes)
    if (change.pair == pair && change.step <= step) active = change.active;
  return active;
}

/// What made the cells of this step be away, or the pair be there: the change to blame.
core::SourceMark blamed(const Step& step) {
  if (!step.remove.empty()) return step.remove.front().mark;
  return step.contact.empty() ? step.name.mark : step.contact.front().mark;
}

}  // namespace

template <int Dim>
void check_removed(const BuildContext<Dim>& c) {
  const model::BasicModel<Dim>& m = c.model();
  for (std::size_t p = 0; p < m.pairs.size(); ++p) {
    const model::BasicContactPair<Dim>& pair = m.pairs[p];
    std::optional<FacetsAt> facets;
    for (std::size_t s = 0; s < c.removed_cells.size(); ++s) {
      if (c.removed_cells[s].empty() || !acts(m, p, s)) continue;
      const Step& step = c.description.steps[s];
      const auto refuse = [&](const std::string& what) {
        throw core::InputError(
            blamed(step),
            fmt::format("{} in step '{}', in which the pair is active: make it inactive "
                        "(`contact: [{{pair: {}, active: false}}]`), or let them stay",
                        what, step.name.value, pair.name));
      };
      for (const Index n : pair.definition.slave.nodes)
        if (c.bare_nodes[s].contains(n))
          refuse(fmt::format("{} of contact '{}' has no cell left", mesh::describe_node(m.mesh, n),
                             pair.name));
      if (!facets) facets = facets_of(pair.definition);
      for (const auto& [block, cell] : c.removed_cells[s])
        if (is_behind_one(model::cell_nodes(m.mesh, {block, cell}).nodes, *facets))
          refuse(fmt::format("cell {} at the surface of contact '{}' is removed",
                             mesh::cell_number(m.mesh, {block, cell}), pair.name));
    }
  }
}

template void check_removed(const BuildContext<2>&);
template void check_removed(const BuildContext<3>&);

}  // namespace osculate::deck
