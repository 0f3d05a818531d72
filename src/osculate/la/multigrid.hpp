#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "osculate/core/crew.hpp"
#include "osculate/la/grouped_rows.hpp"
#include "osculate/la/halo.hpp"

namespace osculate::la {

/// A multigrid cycle of smoothed aggregation: an approximate inverse of the stiffness of bodies.
/// Each coarser model has the rigid motions of groups of nodes as its unknowns; the smoother is a
/// Chebyshev polynomial of the blocks of the nodes, the coarsest model is factored by Mumps.
///
/// Formula    P = (I - 4 / (3 rho) D^-1 A) P_0 , A_coarse = P^T A P , P_0 an orthonormal basis of
///            the near null vectors in each aggregate, D the diagonal blocks, rho the largest
///            eigenvalue of D^-1 A . Models are made in double precision, the cycle multiplies with
///            their entries rounded to single precision (vectors and sums are double: it is linear)
/// Several processes make models of aggregates of their own nodes; the coarsest is in each of them.
///
/// Contract   the bits depend on the matrix, groups and near null vectors alone (and on how they
///            are dealt out)
/// Source     P. Vanek, J. Mandel, M. Brezina, Computing 56 (1996) 179-196;
///            M. Adams et al., J. Comput. Phys. 188 (2003) 593-610 (Chebyshev)
/// Tested by  tests/unit/la/test_multigrid.cpp
class Multigrid {
 public:
  explicit Multigrid(core::Crew& crew);
  ~Multigrid();
  Multigrid(const Multigrid&) = delete;
  Multigrid& operator=(const Multigrid&) = delete;

  /// Builds the coarser models. False: it cannot be, as where a body is free to move.
  ///
  /// Shapes     a: the rows of this process, with the columns of `halo`, needed for this call;
  ///            near_null: a row per own unknown. Unknowns of rows of zeros are in no coarser
  ///            model; groups whose block is not positive definite are not smoothed either
  bool build(const GroupedRows& a, Halo halo, Eigen::MatrixXd near_null);
  /// Takes another matrix of the same groups, near to the one that it was built of: the coarser
  /// models stay. False: it has to be built.
  ///
  /// Input      differs: groups in which it is not that of the last call, where both have the same
  ///            places for entries; null: they may have others
  bool refresh(const GroupedRows& a, const std::vector<char>* differs, Halo halo);
  /// One cycle from zero, on own unknowns. False: no numbers came out.
  bool apply(Eigen::VectorXd& rhs_in_solution_out);
  /// Places for entries of all matrices over those of the finest.
  [[nodiscard]] double complexity() const;
  [[nodiscard]] int levels() const;
  void forget();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace osculate::la
