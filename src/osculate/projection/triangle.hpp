#pragma once
#include "osculate/core/types.hpp"

namespace osculate::projection {

/// Nearest point of a plane triangle.
struct TriangleFoot {
  Vec2 xi{0, 0};  ///< a + xi1 (b - a) + xi2 (c - a)
  Vec3 point{0, 0, 0};
  double squared_distance = 0;
  std::uint8_t pressed = 0;  ///< bit k: pulled beyond edge k (two bits: at the corner between them)
};

/// Closed form by the regions of face, edges and corners; a triangle without area is the longest of
/// its edges.
///
/// Tested by  tests/unit/projection/test_pieces.cpp (against brute force)
[[nodiscard]] TriangleFoot closest_on_triangle(const Vec3& a, const Vec3& b, const Vec3& c,
                                               const Vec3& point);

}  // namespace osculate::projection
