#pragma once
#include <array>

#include "osculate/core/types.hpp"

namespace osculate::geometry {

/// Position of a surface point and its derivatives with respect to the surface's two parameters.
/// Every surface (Lagrange facet, NURBS patch, analytic shape) fills this value, and every
/// geometric quantity is computed from it and nothing else.
struct SurfaceJet {
  Vec3 r = Vec3::Zero();                                             ///< position [length]
  std::array<Vec3, 2> r1{Vec3::Zero(), Vec3::Zero()};                ///< 1; 2
  std::array<Vec3, 3> r2{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  ///< 11; 12; 22
  std::array<Vec3, 4> r3{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  ///< 111 .. 222
};

}  // namespace osculate::geometry
