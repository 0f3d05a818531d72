#pragma once
#include <span>
#include <string>

#include "osculate/mesh/mesh.hpp"

namespace osculate::mesh {

// Sets made of sets. Cells are the same if they have the same nodes. Sets of cells of one dimension
// make a set of such cells; in every other case the result is a set of nodes.
//
// Tested by  tests/unit/mesh/test_set_algebra.cpp

/// What is in one of them.
[[nodiscard]] Set unite(const Mesh& mesh, std::string name, std::span<const Set* const> sets);
/// What is in `set`, but not in `other`; nodes of `other` that cells of the rest use stay.
[[nodiscard]] Set without(const Mesh& mesh, std::string name, const Set& set, const Set& other);
/// What is in both; where sets of cells share no cell (two sides of a body), the nodes they share.
[[nodiscard]] Set common(const Mesh& mesh, std::string name, const Set& set, const Set& other);

}  // namespace osculate::mesh
