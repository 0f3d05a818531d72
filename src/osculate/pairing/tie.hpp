#pragma once
// Points tied from the start; for sources of this layer (pair.hpp is the entry).
#include "osculate/pairing/pair.hpp"

namespace osculate::pairing {

/// Finds the points that are tied: those whose distance from the master at `reference` differs from
/// the offset by no more than the tolerance. The others never come into contact.
///
/// Requires   all else of `pair` is prepared
template <int Dim>
void prepare_ties(PairDefinition<Dim>& pair, Points<Dim> reference);

/// Ties points to their places: sticking both ways, pulled and pressed, without a search.
///
/// Formula    q = sum_k w_k x_k - G ,  G = c^i r_,i + c^n n ,  n = m / |m| ,  m = k x r_,1 or
///            r_,1 x r_,2 ;  energy A (eps_T q . q + (eps_N - eps_T) (n . q)^2) / 2 ,  whose
///            derivatives force and tangent are;  c: so that q = 0 at the start (keep), or G the
///            offset along the normal (close), and with it the share `relief` of the gap that does
///            not count (InitialOverlap). What is kept turns with its facet, what is kept along it
///            stretches with it, too
/// Balance    forces and moments, exactly: the energy does not change with a motion of both bodies
/// Areas      those of the start; with mortar D, M and d_j of the start too
/// Tested by  tests/unit/pairing/test_tie.cpp
template <int Dim>
void evaluate_ties(const PairDefinition<Dim>& pair, Points<Dim> x, double relief, bool with_tangent,
                   PairEvaluation<Dim>& out);

}  // namespace osculate::pairing
