#pragma once
#include <Eigen/Core>
#include <cstdint>

namespace osculate {

/// Local index of a node, element, facet or unknown; -1 means "none".
using Index = std::int32_t;

template <int N>
using Vec = Eigen::Matrix<double, N, 1>;
template <int R, int C>
using Mat = Eigen::Matrix<double, R, C>;
using Vec2 = Vec<2>;
using Vec3 = Vec<3>;

/// k x v for the unit vector k out of the plane: a turn by +90 degrees.
[[nodiscard]] inline Vec2 turn(const Vec2& v) { return {-v.y(), v.x()}; }

}  // namespace osculate
