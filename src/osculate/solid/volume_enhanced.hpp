#pragma once
// Enhanced strains of hex8; shared by volume.cpp and volume_stress.cpp.
#include "osculate/solid/volume_point.hpp"

namespace osculate::solid {

inline constexpr int enhanced_count3 = 12;

/// State of the twelve incompatible strain modes at given displacements.
struct EnhancedModes3 {
  bool ok = true;
  std::array<Mat<6, enhanced_count3>, 8> matrix;  ///< strain per mode at the quadrature points
  std::array<material::Response3, 8> response;    ///< at strain + matrix * alpha
  Vec<enhanced_count3> alpha = Vec<enhanced_count3>::Zero();
  Mat<enhanced_count3, enhanced_count3> stiffness;
};

/// Finds the mode parameters by a local Newton iteration from zero to round-off (one step where
/// linear): int M^T S dV = 0. The element keeps no state. Nine modes, linear along the axes of the
/// cell, let it bend; three volumetric ones (xi eta, eta zeta, zeta xi) let it keep its volume.
///
/// Source     Simo & Rifai 1990, Simo, Armero & Taylor 1993 (the modes); for finite strain the
///            Green-Lagrange strain is enhanced in the same way
/// Limits     one cell in uniform compression by more than about a third (neo-Hooke) has hourglass
///            modes of negative stiffness, as enhanced strains are known to; bbar has none there
/// Returns    ok is false where the law has no answer or the iteration finds none
/// Tested by  tests/unit/solid/test_derivatives.cpp, test_patch.cpp, test_volume_locking.cpp
[[nodiscard]] EnhancedModes3 enhanced_modes(const VolumeSection& section,
                                            const Coordinates3& reference, const HexPoints& points,
                                            const material::Memory& memory);

}  // namespace osculate::solid
