#pragma once
#include <cstddef>
#include <limits>
#include <vector>

#include "osculate/types.hpp"

namespace osculate {

/// Tractions of one point that do not follow from its penetration: N <= 0 in contact, and the shear
/// traction as a vector in space (its negative acts on the slave).
template <int Dim>
struct Multiplier {
  double normal = 0;
  Vector<Dim> shear{};
};

/// Those of all points of a contact; plain numbers, which belong to the host. With
/// augmented_lagrange they are corrected around its solutions, with lagrange_multiplier they are
/// its unknowns (Evaluator::multipliers_of).
template <int Dim>
struct Multipliers {
  std::vector<Multiplier<Dim>> points;  ///< none with Enforcement::penalty
  double stiffening = 1;                ///< of all penalties of the contact
  /// Largest gap or elastic slip at the last correction [length].
  double violation = std::numeric_limits<double>::infinity();
};

}  // namespace osculate
