#pragma once
// Inside of the public library; included by its sources only.
#include "osculate/embed/values.hpp"

namespace osculate::embed {

/// Forces, tangent, points and constraints of the host out of the blocks of an evaluation.
template <int Dim>
void collect(bool with_tangent, Evaluation<Dim>& e);

/// Unknowns of one point with unknown tractions.
template <int Dim>
[[nodiscard]] Index unknowns_per_point(const pairing::PairDefinition<Dim>& pair) {
  return pairing::has_shear(pair) ? Dim + 1 : 1;
}

}  // namespace osculate::embed
