#include "osculate/mesh/set_algebra.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <vector>

#include "osculate/mesh/generate_support.hpp"
#include "osculate/mesh/support.hpp"

namespace osculate::mesh {
namespace {

using Key = std::vector<Index>;

Key key_of(const Mesh& mesh, CellRef ref) {
  const Index* const nodes = nodes_of(mesh, ref);
  Key key(nodes, nodes + info_of(mesh, ref).nodes);
  std::sort(key.begin(), key.end());
  return key;
}

std::set<Key> keys_of(const Mesh& mesh, const Set& set) {
  std::set<Key> keys;
  for (const CellRef ref : set.cells) keys.insert(key_of(mesh, ref));
  return keys;
}

bool has_cells(const Set& set) { return set.dimension > 0 && !set.cells.empty(); }

bool same_kind(const Set& a, const Set& b) {
  return has_cells(a) && has_cells(b) && a.dimension == b.dimension;
}

/// The nodes of its cells.
void add_nodes(const Mesh& mesh, Set& set) {
  for (const CellRef ref : set.cells) {
    const Index* const nodes = nodes_of(mesh, ref);
    set.nodes.insert(set.nodes.end(), nodes, nodes + info_of(mesh, ref).nodes);
  }
  finish(set);
}

/// Cells of a set that are among the others, or are not.
Set chosen_cells(const Mesh& mesh, std::string name, const Set& set, const Set& other,
                 bool inside) {
  const std::set<Key> keys = keys_of(mesh, other);
  Set out{std::move(name), set.dimension, {}, {}};
  for (const CellRef ref : set.cells)
    if (keys.contains(key_of(mesh, ref)) == inside) out.cells.push_back(ref);
  add_nodes(mesh, out);
  return out;
}

}  // namespace

Set unite(const Mesh& mesh, std::string name, std::span<const Set* const> sets) {
  Set out{std::move(name), 0, {}, {}};
  const bool of_cells = std::all_of(sets.begin(), sets.end(),
                                    [&](const Set* s) { return same_kind(*s, *sets.front()); });
  std::set<Key> seen;
  for (const Set* const set : sets) {
    out.nodes.insert(out.nodes.end(), set->nodes.begin(), set->nodes.end());
    if (!of_cells) continue;
    out.dimension = set->dimension;
    for (const CellRef ref : set->cells)
      if (seen.insert(key_of(mesh, ref)).second) out.cells.push_back(ref);
  }
  finish(out);
  return out;
}

Set without(const Mesh& mesh, std::string name, const Set& set, const Set& other) {
  if (same_kind(set, other)) return chosen_cells(mesh, std::move(name), set, other, false);
  Set out{std::move(name), 0, {}, {}};
  std::set_difference(set.nodes.begin(), set.nodes.end(), other.nodes.begin(), other.nodes.end(),
                      std::back_inserter(out.nodes));
  return out;
}

Set common(const Mesh& mesh, std::string name, const Set& set, const Set& other) {
  if (same_kind(set, other)) {
    Set out = chosen_cells(mesh, name, set, other, true);
    if (!out.cells.empty()) return out;
  }
  Set out{std::move(name), 0, {}, {}};
  std::set_intersection(set.nodes.begin(), set.nodes.end(), other.nodes.begin(), other.nodes.end(),
                        std::back_inserter(out.nodes));
  return out;
}

}  // namespace osculate::mesh
