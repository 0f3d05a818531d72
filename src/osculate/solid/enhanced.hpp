#pragma once
// Enhanced strains of quad4; shared by element.cpp and stress.cpp.
#include <array>

#include "osculate/solid/point_strain.hpp"

namespace osculate::solid {

inline constexpr int enhanced_count = 4;

/// State of the four incompatible strain modes at given displacements.
struct EnhancedModes {
  bool ok = true;
  std::array<Mat<4, enhanced_count>, 4> matrix;  ///< strain per mode at the quadrature points
  std::array<material::Response, 4> response;    ///< at strain + matrix * alpha
  Vec<enhanced_count> alpha = Vec<enhanced_count>::Zero();
  Mat<enhanced_count, enhanced_count> stiffness;
};

/// Finds the mode parameters by a local Newton iteration from zero to round-off (one step where
/// linear): int M^T S dV = 0. The element keeps no state.
///
/// Source     Simo & Rifai 1990 (small strain); for finite strain the Green-Lagrange strain is
///            enhanced in the same way
/// Returns    ok is false where the law has no answer or the iteration finds none
/// Tested by  tests/unit/solid/test_patch.cpp, test_derivatives.cpp, test_locking.cpp
[[nodiscard]] EnhancedModes enhanced_modes(const Section& section, const Coordinates& reference,
                                           std::span<const PointGeometry> geometry,
                                           std::span<const PointStrain> strain);

}  // namespace osculate::solid
