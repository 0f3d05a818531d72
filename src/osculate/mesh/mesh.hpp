#pragma once
#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "osculate/cell/cell_type.hpp"
#include "osculate/core/types.hpp"

namespace osculate::mesh {

/// Cells of one type, connectivity flattened (node indices 0-based, Gmsh order).
struct Block {
  cell::CellType type;
  std::vector<Index> connectivity;
  std::vector<std::int64_t> numbers{};  ///< of the cells in the mesh file; empty: none
  [[nodiscard]] Index size() const {
    return static_cast<Index>(connectivity.size()) / cell::info(type).nodes;
  }
  [[nodiscard]] const Index* cell(Index c) const {
    return connectivity.data() + static_cast<std::size_t>(c) * cell::info(type).nodes;
  }
};

/// One cell of the mesh.
struct CellRef {
  Index block;
  Index cell;
  bool operator==(const CellRef&) const = default;
};

/// A named set: cells of one dimension (0 points, 1 lines, 2 areas, 3 volumes) and all their nodes
/// (sorted, unique). A pure node set has dimension 0 and may have no cells.
struct Set {
  std::string name;
  int dimension = 0;
  std::vector<CellRef> cells;
  std::vector<Index> nodes;
  bool any_case = false;  ///< its name may be written in capital and small letters alike
};

/// Displacements that depend on each other by what a mesh stands for: sum of factor * u = 0. A node
/// of a shell or beam moves as the mean of the nodes that it was expanded to (io::read_inp). The
/// first term is what follows from the others.
struct Relation {
  struct Term {
    Index node;
    int direction;
    double factor;
  };
  /// A displacement of a node, or (direction -1) any of its displacements.
  struct Support {
    Index node = -1;
    int direction = -1;
    bool operator==(const Support&) const = default;
  };
  std::vector<Term> terms;
  Support from{};  ///< it holds from the step on that prescribes this; without a node always
};

/// A node that one of a shell, a beam or a plane element was expanded to (io::read_inp): it has the
/// temperature of that one, whose force it is a part of.
struct Expanded {
  Index node;
  Index of;     ///< what the file has
  Vec2 height;  ///< from there along the normal of a shell or the second axis of a beam, and along
                ///< the first axis of a beam
  bool follows = false;  ///< of plane elements: it moves with that one, not that one as the mean
};

/// Whether names differ at most in capital and small letters (of ASCII).
[[nodiscard]] inline bool same_but_for_case(std::string_view a, std::string_view b) {
  const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return small(x) == small(y); });
}

/// Nodes, cells, named sets, relations of nodes and what these stand for; nothing else. Coordinates
/// always have three components (z = 0 for plane problems).
struct Mesh {
  std::vector<Vec3> nodes;
  std::vector<Block> blocks;
  std::vector<Set> sets;
  std::vector<std::int64_t> numbers{};  ///< of the nodes in the mesh file; empty: 1, 2, ...
  std::vector<Relation> relations{};
  std::vector<Expanded> expanded{};
  std::unordered_map<std::string, std::size_t> place_of_set{};  ///< of `remember_names`, a hint

  /// The set of that name, else one that is called so but for capital letters.
  [[nodiscard]] const Set* find_set(std::string_view name) const {
    if (const auto hint = place_of_set.find(std::string(name)); hint != place_of_set.end())
      if (hint->second < sets.size() && sets[hint->second].name == name) return &sets[hint->second];
    for (const Set& set : sets)
      if (set.name == name) return &set;
    for (const Set& set : sets)
      if (set.any_case && same_but_for_case(set.name, name)) return &set;
    return nullptr;
  }
};

/// Notes where sets stand, for meshes of thousands of sets (decks that name nodes one by one).
inline void remember_names(Mesh& mesh) {
  mesh.place_of_set.clear();
  for (std::size_t s = 0; s < mesh.sets.size(); ++s)
    mesh.place_of_set.try_emplace(mesh.sets[s].name, s);
}

/// What the user calls a node: its number in the mesh file.
[[nodiscard]] inline std::int64_t node_number(const Mesh& mesh, Index node) {
  return mesh.numbers.empty() ? std::int64_t{node} + 1
                              : mesh.numbers[static_cast<std::size_t>(node)];
}

/// What the user calls a cell: its number in the mesh file; of generated meshes that within cells
/// of its type.
[[nodiscard]] inline std::int64_t cell_number(const Mesh& mesh, const CellRef& ref) {
  const Block& block = mesh.blocks[static_cast<std::size_t>(ref.block)];
  return block.numbers.empty() ? std::int64_t{ref.cell} + 1
                               : block.numbers[static_cast<std::size_t>(ref.cell)];
}

/// True if there are volume cells.
[[nodiscard]] inline bool has_volumes(const Mesh& mesh) {
  for (const Block& block : mesh.blocks)
    if (cell::info(block.type).dimension == 3 && block.size() > 0) return true;
  return false;
}

}  // namespace osculate::mesh
