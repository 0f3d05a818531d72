#include "osculate/pairing/reentrant_edge.hpp"

#include <algorithm>
#include <cmath>

#include "osculate/pairing/point_block.hpp"
#include "osculate/pairing/point_sample.hpp"
#include "osculate/pairing/point_weight.hpp"
#include "osculate/pairing/reentrant_edge_traction.hpp"
#include "osculate/pairing/reentrant_state.hpp"
#include "osculate/pairing/report.hpp"

namespace osculate::pairing {

using contact::Branch;
using contact::Multiplier;
using contact::PointHistory;
using contact::Status;
using projection::Feature;

namespace {

const ReentrantEdges& edges_in(const PairDefinition<3>& pair) {
  return std::get<ByMultipliers>(pair.enforcement).reentrant_edges;
}

const SharpEdge& edge_of(const PairDefinition<3>& pair, const EdgePlace& place) {
  return edges_in(pair).list[static_cast<std::size_t>(place.edge)];
}

/// The side on which the point has come sliding in this increment; -1: on none.
int side_of_arrival(const PairDefinition<3>& pair, const PointHistory<3>& history,
                    const EdgePlace& place, Points<3> x) {
  if (!pair.friction || !history.active || history.facet < 0 ||
      rests_in_reentrant_edge(pair, history))
    return -1;
  return static_cast<int>(side_of(edge_of(pair, place), place, pair.master, history.facet, x));
}

/// The traction with what friction lets it be along the edge.
Vec3 bounded_traction(const PairDefinition<3>& pair, const PointHistory<3>& history,
                      const EdgePlace& place, const Vec3& carried, const PointContext<3>& context,
                      Points<3> x) {
  const double along = carried.dot(place.tangent);
  const Vec3 across = carried - along * place.tangent;
  if (!pair.friction) return across;
  std::array<double, 2> normal = normal_parts(place, carried);
  for (double& part : normal) part = std::min(part, 0.0);
  const contact::FrictionLaw law = friction_law(pair, normal[0] + normal[1], context);
  const double predictor =
      along + contact::stiffness(law) * way_along(pair, place, history, x).along;
  const EdgeFriction friction =
      friction_of_both(law, predictor, normal, sliding_of(history, context));
  return across + friction.value * place.tangent;
}

/// The side (0 or 1) on which the traction leaves the edge; -1: it is held.
int side_left(const PairDefinition<3>& pair, const PointHistory<3>& history, const EdgePlace& place,
              const Vec3& traction, const PointContext<3>& context, Points<3> x) {
  return left_side<3>(
      traction, place.normal, place.away, side_of_arrival(pair, history, place, x), [&](int k) {
        const auto s = static_cast<std::size_t>(k);
        const Vec2 shear(traction.dot(place.away[s]), traction.dot(place.tangent));
        return slides_on_facet<3>(pair, history, traction.dot(place.normal[s]), shear, context);
      });
}

/// The traction of the edge as a facet with this normal takes it.
void take_to(const Vec3& normal, Multiplier<3>& taken) {
  taken.normal = taken.shear.dot(normal);
  taken.shear -= taken.normal * normal;
}

/// The traction of a facet as the edge takes it. Without friction its part along the edge has no
/// meaning, and is chosen as the constraint wants it (`edge_axis`).
void take_into(const PairDefinition<3>& pair, const EdgePlace& place, const Vec3& normal,
               Multiplier<3>& taken) {
  taken.shear += taken.normal * normal;
  taken.normal = 0;
  if (pair.friction) return;
  const Vec3 axis = edge_axis(place);
  taken.shear -= taken.shear.dot(axis) / place.tangent.dot(axis) * place.tangent;
}

/// A point that was in the edge stays, or goes to a facet with its traction.
std::optional<EdgePlace> stay_or_leave(const PairDefinition<3>& pair, Points<3> x,
                                       const PointHistory<3>& history, std::size_t i,
                                       const StateBefore<3>& before, const PairEvaluation<3>& work,
                                       const PointContext<3>& context, Multiplier<3>& taken,
                                       ProjectedPoint<3>& projected) {
  const std::optional<EdgeLocation> last =
      location_on_edge(edges_in(pair), pair.master, before.facet, before.xi);
  if (!last) return std::nullopt;
  const Vec3 point = position<3>(pair.slave.points[i], x);
  const EdgePlace place = follow_edge(edges_in(pair), pair.master, last->edge, x, point);
  const auto leave = [&](const Vec3& normal) {
    if (!pair.friction) taken.shear -= taken.shear.dot(place.tangent) * place.tangent;
    take_to(normal, taken);
  };
  if (place.beyond) {
    leave(projected.kinematics.normal);
    return std::nullopt;
  }
  const Vec3 offset = point - place.point;
  const Vec3 traction = bounded_traction(
      pair, history, place, taken.shear + point_penalty(pair, i).shear * offset, context, x);
  const int left = context.predict ? -1 : side_left(pair, history, place, traction, context, x);
  if (left < 0 && !too_deep<3>(pair, place.normal, offset)) return place;
  const auto side = static_cast<std::size_t>(std::max(left, 0));
  leave(place.normal[side]);
  projected = project_point<3>(pair, work, x, i, history, edge_of(pair, place).facets[side]);
  return std::nullopt;
}

/// Whether the closest place of the master is on the edge, and not in a facet beside it.
bool is_on_edge(const PairDefinition<3>& pair, const ProjectedPoint<3>& projected,
                const EdgePlace& place) {
  constexpr double rounding = 1e-6;
  const Feature feature = projected.projection.feature;
  return (feature == Feature::edge || feature == Feature::corner) &&
         (projected.foot - place.point).norm() <= rounding * place.first.norm() &&
         location_on_edge(edges_in(pair), pair.master, edge_of(pair, place).facets[0],
                          edge_xi(edge_of(pair, place), 0, place.s));
}

/// Whether an edge is one of the facet, or begins or ends at it.
bool touches(const SurfaceFacet& facet, const SharpEdge& edge) {
  const auto is_end = [&](Index node) { return node == edge.nodes[0] || node == edge.nodes[1]; };
  return std::any_of(facet.nodes.begin(), facet.nodes.begin() + facet.count, is_end);
}

/// A point that was pressed on a facet, and is placed beside it: in the edge if it has come into
/// the facet behind it as well, else still on its own, unless that lets it go.
std::optional<EdgePlace> come_or_keep(const PairDefinition<3>& pair, Points<3> x,
                                      const PointHistory<3>& history, std::size_t i, Index facet,
                                      const PairEvaluation<3>& work, Multiplier<3>& taken,
                                      ProjectedPoint<3>& projected) {
  const Projection<3>& p = projected.projection;
  if (p.facet == facet && p.feature == Feature::face) return std::nullopt;
  const Vec3 point = position<3>(pair.slave.points[i], x);
  const std::optional<EdgePlace> place =
      edge_between(edges_in(pair), pair.master, {facet, p.facet}, x, point);
  if (!place || place->beyond) return std::nullopt;
  const SharpEdge& edge = edge_of(pair, *place);
  for (const Index f : {facet, p.facet})  // it lies between them
    if (!touches(pair.master.facets[static_cast<std::size_t>(f)], edge)) return std::nullopt;
  const std::size_t from = side_of(edge, *place, pair.master, facet, x);
  const bool on_edge = is_on_edge(pair, projected, *place);
  if (!on_edge &&
      (p.feature != Feature::face || side_of(edge, *place, pair.master, p.facet, x) == from))
    return std::nullopt;
  const Vec3 offset = point - place->point;
  if (too_deep<3>(pair, place->normal, offset)) return std::nullopt;
  if (taken.normal + point_penalty(pair, i).normal * offset.dot(place->normal[from]) > 0) {
    taken = {};  // let go: nothing of it belongs to the other facet
    return std::nullopt;
  }
  if (!on_edge && offset.dot(place->normal[1 - from]) >= 0) {
    projected = project_point<3>(pair, work, x, i, history, edge.facets[from]);
    return std::nullopt;
  }
  take_into(pair, *place, place->normal[from], taken);
  return place;
}

/// A point that was open is in the edge if that is its place.
std::optional<EdgePlace> come_from_outside(const PairDefinition<3>& pair, Points<3> x,
                                           std::size_t i, const ProjectedPoint<3>& projected,
                                           Multiplier<3>& taken) {
  const Projection<3>& p = projected.projection;
  if (p.feature == Feature::face || !(projected.kinematics.gap <= 0) ||
      -projected.kinematics.gap > pair.depth)
    return std::nullopt;
  const std::optional<EdgePlace> place = edge_between(
      edges_in(pair), pair.master, {p.facet, p.facet}, x, position<3>(pair.slave.points[i], x));
  if (!place || place->beyond || !is_on_edge(pair, projected, *place)) return std::nullopt;
  take_into(pair, *place, place->bisector, taken);
  return place;
}

}  // namespace

bool rests_in_reentrant_edge(const PairDefinition<3>& pair, const PointHistory<3>& history) {
  return has_reentrant_vertices(pair) && history.facet >= 0 && history.feature != Feature::face &&
         history.feature != Feature::none &&
         location_on_edge(edges_in(pair), pair.master, history.facet, history.xi).has_value();
}

std::optional<EdgePlace> find_reentrant_edge(const PairDefinition<3>& pair, Points<3> x,
                                             const PointHistory<3>& history, std::size_t i,
                                             const PairEvaluation<3>& work, Multiplier<3>& taken,
                                             PointContext<3>& context,
                                             ProjectedPoint<3>& projected) {
  taken = *context.multiplier;
  context.multiplier = &taken;
  if (projected.projection.feature == Feature::none) return std::nullopt;
  if (context.active.kept() >= 0) {
    if (context.active.branch == Branch::reentrant) take_to(projected.kinematics.normal, taken);
    return std::nullopt;
  }
  const StateBefore<3> before =
      state_before<3>(history, context, [&] { return rests_in_reentrant_edge(pair, history); });
  constexpr double none = 1e-6;  // what was in an edge has no multiplier along a normal
  const bool of_facet =
      (context.predict || !context.known) && std::abs(taken.normal) > none * taken.shear.norm();
  if (before.reentrant && !of_facet)
    return stay_or_leave(pair, x, history, i, before, work, context, taken, projected);
  if (before.facet >= 0)
    return come_or_keep(pair, x, history, i, before.facet, work, taken, projected);
  return come_from_outside(pair, x, i, projected, taken);
}

ActiveBranch<3> predicted_in_edge(const PairDefinition<3>& pair, const PointHistory<3>& history,
                                  Points<3> x, Prediction friction) {
  ActiveBranch<3> branch{Branch::reentrant, Vec3::Zero()};
  branch.facet = history.facet;
  branch.xi = history.xi;
  const std::optional<EdgeLocation> at =
      location_on_edge(edges_in(pair), pair.master, history.facet, history.xi);
  if (!at || !history.slipping || friction == Prediction::sticking) return branch;
  const SharpEdge& edge = edges_in(pair).list[static_cast<std::size_t>(at->edge)];
  branch.direction =
      (history.traction[0] > 0 ? 1.0 : -1.0) * edge_derivative(edge, 1, at->s, x).normalized();
  return branch;
}

namespace {

ContactSample<3> sample_in(const PairDefinition<3>& pair, const EdgePlace& place,
                           const Vec3& offset) {
  const SharpEdge& edge = edge_of(pair, place);
  ContactSample<3> sample;
  sample.facet = edge.facets[0];
  sample.feature = Feature::edge;
  sample.xi = edge_xi(edge, 0, place.s);
  sample.gap = std::min(offset.dot(place.normal[0]), offset.dot(place.normal[1]));
  sample.foot = place.point;
  sample.normal = place.bisector;
  sample.frame = contact::tangent_frame<3>(place.bisector, place.tangent);
  return sample;
}

Response<3> response_in(const ContactSample<3>& sample, const EdgeTraction& t,
                        const PairDefinition<3>& pair, const PointHistory<3>& history,
                        const PointContext<3>& context) {
  Response<3> r;
  r.traction.normal = {true, t.lawful.dot(sample.normal), 0};
  r.law.status = t.status;
  r.law.traction = sample.frame.transpose() * t.lawful;
  r.traction.tangential.traction = sample.frame.transpose() * t.f[0];
  r.has_shear = true;
  r.slip = {t.way.along, t.way.across};
  r.slid = t.slid + t.way.across;
  r.dissipated = t.dissipated;
  if (pair.friction)
    r.memory = contact::remembered(friction_law(pair, r.traction.normal.traction, context), r.slid,
                                   sliding_of(history, context));
  return r;
}

/// Node shape functions of a block: by slot of `EdgeTraction` and node. Nodes are the slave's, the
/// edge's and, with friction, the others of both facets.
struct EdgeWeights {
  static constexpr int most = max_slave_nodes<3> + 2 * max_master_nodes<3>;
  std::array<std::array<double, most>, 6> value{};

