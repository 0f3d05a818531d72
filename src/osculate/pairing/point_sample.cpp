#include "osculate/pairing/point_sample.hpp"

#include "osculate/pairing/point_block.hpp"
#include "osculate/pairing/point_weight.hpp"
#include "osculate/pairing/report.hpp"

namespace osculate::pairing {

using contact::Kinematics;
using contact::NormalResponse;
using contact::PointHistory;
using contact::PointTerms;
using contact::Traction;
using projection::Feature;

namespace {

template <int Dim>
ContactSample<Dim> sample_at(const ProjectedPoint<Dim>& projected) {
  const Kinematics<Dim>& k = projected.kinematics;
  const Projection<Dim>& p = projected.projection;
  return {p.facet, p.feature, p.xi, k.gap, projected.foot, k.normal, k.frame};
}

/// The elastic predictor since the last converged state; around a multiplier what is carried is in
/// the multiplier.
///
/// Formula    d((I - n n^T) t) = -(n . t) d(n) in the tangent plane
template <int Dim>
ElasticPredictor<Dim> predictor(const SurfaceSample<Dim>& point, PointHistory<Dim> history,
                                const contact::Multiplier<Dim>* multiplier, double stiffness,
                                const ContactTimeFraction& time_fraction, Points<Dim> x,
                                PathBuffers<Dim>* path) {
  if (multiplier) history.active = false;
  ElasticPredictor<Dim> tr = elastic_predictor(point.surface, history, point.projected, stiffness,
                                               time_fraction, x, path, point.rule);
  if (!multiplier) return tr;
  const Kinematics<Dim>& k = point.projected.kinematics;
  tr.value += k.frame.transpose() * multiplier->shear;
  tr.variation.add(Mat<Dim, Dim>(-k.normal.dot(multiplier->shear) * Mat<Dim, Dim>::Identity()),
                   k.d_normal);
  return tr;
}

/// Where the point is, and what its normal law says; not active where it is not in contact.
template <int Dim>
NormalResponse report_point(const PairDefinition<Dim>& pair, const PointHistory<Dim>& history,
                            const ProjectedPoint<Dim>& projected, const PointContext<Dim>& context,
                            PointResult<Dim>& result) {
  if (projected.projection.feature == Feature::none) return {};
  const Kinematics<Dim>& k = projected.kinematics;
  report_sample(sample_at(projected), pair.offset + context.relieved, result);
  if (projected.projection.beyond_end) {
    result.history.gap = result.gap = std::abs(k.gap);
    return {};
  }
  const NormalResponse normal = normal_response(pair, history, k.gap, context);
  result.outside_domain = normal.active && !contact::inside_domain(k);
  return result.outside_domain ? NormalResponse{} : normal;
}

/// Rows and columns of the multipliers of a point in contact.
template <int Dim, class WeightOf>
void set_constraint_tangent(const PairDefinition<Dim>& pair, std::size_t i,
                            const Kinematics<Dim>& k, const Traction<Dim>& t, const WeightOf& w,
                            double weight, ContactBlock<Dim>& block) {
  const PointPenalty penalty = point_penalty(pair, i);
  const double area = constraint_weight(pair, i);
  ConstraintBlock<Dim>& c = block.constraint;
  const contact::ShearRate<Dim> rate = contact::shear_rate(k, t);
  for (int n = 0; n < block.count; ++n) {
    Vec<Dim> gap = Vec<Dim>::Zero();
    Mat<Dim, Dim> along = Mat<Dim, Dim>::Zero();
    for (std::size_t s = 0; s < k.d_gap.v.size(); ++s) {
      gap += w(s, n) * k.d_gap[s];
      along += w(s, n) * rate.variation[s];
    }
    const Index node = block.nodes[static_cast<std::size_t>(n)];
    c.normal_row.push_back({node, area * penalty.normal * gap});
    if (pair.friction) c.shear_row.push_back({node, area * along});
  }
  for (const NodeMatrix<Dim>& g : block.path())
    c.shear_row.push_back({g.node, area * rate.d_predictor * g.value});
  set_multiplier_terms<Dim>(
      penalty, area, k.normal, rate.d_predictor, rate.d_push,
      [&](int n) { return weight * w(0, n); }, block);
}

template <int Dim>
void set_point_nodes(const SurfaceSample<Dim>& point, int most, ContactBlock<Dim>& block) {
  const auto facet = static_cast<std::size_t>(point.projected.projection.facet);
  std::span<const Index> slave;
  if (point.slave)
    slave = std::span(point.slave->nodes).first(static_cast<std::size_t>(point.slave->count));
  block.reserve(most);
  set_nodes<Dim>(slave,
                 std::span<const Index>(point.surface.facets[facet].nodes)
                     .first(static_cast<std::size_t>(point.projected.count)),
                 block);
}

/// The block of the smooth facet of the master that the point is on; null for other facets.
template <int Dim>
ContactBlock<Dim>* block_of_facet(const SurfaceSample<Dim>& point, PairEvaluation<Dim>& out) {
  if constexpr (Dim == 3) {
    const auto facet = static_cast<std::size_t>(point.projected.projection.facet);
    if (out.master_blocks > 0 && point.surface.facets[facet].patch)
      return &out.blocks[out.master_blocks + facet];
  }
  return nullptr;
}

/// The first one of the points behind each other that stand on the same nodes of the slave as point
/// i, of the last few; of edge-edge contacts the first of the last few.
template <int Dim>
std::size_t first_alike(const PairDefinition<Dim>& pair, std::size_t i) {
  constexpr std::size_t farthest = 16;
  const std::vector<SlavePoint<Dim>>& points = pair.slave.points;
  const std::size_t least = i - std::min(i, farthest);
  if (i >= points.size()) return std::max(points.size(), least);
  std::size_t first = i;
  while (first > least && on_same_nodes(points[first - 1], points[i])) --first;
  return first;
}

/// Forces, tangent and constraint of a point in contact.
template <int Dim>
void set_block(const PairDefinition<Dim>& pair, const SurfaceSample<Dim>& point,
               const Response<Dim>& r, const PointContext<Dim>& context, bool with_tangent,
               std::size_t i, PairEvaluation<Dim>& out) {
  ContactBlock<Dim>& block = out.blocks[i];
  const Kinematics<Dim>& k = point.projected.kinematics;
  const double weight = out.points[i].weight;
  set_point_nodes(point, out.block_nodes, block);
  const Weights<Dim> weights = contact_weights(point.slave, point.projected);
  const auto w = [&](std::size_t slot, int n) {
    return weights[slot][static_cast<std::size_t>(n)];
  };
  const PointTerms<Dim> terms =
      with_tangent ? contact::point_terms(k, r.traction, pair.residual, pair.tangent)
                   : contact::point_forces(k, r.traction, pair.residual);
  set_forces<Dim>(
      r, context.kept, terms.f,
      [&](const Traction<Dim>& t) { return contact::point_forces(k, t, pair.residual).f; }, w,
      weight, block);
  if (block.constraint.on)
    set_constraint_values(constraint_weight(pair, i), r, k.frame, context, block.constraint);
  if (!with_tangent) return;
  if (block.constraint.on) set_constraint_tangent(pair, i, k, r.traction, w, weight, block);
  ContactBlock<Dim>* const of_facet = block_of_facet(point, out);
  ContactBlock<Dim>& holder = tangent_holder(i, first_alike(pair, i), out.blocks);
  block.elsewhere = &holder != &block;
  holder.reserve_tangent(out.block_nodes);
  const bool own_path = path_is_own(block);
  const std::span<const NodeMatrix<Dim>> path(block.path().data(),
                                              own_path ? block.path().size() : 0);
  if (of_facet) {
    if (!block.elsewhere) start_without_master(block);
    scatter_tangent<Dim>(terms, w, weight, block, holder.tangent, block.elsewhere,
                         facet_block(block, *of_facet).tangent, path);
  } else {
    holder.without_master = false;
    scatter_tangent<Dim>(terms, block.count, w, weight, holder.tangent, block.elsewhere, path);
  }
  if (own_path)
    block.behind.path.clear();
  else if (!block.path().empty())
    scatter_path<Dim>(terms.s, w, weight, block);
  if (!pair.tangent.consistent || pair.weight != Weight::current_area || !point.slave) return;
  add_area_gradient<Dim>(pair, out, i, k.normal, block.area);
  block.reserve_area();
  scatter_forces<Dim>(terms.f, block.count, w, pass_factor(pair), block.area_rows);
}

}  // namespace

template <int Dim>
void evaluate_point(const PairDefinition<Dim>& pair, Points<Dim> x,
                    const PointHistory<Dim>& history, const SurfaceSample<Dim>& point,
                    const PointContext<Dim>& context, bool with_tangent, std::size_t i,
                    PairEvaluation<Dim>& out) {
  PointResult<Dim>& result = out.points[i];
  ContactBlock<Dim>& block = out.blocks[i];
  const Kinematics<Dim>& k = point.projected.kinematics;
  result = open_result(history, point.slave ? point_weight(pair, out, i) : point.weight);
  clear_block(block);
  start_constraint(pair, context, i, block);
  const NormalResponse normal = report_point(pair, history, point.projected, context, result);
  if (point.slave && (normal.active || normal.stored > 0))
    result.weight = facing_weight<Dim>(pair, out, i, k.normal);
  report_normal(normal, history.damping_work, result);
  if (!normal.active && !context.kept) return;
  PathBuffers<Dim>* const path = with_tangent && pair.tangent.consistent ? &block.behind : nullptr;
  const Response<Dim> r = respond<Dim>(
      pair, history, k.gap, k.frame, context, normal,
      [&](double stiffness, const ContactTimeFraction& time_fraction) {
        return predictor(point, history, context.multiplier, stiffness, time_fraction, x, path);
      });
  if (context.kept)
    report_kept(r, context, result);
  else
    report_contact<Dim>(
        r, stored_components(point.surface, point.projected, r.law.traction, x, point.rule),
        history, result);
  set_block(pair, point, r, context, with_tangent, i, out);
}

template <int Dim>
void report_far(const PairDefinition<Dim>& pair, const PointHistory<Dim>& history,
                const ProjectedPoint<Dim>& projected, PointResult<Dim>& result) {
  report_normal(report_point(pair, history, projected, {}, result), history.damping_work, result);
}

template <int Dim>
PointHistory<Dim> history_at(const ProjectedPoint<Dim>& projected) {
  PointResult<Dim> result;
  report_sample(sample_at(projected), 0, result);
  return result.history;
}

template void evaluate_point<2>(const PairDefinition<2>&, Points<2>, const PointHistory<2>&,
                                const SurfaceSample<2>&, const PointContext<2>&, bool, std::size_t,
                                PairEvaluation<2>&);
template void evaluate_point<3>(const PairDefinition<3>&, Points<3>, const PointHistory<3>&,
                                const SurfaceSample<3>&, const PointContext<3>&, bool, std::size_t,
                                PairEvaluation<3>&);
template void report_far<2>(const PairDefinition<2>&, const PointHistory<2>&,
                            const ProjectedPoint<2>&, PointResult<2>&);
template void report_far<3>(const PairDefinition<3>&, const PointHistory<3>&,
                            const ProjectedPoint<3>&, PointResult<3>&);
template PointHistory<2> history_at<2>(const ProjectedPoint<2>&);
template PointHistory<3> history_at<3>(const ProjectedPoint<3>&);

}  // namespace osculate::pairing
