#pragma once
// Where a surface ends for one slave point; for sources of this layer.
#include <algorithm>

#include "osculate/pairing/candidate_filter.hpp"
#include "osculate/pairing/same_way.hpp"

namespace osculate::pairing {

/// Beyond an edge between normals farther apart (37 degrees) lies another side of the body.
inline constexpr double other_side_cosine = 0.8;

/// Whether nothing with this normal may be touched, wherever it lies.
template <int Dim>
[[nodiscard]] bool turned_away(const ProjectionQuery<Dim>& query, const Vec<Dim>& normal) {
  if (query.slave_normal && normal.dot(*query.slave_normal) > same_way_cosine) return true;
  if (!query.filter || query.filter->facing.empty()) return false;
  const auto faces = [&](const Vec<Dim>& n) { return n.dot(normal) < facing_cosine; };
  return std::none_of(query.filter->facing.begin(), query.filter->facing.end(), faces);
}

/// Whether all of a facet, or of a branch of the tree, faces the same way as the point, as far as
/// that is known without a projection.
template <int Dim>
[[nodiscard]] bool faces_same_way(const ProjectionQuery<Dim>& query, Index facet) {
  return query.same_way && query.slave_normal &&
         query.same_way->facets[static_cast<std::size_t>(facet)].holds(*query.slave_normal);
}
template <int Dim>
[[nodiscard]] bool branch_faces_same_way(const ProjectionQuery<Dim>& query, Index branch) {
  return query.same_way && query.slave_normal &&
         query.same_way->branches[static_cast<std::size_t>(branch)].holds(*query.slave_normal);
}

/// Whether the surface ends for this point between two facets with these normals, `arm` from the
/// middle of the one to that of the other: beyond a convex edge is another side of the body, which
/// the point may not touch. A node beside a block is not in it, and one at its rim must not change
/// between face and edge by rounding errors.
///
/// Tested by  tests/unit/pairing/test_rim.cpp
template <int Dim>
[[nodiscard]] bool ends_between(const ProjectionQuery<Dim>& query, const Vec<Dim>& normal,
                                const Vec<Dim>& beyond, const Vec<Dim>& arm) {
  const bool convex = arm.dot(normal) < 0;
  return convex && normal.dot(beyond) < other_side_cosine && turned_away(query, beyond);
}

/// Whether two sides do not face each other: their normals are not within 60 degrees of opposite.
/// `cosine`: of the angle between their normals.
[[nodiscard]] inline bool across(double cosine) { return cosine > facing_cosine; }

/// A point that came through a facet that faces it stays on it, or on a neighbour that faces it
/// too, where a face across is nearer: under the corner of a punch the lower face bears, however
/// near the side face is.
///
/// `look.on(f)` is the candidate on facet f {facet, distance, cosine of the normals}, `look.inside`
/// whether its foot lies inside the facet, `look.gap` its gap.
///
/// Tested by  tests/unit/pairing/test_rim.cpp
template <int Dim, class Candidate, class Neighbours, class Look>
[[nodiscard]] Candidate entered_through(const ProjectionQuery<Dim>& query, const Candidate& nearest,
                                        const Neighbours& neighbours, const Look& look) {
  const bool through =
      nearest.facet == query.history && query.history_feature == projection::Feature::face;
  if (!query.slave_normal || query.history < 0 || through || !look.inside(nearest) ||
      !(look.gap(nearest) < 0) || !across(nearest.cosine))
    return nearest;
  Candidate best;
  const auto visit = [&](Index f) {
    if (f < 0 || f == nearest.facet) return;
    const Candidate c = look.on(f);
    if (look.inside(c) && look.gap(c) < 0 && !across(c.cosine) && c.distance < best.distance)
      best = c;
  };
  visit(query.history);
  for (const Index f : neighbours) visit(f);
  return best.facet < 0 ? nearest : best;
}

}  // namespace osculate::pairing