  [[nodiscard]] double operator()(std::size_t slot, int k) const {
    return value[slot][static_cast<std::size_t>(k)];
  }
};

/// Number of a node in the block; it is added if it is not there.
std::size_t number_of(Index node, ContactBlock<3>& block) {
  int k = block.slave_count;
  while (k < block.count && block.nodes[static_cast<std::size_t>(k)] != node) ++k;
  if (k == block.count) block.nodes[static_cast<std::size_t>(block.count++)] = node;
  return static_cast<std::size_t>(k);
}

EdgeWeights set_weights(const PairDefinition<3>& pair, const EdgePlace& place, std::size_t i,
                        ContactBlock<3>& block) {
  const SharpEdge& edge = edge_of(pair, place);
  const SlavePoint<3>& slave = pair.slave.points[i];
  const auto first = static_cast<std::size_t>(slave.count);
  set_nodes<3>(std::span(slave.nodes).first(first),
               std::span(edge.nodes).first(static_cast<std::size_t>(edge.count)), block);
  EdgeWeights w;
  std::copy_n(slave.shape.begin(), first, w.value[0].begin());
  const cell::LineShape shape = cell::lagrange_line(edge.count, place.s);
  for (std::size_t k = 0; k < static_cast<std::size_t>(edge.count); ++k) {
    w.value[0][first + k] = -shape.n[0][k];
    w.value[1][first + k] = shape.n[1][k];
    if (!pair.friction) w.value[2][first + k] = shape.n[2][k];
  }
  if (!pair.friction) return w;
  for (const std::size_t side : {0u, 1u}) {
    const SurfaceFacet& facet = pair.master.facets[static_cast<std::size_t>(edge.facets[side])];
    const cell::FacetShape of = cell::facet_shape(facet.type, edge_xi(edge, side, place.s), 1);
    for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k) {
      const std::size_t n = number_of(facet.nodes[k], block);
      for (const std::size_t d : {0u, 1u}) w.value[2 + 2 * side + d][n] = of.n[1 + d][k];
    }
  }
  return w;
}

/// The derivatives of the way along the edge by the nodes of the present and the last place, each
/// as the first row of a matrix.
void set_path(const PairDefinition<3>& pair, const EdgePlace& place, const PointHistory<3>& history,
              const EdgeTraction& t, ContactBlock<3>& block) {
  std::vector<NodeMatrix<3>>& path = block.behind.path;
  if (!pair.friction || !t.way.known) return;
  const auto add = [&](Index node, const Vec3& gradient) {
    Mat<3, 3> row = Mat<3, 3>::Zero();
    row.row(0) = gradient.transpose();
    path.push_back({node, row});
  };
  const SharpEdge& edge = edge_of(pair, place);
  const cell::LineShape here = cell::lagrange_line(edge.count, place.s);
  for (std::size_t k = 0; k < static_cast<std::size_t>(edge.count); ++k)
    add(edge.nodes[k], here.n[0][k] * t.way_of_chord);
  const SurfaceFacet& old = pair.master.facets[static_cast<std::size_t>(history.facet)];
  const cell::FacetShape there = facet_shape(old, history.xi);
  for (std::size_t k = 0; k < static_cast<std::size_t>(old.count); ++k)
    add(old.nodes[k], -there.n[0][k] * t.way_of_chord);
  if (!t.way.from) return;
  const SharpEdge& last = edges_in(pair).list[static_cast<std::size_t>(t.way.from->edge)];
  const cell::LineShape run = cell::lagrange_line(last.count, t.way.from->s);
  const double sign = t.way.turned ? -1 : 1;
  for (std::size_t k = 0; k < static_cast<std::size_t>(last.count); ++k)
    add(last.nodes[k], sign * run.n[1][k] * t.way_of_last);
}

/// Derivatives of the forces; the place moves with the point, and the weights with it.
void set_tangent(const EdgeTraction& t, const EdgeWeights& w, double weight,
                 ContactBlock<3>& block) {
  contact::PointTerms<3> terms;
  for (auto& row : terms.m) row.fill(Mat<3, 3>::Zero());
  for (auto& s : terms.s) s.setZero();
  for (std::size_t b = 0; b < 6; ++b) {
    terms.m[0][b] = t.of_slot[0][b];
    terms.m[1][b] = t.of_slot[1][b] - t.f[0] * t.d_place[b].transpose();
    if (!t.f[1].isZero(0)) terms.m[2][b] = t.f[1] * t.d_place[b].transpose();
  }
  terms.s[0].col(0) = t.of_way;
  scatter_tangent<3>(terms, block.count, w, weight, block.tangent);
  scatter_path<3>(terms.s, w, weight, block);
}

/// Derivatives of the constraint and by the multipliers; the normal multiplier vanishes.
void set_constraint_tangent(const EdgeTraction& t, const EdgeWeights& w, double spring, double area,
                            double weight, ContactBlock<3>& block) {
  ConstraintBlock<3>& c = block.constraint;
  if (c.columns.rows() < 3 * block.count) c.columns.resize(3 * block.count, 4);
  for (int k = 0; k < block.count; ++k) {
    Mat<3, 3> row = Mat<3, 3>::Zero();
    for (std::size_t b = 0; b < 6; ++b) row += w(b, k) * t.constraint_of_slot[b];
    c.shear_row.push_back({block.nodes[static_cast<std::size_t>(k)], area * row});
    auto rows = c.columns.middleRows<3>(3 * k);
    rows.col(0).setZero();
    rows.rightCols<3>() =
        weight * spring * (w(0, k) * t.of_multiplier[0] + w(1, k) * t.of_multiplier[1]);
  }
  for (const NodeMatrix<3>& g : block.path())
    c.shear_row.push_back({g.node, area * t.of_way * g.value.row(0)});
  c.own.setZero();
  c.own(0, 0) = -c.scale[0];
  c.own.bottomRightCorner<3, 3>() = area * spring * t.constraint_of_multiplier;
}

}  // namespace

