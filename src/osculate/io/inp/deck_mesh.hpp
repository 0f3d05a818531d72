#pragma once
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "osculate/io/inp/cards.hpp"
#include "osculate/mesh/mesh.hpp"

namespace osculate::io::inp {

/// A deck has four kinds of names, each for itself.
enum class SetKind : std::uint8_t { elements, surface, nodes, node_surface };

/// What a name of the deck became.
struct DeckSet {
  SetKind kind;
  std::string name;  ///< as first written; of instances `instance.name`
  std::size_t set;   ///< place in Mesh::sets
  /// Of elements: the one type that they have, in capitals; else empty.
  std::string type{};
};

/// The elements of one type (in capitals) of a set that `*SOLID SECTION` names, where it has
/// several: `BLOCK of C3D20R`.
[[nodiscard]] std::string typed_set_name(std::string_view elements, std::string_view type);

/// Nodes that move as one where shells or beams meet.
struct DeckKnot {
  Index node;       ///< the deck's, to which its supports and loads refer
  std::string set;  ///< of all of them: `knot 17`
};

struct DeckMesh {
  mesh::Mesh mesh;
  std::vector<DeckSet> sets;
  std::vector<DeckKnot> knots{};
  bool sectors = false;  ///< axisymmetric elements became sectors of 2 degrees
  /// Numbers of nodes that sets list and that do not exist, with a line each: left out.
  std::map<std::int64_t, std::uint32_t> missing{};
  /// Masses and others that are no cells, by number, of sets of elements (in capitals).
  std::map<std::string, std::set<std::int32_t>> discrete{};
};

/// Of a set of elements that `*SHELL SECTION, COMPOSITE` names: one of its layers, the first of
/// which is the lowest.
[[nodiscard]] std::string set_of_layer(std::string_view elements, std::size_t layer);
/// Of a set of nodes with some in knots: the set of the others.
[[nodiscard]] std::string set_without_knots(std::string_view nodes);
/// Of a set of nodes: the set of the nodes whose displacements are their rotations.
[[nodiscard]] std::string set_of_rotations(std::string_view nodes);

/// The mesh that the cards of a deck describe, see io::read_inp.
///
/// Tested by  tests/unit/io/test_inp.cpp, test_inp_parts.cpp, test_inp_broken.cpp
[[nodiscard]] DeckMesh deck_mesh(const Deck& deck);

}  // namespace osculate::io::inp
