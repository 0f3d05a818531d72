#pragma once
#include "osculate/contact/law/normal_response.hpp"
#include "osculate/core/types.hpp"

namespace osculate::contact {

/// Traction of one contact point that does not follow from its penetration. The penalty laws act
/// around it: N = lambda + eps_N gap, t_trial = (I - n n^T) t + eps_T slip. The slip is that of the
/// increment alone; what the point carries from earlier is in `shear`.
///
/// Source     AC91 (the augmented Lagrangian with friction); both parts as vectors in space, so
///            that they need no frame
template <int Dim>
struct Multiplier {
  double normal = 0;                  ///< lambda <= 0 in contact
  Vec<Dim> shear = Vec<Dim>::Zero();  ///< t, as PointResult::shear()
};

/// The linear penalty `stiffness` around a multiplier.
///
/// Formula    N = lambda + eps_N gap where that is not positive or the point is held, otherwise 0
[[nodiscard]] inline NormalResponse augmented(double stiffness, double gap, double lambda,
                                              bool held = false) {
  const double traction = lambda + stiffness * gap;
  if (traction > 0 && !held) return {};
  return {true, traction, stiffness};
}

}  // namespace osculate::contact
