#pragma once
#include "osculate/pairing/projection.hpp"
#include "osculate/pairing/slave_side.hpp"

namespace osculate::pairing {

/// A convex part of a facet's reference cell: the ends of a line, or three or four corners,
/// counter-clockwise.
template <int Dim>
struct CellPart {
  int count = 0;
  std::array<Vec<Dim - 1>, 4> corners;
};

/// Cuts slave facets where the edges of a master's facets cross them, seen along the normal in the
/// middle of the slave facet: over each part contact tractions are smooth, and a Gauss rule there
/// integrates them as it should (segment-based integration). Facets are taken to have straight
/// edges.
///
/// Formula    plane of the slave facet through its middle; common parts of its outline and those of
///            the master's facets that face it within its own size; what is over none of them
/// Source     clipping: Sutherland and Hodgman, Communications of the ACM 17 (1974) 32-42;
///            segments: Puso and Laursen, CMAME 193 (2004) 601-629, section 3
/// Tested by  tests/unit/pairing/test_cut_facets.cpp
template <int Dim>
class FacetCutter {
 public:
  /// The master's analytic facets cut nothing. All arguments are referred to, not copied.
  FacetCutter(const Boundary<Dim>& slave, const Boundary<Dim>& master,
              std::type_identity_t<std::span<const Vec<Dim>>> x);
  /// The parts cover the cell (parts narrower than a ten-thousandth of it are left out); none where
  /// no edge crosses it, or where several layers of the master lie over each other.
  [[nodiscard]] std::vector<CellPart<Dim>> parts(Index facet) const;

 private:
  const Boundary<Dim>& slave_;
  const Boundary<Dim>& master_;
  std::span<const Vec<Dim>> x_;
  Tree<Dim> tree_;
};

}  // namespace osculate::pairing
