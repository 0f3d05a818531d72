#pragma once
#include "osculate/deck/build.hpp"

namespace osculate::deck {

/// What factors of a tangent may have at most where nobody asks for them.
struct FactorLimits {
  double memory = 0;      ///< of the machine [bytes]; 0: not known
  double entries = 3e8;   ///< both triangles: from there on multigrid takes a tenth of the time
  double anything = 900;  ///< entries for each unknown, of one triangle where it is symmetric:
                          ///< blocks of 13 000 unknowns with friction have so many
  double compact = 450;   ///< the same for bodies that are compact and of which more changes than a
                          ///< few unknowns: of 4 000 unknowns with friction
  double compactness = 0.018;  ///< mesh::least_compactness from which on they are: plates 1 : 16
  double exact = 0.35;         ///< most of the unknowns that may be of contact, as a share:
                               ///< multigrid has factors of these for each increment, or more
};

/// Linear systems are solved as it is asked for: by default with factors up to these limits, else
/// by multigrid, and `linear_note` says so.
///
/// Decision   docs/decisions/103-multigrid-by-shape.md
/// Tested by  tests/unit/deck/test_linear_choice.cpp
template <int Dim>
void choose_linear_solver(Linear asked, const FactorLimits& limits, BasicBuilt<Dim>& built);

}  // namespace osculate::deck
