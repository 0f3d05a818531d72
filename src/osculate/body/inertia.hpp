#pragma once
#include "osculate/body/rigid_body.hpp"
#include "osculate/core/types.hpp"

namespace osculate::body {

/// Inertia of a rigid body in its reference configuration.
///
/// Formula    J = integral of rho (|r|^2 I - r r^T) dV ,  r = X - X_c   (plane: of rho |r|^2, about
/// z) Units      of the model; in the plane per the thickness that the mass is given for
template <int Dim>
struct Inertia {
  double mass = 0;
  Vec<Dim> center = Vec<Dim>::Zero();  ///< centre of mass X_c
  Mat<rotations<Dim>, rotations<Dim>> tensor = Mat<rotations<Dim>, rotations<Dim>>::Zero();  ///< J
};

}  // namespace osculate::body
