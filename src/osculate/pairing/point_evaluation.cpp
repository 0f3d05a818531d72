#include "osculate/pairing/point_evaluation.hpp"

#include <algorithm>
#include <cmath>

#include "osculate/pairing/friction_branch.hpp"
#include "osculate/pairing/point_block.hpp"
#include "osculate/pairing/point_weight.hpp"

namespace osculate::pairing {

using contact::Kinematics;
using contact::NormalResponse;
using contact::PointHistory;
using contact::PointTerms;
using contact::Status;
using contact::TangentialResponse;
using contact::Traction;
using projection::Feature;

namespace {

template <int Dim>
struct Friction {
  Traction<Dim> traction;
  TangentialResponse<Dim> law;  ///< what the law says; `traction` may be in another branch
  Vec<Dim - 1> slip = Vec<Dim - 1>::Zero();  ///< of the increment, times the share in contact
  double slid = 0;                           ///< distance, in the increment
  double dissipated = 0;                     ///< per area (or per node) in the increment
};

/// The elastic trial around a multiplier: the slip of the whole increment counts, also that of a
/// point that was open at its start, and what is carried is in the multiplier.
///
/// Formula    d((I - n n^T) t) = -(n . t) d(n) in the tangent plane
template <int Dim>
Trial<Dim> trial_around(const PairDefinition<Dim>& pair, const contact::Multiplier<Dim>& multiplier,
                        double stiffness, PointHistory<Dim> history, const Placed<Dim>& placed,
                        Points<Dim> x, PathBuffers<Dim>* path) {
  history.active = false;
  Trial<Dim> tr =
      trial(pair.master, history, placed, stiffness, ContactShare{}, x, path, pair.history);
  const Kinematics<Dim>& k = placed.kinematics;
  tr.value += k.frame.transpose() * multiplier.shear;
  tr.variation.add(Mat<Dim, Dim>(-k.normal.dot(multiplier.shear) * Mat<Dim, Dim>::Identity()),
                   k.d_normal);
  return tr;
}

template <int Dim>
Friction<Dim> tractions(const PairDefinition<Dim>& pair, const PointHistory<Dim>& history,
                        const Placed<Dim>& placed, Points<Dim> x, const BranchHint<Dim>& hint,
                        PathBuffers<Dim>* path) {
  Friction<Dim> f;
  const Kinematics<Dim>& k = placed.kinematics;
  f.traction.normal = hint.kept ? hint.kept->response : normal_response(pair, history, k.gap, hint);
  if (!f.traction.normal.active || !pair.friction) return f;
  const double normal = f.traction.normal.traction;
  const contact::FrictionLaw law = friction_law(pair, normal, hint);
  const double stiffness = contact::stiffness(law);
  const contact::Sliding sliding = sliding_of(history, hint);
  const double gap = k.gap - (hint.kept ? hint.kept->farther : 0);
  const Trial<Dim> tr =
      hint.multiplier
          ? trial_around<Dim>(pair, *hint.multiplier, stiffness, history, placed, x, path)
          : trial(pair.master, history, placed, stiffness, contact_share(pair, history, gap, hint),
                  x, path, pair.history);
  f.slip = tr.slip;
  f.law = contact::response<Dim>(law, tr.value, normal, sliding);
  f.slid = contact::slid<Dim>(tr.value, f.law, stiffness);
  f.dissipated = contact::dissipated<Dim>(tr.value, f.law, stiffness);
  f.traction.tangential =
      linearised_branch<Dim>(law, f.law, tr.value, normal, k.frame, sliding, hint);
  f.traction.stiffness = stiffness;
  f.traction.d_trial = tr.variation;
  return f;
}

template <int Dim>
void scatter_forces(Eigen::VectorXd& force, int count, const Weights<Dim>& w,
                    const PointTerms<Dim>& terms, double area) {
  for (int k = 0; k < count; ++k) {
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (std::size_t a = 0; a < terms.f.size(); ++a)
      sum += w[a][static_cast<std::size_t>(k)] * terms.f[a];
    force.template segment<Dim>(Dim * k) = area * sum;
  }
}

template <int Dim>
void scatter_path(ContactBlock<Dim>& block, const Weights<Dim>& w, const PointTerms<Dim>& terms,
                  double area) {
  for (int k = 0; k < block.count; ++k) {
    Mat<Dim, Dim> behind = Mat<Dim, Dim>::Zero();
    for (std::size_t a = 0; a < terms.s.size(); ++a)
      behind += w[a][static_cast<std::size_t>(k)] * terms.s[a];
    block.path_rows.template middleRows<Dim>(Dim * k) = area * behind;
  }
}

template <int Dim>
PointHistory<Dim> next_history(const PairDefinition<Dim>& pair, Points<Dim> x,
                               const PointHistory<Dim>& old, const Placed<Dim>& placed,
                               const Friction<Dim>& f) {
  PointHistory<Dim> h;
  h.facet = placed.projection.facet;
  h.feature = placed.projection.feature;
  h.xi = placed.projection.xi;
  h.gap = placed.kinematics.gap;
  h.active = f.traction.normal.active;
  h.friction_work = old.friction_work;
  h.held = old.held;
  h.rest = old.rest;
  if (!h.active) return h;
  h.traction = stored_components(pair.master, placed, f.law.traction, x, pair.history);
  h.slipping = f.law.status == Status::slip;
  h.slip = f.slip;
  h.slid = f.slid;
  if (!old.active) return h;
  h.slip += old.slip;
  h.slid += old.slid;
  return h;
}

/// Where the point is, and what its normal law says; not active where it is not in contact.
template <int Dim>
NormalResponse report_place(const PairDefinition<Dim>& pair, Points<Dim> x,
                            const PointHistory<Dim>& history, const Placed<Dim>& placed,
                            const BranchHint<Dim>& hint, PointResult<Dim>& result) {
  if (placed.projection.feature == Feature::none) return {};
  const Kinematics<Dim>& k = placed.kinematics;
  result.gap = k.gap - pair.offset - hint.relieved;
  result.foot = placed.foot;
  result.normal = k.normal;
  result.frame = k.frame;
  result.history = next_history<Dim>(pair, x, history, placed, {});
  if (placed.projection.beyond_end) result.history.gap = result.gap = std::abs(k.gap);
  if (placed.projection.beyond_end) return {};
  const NormalResponse normal = normal_response(pair, history, k.gap, hint);
  result.outside_domain = normal.active && !contact::inside_domain(k);
  return result.outside_domain ? NormalResponse{} : normal;
}

/// Rows and columns of the multipliers of a point in contact.
template <int Dim>
void set_constraint_tangent(const PairDefinition<Dim>& pair, std::size_t i,
                            const Kinematics<Dim>& k, const Traction<Dim>& t, const Weights<Dim>& w,
                            double weight, ContactBlock<Dim>& block) {
  const PointPenalty penalty = point_penalty(pair, i);
  const double area = constraint_weight(pair, i);
  ConstraintBlock<Dim>& c = block.constraint;
  const contact::ShearRate<Dim> rate = contact::shear_rate(k, t);
  for (std::size_t n = 0; n < static_cast<std::size_t>(block.count); ++n) {
    Vec<Dim> gap = Vec<Dim>::Zero();
    Mat<Dim, Dim> along = Mat<Dim, Dim>::Zero();
    for (std::size_t s = 0; s < contact::slots<Dim>; ++s) {
      gap += w[s][n] * k.d_gap[s];
      along += w[s][n] * rate.variation[s];
    }
    c.normal_row.push_back({block.nodes[n], area * penalty.normal * gap});
    if (pair.friction) c.shear_row.push_back({block.nodes[n], area * along});
  }
  for (const NodeMatrix<Dim>& g : block.path())
    c.shear_row.push_back({g.node, area * rate.d_trial * g.value});
  set_multiplier_terms<Dim>(
      penalty, area, k.normal, rate.d_trial, rate.d_push,
      [&](int n) { return weight * w[0][static_cast<std::size_t>(n)]; }, block);
}

/// What is reported of a point in contact.
template <int Dim>
void report_contact(const PairDefinition<Dim>& pair, Points<Dim> x,
                    const PointHistory<Dim>& history, const Placed<Dim>& placed,
                    const BranchHint<Dim>& hint, const Friction<Dim>& f, PointResult<Dim>& result) {
  result.history = next_history(pair, x, history, placed, f);
  result.history.friction_work += result.weight * f.dissipated;
  report_normal(f.traction.normal, history.damping_work, result);
  result.status = !pair.friction ? Status::slip : f.law.status;
  result.branch.branch = contact::Branch::slip;
  if (pair.friction) result.branch = branch_of<Dim>(f.traction.tangential, placed.kinematics.frame);
  if (pair.friction && !hint.multiplier)
    result.stored += 0.5 * f.law.traction.squaredNorm() / f.traction.stiffness;
  result.normal_traction = f.traction.normal.traction;
  result.shear_traction = f.law.traction;
  result.slip_increment = f.slip;
}

/// What is remembered of an open point that is linearised in contact.
template <int Dim>
void report_kept(const PairDefinition<Dim>& pair, const Placed<Dim>& placed,
                 const BranchHint<Dim>& hint, const Friction<Dim>& f, PointResult<Dim>& result) {
  result.branch.branch = contact::Branch::slip;
  if (pair.friction) result.branch = branch_of<Dim>(f.traction.tangential, placed.kinematics.frame);
  result.branch.closed = true;
  result.branch.kept_on = hint.assumed.kept_on + 1;
}

/// The tractions at the linearised gap, continued along their tangent to the present gap.
template <int Dim>
Traction<Dim> pulled(Traction<Dim> t, const KeptContact& kept) {
  const double more = t.normal.d_traction * kept.farther;
  t.normal.traction += more;
  t.tangential.traction += more * t.tangential.d_normal;
  return t;
}

/// The forces of a point in contact, and those of the branch that it is linearised in.
template <int Dim>
void set_forces(const PairDefinition<Dim>& pair, const Kinematics<Dim>& k, const Friction<Dim>& f,
                const BranchHint<Dim>& hint, const Weights<Dim>& w, const PointTerms<Dim>& terms,
                double weight, ContactBlock<Dim>& block) {
  scatter_forces(block.branch_force, block.count, w, terms, weight);
  block.force = block.branch_force;
  block.branched = pair.friction && f.law.traction != f.traction.tangential.traction;
  if (hint.kept) {
    block.branched = true;
    block.force.head(Dim * block.count).setZero();
    scatter_forces(block.branch_force, block.count, w,
                   contact::point_forces(k, pulled(f.traction, *hint.kept), pair.residual), weight);
  } else if (block.branched) {
    Traction<Dim> lawful = f.traction;
    lawful.tangential = f.law;
    scatter_forces(block.force, block.count, w, contact::point_forces(k, lawful, pair.residual),
                   weight);
  }
}

template <int Dim>
void set_kept_constraint(const PairDefinition<Dim>& pair, std::size_t i, const Friction<Dim>& f,
                         const BranchHint<Dim>& hint, const Mat<Dim, Dim - 1>& frame,
                         ConstraintBlock<Dim>& c) {
  const Traction<Dim> t = pulled(f.traction, *hint.kept);
  const double area = constraint_weight(pair, i);
  set_constraint_values<Dim>(area, t.normal.traction, frame * t.tangential.traction,
                             frame * t.tangential.traction, *hint.multiplier, c);
  c.normal = -area * hint.multiplier->normal;
  c.shear = -area * hint.multiplier->shear;
}

}  // namespace

template <int Dim>
void evaluate_point(const PairDefinition<Dim>& pair, Points<Dim> x,
                    const PointHistory<Dim>& history, const Placed<Dim>& placed,
                    const BranchHint<Dim>& hint, bool with_tangent, std::size_t i,
                    PairEvaluation<Dim>& out) {
  PointResult<Dim>& result = out.points[i];
  ContactBlock<Dim>& block = out.blocks[i];
  result = {};
  clear_block(block);
  result.weight = point_weight(pair, out, i);
  result.history.friction_work = history.friction_work;
  result.history.damping_work = history.damping_work;
  result.history.held = history.held;
  result.history.rest = history.rest;
  result.gap = std::numeric_limits<double>::infinity();
  const bool constrained = start_constraint(pair, hint, i, block);
  const NormalResponse normal = report_place(pair, x, history, placed, hint, result);
  const Kinematics<Dim>& k = placed.kinematics;
  if (normal.active || normal.stored > 0)
    result.weight = facing_weight<Dim>(pair, out, i, k.normal);
  report_normal(normal, history.damping_work, result);
  if (!normal.active && !hint.kept) return;
  const bool exact = with_tangent && pair.tangent.consistent;
  const Friction<Dim> f =
      tractions<Dim>(pair, history, placed, x, hint, exact ? &block.behind : nullptr);
  if (hint.kept)
    report_kept(pair, placed, hint, f, result);
  else
    report_contact(pair, x, history, placed, hint, f, result);

  const SlavePoint<Dim>& slave = pair.slave.points[i];
  set_nodes(block, pair.master, placed, slave, out.block_nodes);
  const Weights<Dim> w = contact_weights(slave, placed);
  const PointTerms<Dim> terms =
      with_tangent ? contact::point_terms(k, f.traction, pair.residual, pair.tangent)
                   : contact::point_forces(k, f.traction, pair.residual);
  set_forces(pair, k, f, hint, w, terms, result.weight, block);
  if (constrained)
    set_constraint_values<Dim>(constraint_weight(pair, i), result.normal_traction,
                               k.frame * f.law.traction, k.frame * f.traction.tangential.traction,
                               *hint.multiplier, block.constraint);
  if (constrained && hint.kept) set_kept_constraint(pair, i, f, hint, k.frame, block.constraint);
  if (!with_tangent) return;
  if (constrained) set_constraint_tangent<Dim>(pair, i, k, f.traction, w, result.weight, block);
  scatter_tangent<Dim>(w, terms, block.count, result.weight, block.tangent);
  scatter_path(block, w, terms, result.weight);
  if (!exact || pair.weight != Weight::current_area) return;
  add_area_gradient<Dim>(pair, out, i, k.normal, block.area);
  scatter_forces(block.area_rows, block.count, w, terms, side_share(pair));
}

template <int Dim>
void report_far(const PairDefinition<Dim>& pair, Points<Dim> x, const PointHistory<Dim>& history,
                const Placed<Dim>& placed, std::size_t i, PairEvaluation<Dim>& out) {
  const NormalResponse none = report_place(pair, x, history, placed, {}, out.points[i]);
  report_normal(none, history.damping_work, out.points[i]);
}

template <int Dim>
PointHistory<Dim> history_at(const PairDefinition<Dim>& pair, Points<Dim> x,
                             const Placed<Dim>& placed) {
  return next_history<Dim>(pair, x, {}, placed, {});
}

template void evaluate_point<2>(const PairDefinition<2>&, Points<2>, const PointHistory<2>&,
                                const Placed<2>&, const BranchHint<2>&, bool, std::size_t,
                                PairEvaluation<2>&);
template void evaluate_point<3>(const PairDefinition<3>&, Points<3>, const PointHistory<3>&,
                                const Placed<3>&, const BranchHint<3>&, bool, std::size_t,
                                PairEvaluation<3>&);
template void report_far<2>(const PairDefinition<2>&, Points<2>, const PointHistory<2>&,
                            const Placed<2>&, std::size_t, PairEvaluation<2>&);
template void report_far<3>(const PairDefinition<3>&, Points<3>, const PointHistory<3>&,
                            const Placed<3>&, std::size_t, PairEvaluation<3>&);
template PointHistory<2> history_at<2>(const PairDefinition<2>&, Points<2>, const Placed<2>&);
template PointHistory<3> history_at<3>(const PairDefinition<3>&, Points<3>, const Placed<3>&);

}  // namespace osculate::pairing
