#include "osculate/projection/triangle.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace osculate::projection {
namespace {

/// Bits of the edges that meet at a corner: edge k joins corners k and k + 1.
constexpr std::uint8_t at_corner[3] = {0b101, 0b011, 0b110};

struct SegmentFoot {
  double t = 0, squared_distance = 0;
};

SegmentFoot on_segment(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Vec3 d = b - a;
  const double length2 = d.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(d) / length2, 0.0, 1.0) : 0.0;
  return {t, (p - (a + t * d)).squaredNorm()};
}

/// The best of the three edges.
TriangleFoot on_border(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& point) {
  const Vec3* const corner[3] = {&a, &b, &c};
  int edge = 0;
  SegmentFoot best = on_segment(a, b, point);
  for (int k = 1; k < 3; ++k) {
    const SegmentFoot foot = on_segment(*corner[k], *corner[(k + 1) % 3], point);
    if (foot.squared_distance < best.squared_distance) best = foot, edge = k;
  }
  const Vec2 xi[3] = {{0, 0}, {1, 0}, {0, 1}};
  const int next = (edge + 1) % 3;
  TriangleFoot out;
  out.xi = (1 - best.t) * xi[edge] + best.t * xi[next];
  out.point = *corner[edge] + best.t * (*corner[next] - *corner[edge]);
  out.squared_distance = best.squared_distance;
  out.pressed = static_cast<std::uint8_t>(best.t <= 0   ? at_corner[edge]
                                          : best.t >= 1 ? at_corner[next]
                                                        : 1U << edge);
  return out;
}

}  // namespace

TriangleFoot closest_on_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& point) {
  const Vec3 ab = b - a, ac = c - a, ap = point - a;
  const Vec3 n = ab.cross(ac);
  const double area2 = n.squaredNorm();
  if (!(area2 > 1e-24 * ab.squaredNorm() * ac.squaredNorm())) return on_border(a, b, c, point);
  const double u = ap.cross(ac).dot(n) / area2, v = ab.cross(ap).dot(n) / area2;
  constexpr double beyond = -1e-10;  // a foot that misses an edge by less lies on the face
  if (u < beyond || v < beyond || 1 - u - v < beyond) return on_border(a, b, c, point);
  TriangleFoot out;
  out.xi = {std::max(u, 0.0), std::max(v, 0.0)};
  const double over = out.xi[0] + out.xi[1];
  if (over > 1) out.xi /= over;
  out.point = a + out.xi[0] * ab + out.xi[1] * ac;
  out.squared_distance = (point - out.point).squaredNorm();
  return out;
}

}  // namespace osculate::projection
