#pragma once
#include <limits>

#include "osculate/contact/law/tangential.hpp"
#include "osculate/projection/feature.hpp"

namespace osculate::contact {

/// What one contact point remembers of the last converged increment. Committed values are const
/// during an increment; the trial is a new value.
///
/// The tangential traction is stored by its physical components in an orthonormal frame that moves
/// with the facet (2D: along the direction of travel, T = sqrt(a11) t; 3D: along rho_,1 and n x
/// rho_,1). Carrying it to another facet is the minimal rotation of the normals: the length of the
/// traction is kept (the metric correction of docs/errata.md).
template <int Dim>
struct PointHistory {
  bool active = false;  ///< in contact at the last converged state
  Index facet = -1;     ///< facet of the foot point, -1 = none
  projection::Feature feature = projection::Feature::none;
  Vec<Dim - 1> xi = Vec<Dim - 1>::Zero();  ///< convective coordinates on that facet
  double gap = 0;                          ///< also of open points: it dates the first contact
  Vec<Dim - 1> traction = Vec<Dim - 1>::Zero();  ///< t
  bool slipping = false;                         ///< the friction limit was reached
  Vec<Dim - 1> slip = Vec<Dim - 1>::Zero();      ///< accumulated sliding distance (signed)
  /// Of an edge-edge contact: number of the slave's, while `facet` is that of the master's, and
  /// whether the slave's edge is run backwards.
  Index edge = -1;
  bool flipped = false;
  LawMemory memory{};  ///< of the friction law
  double slid = 0;     ///< distance slid (without the elastic part) since it came into contact
  bool held = false;   ///< tied to the master in the normal direction from the start
  double rest = 0;     ///< of a held point: its gap at the start
  double friction_work = 0;  ///< [energy] dissipated here so far; stays when the point opens
  /// Law gap (NormalResponse::deepest) of damping that remembers; stays while the sides overlap.
  double deepest = std::numeric_limits<double>::infinity();
  double damping_work = 0;  ///< [energy] dissipated here by damping so far
};

}  // namespace osculate::contact
