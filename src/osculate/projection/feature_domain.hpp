#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "osculate/core/types.hpp"

namespace osculate::projection {

// Domains of the features of lower dimension: from which directions is an edge or a corner nearer
// than everything near it. They fill the gaps that the domains of the smooth faces leave.

/// Two smooth faces that meet along an edge, at one of its points.
///
/// Shapes     n: unit normals; into: unit vectors in the tangent planes, across the edge and into
///            the face
struct EdgeFaces {
  Vec3 tau = Vec3::Zero();  ///< along the edge
  std::array<Vec3, 2> n{Vec3::Zero(), Vec3::Zero()}, into{Vec3::Zero(), Vec3::Zero()};
};

/// Angle between the normals, 0 on a smooth surface; > 0 convex (the wedge opens above, to where
/// the normals point), < 0 re-entrant (it opens below).
[[nodiscard]] inline double edge_angle(const EdgeFaces& e) {
  const double angle = std::atan2(e.n[0].cross(e.n[1]).norm(), e.n[0].dot(e.n[1]));
  return e.n[0].dot(e.into[1]) + e.n[1].dot(e.into[0]) > 0 ? -angle : angle;
}
/// The same for a plane curve with its body on the right, from the tangents before and after.
[[nodiscard]] inline double corner_angle(const Vec2& before, const Vec2& after) {
  return -std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
}

/// True for directions v from which nothing near the edge or corner is nearer than itself:
/// v . t <= 0 for all tangents t that lead from it into the surface. At an edge these are the two
/// `into` and both +-tau; at a corner the tangents of the edges that meet there.
///
/// Formula    the normal cone; of a convex edge the wedge between the two facet normals, of a
///            convex corner the cone of the facet normals
/// Source     KSCPP 4.1.2 and 4.2, Figs. 7 and 8
/// Tested by  tests/unit/projection/test_feature_domain.cpp
/// Requires   facets whose angle at the corner is less than 180 degrees
template <int Dim>
[[nodiscard]] bool in_normal_cone(std::span<const Vec<Dim>> tangents, const Vec<Dim>& v,
                                  double tolerance = 1e-12) {
  return std::all_of(tangents.begin(), tangents.end(), [&](const Vec<Dim>& t) {
    return v.dot(t) <= tolerance * v.norm() * t.norm();
  });
}

[[nodiscard]] inline bool in_edge_wedge(const EdgeFaces& e, const Vec3& v,
                                        double tolerance = 1e-12) {
  const std::array<Vec3, 4> tangents{e.into[0], e.into[1], e.tau, -e.tau};
  return in_normal_cone<3>(tangents, v, tolerance);
}

/// Unit vector between the unit vectors a and b, at the part t of the angle between them.
template <int Dim>
[[nodiscard]] Vec<Dim> turned(const Vec<Dim>& a, const Vec<Dim>& b, double t) {
  const double cosine = std::clamp(a.dot(b), -1.0, 1.0);
  const Vec<Dim> off = b - cosine * a;
  const double sine = off.norm();
  if (sine < 1e-12) return a;
  const double angle = t * std::atan2(sine, cosine);
  return std::cos(angle) * a + std::sin(angle) / sine * off;
}

/// Unit vectors along the extreme rays of the normal cone of a corner in space; empty if the cone
/// is empty (a saddle, say). The cone of a corner of the border holds a whole line: then the rays
/// are its two directions, and across it those between which the rest lies.
[[nodiscard]] inline std::vector<Vec3> corner_rays(std::span<const Vec3> tangents) {
  std::vector<Vec3> rays;
  constexpr double tolerance = 1e-9;
  const auto offer = [&](const Vec3& direction, double scale) {
    const double length = direction.norm();
    if (!(length > tolerance * scale)) return;
    const Vec3 ray = direction / length;
    const bool known = std::any_of(rays.begin(), rays.end(),
                                   [&](const Vec3& other) { return (other - ray).norm() < 1e-6; });
    if (!known && in_normal_cone<3>(tangents, ray, tolerance)) rays.push_back(ray);
  };
  for (std::size_t i = 0; i < tangents.size(); ++i)
    for (std::size_t j = i + 1; j < tangents.size(); ++j) {
      const Vec3 normal = tangents[i].cross(tangents[j]);
      offer(normal, tangents[i].norm() * tangents[j].norm());
      offer(-normal, tangents[i].norm() * tangents[j].norm());
    }
  if (rays.size() != 2 || rays[0].dot(rays[1]) > -1 + tolerance) return rays;
  for (const Vec3& a : tangents)
    for (const Vec3& b : tangents) offer(b.dot(a) / a.squaredNorm() * a - b, b.norm());
  return rays;
}

}  // namespace osculate::projection
