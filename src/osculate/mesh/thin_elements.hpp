#pragma once
#include <utility>
#include <vector>

#include "osculate/mesh/mesh.hpp"

namespace osculate::mesh {

/// A shell, beam or plane element of a deck that has become a cell of the mesh (io::read_inp): as
/// the deck has it.
struct ThinElement {
  CellRef cell;
  cell::CellType type;       ///< line2, line3, tri3, tri6, quad4, quad8
  std::vector<Index> nodes;  ///< of the deck, in the order of `type`
};

/// What is told of a node of the deck: sum of share * value over the nodes of its section.
struct SectionMean {
  Index node;
  std::vector<std::pair<Index, double>> shares;
  bool leads = false;  ///< a node of plane elements: the displacement is its own
};

struct ThinElements {
  std::vector<ThinElement> elements;
  std::vector<SectionMean> means;  ///< sorted by node
  bool complete = true;  ///< false: of some (layers, hollow sections) there is nothing here

  [[nodiscard]] const SectionMean* mean_of(Index node) const;
};

/// Shells, beams and plane elements of one cell each, and the means over their sections that
/// CalculiX tells of their nodes. These are not what the nodes are moved by: see Mesh::relations.
///
/// Formula    (bottom + 4 middle + top) / 6 at corners of tri6 and quad8, else the mean of the
///            corners of the section; where elements with other sections meet, that of the elements
/// Source     files written by ccx 2.20 with OUTPUT=2D
/// Tested by  tests/unit/mesh/test_thin_elements.cpp, tests/system/test_shells.py
[[nodiscard]] ThinElements thin_elements(const Mesh& mesh);

}  // namespace osculate::mesh
