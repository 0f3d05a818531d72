#pragma once
#include <vector>

#include "osculate/pairing/chain.hpp"
#include "osculate/pairing/projection.hpp"
#include "osculate/pairing/surface.hpp"

namespace osculate::pairing {

/// A facet in short: enough to pass over most of them without a projection.
template <int Dim>
struct FacetOutline {
  Vec<Dim> middle, normal;
  double bulge = 0;   ///< of its nodes over the plane through the middle; infinite: analytic shape
  double spread = 0;  ///< its normals are within this angle of the one in the middle
  double radius = 0;  ///< feet are within this of the middle
  double overhang = 0;              ///< and within this of the box
  double facing = 2, same_way = 2;  ///< as of a branch
};

/// Unit normal in the middle of a facet that is no analytic shape.
[[nodiscard]] Vec2 middle_normal(const Facet& facet, std::span<const Vec2> x);
[[nodiscard]] Vec3 middle_normal(const SurfaceFacet& facet, std::span<const Vec3> x);

/// Angles between normals that matter to the rules of a candidate filter.
inline constexpr double facing_cosine = -0.5;   ///< own surface: only beyond 120 degrees
inline constexpr double same_way_cosine = 0.5;  ///< other surfaces: never within 60 degrees

/// What a branch of the tree holds: the box, and a cone round all normals.
template <int Dim>
struct BranchOutline {
  Vec<Dim> middle = Vec<Dim>::Zero(), half = Vec<Dim>::Zero();
  Vec<Dim> axis = Vec<Dim>::Zero();
  double cosine = 0, sine = 1;   ///< of the cone's angle
  double along = 0, across = 0;  ///< halves of the box along the axis, and of its diagonal
  double bulge = std::numeric_limits<double>::infinity();  ///< the largest
  double overhang = 0;                                     ///< the largest
  /// A unit vector whose product with the axis is larger has all normals within 120 degrees of
  /// itself (`facing`), within 60 degrees (`same_way`).
  double facing = 2, same_way = 2;

  /// Upper bound of (point - middle) . normal of the facets in it.
  [[nodiscard]] double highest(const Vec<Dim>& point) const;
  /// Lower bound of the distance from their feet.
  [[nodiscard]] double nearest(const Vec<Dim>& point) const;
};

/// The product with the axis of a cone of this angle beyond which a unit vector has all its
/// directions within the limit; 2 if there is none.
[[nodiscard]] double product_within(double limit_cosine, double angle);

/// Tree of a master whose facets are looked at by where they face: facets that lie within `reach`
/// of each other are sorted by their normals, so that a branch has the upper or the lower side of a
/// plate but not both. Builds `tree` anew if it has another number of facets, else refits it.
template <int Dim>
void plant(const std::vector<FacetOutline<Dim>>& outlines,
           const std::vector<search::Box<Dim>>& boxes, double search_distance, Tree<Dim>& tree,
           std::vector<BranchOutline<Dim>>& branches);

}  // namespace osculate::pairing
