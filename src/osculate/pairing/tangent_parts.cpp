#include "osculate/pairing/tangent_parts.hpp"

#include <algorithm>

#include "osculate/pairing/point_block.hpp"
#include "osculate/pairing/point_sample.hpp"

namespace osculate::pairing {
namespace {

template <int Dim>
double share_at(const PairDefinition<Dim>& pair, std::size_t i, const PointResult<Dim>& point,
                const ProjectedPoint<Dim>& projected, double stiffening,
                const contact::TangentForm& parts) {
  const SlavePoint<Dim>& slave = pair.slave.points[i];
  PointContext<Dim> context;
  context.own = relative_stiffness(pair, i);
  context.stiffening = stiffening;
  contact::Traction<Dim> traction;
  traction.normal = normal_response<Dim>(pair, point.history, projected.kinematics.gap, context);
  if (!traction.normal.active)
    traction.normal.d_traction = stiffening * point_penalty(pair, i).normal;
  traction.normal.traction = point.normal_traction;
  const Weights<Dim> weights = contact_weights(&slave, projected);
  const auto w = [&](std::size_t s, int n) { return weights[s][static_cast<std::size_t>(n)]; };
  const int count = slave.count + projected.count, size = Dim * count;
  const auto matrix = [&](bool rotational, bool curvature) {
    const contact::TangentForm form{false, true, rotational, curvature};
    Eigen::MatrixXd k(size, size);
    scatter_tangent<Dim>(
        contact::covariant_terms(projected.kinematics, traction, pair.residual, form), count, w,
        1.0, k);
    return k;
  };
  const Eigen::MatrixXd full = matrix(parts.rotational, parts.curvature),
                        main = matrix(false, false);
  const Eigen::MatrixXd rest = full - main;
  const double share = row_sum_norm(rest) / row_sum_norm(main);  // @eq KSVD:60
  return share;
}

}  // namespace

template <int Dim>
double curvature_share(const PairDefinition<Dim>& pair, Points<Dim> x,
                       const PairEvaluation<Dim>& evaluation, const contact::TangentForm& parts) {
  double largest = 0;
  if (by_mortar(pair) || is_tied(pair)) return largest;         // one tangent, no parts
  for (std::size_t i = 0; i < pair.slave.points.size(); ++i) {  // not the edge-edge contacts
    if (evaluation.points[i].status == contact::Status::open) continue;
    const contact::PointHistory<Dim>& history = evaluation.points[i].history;
    const ProjectedPoint<Dim> projected =
        project_point<Dim>(pair, evaluation, x, i, history, -1, 1);
    if (projected.projection.feature == projection::Feature::none) continue;
    largest = std::max(
        largest, share_at(pair, i, evaluation.points[i], projected, evaluation.stiffening, parts));
  }
  return largest;
}

template double curvature_share<2>(const PairDefinition<2>&, Points<2>, const PairEvaluation<2>&,
                                   const contact::TangentForm&);
template double curvature_share<3>(const PairDefinition<3>&, Points<3>, const PairEvaluation<3>&,
                                   const contact::TangentForm&);

}  // namespace osculate::pairing
