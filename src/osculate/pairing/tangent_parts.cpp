#include "osculate/pairing/tangent_parts.hpp"

#include <algorithm>
#include <mutex>

#include "osculate/core/pieces.hpp"
#include "osculate/pairing/point_block.hpp"
#include "osculate/pairing/point_sample.hpp"

namespace osculate::pairing {
namespace {

/// Matrices of a point, whose room serves for the next one.
struct Room {
  Eigen::MatrixXd full, main;
};

template <int Dim>
double share_at(const PairDefinition<Dim>& pair, std::size_t i, const PointResult<Dim>& point,
                const ProjectedPoint<Dim>& projected, double stiffening,
                const contact::TangentForm& parts, Room& room) {
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
  const auto set = [&](Eigen::MatrixXd& k, bool rotational, bool curvature) {
    const contact::TangentForm form{false, true, rotational, curvature};
    k.resize(size, size);
    scatter_tangent<Dim>(
        contact::covariant_terms(projected.kinematics, traction, pair.residual, form), count, w,
        1.0, k);
  };
  set(room.full, parts.rotational, parts.curvature);
  set(room.main, false, false);
  room.full -= room.main;
  return row_sum_norm(room.full) / row_sum_norm(room.main);  // @eq KSVD:60
}

}  // namespace

template <int Dim>
double curvature_share(const PairDefinition<Dim>& pair, Points<Dim> x,
                       const PairEvaluation<Dim>& evaluation, const contact::TangentForm& parts,
                       int threads) {
  if (by_mortar(pair) || is_tied(pair)) return 0;  // one tangent, no parts
  constexpr std::size_t piece = 512;
  std::mutex mutex;
  double largest = 0;
  const auto look_at = [&](std::size_t begin, std::size_t end) {
    Room room;
    double here = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const PointResult<Dim>& point = evaluation.points[i];
      if (point.status == contact::Status::open) continue;
      const ProjectedPoint<Dim> projected =
          project_point<Dim>(pair, evaluation, x, i, point.history, -1, 1);
      if (projected.projection.feature == projection::Feature::none) continue;
      here =
          std::max(here, share_at(pair, i, point, projected, evaluation.stiffening, parts, room));
    }
    const std::scoped_lock lock(mutex);
    largest = std::max(largest, here);
  };
  // Not the edge-edge contacts.
  core::for_pieces(pair.slave.points.size(), piece, threads, look_at);
  return largest;
}

template double curvature_share<2>(const PairDefinition<2>&, Points<2>, const PairEvaluation<2>&,
                                   const contact::TangentForm&, int);
template double curvature_share<3>(const PairDefinition<3>&, Points<3>, const PairEvaluation<3>&,
                                   const contact::TangentForm&, int);

}  // namespace osculate::pairing
