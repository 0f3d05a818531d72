#pragma once
#include <Eigen/Core>
#include <vector>

#include "osculate/body/rigid_body.hpp"
#include "osculate/core/types.hpp"
#include "osculate/pairing/pair.hpp"

namespace osculate::model {

/// A configuration. Committed states are const; a trial is a new value.
struct State {
  Eigen::VectorXd u;                         ///< displacements of all nodes, x0 y0 x1 y1 ...
  std::vector<body::RigidMotion> rigid;      ///< one per rigid body
  std::vector<pairing::PairState<2>> pairs;  ///< history of the last converged increment
  std::vector<pairing::Assumed<2>> assumed;  ///< branches of the last iteration (trial states only)
  double fraction = 0;                       ///< of the running step
};

}  // namespace osculate::model
