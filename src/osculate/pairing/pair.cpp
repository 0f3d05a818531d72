#include "osculate/pairing/pair.hpp"

#include <cmath>

#include "osculate/core/error.hpp"

namespace osculate::pairing {

using contact::Kinematics;
using contact::PointHistory;
using contact::PointTerms;
using contact::Status;
using contact::Traction;
using projection::Feature;

void prepare(PairDefinition& pair, std::span<const Vec2> reference) {
  nodal_areas(pair.slave, reference, pair.area, pair.reference_areas, nullptr);
  if (pair.weight == Weight::node) return;
  for (const double area : pair.reference_areas)
    if (!(area > 0))
      throw core::GeometryError("a slave node has no positive tributary area; use weight: node");
}

namespace {

struct Placed {
  Projection projection;
  Kinematics kinematics;
  cell::LineShape shape;  ///< of the facet at the foot point (vertices: at the facet's end)
  Vec2 foot{0, 0};
};

Placed place(const PairDefinition& pair, const PairEvaluation& work, std::span<const Vec2> x,
             std::size_t i, const PointHistory& history) {
  ProjectionQuery query;
  query.point = x[static_cast<std::size_t>(pair.slave.nodes[i])];
  if (work.normals[i].squaredNorm() > 0) query.slave_normal = work.normals[i];
  query.history = {history.facet, history.xi};
  Placed placed;
  placed.projection = closest_on_chain(pair.master, work.tree, x, query);
  const Projection& p = placed.projection;
  if (p.feature == Feature::none) return placed;
  const Facet& facet = pair.master.facets[static_cast<std::size_t>(p.location.facet)];
  placed.shape = facet_shape(facet, p.location.xi);
  const geometry::CurveJet<2> jet = facet_jet(facet, placed.shape, x);
  placed.foot = jet.r;
  placed.kinematics = p.feature == Feature::corner
                          ? contact::corner_kinematics(jet.r, query.point, p.outward)
                          : contact::face_kinematics(jet, query.point);
  return placed;
}

/// Part of the increment that a point which was open at its start has spent in contact, assuming
/// a constant approach velocity, and its derivative with respect to the gap.
struct ContactShare {
  double value = 1, d_gap = 0;
};

ContactShare contact_share(const PointHistory& history, double gap) {
  if (history.active || history.facet < 0 || !(history.gap > 0)) return {};
  const double range = history.gap - gap;
  return {-gap / range, -history.gap / (range * range)};
}

struct Friction {
  Traction traction;
  contact::TangentialResponse law;  ///< what the law says; `traction` may be in another branch
  double slip = 0;                  ///< arc length of the increment, times the share in contact
};

/// What is known of a point's branch before the law is asked.
struct BranchHint {
  contact::Branch branch = contact::Branch::none;
  bool predict = false;
};

contact::TangentialResponse linearised_branch(const contact::Coulomb& law,
                                              const contact::TangentialResponse& response,
                                              double trial, double normal, const BranchHint& hint) {
  using contact::Branch;
  const bool slipped = hint.branch == Branch::slip_forward || hint.branch == Branch::slip_backward;
  if (!slipped) return response;
  const double sign = hint.branch == Branch::slip_forward ? 1.0 : -1.0;
  if (hint.predict) return law.slip(sign, normal);
  const bool reversed = response.status == Status::slip && sign * trial < 0;
  return reversed ? contact::Coulomb::stick(trial) : response;
}

contact::Branch branch_of(const contact::TangentialResponse& response) {
  if (response.status == Status::stick) return contact::Branch::stick;
  return response.traction > 0 ? contact::Branch::slip_forward : contact::Branch::slip_backward;
}

/// The trial is KS2D:89 with the length of T kept across borders (docs/errata.md); within one facet
/// of constant metric it is KS2D:74 and, after KS2D:81, the moved centre of KS2D:82.
Friction tractions(const PairDefinition& pair, const PointHistory& history, const Placed& placed,
                   std::span<const Vec2> x, const BranchHint& hint,
                   std::vector<NodeGradient>* path) {
  Friction f;
  f.traction.normal = pair.normal.response(placed.kinematics.gap);
  if (!f.traction.normal.active || !pair.friction) return f;
  const contact::Coulomb& law = *pair.friction;
  const ContactShare share = contact_share(history, placed.kinematics.gap);
  const std::optional<double> arc =
      path_length(pair.master, x, {history.facet, history.xi}, placed.projection.location, path);
  const double length = arc.value_or(0.0);
  const double carried = history.active && arc ? history.traction : 0.0;
  f.slip = share.value * length;
  const double trial = carried + law.stiffness * f.slip;  // @eq KS2D:89, KS2D:74
  f.law = law.response(trial, f.traction.normal.traction);
  f.traction.tangential = linearised_branch(law, f.law, trial, f.traction.normal.traction, hint);
  f.traction.tangential_stiffness = law.stiffness;
  if (arc) {
    f.traction.d_trial_d_slip = law.stiffness * share.value;
    f.traction.d_trial_d_gap = law.stiffness * share.d_gap * length;
  }
  return f;
}

void set_nodes(ContactBlock& block, const Facet& facet, Index slave) {
  block.count = 1 + facet.count;
  block.nodes[0] = slave;
  for (std::size_t k = 0; k < static_cast<std::size_t>(facet.count); ++k)
    block.nodes[k + 1] = facet.nodes[k];
}

/// Contact weights w_k and their derivatives: 1 and 0 for the slave, -N_k, -N_k', -N_k'' for the
/// master (KS2D:60, 61 with two columns per node). At a vertex the foot point does not move.
using Weights = std::array<std::array<double, max_block_nodes>, 3>;

Weights contact_weights(const Placed& placed, int count) {
  Weights w{};
  w[0][0] = 1.0;
  const std::size_t orders = placed.projection.feature == Feature::corner ? 1 : 3;
  for (std::size_t order = 0; order < orders; ++order)
    for (std::size_t k = 1; k < static_cast<std::size_t>(count); ++k)
      w[order][k] = -placed.shape.n[order][k - 1];  // @eq KS2D:60
  return w;
}

void scatter(ContactBlock& block, const Weights& w, const PointTerms& terms, double area,
             bool with_tangent) {
  for (int k = 0; k < block.count; ++k) {
    const auto a = static_cast<std::size_t>(k);
    const Vec2 force = w[0][a] * terms.f0 + w[1][a] * terms.f1;
    block.force.segment<2>(2 * k) = area * force;
    if (!with_tangent) continue;
    block.area_rows.segment<2>(2 * k) = force;
    block.path_rows.segment<2>(2 * k) = area * (w[0][a] * terms.s0 + w[1][a] * terms.s1);
    std::array<Mat<2, 2>, 3> row;
    for (std::size_t c = 0; c < 3; ++c)
      row[c] = area * (w[0][a] * terms.m[0][c] + w[1][a] * terms.m[1][c] + w[2][a] * terms.m[2][c]);
    for (int l = 0; l < block.count; ++l) {
      const auto b = static_cast<std::size_t>(l);
      block.tangent.block<2, 2>(2 * k, 2 * l) =
          w[0][b] * row[0] + w[1][b] * row[1] + w[2][b] * row[2];
    }
  }
}

PointHistory next_history(const PointHistory& old, const Placed& placed, const Friction& f) {
  PointHistory h;
  h.facet = placed.projection.location.facet;
  h.feature = placed.projection.feature;
  h.xi = placed.projection.location.xi;
  h.gap = placed.kinematics.gap;
  h.active = f.traction.normal.active;
  if (!h.active) return h;
  h.traction = f.law.traction;
  h.slipping = f.law.status == Status::slip;
  h.slip = (old.active ? old.slip : 0.0) + f.slip;
  return h;
}

double point_weight(const PairDefinition& pair, const PairEvaluation& work, std::size_t i) {
  switch (pair.weight) {
    case Weight::node:
      return 1.0;
    case Weight::reference_area:
      return pair.reference_areas[i];
    case Weight::current_area:
      return work.areas[i];
  }
  return 1.0;
}

void evaluate_point(const PairDefinition& pair, std::span<const Vec2> x,
                    const PointHistory& history, const BranchHint& hint, bool with_tangent,
                    std::size_t i, PairEvaluation& out) {
  PointResult& result = out.points[i];
  ContactBlock& block = out.blocks[i];
  result = {};
  block.count = 0;
  block.path.clear();
  block.area.clear();
  result.weight = point_weight(pair, out, i);
  result.gap = std::numeric_limits<double>::infinity();
  const Placed placed = place(pair, out, x, i, history);
  if (placed.projection.feature == Feature::none) return;
  const Kinematics& k = placed.kinematics;
  result.gap = k.gap;
  result.foot = placed.foot;
  result.normal = k.normal;
  result.unit_tangent = k.unit_tangent;
  result.history = next_history(history, placed, {});
  if (placed.projection.beyond_end || k.gap < -pair.depth || k.gap > 0) {
    if (placed.projection.beyond_end) result.history.gap = result.gap = std::abs(k.gap);
    return;
  }
  const bool exact = with_tangent && pair.tangent.consistent;
  const Friction f = tractions(pair, history, placed, x, hint, exact ? &block.path : nullptr);
  result.history = next_history(history, placed, f);
  result.status = !pair.friction ? Status::slip : f.law.status;
  result.branch = pair.friction ? branch_of(f.traction.tangential) : contact::Branch::none;
  result.normal_traction = f.traction.normal.traction;
  result.shear_traction = f.law.traction;
  result.slip_increment = f.slip;

  const Facet& facet =
      pair.master.facets[static_cast<std::size_t>(placed.projection.location.facet)];
  set_nodes(block, facet, pair.slave.nodes[i]);
  const Weights w = contact_weights(placed, block.count);
  const PointTerms terms = with_tangent
                               ? contact::point_terms(k, f.traction, pair.residual, pair.tangent)
                               : contact::point_forces(k, f.traction, pair.residual);
  scatter(block, w, terms, result.weight, with_tangent);
  block.branch_force = block.force;
  block.branched = pair.friction && f.law.traction != f.traction.tangential.traction;
  if (block.branched) {
    Traction lawful = f.traction;
    lawful.tangential = f.law;
    scatter(block, w, contact::point_forces(k, lawful, pair.residual), result.weight, false);
  }
  if (exact && pair.weight == Weight::current_area) block.area = out.area_gradients[i];
}

void refresh(const PairDefinition& pair, std::span<const Vec2> x, bool with_tangent,
             PairEvaluation& out) {
  const std::size_t n = pair.slave.nodes.size();
  out.points.resize(n);
  out.blocks.resize(n);
  nodal_normals(pair.slave, x, out.normals);
  if (pair.weight == Weight::current_area)
    nodal_areas(pair.slave, x, pair.area, out.areas, with_tangent ? &out.area_gradients : nullptr);
  const std::size_t before = out.boxes.size();
  facet_boxes(pair.master, x, out.boxes);
  if (before == out.boxes.size() && before > 0)
    out.tree.refit(out.boxes);
  else
    out.tree = Tree(out.boxes);
}

}  // namespace

void evaluate(const PairDefinition& pair, std::span<const Vec2> x, const PairState& committed,
              bool with_tangent, PairEvaluation& out, const Assumed& assumed) {
  refresh(pair, x, with_tangent, out);
  for (std::size_t i = 0; i < pair.slave.nodes.size(); ++i) {
    BranchHint hint;
    if (!assumed.branch.empty()) hint = {assumed.branch[i], assumed.predict};
    evaluate_point(pair, x, committed.points[i], hint, with_tangent, i, out);
  }
}

Assumed committed_branches(const PairState& committed) {
  Assumed assumed;
  assumed.predict = true;
  for (const PointHistory& h : committed.points) {
    contact::Branch branch = contact::Branch::none;
    if (h.active) branch = contact::Branch::stick;
    if (h.active && h.slipping)
      branch = h.traction > 0 ? contact::Branch::slip_forward : contact::Branch::slip_backward;
    assumed.branch.push_back(branch);
  }
  return assumed;
}

Assumed evaluated_branches(const PairEvaluation& evaluation) {
  Assumed assumed;
  for (const PointResult& point : evaluation.points) assumed.branch.push_back(point.branch);
  return assumed;
}

PairState initial_state(const PairDefinition& pair, std::span<const Vec2> x) {
  PairEvaluation work;
  refresh(pair, x, false, work);
  PairState state;
  state.points.resize(pair.slave.nodes.size());
  for (std::size_t i = 0; i < state.points.size(); ++i) {
    const Placed placed = place(pair, work, x, i, {});
    if (placed.projection.feature == Feature::none) continue;
    PointHistory& h = state.points[i];
    h = next_history({}, placed, {});
    if (placed.projection.beyond_end) h.gap = std::abs(h.gap);
    h.active = h.gap <= 0 && h.gap >= -pair.depth;
  }
  return state;
}

PairState commit(const PairEvaluation& evaluation) {
  PairState state;
  state.points.reserve(evaluation.points.size());
  for (const PointResult& point : evaluation.points) state.points.push_back(point.history);
  return state;
}

}  // namespace osculate::pairing
