#pragma once
// Contact by mortar integration; for sources of this layer (pair.hpp is the entry).
#include "osculate/pairing/pair.hpp"

namespace osculate::pairing {

/// Contact sampled by segment-to-segment mortar integration with dual shape functions.
///
/// Formula    tributary area  A_j = d_j = int psi_j dA over what is covered
///            gap             g_j = n_j . (x_j - y_j),  x_j = sum_k D_jk x_k / d_j (where D is
///                            diagonal the slave node itself),  y_j = sum_l M_jl x_l / d_j,
///                            n_j = minus the slave's averaged normal (so g < 0 is penetration)
///            traction        t_j = N(g_j) n_j + E_j t;  forces D_jk t_j on slave node k and
///                            -M_jl t_j on master node l
///            slip            s_j = E_j^T (sum_l (P_jl - P_jl,old) x_l),  P_jl = M_jl / d_j, on the
///                            present positions, so that it does not change with a motion of both
///                            bodies together (increments of D and M at fixed positions, Gitterle
///                            et al. 2010, here divided by d_j); t is kept by its components in
///                            E_j, the frame that moves with the slave node
///            The chord between the two places is the way along the master up to second order in
///            the angle it turns by on the way
/// Areas      `weight`: reference_area integrates over the slave's reference area, current_area
///            over the current one
/// Balance    forces exactly (sum_k D_jk = sum_l M_jl); moments up to d_j (x_j - y_j) x t_j:
///            nothing for the normal traction on flat faces, otherwise of the order of the gap
///            times the angle between the nodal normals plus the gap times the shear
/// Jumps      where a facet with nodes on its edges begins to be covered in part, its multipliers
///            change from its own order to the corners' linear functions: a uniform traction stays
///            what it was, another one is shared out anew
/// Blocks     one per slave node (its forces and, as path, the derivative of its traction),
///            then one per slave facet in contact (the derivatives of D and M times the tractions)
/// Requires   `prepare`, which throws where the pair is none for mortar (combinations.hpp)
/// Tested by  tests/unit/pairing/test_mortar.cpp, test_mortar3.cpp
template <int Dim>
void evaluate_mortar(const PairDefinition<Dim>& pair, Points<Dim> x,
                     const PairState<Dim>& committed, bool with_tangent, PairEvaluation<Dim>& out,
                     const ActiveSet<Dim>& active_set = {},
                     const PairMultipliers<Dim>* multipliers = nullptr);

/// State before the first increment.
template <int Dim>
[[nodiscard]] PairState<Dim> initial_mortar_state(const PairDefinition<Dim>& pair, Points<Dim> x);

/// Tangents that the shear of slave node `i` is kept in.
template <int Dim>
[[nodiscard]] Mat<Dim, Dim - 1> mortar_frame(const PairDefinition<Dim>& pair, std::size_t i,
                                             Points<Dim> x);

}  // namespace osculate::pairing
