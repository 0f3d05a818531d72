#pragma once
#include "osculate/projection/reach.hpp"

namespace osculate::projection {

/// Where a search starts.
struct PieceSample {
  int piece = 0;
  Vec2 xi{0, 0};
};

/// The two nearest places on smooth pieces that face each other on one side (+1 above, -1 below),
/// each on the normal of the other: pairs of samples that nearly do, refined by Newton's method on
/// the gradient of the distance (such a pair need not be a minimum of it).
///
/// Formula    (q - p) . p_,i = (q - p) . q_,j = 0
/// Returns    half their distance; `none` where no pair was found
/// Tested by  tests/unit/projection/test_reach.cpp
template <int Dim>
[[nodiscard]] SideLimit<Dim> smallest_bottleneck(const Composed<Dim>& surface, int side,
                                                 std::span<const PieceSample> samples);

}  // namespace osculate::projection
