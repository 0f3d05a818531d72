#include "osculate/pairing/valley.hpp"

#include <algorithm>
#include <cmath>

#include "osculate/pairing/friction_branch.hpp"
#include "osculate/pairing/point_block.hpp"
#include "osculate/pairing/point_weight.hpp"

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

/// The state that the tractions of a point belong to: the valley behind a facet, a facet, or
/// neither where it was open.
struct Before {
  bool valley = false;
  Index facet = -1;
};

Before state_before(const PairDefinition<2>& pair, const PointHistory<2>& history,
                    const BranchHint<2>& hint, Points<2> x) {
  if (hint.assumed.branch == Branch::valley) return {true, hint.assumed.facet};
  if (hint.assumed.branch != Branch::none && hint.assumed.facet >= 0)
    return {false, hint.assumed.facet};
  const bool of_history = hint.predict || !hint.known;
  if (!of_history || !history.active) return {};
  return {rests_in_valley(pair, history, x), history.facet};
}

/// The valley between a facet and the place beside it that a point has moved to.
std::optional<Valley> valley_between(const Chain& chain, Index facet, const Projection<2>& p,
                                     Points<2> x) {
  const Facet& from = facet_of(chain, facet);
  if (p.feature == Feature::corner) {
    const Facet& at = facet_of(chain, p.facet);
    const Index before = p.xi[0] > 0.5 * (at.lo + at.hi) ? p.facet : at.prev;
    return before < 0 ? std::nullopt : valley_after(chain, before, x);
  }
  if (p.facet == from.next) return valley_after(chain, facet, x);
  if (p.facet == from.prev) return valley_after(chain, p.facet, x);
  return std::nullopt;
}

/// The way along the master to the vertex, of a point that was in contact elsewhere.
double way_to(const Valley& valley, const PairDefinition<2>& pair, const PointHistory<2>& history,
              Points<2> x) {
  if (!history.active || history.facet < 0) return 0;
  return path_length(pair.master, x, {history.facet, history.xi[0]}, {valley.facets[0], valley.end},
                     nullptr)
      .value_or(0);
}

/// The side on which the point has come sliding in this increment; -1: on none.
int side_of_arrival(const PairDefinition<2>& pair, const PointHistory<2>& history, const Valley& v,
                    Points<2> x) {
  if (!pair.friction || rests_in_valley(pair, history, x)) return -1;
  const double way = way_to(v, pair, history, x);
  return way > 0 ? 0 : way < 0 ? 1 : -1;
}

/// Whether a facet's law lets the traction slide.
bool slides(const PairDefinition<2>& pair, const PointHistory<2>& history, double normal,
            double shear, const BranchHint<2>& hint) {
  return !pair.friction || contact::response<2>(friction_law(pair, normal, hint), Vec<1>(shear),
                                                normal, sliding_of(history, hint))
                                   .status == Status::slip;
}

/// The side (0 or 1) on which the traction leaves the valley; -1: it is held.
int left_side(const PairDefinition<2>& pair, const PointHistory<2>& history, const Valley& v,
              const Vec2& traction, const BranchHint<2>& hint, int arrived) {
  int side = -1;
  double least = 0;
  for (int k = 0; k < 2; ++k) {
    const auto s = static_cast<std::size_t>(k);
    const double normal = traction.dot(v.normal[s]), shear = traction.dot(v.along[s]);
    const bool away = k == 0 ? shear < 0 : shear > 0;  // it would slide away from the vertex
    const bool sliding = slides(pair, history, normal, shear, hint);
    const bool leaves = k == arrived ? away || !sliding : away && sliding;
    if (!leaves || (side >= 0 && normal >= least)) continue;
    side = k;
    least = normal;
  }
  return side;
}

bool too_deep(const PairDefinition<2>& pair, const Valley& v, const Vec2& offset) {
  return std::min(offset.dot(v.normal[0]), offset.dot(v.normal[1])) < -pair.depth;
}

