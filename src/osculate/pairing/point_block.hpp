#pragma once
// From the terms of one contact point to the matrix of its nodes; for sources of this layer.
#include <algorithm>

#include "osculate/pairing/pair.hpp"

namespace osculate::pairing {

/// Contact weights by slot: N_k and no derivatives for the slave (1 for a node), -N_k, -N_k,i,
/// -N_k,ij for the master (KS2D:60, 61 with as many columns per node as there are directions).
template <int Dim>
using Weights = std::array<std::array<double, max_slave_nodes<Dim> + max_master_nodes<Dim>>,
                           contact::slots<Dim>>;

template <int Dim>
[[nodiscard]] Weights<Dim> contact_weights(const SlavePoint<Dim>& slave,
                                           const Placed<Dim>& placed) {
  Weights<Dim> w{};
  const auto first = static_cast<std::size_t>(slave.count);
  std::copy_n(slave.shape.begin(), first, w[0].begin());
  for (std::size_t s = 0; s < w.size(); ++s)
    for (std::size_t k = 0; k < static_cast<std::size_t>(placed.count); ++k)
      w[s][first + k] = -placed.shape[s][k];  // @eq KS2D:60
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
[[nodiscard]] double near_reach(const PairDefinition<Dim>& pair) {
  return std::max(0.5 * pair.scope.reach,
                  2 * (std::abs(pair.offset) + contact::reach(pair.normal)));
}

/// Whether the point is farther than that in front of where it was, so that it has not come through
/// the master since.
template <int Dim>
[[nodiscard]] bool far_in_front(const PairDefinition<Dim>& pair,
                                const contact::PointHistory<Dim>& history, const Vec<Dim>& arm,
                                Points<Dim> x) {
  const auto& facet = pair.master.facets[static_cast<std::size_t>(history.facet)];
  return !facet.shape && arm.norm() > near_reach(pair) && arm.dot(middle_normal(facet, x)) > 0;
}

/// Closest point of slave point `i` on the master and the kinematics there; no place where none is
/// found. `work` is refreshed at `x`.
template <int Dim>
[[nodiscard]] Placed<Dim> place_point(const PairDefinition<Dim>& pair,
                                      const PairEvaluation<Dim>& work, Points<Dim> x, std::size_t i,
                                      const contact::PointHistory<Dim>& history, Index kept = -1) {
  if (work.apart) return {};
  ProjectionQuery<Dim> query;
  query.point = position<Dim>(pair.slave.points[i], x);
  if (work.normals[i].squaredNorm() > 0) query.slave_normal = work.normals[i];
  query.history = history.facet;
  query.history_feature = history.feature;
  query.kept = kept;
  NodeScope<Dim> rules;
  if (pair.scope.limited()) {
    rules = node_scope<Dim>(pair.scope, pair.slave, work.scope, i, query.point);
    if (work.near) rules.reach = std::min(rules.reach, near_reach(pair));
    if (history.facet >= 0) {
      rules.last = place_in_space(pair.master, history, x);
      const Vec<Dim> arm = query.point - *rules.last;
      const double way = arm.norm();
      rules.edge_depth *= std::max(1.0, way / pair.scope.reach);
      if (work.near && far_in_front(pair, history, arm, x))
        query.history = -1;
      else
        rules.reach = std::max(rules.reach, way);
    }
    query.scope = &rules;
  }
  const Projection<Dim> p = closest(pair.master, work.tree, x, query);
  if (p.feature == projection::Feature::none) return {};
  return place(pair.master, p, query.point, x);
}

/// Sets the first Dim * count rows and columns of `tangent`.
template <int Dim>
void scatter_tangent(const Weights<Dim>& w, const contact::PointTerms<Dim>& terms, int count,
                     double area, Eigen::MatrixXd& tangent) {
  for (int k = 0; k < count; ++k) {
    std::array<Mat<Dim, Dim>, contact::slots<Dim>> row;
    for (std::size_t b = 0; b < terms.used; ++b) {
      row[b].setZero();
      for (std::size_t a = 0; a < terms.used; ++a) {
        const double weight = w[a][static_cast<std::size_t>(k)];
        if (weight != 0.0) row[b] += (area * weight) * terms.m[a][b];
      }
    }
    for (int l = 0; l < count; ++l) {
      Mat<Dim, Dim> sum = Mat<Dim, Dim>::Zero();
      for (std::size_t b = 0; b < terms.used; ++b)
        sum += w[b][static_cast<std::size_t>(l)] * row[b];
      tangent.template block<Dim, Dim>(Dim * k, Dim * l) = sum;
    }
  }
}

}  // namespace osculate::pairing
