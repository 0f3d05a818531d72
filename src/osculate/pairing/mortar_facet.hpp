#pragma once
#include "osculate/pairing/mortar_cell.hpp"

namespace osculate::pairing {

/// Mortar matrices of one slave facet with dual functions Phi_j.
///
/// Formula    psi = T N the functions of the multipliers (mortar_basis.hpp), E = int psi psi^T dA,
///            Phi = diag(d) E^-1 psi with d_j = int psi_j dA: biorthogonal over the covered part of
///            the facet, int Phi_j psi_k dA = delta_jk d_j, whatever part that is; then
///            D_jk = int Phi_j N_k dA = (diag(d) E^-1 T int N N^T dA)_jk: diag(d) where T = 1
///            M_jl = int Phi_j N_l dA
///            Phi sums up to 1, and sum_k D_jk = sum_l M_jl = d_j
/// Shapes     row j of `dd`, j + n k of `ds`, j + n l of `dm`, n the number of multipliers; column
///            Dim c + i is the derivative by direction i of nodes[c]
/// Tested by  tests/unit/pairing/test_mortar_facet.cpp
template <int Dim>
struct alignas(EIGEN_MAX_STATIC_ALIGN_BYTES) MortarFacet {
  std::vector<Index> masters;  ///< nodes
  FacetVector d;
  FacetMatrix s;  ///< D over the facet's nodes
  Sheet m;        ///< M over `masters`
  std::vector<Index> nodes;
  Sheet dd, ds, dm;
  /// Working space: places of the cells' master nodes and columns among those of the facet, one
  /// cell after the other; sums and solutions.
  struct Work {
    std::vector<Eigen::Index> masters, columns;
    Sheet f, other;
  } work;
};

/// Of the cells of a slave facet (at least one) with T = `basis`.
template <int Dim>
void mortar_facet(std::span<const MortarCell<Dim>> cells, const Boundary<Dim>& master,
                  const Eigen::MatrixXd& basis, bool derivatives, MortarFacet<Dim>& out);

}  // namespace osculate::pairing
