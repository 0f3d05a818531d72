#pragma once
#include <vector>

#include "osculate/io/inp/scope.hpp"
#include "osculate/io/number_map.hpp"
#include "osculate/mesh/mesh.hpp"

namespace osculate::io::inp {

struct Element {
  const ElementType* type = nullptr;
  mesh::CellRef cell{};
  std::size_t variant = 0;              ///< place in Numbering::variants
  std::vector<Index> deck_nodes{};      ///< of one that was expanded: those that the deck names
  Family deck_family = Family::solid;   ///< of one that was expanded: surface or line
  std::vector<mesh::CellRef> others{};  ///< of one that was expanded to several cells: the others
  bool layered = false;                 ///< these are the layers above the first one
};

/// Where the nodes and elements of one scope are in the mesh.
struct ScopeNumbers {
  NumberMap nodes, elements;
  Index first_node = 0;     ///< what is added to a place in `nodes`
  Index first_element = 0;  ///< what is added to a place in `elements`
};

/// Where all nodes and elements of a deck are in its mesh.
struct Numbering {
  std::vector<ScopeNumbers> scopes;  ///< as those of RawMesh
  std::vector<Element> elements;
  std::vector<std::string> variants;  ///< C3D20R and others, in capitals
};

/// Makes nodes and cells of what the scopes hold, which is moved from: those of instances first,
/// in the order of their numbers. The mesh has the deck's numbers unless instances share some.
///
/// Errors     core::InputError: numbers used twice, nodes that do not exist, no nodes, no elements
/// Tested by  tests/unit/io/test_inp.cpp, test_inp_parts.cpp, test_inp_broken.cpp
[[nodiscard]] Numbering add_cells(const Deck& deck, RawMesh& raw, mesh::Mesh& mesh);

/// Place of a variant among those of the numbering; a new one if it is not there.
[[nodiscard]] std::size_t variant_place(Numbering& numbering, const std::string& variant);

/// The block of that type; a new one if there is none.
[[nodiscard]] Index block_of_type(mesh::Mesh& mesh, cell::CellType type);

}  // namespace osculate::io::inp
