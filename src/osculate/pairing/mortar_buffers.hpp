#pragma once
#include "osculate/pairing/mortar_contact.hpp"
#include "osculate/pairing/mortar_facet.hpp"
#include "osculate/search/bvh.hpp"

namespace osculate::pairing {

/// Where a slave node was over the master: y_j = sum_l P_jl x_l, P = M / D (the weights sum up to
/// 1). Empty: over no master.
struct MortarPlace {
  std::vector<Index> nodes;
  std::vector<double> weights;
};

/// What a slave node collects from its facets.
template <int Dim>
struct MortarNode {
  double area = 0;                    ///< d_j
  Vec<Dim> own = Vec<Dim>::Zero();    ///< sum_k D_jk x_k
  Vec<Dim> other = Vec<Dim>::Zero();  ///< sum_l M_jl x_l
  MortarPlace slaves, masters;        ///< D_jk and M_jl
  Index facet = -1;                   ///< of the master
  /// Derivatives of these, and of what else the traction depends on, by one node.
  struct Rate {
    Index node;
    Mat<Dim, Dim> own = Mat<Dim, Dim>::Zero(), other = Mat<Dim, Dim>::Zero();
    Vec<Dim> area = Vec<Dim>::Zero();
    double old = 0;  ///< of the last place
    Mat<Dim, Dim> normal = Mat<Dim, Dim>::Zero();
    std::array<Mat<Dim, Dim>, Dim - 1> frame{};
  };
  std::vector<Rate> rates;
};

/// Buffers of an evaluation by mortar integration; reused.
template <int Dim>
struct MortarBuffers {
  std::vector<MortarNode<Dim>> nodes;           ///< D and M of the slave's nodes
  std::vector<NodeContact<Dim>> contacts;       ///< of the slave's nodes
  std::vector<MortarPlace> places;              ///< trial, as `PairState::places`
  std::vector<NodalNormal<Dim>> normals;        ///< of the slave's nodes
  std::vector<std::vector<std::size_t>> slots;  ///< of each slave facet's nodes
  std::vector<std::vector<Index>> overlaps;     ///< of each slave facet: masters it lies over
  std::vector<MortarCell<Dim>> cells;
  /// Of each slave facet; those that were in contact in the last iteration, or at the end of the
  /// last increment, have their derivatives from the beginning.
  std::vector<MortarFacet<Dim>> facets;
  std::vector<bool> has_rates;
  std::vector<Vec<Dim>> tractions;  ///< of the linearised branch
};

}  // namespace osculate::pairing
