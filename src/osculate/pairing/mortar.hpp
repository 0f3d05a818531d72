#pragma once
#include "osculate/pairing/mortar_facet.hpp"
#include "osculate/pairing/pair.hpp"

namespace osculate::pairing {

/// Where a slave node was over the master: y_j = sum_l P_jl x_l, P = M / D (the weights sum up to
/// 1). Empty: over no master.
struct MortarPlace {
  std::vector<Index> nodes;
  std::vector<double> weights;
};

/// History of a pair sampled by mortar: one entry per slave node.
template <int Dim>
struct MortarState {
  std::vector<contact::PointHistory<Dim>> points;
  std::vector<MortarPlace> places;
};

/// Forces and tangent of some nodes, as `ContactBlock`.
template <int Dim>
struct MortarBlock {
  std::vector<Index> nodes;
  int slave_count = 0;
  Eigen::VectorXd force, branch_force;
  bool branched = false;
  Eigen::MatrixXd tangent;  ///< empty: none
  Eigen::Matrix<double, Eigen::Dynamic, Dim> path_rows;
  std::vector<NodeMatrix<Dim>> path;
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

/// Buffers and results of one evaluation; reused.
template <int Dim>
struct MortarEvaluation {
  std::vector<PointResult<Dim>> points;  ///< one per slave node; `weight` is D_jj
  std::vector<MortarPlace> places;       ///< trial, as `MortarState::places`
  /// One per slave node: forces, and the derivative of its traction. Then one per slave facet in
  /// contact: the derivatives of D and M.
  std::vector<MortarBlock<Dim>> blocks;
  std::vector<MortarNode<Dim>> nodes;  ///< D and M
  std::vector<NodalNormal<Dim>> normals;
  std::vector<std::vector<std::size_t>> slots;  ///< of each slave facet's nodes
  std::vector<std::vector<Index>> overlaps;     ///< of each slave facet: masters
  std::vector<search::Box<Dim>> boxes;
  Tree<Dim> tree;
  std::vector<MortarCell<Dim>> cells;
  MortarFacet<Dim> facet;
  std::vector<Vec<Dim>> tractions;  ///< of the linearised branch
};

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
/// Requires   `pair.weight` is an area; all facets through nodes (lines up to 4 nodes); no scope
/// Tested by  tests/unit/pairing/test_mortar.cpp, test_mortar3.cpp
template <int Dim>
void evaluate_mortar(const PairDefinition<Dim>& pair, Points<Dim> x, Points<Dim> reference,
                     const MortarState<Dim>& committed, bool with_tangent,
                     MortarEvaluation<Dim>& out, const Assumed<Dim>& assumed = {});

/// State before the first increment.
template <int Dim>
[[nodiscard]] MortarState<Dim> initial_mortar_state(const PairDefinition<Dim>& pair, Points<Dim> x,
                                                    Points<Dim> reference);

/// The trial history of an accepted evaluation.
template <int Dim>
[[nodiscard]] MortarState<Dim> commit(const MortarEvaluation<Dim>& evaluation);

}  // namespace osculate::pairing
