#pragma once
#include "osculate/material/response.hpp"

namespace osculate::material {

/// Where axes point, which may differ from place to place: of a material in the undeformed body, of
/// displacements at a node.
///
/// rectangular: the first along a, the second in the plane of a and b, the third along a x b;
/// cylindrical: radial, around and along the line from a to b, on which any radial direction does.
/// Then they may be turned about one of them, and laid onto the layer of cells that a shell is.
struct Orientation {
  enum class Kind { global, rectangular, cylindrical };
  Kind kind = Kind::global;
  Vec3 a{0, 0, 0}, b{0, 0, 0};
  int about = 2;          ///< 0, 1 or 2
  double angle = 0;       ///< radians, counter-clockwise about it
  bool on_shell = false;  ///< the third one is across the cell (`axes_along_shell`)
};

/// The axes (columns) at a place, right-handed and of length 1.
///
/// Requires   gives_axes(orientation)
/// Tested by  tests/unit/material/test_anisotropic.cpp
[[nodiscard]] Mat<3, 3> axes_at(const Orientation& orientation, const Vec3& place);
/// The axes laid onto a shell: the third one its normal (of length 1), the first one as near as it
/// lies within the shell, or the third one there, where the first one is within 0.1 degrees of the
/// normal.
///
/// Formula    e1 = a1 - (a1 . n) n over its length, e2 = n x e1, e3 = n
/// Tested by  tests/unit/material/test_anisotropic.cpp
[[nodiscard]] Mat<3, 3> axes_along_shell(const Mat<3, 3>& axes, const Vec3& normal);
/// False: the points coincide, or lie in one direction.
[[nodiscard]] bool gives_axes(const Orientation& orientation);

/// Components of a strain in the axes (columns), from those in space.
///
/// Formula    E'_ab = sum_kl Q_ka Q_lb E_kl , shear components twice those of the tensor
[[nodiscard]] Mat<6, 6> into_axes(const Mat<3, 3>& axes);
/// A stiffness in space, from that in the axes: both work on the same strain.
///
/// Formula    D = T^T D' T , T of into_axes
/// Source     Ting, Anisotropic Elasticity, 1996, section 2.5
[[nodiscard]] Tangent3 turned(const Tangent3& stiffness, const Mat<3, 3>& axes);

}  // namespace osculate::material
