#pragma once
// One point for quad4 and hex8, with what keeps their other modes from having no energy.
#include "osculate/solid/points.hpp"

namespace osculate::solid {

/// The one point of a cell: the means of the strain matrix over the cell, so that the nodal forces
/// of a constant stress are exact however the cell is distorted, in rings too.
///
/// Formula    dN_k/dX = 1/V int dN_k/dX dV , N_k/R = 1/V int N_k/R dV , V = int dV
/// Source     Flanagan & Belytschko 1981 (uniform strain)
/// Returns    false if det F is not positive (finite kinematics)
/// Tested by  tests/unit/solid/test_patch.cpp, test_stress.cpp
template <int Dim>
[[nodiscard]] bool fill_mean_point(const Section<Dim>& section, const Coordinates<Dim>& reference,
                                   const Coordinates<Dim>& displacement, CornerPoint<Dim>& p);

/// E' of the directions and mu of the modes (below).
template <int Dim>
[[nodiscard]] std::array<double, 2> mode_moduli(const Section<Dim>& section);

/// Energy of the modes that the mean strain does not see, its derivative, and the lower triangle of
/// the second one.
///
/// Formula    h_a the products of two and three of (xi, eta, zeta); q_a = sum_k gamma_ak u_k with
///            gamma_a = (h_a - sum_i (h_a . X_i) dN/dX_i) / 2^dim , blind to linear motions;
///            Q_ai = q_a . g_i , g_i = sum_k x_k dN_k/dxi_i at the centre (small: of X). The modes
///            then strain the cell by sum_a Q_ai dh_a/dxi_i along xi_i (to first order in q), and,
///            across xi_k, by (Q_ii + Q_jj) xi_k between xi_i and xi_j. With the stress along each
///            axis taken alone, as in bending, and no other shear (it would lock), integrated over
///            the cell with the metric of its centre,
///            W = V/2 [ E' sum_i (sum_{a != i} Q_ai^2 / 3 + Q_4i^2 / 9) / |G_i|^4
///                      + mu sum_{i<j} (Q_ii + Q_jj)^2 / 3 / (|G_i| |G_j|)^2 ]
///            (plane: V/2 E' sum_i Q_1i^2 / 3 / |G_i|^4). E' = E, where the plane is strained
///            E/(1 - nu^2), mu = E/2/(1 + nu) of the unloaded material: cells that flow keep them.
///            Rings also: V/2 E' sum_i D_i^2 / 3 , D_i = d(u_r/R)/dxi_i at the centre, without
///            which a ring that rolls has no energy
/// Source     modes: Flanagan & Belytschko 1981; strains without locking: Belytschko & Bindeman
///            1991, 1993; g_i q_a makes it indifferent to rotations
/// Limits     the constants are those of the unloaded material
/// Tested by  tests/unit/solid/test_reduced.cpp, test_derivatives.cpp, test_invariance.cpp
template <int Dim>
struct Hourglass {
  double energy = 0;
  typename CornerSizes<Dim>::Vector force;
  typename CornerSizes<Dim>::Matrix tangent;  ///< filled only when asked for
};
/// Input      p: of fill_mean_point
template <int Dim>
[[nodiscard]] Hourglass<Dim> hourglass(const Section<Dim>& section,
                                       const Coordinates<Dim>& reference,
                                       const Coordinates<Dim>& displacement,
                                       const CornerPoint<Dim>& p, bool with_tangent);

/// Whether a cell is one of hex20 whose eight points leave six modes without energy, or of wedge6
/// whose two leave one: a row of such cells may have some of them together, and its linear
/// equations have no answer.
[[nodiscard]] inline bool has_faint_stiffness(const Section<3>& section, cell::CellType type) {
  return section.formulation == Formulation::reduced &&
         (type == cell::CellType::hex20 || type == cell::CellType::wedge6);
}
using NodeMatrix3 = Sizes<3, Eigen::Dynamic>::NodeMatrix;
/// What resists displacements of hex20 that are not quadratic in space, of wedge6 that are not
/// linear; the same in each direction.
///
/// Formula    W = k/2 sum_i u_i . P u_i , P = 1 - Q Q^T with the orthonormal Q of the quadratic
///            (linear) polynomials of X at the nodes; k = c E V h^2 / l^4 , c = 1e-6, of hex20 with
///            finite kinematics 1e-4, where the modes otherwise buckle, E of the unloaded material,
///            l the largest of the cell's lengths at its centre, h its height over the largest of
///            the faces there. That is small beside the bending of a plate, too. No quadratic
///            displacement has it, so that what converges does as before, nor does a rotation: P F
///            X = 0
/// Tested by  tests/unit/solid/test_reduced.cpp, test_derivatives.cpp, test_invariance.cpp
[[nodiscard]] NodeMatrix3 faint_stiffness(const Section<3>& section, cell::CellType type,
                                          const Coordinates<3>& reference);
template <class Sum>
void add_faint_stiffness(const NodeMatrix3& stiffness, const Coordinates<3>& displacement,
                         Sum& sum) {
  const Coordinates<3> force = stiffness * displacement;
  for (Eigen::Index k = 0; k < force.rows(); ++k)
    sum.force.template segment<3>(3 * k) += force.row(k);
  if (sum.with_tangent) sum.geometric += stiffness;
}

}  // namespace osculate::solid
