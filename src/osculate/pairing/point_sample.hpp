#pragma once
// Slave nodes and quadrature points as contact samples; for sources of this layer.
#include "osculate/pairing/point_context.hpp"

namespace osculate::pairing {

/// Contact weights by slot: N_k and no derivatives for the slave (1 for a node), -N_k, -N_k,i,
/// -N_k,ij for the master (KS2D:60, 61 with as many columns per node as there are directions).
template <int Dim>
using Weights = std::array<std::array<double, max_slave_nodes<Dim> + max_master_nodes<Dim>>,
                           contact::slots<Dim>>;

template <int Dim>
[[nodiscard]] Weights<Dim> contact_weights(const SlavePoint<Dim>* slave,
                                           const ProjectedPoint<Dim>& projected) {
  Weights<Dim> w{};
  const std::size_t first = slave ? static_cast<std::size_t>(slave->count) : 0;
  if (slave) std::copy_n(slave->shape.begin(), first, w[0].begin());
  for (std::size_t s = 0; s < w.size(); ++s)
    for (std::size_t k = 0; k < static_cast<std::size_t>(projected.count); ++k)
      w[s][first + k] = -projected.shape[s][k];  // @eq KS2D:60
  return w;
}

/// Where the place of a history is now.
[[nodiscard]] inline Vec2 place_in_space(const Chain& master, const contact::PointHistory<2>& h,
                                         std::span<const Vec2> x) {
  return facet_jet(master.facets[static_cast<std::size_t>(h.facet)], h.xi[0], x).r;
}
[[nodiscard]] inline Vec3 place_in_space(const FacetSurface& master,
                                         const contact::PointHistory<3>& h,
                                         std::span<const Vec3> x) {
  return facet_point(master.facets[static_cast<std::size_t>(h.facet)], h.xi, x);
}

/// How far from its master a point needs a place in a `near` evaluation.
template <int Dim>
[[nodiscard]] double near_distance(const PairDefinition<Dim>& pair) {
  return std::max(0.5 * pair.filter.distance,
                  2 * (std::abs(pair.offset) + contact::onset_gap(pair.normal)));
}

/// Whether the point is farther than that in front of where it was, so that it has not come through
/// the master since.
template <int Dim>
[[nodiscard]] bool far_in_front(const PairDefinition<Dim>& pair,
                                const contact::PointHistory<Dim>& history, const Vec<Dim>& arm,
                                Points<Dim> x) {
  const auto& facet = pair.master.facets[static_cast<std::size_t>(history.facet)];
  return !facet.shape && arm.norm() > near_distance(pair) && arm.dot(middle_normal(facet, x)) > 0;
}

/// Highest derivatives of the shape functions that forces and tangent of a pair's points have.
template <int Dim>
[[nodiscard]] int derivatives_needed(const PairDefinition<Dim>& pair, bool with_tangent) {
  if (has_reentrant_vertices(pair)) return 3;
  const bool full = pair.residual == contact::ResidualForm::full;
  return with_tangent ? (full ? 3 : 1) : (full ? 1 : 0);
}

/// Where slave point `i` is on the master; no place where none is found. `work` is refreshed at
/// `x`.
template <int Dim>
[[nodiscard]] Projection<Dim> place_of_point(const PairDefinition<Dim>& pair,
                                             const PairEvaluation<Dim>& work, Points<Dim> x,
                                             std::size_t i,
                                             const contact::PointHistory<Dim>& history,
                                             Index kept = -1) {
  if (work.apart) return {};
  ProjectionQuery<Dim> query;
  query.point = position<Dim>(pair.slave.points[i], x);
  if (work.normals[i].squaredNorm() > 0) query.slave_normal = work.normals[i];
  query.history = history.facet;
  query.history_feature = history.feature;
  query.kept = kept;
  // The continuation is for points on the border of both sides.
  if (pair.slave.points[i].inside && is<MayPart>(pair.separation))
    query.beyond_open = border_tolerance;
  query.patches = work.patches;
  if (work.same_way.fresh) query.same_way = &work.same_way;
  NodeFilter<Dim> rules;
  if (pair.filter.limited()) {
    rules = node_filter<Dim>(pair.filter, pair.slave, work.filter, i, query.point);
    if (work.near) rules.distance = std::min(rules.distance, near_distance(pair));
    if (history.facet >= 0) {
      rules.last = place_in_space(pair.master, history, x);
      const Vec<Dim> arm = query.point - *rules.last;
      const double way = arm.norm();
      rules.edge_depth *= std::max(1.0, way / pair.filter.distance);
      if (work.near && far_in_front(pair, history, arm, x))
        query.history = -1;
      else
        rules.distance = std::max(rules.distance, way);
    }
    query.filter = &rules;
  }
  const Projection<Dim> p = closest(pair.master, work.tree, x, query);
  if (p.feature == projection::Feature::none || pair.filter.hidden.has(i, p.facet)) return {};
  return p;
}

/// The kinematics of slave point `i` at its place, if it has one. `order` as in `projected_point`.
template <int Dim>
[[nodiscard]] ProjectedPoint<Dim> point_at(const PairDefinition<Dim>& pair,
                                           const PairEvaluation<Dim>& work, Points<Dim> x,
                                           std::size_t i, const Projection<Dim>& place,
                                           int order = 3) {
  if (place.feature == projection::Feature::none) return {};
  const Vec<Dim> point = position<Dim>(pair.slave.points[i], x);
  if constexpr (Dim == 3)
    return projected_point(pair.master, place, point, x, work.patches, order);
  else
    return projected_point(pair.master, place, point, x);
}

/// Closest point of slave point `i` on the master and the kinematics there.
template <int Dim>
[[nodiscard]] ProjectedPoint<Dim> project_point(const PairDefinition<Dim>& pair,
                                                const PairEvaluation<Dim>& work, Points<Dim> x,
                                                std::size_t i,
                                                const contact::PointHistory<Dim>& history,
                                                Index kept = -1, int order = 3) {
  return point_at(pair, work, x, i, place_of_point(pair, work, x, i, history, kept), order);
}

/// A point that is placed on a surface: a slave point on the master, or the origin on the surface
/// of the differences of edges.
template <int Dim>
struct SurfaceSample {
  const Boundary<Dim>& surface;
  const ProjectedPoint<Dim>& projected;
  /// None of an edge-edge contact: the origin is no node, and its weight is the area of its edge.
  const SlavePoint<Dim>* slave;
  double weight = 1;  ///< of an edge-edge contact
  HistoryRule rule = HistoryRule::continuous;
};

/// Fills `out.points[i]` and `out.blocks[i]` of a sample; `out` is refreshed at `x`.
template <int Dim>
void evaluate_point(const PairDefinition<Dim>& pair, Points<Dim> x,
                    const contact::PointHistory<Dim>& history, const SurfaceSample<Dim>& point,
                    const PointContext<Dim>& context, bool with_tangent, std::size_t i,
                    PairEvaluation<Dim>& out);

/// What an open point reports and remembers of the place it has been found far in front of.
template <int Dim>
void report_far(const PairDefinition<Dim>& pair, const contact::PointHistory<Dim>& history,
                const ProjectedPoint<Dim>& projected, PointResult<Dim>& result);

/// What a point remembers of a place at which it has not slipped.
template <int Dim>
[[nodiscard]] contact::PointHistory<Dim> history_at(const ProjectedPoint<Dim>& projected);

/// Points and blocks of the edge-edge contacts, behind those of the slave's points.
void evaluate_edge_contacts(const PairDefinition<3>& pair, Points<3> x,
                            const PairState<3>& committed, bool with_tangent,
                            PairEvaluation<3>& out, const ActiveSet<3>& active_set);

/// Frame of an edge-edge contact's stored traction.
[[nodiscard]] Mat<3, 2> edge_contact_frame(const PairDefinition<3>& pair,
                                           const contact::PointHistory<3>& h, Points<3> x);

}  // namespace osculate::pairing
