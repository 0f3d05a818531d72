#pragma once
#include <cmath>
#include <vector>

#include "osculate/projection/cells.hpp"
#include "osculate/search/bvh.hpp"

namespace osculate::projection {

/// What lies below a node of a tree: a ball round it, and a cone of directions.
template <int Dim>
struct Guard {
  Vec<Dim> center = Vec<Dim>::Zero();
  double radius = 0;
  Vec<Dim> axis = Vec<Dim>::UnitX();
  double cosine = -1, sine = 0;  ///< of the cone's angle; cosine -1: any direction
};

/// No point of the ball sees `point` along plus or minus a direction of the cone. Where these are
/// the normals of a surface and of all facets it meets, no local minimum of the distance lies
/// there: inside a facet the line to the point is a normal; at an edge or corner inside the
/// surface, whose facets' normals all lie within an angle below 90 degrees of an axis, the surface
/// is a graph over the plane across the axis with at most the slope of that angle, and a line
/// steeper than its complement would have a nearer point beside it.
template <int Dim>
[[nodiscard]] bool off_normals(const Guard<Dim>& guard, const Vec<Dim>& point) {
  if (guard.cosine <= 0) return false;
  const Vec<Dim> d = point - guard.center;
  const double distance2 = d.squaredNorm(), radius2 = guard.radius * guard.radius;
  if (!(distance2 > radius2)) return false;
  // distance cos(angle + asin(radius / distance))
  const double limit = guard.cosine * std::sqrt(distance2 - radius2) - guard.sine * guard.radius;
  constexpr double rounding = 1e-9;
  return limit > 0 && std::abs(d.dot(guard.axis)) < limit - rounding * std::sqrt(distance2);
}

/// From every point of the ball `point` lies on the inner side of all directions of the cone. Where
/// these lead from an open border into the surface, no local minimum lies on the border there.
template <int Dim>
[[nodiscard]] bool inwards(const Guard<Dim>& guard, const Vec<Dim>& point) {
  if (guard.cosine <= 0) return false;
  const Vec<Dim> d = point - guard.center;
  const double distance2 = d.squaredNorm(), radius2 = guard.radius * guard.radius;
  if (!(distance2 > radius2)) return false;
  // distance sin(angle + asin(radius / distance))
  const double limit = guard.cosine * guard.radius + guard.sine * std::sqrt(distance2 - radius2);
  constexpr double rounding = 1e-9;
  return guard.cosine * std::sqrt(distance2 - radius2) > guard.sine * guard.radius &&
         d.dot(guard.axis) > limit + rounding * std::sqrt(distance2);
}

/// A tree with a guard for every node and the piece of every object.
template <int Dim>
struct GuardedTree {
  search::Bvh<Dim> tree;
  std::vector<Guard<Dim>> guards;
  std::vector<Index> piece;
};

/// All pieces with their normals, and once more the pieces along open borders with the directions
/// that lead inwards.
template <int Dim>
struct PieceTrees {
  GuardedTree<Dim> inner, border;
};

/// Puts pieces that lie close to each other close in memory: queries on large meshes wait for it.
template <int Dim>
void sort_by_place(PieceSet<Dim>& set);

template <int Dim>
[[nodiscard]] PieceTrees<Dim> plant(const CellComplex<Dim>& all);

/// Offers every piece within `reach` (a squared distance that may shrink) on which a local minimum
/// of the distance is not excluded; near ones first, some of them twice.
template <int Dim, class Offer>
void for_each_possible(const PieceTrees<Dim>& trees, const Vec<Dim>& point, const double& reach,
                       const Offer& offer) {
  const auto guard = [](const GuardedTree<Dim>& t, Index i) -> const Guard<Dim>& {
    return t.guards[static_cast<std::size_t>(i)];
  };
  trees.inner.tree.for_each_wanted(
      point, reach, [&](Index i) { return !off_normals(guard(trees.inner, i), point); },
      [&](Index k) { offer(trees.inner.piece[static_cast<std::size_t>(k)]); });
  trees.border.tree.for_each_wanted(
      point, reach, [&](Index i) { return !inwards(guard(trees.border, i), point); },
      [&](Index k) { offer(trees.border.piece[static_cast<std::size_t>(k)]); });
}

}  // namespace osculate::projection