/// A point that was in the valley stays, or goes to a facet with its traction.
std::optional<Valley> stay_or_leave(const PairDefinition<2>& pair, Points<2> x,
                                    const PointHistory<2>& history, std::size_t i, Index facet,
                                    const PairEvaluation<2>& work, const BranchHint<2>& hint,
                                    Multiplier<2>& around, Placed<2>& placed) {
  const std::optional<Valley> v = valley_after(pair.master, facet, x);
  if (!v) return std::nullopt;
  const Vec2 offset = position<2>(pair.slave.points[i], x) - v->point;
  const Vec2 traction = around.shear + point_penalty(pair, i).shear * offset;
  const int arrived = side_of_arrival(pair, history, *v, x);
  const int left = hint.predict ? -1 : left_side(pair, history, *v, traction, hint, arrived);
  if (left < 0 && !too_deep(pair, *v, offset)) return v;
  const auto side = static_cast<std::size_t>(std::max(left, 0));
  around.normal = around.shear.dot(v->normal[side]);
  around.shear -= around.normal * v->normal[side];
  placed = place_point<2>(pair, work, x, i, history, v->facets[side]);
  return std::nullopt;
}

/// A point that was pressed on a facet, and is placed beside it: in the valley if it has come into
/// the other facet as well, else still on its own, unless that lets it go.
std::optional<Valley> come_or_keep(const PairDefinition<2>& pair, Points<2> x,
                                   const PointHistory<2>& history, std::size_t i, Index facet,
                                   const PairEvaluation<2>& work, Multiplier<2>& around,
                                   Placed<2>& placed) {
  const std::optional<Valley> v = valley_between(pair.master, facet, placed.projection, x);
  if (!v || (v->facets[0] != facet && v->facets[1] != facet)) return std::nullopt;
  const std::size_t from = v->facets[0] == facet ? 0 : 1;
  const Vec2 offset = position<2>(pair.slave.points[i], x) - v->point;
  const double push = around.normal + point_penalty(pair, i).normal * offset.dot(v->normal[from]);
  if (too_deep(pair, *v, offset)) return std::nullopt;
  if (push > 0) {  // let go: nothing of it belongs to the other facet
    around = {};
    return std::nullopt;
  }
  if (placed.projection.feature != Feature::corner && offset.dot(v->normal[1 - from]) >= 0) {
    placed = place_point<2>(pair, work, x, i, history, facet);
    return std::nullopt;
  }
  around.shear += around.normal * v->normal[from];
  around.normal = 0;
  return v;
}

/// A point that was open is in the valley if that is its place.
std::optional<Valley> come_from_outside(const PairDefinition<2>& pair, Points<2> x,
                                        const Placed<2>& placed, Multiplier<2>& around) {
  const Projection<2>& p = placed.projection;
  if (p.feature != Feature::corner || !(placed.kinematics.gap <= 0)) return std::nullopt;
  const std::optional<Valley> v = valley_between(pair.master, p.facet, p, x);
  if (!v || -placed.kinematics.gap > pair.depth) return std::nullopt;
  around.shear += around.normal * v->bisector;
  around.normal = 0;
  return v;
}

}  // namespace

bool rests_in_valley(const PairDefinition<2>& pair, const PointHistory<2>& history, Points<2> x) {
  if (!pair.valleys || history.feature != Feature::corner) return false;
  const Facet& facet = facet_of(pair.master, history.facet);
  return history.xi[0] > 0.5 * (facet.lo + facet.hi) &&
         valley_after(pair.master, history.facet, x).has_value();
}

std::optional<Valley> find_valley(const PairDefinition<2>& pair, Points<2> x,
                                  const PointHistory<2>& history, std::size_t i,
                                  const PairEvaluation<2>& work, Multiplier<2>& around,
                                  BranchHint<2>& hint, Placed<2>& placed) {
  around = *hint.multiplier;
  hint.multiplier = &around;
  if (placed.projection.feature == Feature::none || hint.assumed.kept() >= 0) return std::nullopt;
  const Before before = state_before(pair, history, hint, x);
  if (before.valley)
    return stay_or_leave(pair, x, history, i, before.facet, work, hint, around, placed);
  if (before.facet >= 0)
    return come_or_keep(pair, x, history, i, before.facet, work, around, placed);
  return come_from_outside(pair, x, placed, around);
}

