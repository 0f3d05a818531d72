#include "osculate/pairing/reentrant_vertex.hpp"

#include <algorithm>
#include <cmath>

#include "osculate/pairing/point_block.hpp"
#include "osculate/pairing/point_sample.hpp"
#include "osculate/pairing/point_weight.hpp"
#include "osculate/pairing/reentrant_state.hpp"
#include "osculate/pairing/report.hpp"

namespace osculate::pairing {

using contact::Branch;
using contact::Multiplier;
using contact::PointHistory;
using contact::Status;
using projection::Feature;

namespace {

const Facet& facet_of(const Chain& chain, Index facet) {
  return chain.facets[static_cast<std::size_t>(facet)];
}

/// The re-entrant vertex between a facet and the place beside it that a point has moved to.
std::optional<ReentrantVertex> reentrant_vertex_between(const Chain& chain, Index facet,
                                                        const Projection<2>& p, Points<2> x) {
  const Facet& from = facet_of(chain, facet);
  if (p.feature == Feature::corner) {
    const Facet& at = facet_of(chain, p.facet);
    const Index before = p.xi[0] > 0.5 * (at.lo + at.hi) ? p.facet : at.prev;
    return before < 0 ? std::nullopt : reentrant_vertex_after(chain, before, x);
  }
  if (p.facet == from.next) return reentrant_vertex_after(chain, facet, x);
  if (p.facet == from.prev) return reentrant_vertex_after(chain, p.facet, x);
  return std::nullopt;
}

/// The way along the master to the vertex, of a point that was in contact elsewhere.
double way_to(const ReentrantVertex& reentrant, const PairDefinition<2>& pair,
              const PointHistory<2>& history, Points<2> x) {
  if (!history.active || history.facet < 0) return 0;
  return path_length(pair.master, x, {history.facet, history.xi[0]},
                     {reentrant.facets[0], reentrant.end}, nullptr)
      .value_or(0);
}

/// The side on which the point has come sliding in this increment; -1: on none.
int side_of_arrival(const PairDefinition<2>& pair, const PointHistory<2>& history,
                    const ReentrantVertex& v, Points<2> x) {
  if (!pair.friction || rests_in_reentrant_vertex(pair, history, x)) return -1;
  const double way = way_to(v, pair, history, x);
  return way > 0 ? 0 : way < 0 ? 1 : -1;
}

/// The side (0 or 1) on which the traction leaves the re-entrant vertex; -1: it is held.
int side_left(const PairDefinition<2>& pair, const PointHistory<2>& history,
              const ReentrantVertex& v, const Vec2& traction, const PointContext<2>& context,
              int arrived) {
  return left_side<2>(traction, v.normal, {-v.along[0], v.along[1]}, arrived, [&](int k) {
    const auto s = static_cast<std::size_t>(k);
    return slides_on_facet<2>(pair, history, traction.dot(v.normal[s]),
                              Vec<1>(traction.dot(v.along[s])), context);
  });
}

/// A point that was in the re-entrant vertex stays, or goes to a facet with its traction.
std::optional<ReentrantVertex> stay_or_leave(const PairDefinition<2>& pair, Points<2> x,
                                             const PointHistory<2>& history, std::size_t i,
                                             Index facet, const PairEvaluation<2>& work,
                                             const PointContext<2>& context, Multiplier<2>& taken,
                                             ProjectedPoint<2>& projected) {
  const std::optional<ReentrantVertex> v = reentrant_vertex_after(pair.master, facet, x);
  if (!v) return std::nullopt;
  const Vec2 offset = position<2>(pair.slave.points[i], x) - v->point;
  const Vec2 traction = taken.shear + point_penalty(pair, i).shear * offset;
  const int arrived = side_of_arrival(pair, history, *v, x);
  const int left = context.predict ? -1 : side_left(pair, history, *v, traction, context, arrived);
  if (left < 0 && !too_deep<2>(pair, v->normal, offset)) return v;
  const auto side = static_cast<std::size_t>(std::max(left, 0));
  taken.normal = taken.shear.dot(v->normal[side]);
  taken.shear -= taken.normal * v->normal[side];
  projected = project_point<2>(pair, work, x, i, history, v->facets[side]);
  return std::nullopt;
}

/// A point that was pressed on a facet, and is placed beside it: in the re-entrant vertex if it has
/// come into the other facet as well, else still on its own, unless that lets it go.
std::optional<ReentrantVertex> come_or_keep(const PairDefinition<2>& pair, Points<2> x,
                                            const PointHistory<2>& history, std::size_t i,
                                            Index facet, const PairEvaluation<2>& work,
                                            Multiplier<2>& taken, ProjectedPoint<2>& projected) {
  const std::optional<ReentrantVertex> v =
      reentrant_vertex_between(pair.master, facet, projected.projection, x);
  if (!v || (v->facets[0] != facet && v->facets[1] != facet)) return std::nullopt;
  const std::size_t from = v->facets[0] == facet ? 0 : 1;
  const Vec2 offset = position<2>(pair.slave.points[i], x) - v->point;
  const double push = taken.normal + point_penalty(pair, i).normal * offset.dot(v->normal[from]);
  if (too_deep<2>(pair, v->normal, offset)) return std::nullopt;
  if (push > 0) {  // let go: nothing of it belongs to the other facet
    taken = {};
    return std::nullopt;
  }
  if (projected.projection.feature != Feature::corner && offset.dot(v->normal[1 - from]) >= 0) {
    projected = project_point<2>(pair, work, x, i, history, facet);
    return std::nullopt;
  }
  taken.shear += taken.normal * v->normal[from];
  taken.normal = 0;
  return v;
}

/// A point that was open is in the re-entrant vertex if that is its place.
std::optional<ReentrantVertex> come_from_outside(const PairDefinition<2>& pair, Points<2> x,
                                                 const ProjectedPoint<2>& projected,
                                                 Multiplier<2>& taken) {
  const Projection<2>& p = projected.projection;
  if (p.feature != Feature::corner || !(projected.kinematics.gap <= 0)) return std::nullopt;
  const std::optional<ReentrantVertex> v = reentrant_vertex_between(pair.master, p.facet, p, x);
  if (!v || -projected.kinematics.gap > pair.depth) return std::nullopt;
  taken.shear += taken.normal * v->bisector;
  taken.normal = 0;
  return v;
}

}  // namespace

bool rests_in_reentrant_vertex(const PairDefinition<2>& pair, const PointHistory<2>& history,
                               Points<2> x) {
  if (!has_reentrant_vertices(pair) || history.feature != Feature::corner) return false;
  const Facet& facet = facet_of(pair.master, history.facet);
  return history.xi[0] > 0.5 * (facet.lo + facet.hi) &&
         reentrant_vertex_after(pair.master, history.facet, x).has_value();
}

std::optional<ReentrantVertex> find_reentrant_vertex(const PairDefinition<2>& pair, Points<2> x,
                                                     const PointHistory<2>& history, std::size_t i,
                                                     const PairEvaluation<2>& work,
                                                     Multiplier<2>& taken, PointContext<2>& context,
                                                     ProjectedPoint<2>& projected) {
  taken = *context.multiplier;
  context.multiplier = &taken;
  if (projected.projection.feature == Feature::none || context.active.kept() >= 0)
    return std::nullopt;
  const StateBefore<2> before = state_before<2>(
      history, context, [&] { return rests_in_reentrant_vertex(pair, history, x); });
  if (before.reentrant)
    return stay_or_leave(pair, x, history, i, before.facet, work, context, taken, projected);
  if (before.facet >= 0)
    return come_or_keep(pair, x, history, i, before.facet, work, taken, projected);
  return come_from_outside(pair, x, projected, taken);
}

namespace {

/// The vertex on the first of its facets, with the bisector as its normal.
ContactSample<2> sample_in(const ReentrantVertex& reentrant, const Vec2& point) {
  const Vec2 offset = point - reentrant.point;
  ContactSample<2> sample;
  sample.facet = reentrant.facets[0];
  sample.feature = Feature::corner;
  sample.xi[0] = reentrant.end;
  sample.gap = std::min(offset.dot(reentrant.normal[0]), offset.dot(reentrant.normal[1]));
  sample.foot = reentrant.point;
  sample.normal = reentrant.bisector;
  sample.frame = contact::tangent_frame<2>(reentrant.bisector, Vec2::UnitX());
  return sample;
}

/// It sticks with the traction T.
Response<2> response_in(const ContactSample<2>& sample, const Vec2& traction, double way) {
  Response<2> r;
  r.traction.normal = {true, traction.dot(sample.normal), 0};
  r.law.traction = r.traction.tangential.traction = sample.frame.transpose() * traction;
  r.has_shear = true;
  r.slip[0] = way;
  r.slid = std::abs(way);
  return r;
}

/// Weights of the point and of the vertex, which is a node of its facet.
std::array<double, max_slave_nodes<2> + max_master_nodes<2>> weights_in(const SlavePoint<2>& slave,
                                                                        const Facet& facet,
                                                                        double end) {
  std::array<double, max_slave_nodes<2> + max_master_nodes<2>> w{};
  const auto first = static_cast<std::size_t>(slave.count);
  std::copy_n(slave.shape.begin(), first, w.begin());
  const cell::LineShape shape = facet_shape(facet, end);
  for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k)
    w[first + k] = -shape.n[0][k];
  return w;
}

/// Derivatives of the constraint and of the forces by the multipliers: the shear's is eps_T (x - v)
/// = 0, the normal multiplier vanishes.
template <class WeightOf>
void set_constraint_tangent(double spring, double area, double weight, const WeightOf& w,
                            ContactBlock<2>& block) {
  ConstraintBlock<2>& c = block.constraint;
  for (int k = 0; k < block.count; ++k)
    c.shear_row.push_back({block.nodes[static_cast<std::size_t>(k)],
                           area * w(0, k) * spring * Mat<2, 2>::Identity()});
  set_multiplier_terms<2>(
      {0, spring}, area, Vec2::Zero(), Mat<2, 2>::Identity(), Vec2::Zero(),
      [&](int k) { return weight * w(0, k); }, block);
  c.own(0, 0) = -c.scale[0];
}

}  // namespace

