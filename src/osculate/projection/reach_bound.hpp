#pragma once
#include "osculate/projection/reach.hpp"
#include "osculate/projection/reach_features.hpp"

namespace osculate::projection {

/// What is proved of one side.
struct SideBound {
  double least = 0;     ///< the reach is not smaller
  Gap gap = Gap::none;  ///< why it is not within the tolerance of what was found
};

struct ReachBound {
  SideBound below, above;
};

struct ReachBoundOptions {
  double kink = 1e-4;       ///< as in ReachOptions
  double tolerance = 0.01;  ///< where the search ends: 1 - least/found
  int effort = 50000;       ///< halvings for the curvature of each side, 16 times as many pairs
};

/// A bound of the reach from below, by branch and bound over the pieces.
///
/// Formula    Where |q - p|^2/(2 (q - p) . v) is smallest of all places p with the normal
/// directions
///            v of the side and all places q, either q - p is along v and its opposite is a normal
///            direction of q: half a bottleneck, or the smallest value is approached as q goes to
///            p: 1/k. (Its derivative along the surface is -(q - p) . (1 - R W) dp/((q - p) . v), R
///            the value and W the shape operator.) So the reach is not less than the smaller of 1/k
///            from above and |q - p|/2 over the pairs that may see each other. Where the directions
///            of a border end (along the tangent plane, outwards) the smallest value may stand
///            without q - p along v; there the quotient itself is bounded.
/// Method     1/k: convex hulls of the derivatives (piece_bend.hpp), halved where they are
///            largest. Pairs: boxes, and the normal cones as linear inequalities for the line
///            between both; halved where they are nearest
/// Requires   facets that share an edge or corner do not cut each other beside it; angles at edges
///            are looked at in five places each
/// Returns    zero and the reason where a part cannot be excluded
/// Tested by  tests/unit/projection/test_reach_bound.cpp
template <int Dim>
[[nodiscard]] ReachBound reach_bound(const Target<Dim>& target, const Reach<Dim>& found,
                                     const ReachBoundOptions& options = {});

}  // namespace osculate::projection
