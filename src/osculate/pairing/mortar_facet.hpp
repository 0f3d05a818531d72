#pragma once
#include "osculate/pairing/mortar_cell.hpp"

namespace osculate::pairing {

/// Mortar matrices of one slave facet with dual shape functions Phi_j.
///
/// Formula    Phi = A N,  A = diag(d) E^-1,  d_j = int N_j dA: biorthogonal to N over the covered
///            part of the facet, int Phi_j N_k dA = delta_jk d_j, whatever part that is; then
///            D_jk = delta_jk d_j  and  M_jl = int Phi_j N_l dA = d_j (E^-1 F)_jl
///            Phi sums up to 1, and so sum_l M_jl = d_j
/// Shapes     `dd`: row j; `dm`: row j + n l, n the slave's nodes, l a place in `masters`; column
///            Dim c + i is the derivative by direction i of nodes[c]
/// Tested by  tests/unit/pairing/test_mortar_facet.cpp
template <int Dim>
struct MortarFacet {
  std::vector<Index> masters;  ///< nodes
  Eigen::VectorXd d;
  Eigen::MatrixXd m;
  std::vector<Index> nodes;
  Eigen::MatrixXd dd, dm;
};

/// Of the cells of a slave facet (at least one). `change` (rows: new functions, columns: N) makes
/// other slave functions of N first; empty: none.
template <int Dim>
void mortar_facet(std::span<const MortarCell<Dim>> cells, const Boundary<Dim>& master,
                  const Eigen::MatrixXd& change, bool derivatives, MortarFacet<Dim>& out);

}  // namespace osculate::pairing
