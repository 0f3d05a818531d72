#pragma once
#include <optional>
#include <string>

#include "osculate/la/critical_factors.hpp"

namespace osculate::model {

/// Factors of additional loads at which a state is no longer stable, smallest first.
///
/// Formula    (K + lambda dK) phi = 0 , phi . K phi = 1 ; K the symmetric part of the tangent of
/// the
///            state, with its stresses and contacts as for vibrations (vibrations.hpp); dK what the
///            stresses that the loads of the step add do to the stiffness
///            (solid::stress_stiffness), and what the forces that they put on nodes of rigid bodies
///            do. The stresses added are those of the linear solution du of
///            K du = loads of the step
/// Limits     linear: du does not change the shape. Contacts stay as they are at the state, and so
///            does the direction of their pressure
/// Source     Bathe 1996, section 6.8.2
struct Buckling {
  Eigen::VectorXd factors;
  Eigen::MatrixXd shapes;          ///< columns; displacements of all nodes, x0 y0 (z0) x1 y1 ...
  Eigen::VectorXd added;           ///< du of all nodes
  std::optional<double> reversed;  ///< factor with the loads reversed; negative
  double residual = 0;             ///< see la::CriticalFactors
  int missing = 0;                 ///< likewise
  int closed = 0;                  ///< contact points that stay closed; those of ties do not count
  std::string failure;             ///< why there are none; empty: there are, or there is none
};

}  // namespace osculate::model