void evaluate_reentrant_vertex(const PairDefinition<2>& pair, Points<2> x,
                               const PointHistory<2>& history, const ReentrantVertex& reentrant,
                               const PointContext<2>& context, bool with_tangent, std::size_t i,
                               PairEvaluation<2>& out) {
  PointResult<2>& result = out.points[i];
  ContactBlock<2>& block = out.blocks[i];
  const SlavePoint<2>& slave = pair.slave.points[i];
  const Facet& facet = facet_of(pair.master, reentrant.facets[0]);
  const Vec2 point = position<2>(slave, x);
  const double spring = point_penalty(pair, i).shear, area = constraint_weight(pair, i);
  const Vec2 pull = spring * (point - reentrant.point);
  const ContactSample<2> sample = sample_in(reentrant, point);
  const Response<2> r =
      response_in(sample, context.multiplier->shear + pull, way_to(reentrant, pair, history, x));
  result = open_result(history, facing_weight<2>(pair, out, i, reentrant.bisector));
  report_sample(sample, 0, result);
  report_normal(r.traction.normal, history.damping_work, result);
  report_contact(r, r.law.traction, history, result);
  result.branch = {Branch::reentrant, Vec2::Zero()};

  clear_block(block);
  start_constraint(pair, context, i, block);
  block.constraint.shear = block.constraint.branch_shear = area * pull;
  block.reserve(out.block_nodes);
  set_nodes<2>(std::span(slave.nodes).first(static_cast<std::size_t>(slave.count)),
               std::span(facet.nodes).first(static_cast<std::size_t>(facet.count)), block);
  const auto weights = weights_in(slave, facet, reentrant.end);
  const auto w = [&](std::size_t, int k) { return weights[static_cast<std::size_t>(k)]; };
  contact::PointTerms<2> terms;
  terms.used = 1;
  terms.f[0] = context.multiplier->shear + pull;
  terms.m[0][0] = spring * Mat<2, 2>::Identity();
  const auto f = std::span<const Vec2>(terms.f).first(1);
  set_forces<2>(
      r, {}, f, [&](const auto&) { return f; }, w, result.weight, block);
  if (!with_tangent) return;
  block.reserve_tangent(out.block_nodes);
  scatter_tangent<2>(terms, block.count, w, result.weight, block.tangent);
  block.reserve_path();
  block.path_rows.topRows(2 * block.count).setZero();
  set_constraint_tangent(spring, area, result.weight, w, block);
  if (pair.weight != Weight::current_area) return;
  add_area_gradient<2>(pair, out, i, reentrant.bisector, block.area);
  block.reserve_area();
  scatter_forces<2>(f, block.count, w, pass_factor(pair), block.area_rows);
}

}  // namespace osculate::pairing
