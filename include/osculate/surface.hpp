#pragma once
#include <vector>

#include "osculate/shapes.hpp"

namespace osculate {

/// Facets by their nodes: corners first, then the middles of edges, then the interior (Gmsh's
/// order). Lines are for the plane: both ends, then the nodes between them.
enum class FacetType : std::uint8_t {
  line2,
  line3,
  line4,
  line5,
  line6,
  line7,
  line8,
  tri3,
  tri6,
  quad4,
  quad8,
  quad9
};

/// Facets of one type, their nodes one facet after the other.
///
/// Sign  plane: the body is on the right of the way from the first to the second node of a facet;
///       space: seen from outside the corners run counterclockwise
struct Facets {
  FacetType type = FacetType::line2;
  std::vector<Index> nodes{};
};

/// A shape on a rigid body, which three nodes carry in the plane and four in space: they stand at
/// the origin and at the tips of the unit vectors of the frame that the shape is described in. The
/// host moves them rigidly; their forces are force and moment on the body:
/// F = sum f_k, M = sum x_k x f_k.
template <int Dim>
struct FramedShapes {
  /// One shape; in the plane also several curves, each of which begins where the last one ends.
  std::vector<Shape<Dim>> shapes{};
  bool closed = false;  ///< several curves: the first one begins where the last one ends
  std::array<Index, static_cast<std::size_t>(Dim) + 1> frame{};
};

/// One side of a contact: facets, or shapes, or (a slave) nodes without facets. Nodes are numbers
/// in the host's list of coordinates; facets that share nodes hang together.
template <int Dim>
struct Surface {
  std::vector<Facets> facets{};
  FramedShapes<Dim> framed{};
  std::vector<Index> points{};  ///< nodes of a slave that have no facet; they weigh 1 each
};

}  // namespace osculate
