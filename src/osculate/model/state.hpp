#pragma once
#include <Eigen/Core>
#include <vector>

#include "osculate/body/rigid_body.hpp"
#include "osculate/core/types.hpp"
#include "osculate/pairing/pair.hpp"

namespace osculate::model {

/// A configuration. Committed states are const; a trial is a new value.
template <int Dim>
struct BasicState {
  Eigen::VectorXd u;  ///< displacements of all nodes, x0 y0 (z0) x1 y1 ...
  std::vector<body::BasicRigidMotion<Dim>> rigid;  ///< one per rigid body
  std::vector<pairing::PairState<Dim>> pairs;      ///< history of the last converged increment
  std::vector<pairing::Assumed<Dim>> assumed;      ///< branches of the last iteration (trials only)
  std::vector<pairing::PairMultipliers<Dim>> multipliers;  ///< of the pairs; empty by penalty
  double fraction = 0;                                     ///< of the running step
};

using State = BasicState<2>;
using State3 = BasicState<3>;

}  // namespace osculate::model