namespace {

/// The place of the vertex on the first of its facets.
Placed<2> place_in(const Valley& valley, const PairDefinition<2>& pair, const Vec2& point,
                   Points<2> x) {
  Projection<2> p;
  p.feature = Feature::corner;
  p.facet = valley.facets[0];
  p.xi[0] = valley.end;
  p.local = 1;
  p.distance = (point - valley.point).norm();
  p.outward = valley.bisector;
  return place(pair.master, p, point, x);
}

void report_valley(const PairDefinition<2>& pair, Points<2> x, const PointHistory<2>& history,
                   const Valley& valley, const Vec2& point, const Vec2& traction,
                   PointResult<2>& result) {
  const Vec2 offset = point - valley.point;
  result.status = Status::stick;
  result.branch = {Branch::valley, Vec2::Zero()};
  result.foot = valley.point;
  result.normal = valley.bisector;
  result.frame = contact::tangent_frame<2>(valley.bisector, Vec2::UnitX());
  result.gap = std::min(offset.dot(valley.normal[0]), offset.dot(valley.normal[1]));
  result.normal_traction = traction.dot(result.normal);
  result.shear_traction = result.frame.transpose() * traction;
  result.slip_increment[0] = way_to(valley, pair, history, x);
  PointHistory<2>& h = result.history;
  h = history;
  h.active = true;
  h.facet = valley.facets[0];
  h.feature = Feature::corner;
  h.xi[0] = valley.end;
  h.gap = result.gap;
  h.traction = result.shear_traction;
  h.slipping = false;
  h.slip = result.slip_increment;
  h.slid = std::abs(result.slip_increment[0]);
  if (!history.active) return;
  h.slip += history.slip;
  h.slid += history.slid;
}

/// Derivatives of forces and constraint: T and the constraint are linear in x - v and Lambda.
void set_tangent(const PairDefinition<2>& pair, std::size_t i, const Weights<2>& w, double weight,
                 ContactBlock<2>& block) {
  const PointPenalty penalty = point_penalty(pair, i);
  const double area = constraint_weight(pair, i);
  const Mat<2, 2> spring = penalty.shear * Mat<2, 2>::Identity();
  const Eigen::Index size = 2 * block.count;
  block.path_rows.topRows(size).setZero();
  block.area_rows.head(size).setZero();
  ConstraintBlock<2>& c = block.constraint;
  if (c.columns.rows() < size) c.columns.resize(size, 3);
  for (int k = 0; k < block.count; ++k) {
    const double of_k = w[0][static_cast<std::size_t>(k)];
    for (int l = 0; l < block.count; ++l)
      block.tangent.block<2, 2>(2 * k, 2 * l) =
          (weight * of_k * w[0][static_cast<std::size_t>(l)]) * spring;
    c.columns.middleRows<2>(2 * k).col(0).setZero();
    c.columns.middleRows<2>(2 * k).rightCols<2>() = (weight * of_k) * spring;
    c.shear_row.push_back({block.nodes[static_cast<std::size_t>(k)], area * of_k * spring});
  }
  c.own.bottomRightCorner<2, 2>().setZero();
}

}  // namespace

void evaluate_in_valley(const PairDefinition<2>& pair, Points<2> x, const PointHistory<2>& history,
                        const Valley& valley, const BranchHint<2>& hint, bool with_tangent,
                        std::size_t i, PairEvaluation<2>& out) {
  PointResult<2>& result = out.points[i];
  ContactBlock<2>& block = out.blocks[i];
  const SlavePoint<2>& slave = pair.slave.points[i];
  const Vec2 point = position<2>(slave, x);
  result = {};
  clear_block(block);
  const PointPenalty penalty = point_penalty(pair, i);
  const Vec2 pull = penalty.shear * (point - valley.point);
  const Vec2 traction = hint.multiplier->shear + pull;
  report_valley(pair, x, history, valley, point, traction, result);
  result.weight = facing_weight<2>(pair, out, i, valley.bisector);
  start_constraint(pair, hint, i, block);
  block.constraint.shear = block.constraint.branch_shear = constraint_weight(pair, i) * pull;

  const Placed<2> placed = place_in(valley, pair, point, x);
  set_nodes(block, pair.master, placed, slave, out.block_nodes);
  const Weights<2> w = contact_weights(slave, placed);
  const auto scatter = [&](double factor, Eigen::VectorXd& force) {
    for (int k = 0; k < block.count; ++k)
      force.segment<2>(2 * k) = (factor * w[0][static_cast<std::size_t>(k)]) * traction;
  };
  scatter(result.weight, block.force);
  scatter(result.weight, block.branch_force);
  if (!with_tangent) return;
  set_tangent(pair, i, w, result.weight, block);
  if (pair.weight != Weight::current_area) return;
  add_area_gradient<2>(pair, out, i, valley.bisector, block.area);
  scatter(side_share(pair), block.area_rows);
}

}  // namespace osculate::pairing