void evaluate_reentrant_edge(const PairDefinition<3>& pair, Points<3> x,
                             const PointHistory<3>& history, const EdgePlace& place,
                             const PointContext<3>& context, bool with_tangent, std::size_t i,
                             PairEvaluation<3>& out) {
  PointResult<3>& result = out.points[i];
  ContactBlock<3>& block = out.blocks[i];
  const Vec3 point = position<3>(pair.slave.points[i], x);
  const double spring = point_penalty(pair, i).shear, area = constraint_weight(pair, i);
  const EdgeTraction t =
      edge_traction(pair, place, point, context.multiplier->shear, spring, history, context, x);
  const ContactSample<3> sample = sample_in(pair, place, point - place.point);
  const Response<3> r = response_in(sample, t, pair, history, context);
  result = open_result(history, facing_weight<3>(pair, out, i, place.bisector));
  report_sample(sample, 0, result);
  report_normal(r.traction.normal, history.damping_work, result);
  report_contact(r, r.law.traction, history, result);
  result.branch = {Branch::reentrant, Vec3::Zero()};
  if (t.slides && t.f[0].dot(place.tangent) != 0)
    result.branch.direction = (t.f[0].dot(place.tangent) > 0 ? 1.0 : -1.0) * place.tangent;

  clear_block(block);
  start_constraint(pair, context, i, block);
  block.constraint.shear = area * t.constraint;
  block.constraint.branch_shear = area * t.branch_constraint;
  block.reserve(out.block_nodes);
  block.reserve_tangent(out.block_nodes);
  const EdgeWeights w = set_weights(pair, place, i, block);
  const std::array<Vec3, 2> lawful{t.lawful, t.f[1]};
  set_forces<3>(
      r, {}, t.f, [&](const auto&) { return lawful; }, w, result.weight, block);
  if (!with_tangent) return;
  set_path(pair, place, history, t, block);
  set_tangent(t, w, result.weight, block);
  set_constraint_tangent(t, w, spring, area, result.weight, block);
  if (pair.weight != Weight::current_area) return;
  add_area_gradient<3>(pair, out, i, place.bisector, block.area);
  block.reserve_area();
  scatter_forces<3>(t.f, block.count, w, pass_factor(pair), block.area_rows);
}

}  // namespace osculate::pairing
