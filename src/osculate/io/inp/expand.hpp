#pragma once
#include <map>
#include <vector>

#include "osculate/io/inp/thin_sections.hpp"

namespace osculate::io::inp {

/// A node at which several expansions meet, and all that move with it as one, itself included.
struct Knot {
  Index node = 0;
  std::vector<Index> nodes;
};

struct Expansion {
  std::vector<Knot> knots;
  std::map<Index, Index> rotations;  ///< by node: the node whose displacements are its rotation
};

/// Makes solids of shells, beams and trusses: S3 to C3D6, S4 to C3D8, S6 to C3D15, S8 to C3D20,
/// lines of two and three nodes to C3D8 and C3D20. First in a cell is the side that the normal of a
/// shell, the first axis of a beam points away from.
///
/// A pipe or box is the cells of its section (hollow_section) along the brick that the beam would
/// be: their nodes move with the 20 of that, which no cell has, and the deck's node, its forces and
/// rotations are the mean over the section. Its first cell has the element's number, the others
/// go on after the largest one.
///
/// The nodes of the deck remain: a relation of the mesh says that each moves as the mean of the
/// corners it was expanded to. Where elements do not continue each other (thin_groups) it is a knot
/// instead: with finite steps a set of nodes that move as one, else relations, with which it may
/// stretch. From the step on that holds a node of a shell of second order, or a rotation of one of
/// a beam, the middles of the edges of its section stay straight, where the deck holds them.
/// Rotations that the deck holds or
/// loads are small, the mean over the corners of the rotation about the axes; a node of its own has
/// them as displacements. Ends of trusses are joined by the means alone; that the first end does
/// not turn about the truss is one relation more.
///
/// Plane elements beside these or solids become one layer of C3D6, C3D8, C3D15 or C3D20, of the
/// same integration: plates between -t/2 and t/2, and sectors of 2 degrees in the middle of which
/// is the plane z = 0. Their nodes follow those of the deck (Fibers::follow_plane).
///
/// Numbers    new nodes go on after the largest one of the deck; cells have those of the elements
/// Source     CalculiX CrunchiX User's Manual, "Expansion of the one-dimensional and
///            two-dimensional elements"
/// Tested by  tests/unit/io/test_inp_expand.cpp, test_inp_supports.cpp, tests/system/test_shells.py
[[nodiscard]] Expansion expand(const Deck& deck, const ThinCards& cards, Numbering& numbering,
                               mesh::Mesh& mesh);

}  // namespace osculate::io::inp
