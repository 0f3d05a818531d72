#pragma once
#include "osculate/core/types.hpp"

namespace osculate::geometry {

/// Position of a curve point and its derivatives with respect to the curve's parameter.
/// Every curve (Lagrange facet, NURBS, analytic shape) fills this value, and every geometric
/// quantity is computed from it and nothing else.
template <int Dim>
struct CurveJet {
  Vec<Dim> r = Vec<Dim>::Zero();   ///< position           [length]
  Vec<Dim> r1 = Vec<Dim>::Zero();  ///< dr/dxi             [length / xi]
  Vec<Dim> r2 = Vec<Dim>::Zero();  ///< d2r/dxi2
  Vec<Dim> r3 = Vec<Dim>::Zero();  ///< d3r/dxi3 (for the exact tangent of the full residual)
};

}  // namespace osculate::geometry
