#pragma once
#include <string>
#include <string_view>

#include "osculate/io/inp/scope.hpp"

namespace osculate::io::inp {

/// Of an `*ELEMENT`: it has one node, which `*DISTRIBUTING COUPLING` ties to others.
[[nodiscard]] bool is_coupling(const Card& element);
/// The set of one node: `node 17`.
[[nodiscard]] std::string node_set_name(std::int32_t number);
/// The facets of a set of elements (or of the element of a number) that a load `P3` acts on:
/// `P3 of BLOCK`.
[[nodiscard]] std::string side_set_name(std::string_view load, std::string_view elements);
/// Whether a load of `*DLOAD` (in capitals) is a pressure on a numbered side: P1, P2, ..., of
/// shells P as well.
[[nodiscard]] bool is_side_load(std::string_view load);

/// Adds sets for what boundary conditions, loads and equations name by numbers of nodes, and for
/// the sides of elements that pressures act on.
///
/// Tested by  tests/unit/deck/test_inp_translate.cpp
void add_loaded_sets(const Deck& deck, RawMesh& mesh);

}  // namespace osculate::io::inp
