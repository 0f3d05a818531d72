#pragma once
#include <Eigen/Core>
#include <vector>

#include "osculate/core/types.hpp"
#include "osculate/pairing/pair.hpp"

namespace osculate::model {

/// Forces of one configuration on all nodes and rigid bodies (primary dofs of the DofSpace).
struct Forces {
  Eigen::VectorXd internal;  ///< from the bulk
  Eigen::VectorXd contact;   ///< from the contact pairs
  Eigen::VectorXd external;  ///< applied loads
  Eigen::VectorXd inertia;   ///< mass times acceleration, and damping; of the last converged state
};

/// What an evaluation of the system leaves behind beside residual and tangent.
template <int Dim>
struct Evaluated {
  Forces forces;
  Eigen::VectorXd predicted;     ///< K du_prescribed on primary dofs
  Eigen::VectorXd branch_shift;  ///< force of the linearised branches minus the true force
  bool branched = false;
  Eigen::VectorXd constraint, branch_constraint;      ///< values of the multipliers' rows
  std::vector<pairing::PairEvaluation<Dim>> contact;  ///< by pair
  std::vector<double> memory;                         ///< of the material points, were it committed
  double carried = 0;  ///< largest prescribed increment of the last prediction

  /// Before the terms add to it. Contact and memory are written over.
  void clear(Index dofs, Index multipliers) {
    for (Eigen::VectorXd* const v :
         {&forces.internal, &forces.contact, &forces.external, &predicted, &branch_shift})
      v->setZero(dofs);
    forces.inertia.resize(0);
    constraint.setZero(multipliers);
    branch_constraint.setZero(multipliers);
    branched = false;
  }
};

}  // namespace osculate::model
