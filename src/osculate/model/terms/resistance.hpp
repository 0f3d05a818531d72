#pragma once
#include "osculate/model/terms/bulk_term.hpp"

namespace osculate::model {

/// What resists free motions in solve::Resistance: the diagonal of the bodies' own stiffness. What
/// is measured for it tells the size of the model and of round-off, too.
///
/// Tested by  tests/unit/model/test_diagnosis.cpp
template <int Dim>
struct Resistance {
  double share = 0;          ///< of it on the diagonal of the tangent
  Eigen::VectorXd diagonal;  ///< one per unknown; empty: not yet measured
  double round_off = 0;      ///< of internal forces, from that of the coordinates
  double extent = 0;         ///< of all cells

  /// `own`: the sizes of the cells' diagonals at rest, one per dof, where they are known; else
  /// empty.
  void measure(BulkTerm<Dim>& bulk, const BasicDofSpace<Dim>& dofs, Eigen::VectorXd own = {});
  void add(double part, const BasicAssembler<Dim>& assembler, la::MatrixBuilder& builder) const;
};

extern template struct Resistance<2>;
extern template struct Resistance<3>;

}  // namespace osculate::model
