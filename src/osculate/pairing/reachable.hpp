#pragma once
#include <limits>
#include <vector>

#include "osculate/pairing/pair.hpp"

namespace osculate::pairing {

/// How far the sides may move from where they are.
struct Reach {
  double motion = 0;  ///< of every node, at most
  /// A promise of the caller's: points in contact are not farther than this from their place.
  double distance = std::numeric_limits<double>::infinity();
};

/// What the force of one slave point may be on, and what it may depend on.
struct ReachablePoint {
  Index point = -1;
  std::vector<Index> facets;   ///< of the master, ascending: those it may press on
  std::vector<Index> own;      ///< nodes that it pushes whichever facet it is on: the slave's; of
                               ///< ties, and with re-entrant vertices, the master's too
  std::vector<Index> further;  ///< nodes that the force depends on beside those of both: area, path
};

/// Couplings of slave points and master facets that evaluations may have while no node is farther
/// than `reach.motion` from `x`, from the history `committed` or (but for contact with itself
/// or by a search distance, which goes as far as a point has gone) one that such evaluations have
/// left behind: a superset, whatever the nodes do within the reach. Points that cannot come into
/// contact are left out.
///
/// Bounds     all by boxes, control points and cones of normals (moving_facet.hpp). With L_f and
///            L_s for how a node's motion d moves places of facet and slave point:
///            near    a foot lies within D + (L_f + L_s) d of where the point is now, where D is
///                    the search distance of contact with itself; else the smallest distance now,
///                    plus its own (L_f + L_s) d, of the facets that cannot come to face the same
///                    way as the point; without such a facet nothing is left out
///            front   by penalty alone, and where points may part: a facet that the point stays in
///                    front of by more than the onset gap, by its normals and (for its borders)
///                    those of the facets that share nodes with it, gives no force
///            facing  facets that must face the same way as the point are no candidates, nor (of
///                    contact with itself) those that cannot come to face it
///            history facets beside a candidate and that of the history are candidates, too: a
///                    point stays on the side that it came through. Where it may come behind a
///                    near facet that does not face it, so are facets beside those, on and on, in
///                    which it may have a foot: one a committed increment (small facets behind
///                    which a point is deep: the whole side, if their normals are not bounded)
/// Path       with friction all facets between two candidates, in the plane along the chain
/// Requires   a pair that `prepare` has seen; neither mortar (unless tied) nor edge-edge contacts:
///            core::GeometryError
/// Tested by  tests/unit/embed/test_pattern.cpp (in random trials), test_pattern_reach.cpp
template <int Dim>
[[nodiscard]] std::vector<ReachablePoint> reachable(const PairDefinition<Dim>& pair, Points<Dim> x,
                                                    const PairState<Dim>& committed,
                                                    const Reach& reach);

}  // namespace osculate::pairing
