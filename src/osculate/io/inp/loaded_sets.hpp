#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "osculate/io/inp/scope.hpp"

namespace osculate::io::inp {

/// Number of nodes of an `*ELEMENT` that is no cell: springs, dampers, masses, gaps, and DCOUP3D,
/// whose node `*DISTRIBUTING COUPLING` ties to others. 0: it is one.
[[nodiscard]] int discrete_nodes(const Card& element);
/// The set of one node: `node 17`.
[[nodiscard]] std::string node_set_name(std::int32_t number);
/// The set of elements that a body force acts on: its name, or `element 17` for a number.
[[nodiscard]] std::string element_set_name(std::string_view elements);
/// The facets of a set of elements (or of the element of a number) that a load `P3` acts on:
/// `P3 of BLOCK`.
[[nodiscard]] std::string side_set_name(std::string_view load, std::string_view elements);
/// Whether a load of `*DLOAD` (in capitals) is a pressure on a numbered side: P1, P2, ..., of
/// shells P as well.
[[nodiscard]] bool is_side_load(std::string_view load);

/// Whether it is a force per length of an edge of shells, in their plane: EDNOR1 to EDNOR4.
[[nodiscard]] bool is_edge_load(std::string_view load);

/// Set of all elements, which a body force without a set acts on.
inline constexpr std::string_view every_element = "every element";
/// Directions that a word of `*BOUNDARY` holds: ENCASTRE 1 to 6, PINNED 1 to 3, XSYMM 1, 5, 6 and
/// its kin, XASYMM 2, 3, 4 and its kin. Empty: no such word.
///
/// Source     Abaqus Keywords Guide, *BOUNDARY
[[nodiscard]] std::vector<int> held_directions(std::string_view word);

/// Adds sets for what boundary conditions, loads and equations name by numbers of nodes, and for
/// the sides of elements that pressures act on.
///
/// Tested by  tests/unit/deck/test_inp_translate.cpp
void add_loaded_sets(const Deck& deck, RawMesh& mesh);

}  // namespace osculate::io::inp
