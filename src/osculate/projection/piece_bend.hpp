#pragma once
#include "osculate/projection/piece.hpp"

namespace osculate::projection {

/// No curvature of the piece towards the unit normals of the cone is larger than this (negative: it
/// bends away from them everywhere); infinite where the bounds say nothing.
///
/// Formula    With r = X/w, T_i = w X_i - X w_i = w^2 r_i and n . T_i = 0:
///            w^4 a_ij = T_i . T_j ,  w^4 h_ij = w^2 (w X_ij - X w_ij - c_ijk T_k) . n
///            for any constants c. All are polynomials but for n, whose place the axis of the cone
///            takes at the cost of the second order, if c takes away what is along the surface.
///            K a - h is nowhere negative if no Bernstein coefficient of it is (they are matrices)
/// Requires   `normals` holds the normals of the piece, all to one side
/// Returns    larger than the largest curvature by the square of the piece's size
/// Tested by  tests/unit/projection/test_reach_bound.cpp
template <int Dim>
[[nodiscard]] double largest_bend(const Piece<Dim>& piece, Control<Dim> control,
                                  const Cone<Dim>& normals);

/// The same for r'' . v/|r'|^2 of a side and the directions v of the cone, across the side.
[[nodiscard]] double largest_side_bend(const Piece<3>& piece, Control<3> control, std::size_t side,
                                       const Cone<3>& directions);

}  // namespace osculate::projection
