#pragma once
#include "osculate/deck/build.hpp"

namespace osculate::deck {

/// What factors of a tangent may have at most where nobody asks for them.
struct FactorLimits {
  double memory = 0;        ///< of the machine [bytes]; 0: not known
  double entries = 3e8;     ///< both triangles: from there on multigrid takes a tenth of the time
  double of_unknown = 900;  ///< entries for each, of one triangle where it is symmetric: of compact
                            ///< bodies of 13 000 unknowns with friction, 60 000 without, where
                            ///< multigrid takes 0.7 to 1.07 times the time and half the memory; of
                            ///< thin ones never
};

/// Linear systems are solved as it is asked for: by default with factors up to these limits, else
/// by multigrid, and `linear_note` says so.
///
/// Tested by  tests/unit/deck/test_linear_choice.cpp
template <int Dim>
void choose_linear_solver(Linear asked, const FactorLimits& limits, BasicBuilt<Dim>& built);

}  // namespace osculate::deck
