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
/// Formula    q = sum_k w_k x_k - G ,  G = c^i r_,i + c^n m ,  m = k x r_,1 or r_,1 x r_,2 ,
///            energy A eps q . q / 2 ;  R_k = A eps (dq/dx_k)^T q ,
///            K_kl = A eps [(dq/dx_k)^T dq/dx_l + c^n (b_1k b_2l - b_2k b_1l) [q]x]  (last: 3D)
///            c: so that q = 0 at the start (keep), or G the offset along the normal (close); what
///            is kept turns and stretches with its facet
/// Balance    forces and moments, exactly: the energy does not change with a motion of both bodies
/// Areas      those of the start; with mortar D, M and d_j of the start too
/// Tested by  tests/unit/pairing/test_tie.cpp
template <int Dim>
void evaluate_ties(const PairDefinition<Dim>& pair, Points<Dim> x, const PairState<Dim>& committed,
                   bool with_tangent, PairEvaluation<Dim>& out);

}  // namespace osculate::pairing
