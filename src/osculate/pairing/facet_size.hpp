#pragma once
#include "osculate/pairing/slave_side.hpp"

namespace osculate::pairing {

/// How far a point looks round where everything may touch everything, in mean facet sizes.
inline constexpr double search_distance_in_facets = 8;

/// Mean length of the facets' edges, 0 without facets. Analytic curves do not count.
///
/// Tested by  tests/unit/embed/test_public_door.cpp, tests/unit/deck/test_enforcement.cpp
[[nodiscard]] double mean_facet_size(const Chain& chain, std::span<const Vec2> x);
[[nodiscard]] double mean_facet_size(const FacetSurface& surface, std::span<const Vec3> x);

}  // namespace osculate::pairing
