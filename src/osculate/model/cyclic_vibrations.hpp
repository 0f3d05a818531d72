#pragma once
#include "osculate/model/system.hpp"

namespace osculate::model {

/// Free vibrations of a ring, of one of its sectors: for each number of nodal diameters k that the
/// step asks for as many as it wants, slowest first. Where 0 < k < sectors / 2 they come in pairs,
/// a cosine and a sine around the axis.
///
/// Formula    u of the dependent face = exp(i k 2 pi / sectors) Q u of the independent one, u = T q
///            with a complex T: T^H K T q = omega^2 T^H M T q , K and M of the sector with free
///            faces
/// Source     Thomas 1979, Dynamics of rotationally periodic structures
/// Tested by  tests/unit/deck/test_cyclic_modes.cpp, verification/cyclic_modes
template <int Dim>
[[nodiscard]] Vibrations cyclic_vibrations(const BasicModel<Dim>& model, const Step& step,
                                           const BasicState<Dim>& about, int threads,
                                           const la::MakeSolver& solver);

}  // namespace osculate::model
