#pragma once
#include "osculate/deck/build.hpp"

namespace osculate::deck {

/// Linear systems are solved as it is asked for: by default with factors where they fit into the
/// memory of the machine [bytes; 0: not known], else by multigrid, and `linear_note` says so.
///
/// Tested by  tests/unit/deck/test_linear_choice.cpp
template <int Dim>
void choose_linear_solver(Linear asked, double memory, BasicBuilt<Dim>& built);

}  // namespace osculate::deck
