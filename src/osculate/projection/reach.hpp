#pragma once
#include <cstdint>
#include <limits>
#include <string_view>

#include "osculate/projection/composed.hpp"
#include "osculate/projection/feature_domain.hpp"

namespace osculate::projection {

/// What ends the domain of unique projection on one side.
enum class Limit : std::uint8_t {
  none,        ///< nothing: without end
  curvature,   ///< a centre of curvature: 1/k
  bottleneck,  ///< another part of the surface; half the way to it where they face each other
  kink         ///< a sharp edge or corner that opens to the other side: zero
};
[[nodiscard]] std::string_view name(Limit limit);

template <int Dim>
struct SideLimit {
  double value = std::numeric_limits<double>::infinity();
  Limit limit = Limit::none;
  Vec<Dim> at = Vec<Dim>::Zero();     ///< where it is attained (not for `none`)
  Vec<Dim> other = Vec<Dim>::Zero();  ///< bottleneck: the place opposite; else the same as `at`
};

/// The three lengths of one side; reach is the least of them.
template <int Dim>
struct SideReach {
  SideLimit<Dim> curvature;   ///< smallest 1/k
  SideLimit<Dim> bottleneck;  ///< smallest half distance of two places on each other's normal
  SideLimit<Dim> reach;
};

template <int Dim>
struct Reach {
  SideReach<Dim> below, above;  ///< normals point above, out of the body
};

struct ReachOptions {
  double kink = 1e-4;  ///< angle between normals up to which a joint counts as smooth, radians
  int samples = 3000;  ///< places looked at, about; at least one per piece
};

/// How far the whole curve or surface can be left on each side before the closest point may cease
/// to be unique: every point nearer than that has one closest point, and no two normals of that
/// side, edges' wedges and corners' cones included, meet within it.
///
/// Formula    inf over places p, directions v of that side and other places q of
///            |q - p|^2/(2 (q - p) . v) : the largest ball that rests on p and has nothing inside.
///            For a smooth closed surface this is min(1/k, half the bottleneck)
/// Source     Federer, Curvature measures, 1959, theorem 4.18; for one side each, and for open
///            surfaces with the quarter of the normal plane of a border on each side
/// Method     curvature: largest on a grid, refined by pattern search. Balls: from every sample the
///            ball shrinks until nothing is inside (closest points on the whole surface); those of
///            the best samples are refined by moving their place. Bottlenecks: pairs of samples
///            that face each other, refined by Gauss and Newton's method (faces only; pairs with
///            edges and corners are found where they limit the reach)
/// Returns    every value is attained at the places given, to about 1e-8 of itself, so that the
///            true reach is not larger. That it is not smaller is sampled, not proved: a feature
///            finer than the distance of the samples can be missed. Joints with an angle below
///            `kink` are taken as smooth: they may hide up to kink/2 of the reach
/// Sign       an edge that is convex by more than `kink` makes the reach below zero, a re-entrant
///            one the reach above; below and above are opposite for the two sides of a border
/// Tested by  tests/unit/projection/test_reach.cpp
template <int Dim>
[[nodiscard]] Reach<Dim> reach(const Composed<Dim>& surface, const ReachOptions& options = {});

/// Faces on both sides of a joint at the part t of piece[0]'s side; false where one has no normal.
[[nodiscard]] bool edge_faces(const Composed<3>& surface, const Joint& joint, double t,
                              EdgeFaces& faces);
/// One border in the same form: the second face lies folded back, n and -n.
[[nodiscard]] bool border_face(const Composed<3>& surface, const Joint& joint, double t,
                               EdgeFaces& faces);
/// Unit tangents of the sides that meet at a corner, leading away from it, and the angle-weighted
/// sum of the normals there.
struct CornerFan {
  std::vector<Vec3> tangents;
  Vec3 normal = Vec3::Zero();
  Vec3 r = Vec3::Zero();
};
[[nodiscard]] CornerFan corner_fan(const Composed<3>& surface, std::span<const PieceCorner> around);

/// Unit tangent of a side at its part t, in the way it runs; zero where it has no length.
[[nodiscard]] Vec3 side_tangent(const Composed<3>& surface, int piece, int side, double t);

/// Angle of a joint in the plane (corner_angle), zero at an end.
[[nodiscard]] double joint_angle(const Composed<2>& curve, const Joint& joint);
/// The largest and the smallest edge angle of a joint in space over some of its places.
[[nodiscard]] std::array<double, 2> joint_angles(const Composed<3>& surface, const Joint& joint);

}  // namespace osculate::projection
