#pragma once
#include "osculate/core/types.hpp"
#include "osculate/projection/feature.hpp"

namespace osculate::contact {

/// What one contact point remembers of the last converged increment. Committed values are const
/// during an increment; the trial is a new value.
///
/// The tangential traction is stored as its physical component t along the direction of travel of
/// the master (T = sqrt(a11) t). Carrying t to another facet is the minimal rotation in 2D with the
/// metric correction of docs/errata.md: the length of the traction is kept.
struct PointHistory {
  bool active = false;  ///< in contact at the last converged state
  Index facet = -1;     ///< facet of the foot point, -1 = none
  projection::Feature feature = projection::Feature::none;
  double xi = 0;          ///< convective coordinate on that facet
  double gap = 0;         ///< zeta (also of open points: it dates the first contact)
  double traction = 0;    ///< t
  bool slipping = false;  ///< the friction limit was reached
  double slip = 0;        ///< accumulated sliding distance (signed)
};

}  // namespace osculate::contact
