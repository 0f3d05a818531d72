#pragma once
// Enhanced strains of quad4; shared by element.cpp and stress.cpp.
#include <array>

#include "osculate/solid/point_strain.hpp"

namespace osculate::solid {

/// How many modes there are: four in the plane, five in a ring.
inline constexpr int plane_modes = 4, ring_modes = 5;

/// State of the incompatible strain modes at given displacements.
template <int Count>
struct EnhancedModes {
  bool ok = true;
  std::array<Mat<4, Count>, 4> matrix;         ///< strain per mode at the quadrature points
  std::array<material::Response, 4> response;  ///< at strain + matrix * alpha
  Vec<Count> alpha = Vec<Count>::Zero();
  Mat<Count, Count> stiffness;
};

/// Finds the mode parameters by a local Newton iteration from zero to round-off (one step where
/// linear): int M^T S dV = 0. The element keeps no state.
///
/// Source     Simo & Rifai 1990 (small strain; the axisymmetric modes too); for finite strain the
///            Green-Lagrange strain is enhanced in the same way
/// Limits     one cell in uniform compression has hourglass modes of negative stiffness, as
///            enhanced strains are known to (decision 037 says from where); bbar has none there
/// Requires   Count is ring_modes where the section is axisymmetric, else plane_modes
/// Returns    ok is false where the law has no answer or the iteration finds none
/// Tested by  tests/unit/solid/test_patch.cpp, test_derivatives.cpp, test_locking.cpp
template <int Count>
[[nodiscard]] EnhancedModes<Count> enhanced_modes(const Section& section,
                                                  const Coordinates& reference,
                                                  std::span<const PointGeometry> geometry,
                                                  std::span<const PointStrain> strain,
                                                  const material::Memory& memory);

}  // namespace osculate::solid
