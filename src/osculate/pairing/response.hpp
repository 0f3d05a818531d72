#pragma once
// Law, enforcement and active set at a contact sample; for sources of this layer.
#include <algorithm>
#include <cmath>

#include "osculate/pairing/point_context.hpp"
#include "osculate/pairing/sample.hpp"

namespace osculate::pairing {

/// Whether a point stays in contact whatever pulls at it.
template <int Dim>
[[nodiscard]] bool is_held(const PairDefinition<Dim>& pair,
                           const contact::PointHistory<Dim>& history) {
  if (pair.separation == Separation::no_separation) return history.active;
  return pair.separation == Separation::tied_normal && history.held;
}

/// The gap at which the normal law begins to count: half thicknesses, what a held point keeps, and
/// the initial overlap that does not count.
template <int Dim>
[[nodiscard]] double rest_gap(const PairDefinition<Dim>& pair,
                              const contact::PointHistory<Dim>& history,
                              const BranchHint<Dim>& hint) {
  return pair.offset + history.rest + hint.relieved;
}

/// At the start: holds a point that is near the master.
template <int Dim>
void hold(const PairDefinition<Dim>& pair, contact::PointHistory<Dim>& history) {
  if (pair.separation != Separation::tied_normal) return;
  const double gap = history.gap - pair.offset;
  history.held = std::abs(gap) <= pair.tolerance;
  if (history.held) history.rest = gap;
}

/// The way of the gap over the same facet since the last converged state, where it is asked for.
template <int Dim>
[[nodiscard]] double way_of_gap(const PairDefinition<Dim>& pair, const Assumed<Dim>& assumed,
                                const contact::PointHistory<Dim>& history, Index facet,
                                double gap) {
  const bool asked = assumed.mean_onset && !pair.damping && history.facet >= 0;
  return asked && history.facet == facet ? std::abs(gap - history.gap) : 0.0;
}

/// Whether the normal law gives a traction at this gap.
template <int Dim>
[[nodiscard]] bool is_closed(const PairDefinition<Dim>& pair,
                             const contact::PointHistory<Dim>& history, double gap,
                             const BranchHint<Dim>& hint = {}) {
  if (gap < -pair.depth) return false;
  if (is_held(pair, history)) return true;
  return pair.separation != Separation::tied_normal &&
         gap - pair.offset - hint.relieved - 0.5 * hint.way <= contact::reach(pair.normal);
}

/// What a law of damping may ask.
template <int Dim>
[[nodiscard]] contact::Closing closing_of(const PairDefinition<Dim>& pair,
                                          const contact::PointHistory<Dim>& history,
                                          const BranchHint<Dim>& hint) {
  return {history.gap - rest_gap(pair, history, hint), history.deepest,
          history.facet >= 0 ? hint.duration : 0.0};
}

/// A normal law with its damping, around the multiplier where there is one.
template <int Dim>
[[nodiscard]] contact::NormalResponse response_of(const contact::NormalLaw& law,
                                                  const PairDefinition<Dim>& pair,
                                                  const contact::PointHistory<Dim>& history,
                                                  double gap, const BranchHint<Dim>& hint) {
  const bool held = is_held(pair, history);
  const double of_law = gap - rest_gap(pair, history, hint);
  contact::NormalResponse r;
  if (hint.multiplier) {
    if (gap < -pair.depth || (pair.separation == Separation::tied_normal && !held)) return {};
    r = contact::shifted(hint.stiffening * contact::penalty_of(law), of_law,
                         hint.multiplier->normal, held);
    if (r.active && pair.enforcement == contact::Enforcement::augmented_lagrange)
      r.stored = contact::stored_energy(law, of_law, true);
    return r;
  }
  if (!is_closed(pair, history, gap, hint)) return {};
  if (pair.damping)
    return contact::damped(*pair.damping, law, of_law, closing_of(pair, history, hint));
  const bool passes = !held && std::abs(of_law - contact::reach(law)) < 0.5 * hint.way;
  r = passes ? contact::mean_response(law, of_law, hint.way) : contact::response(law, of_law, held);
  r.stored = contact::stored_energy(law, of_law, held);
  return r;
}

/// The answer of the point's normal law: the pair's, with the penalty of the point. (Around a
/// multiplier the stiffening comes with it.)
template <int Dim>
[[nodiscard]] contact::NormalResponse normal_response(const PairDefinition<Dim>& pair,
                                                      const contact::PointHistory<Dim>& history,
                                                      double gap, const BranchHint<Dim>& hint) {
  const double factor = hint.own.normal * (hint.multiplier ? 1 : hint.stiffening);
  if (factor == 1) return response_of(pair.normal, pair, history, gap, hint);
  return response_of(pair.normal.stiffened(factor), pair, history, gap, hint);
}

/// The part in contact of a point that was open at the start of the increment (`history`).
template <int Dim>
[[nodiscard]] ContactShare contact_share(const PairDefinition<Dim>& pair,
                                         const contact::PointHistory<Dim>& history, double gap,
                                         const BranchHint<Dim>& hint) {
  const double onset = rest_gap(pair, history, hint) + contact::reach(pair.normal) + 0.5 * hint.way;
  if (history.active || history.facet < 0 || !(history.gap > onset)) return {};
  const double range = history.gap - gap;
  return {(onset - gap) / range, -(history.gap - onset) / (range * range)};
}

/// What the friction law may ask beside the tractions.
template <int Dim>
[[nodiscard]] contact::Sliding sliding_of(const contact::PointHistory<Dim>& history,
                                          const BranchHint<Dim>& hint) {
  return {history.active ? history.slid : 0.0, hint.duration};
}

/// The friction law with the stiffness it has in this evaluation.
template <int Dim>
[[nodiscard]] contact::FrictionLaw friction_law(const PairDefinition<Dim>& pair,
                                                double normal_traction,
                                                const BranchHint<Dim>& hint) {
  const double stiffening = hint.multiplier ? hint.stiffening : 1;
  const contact::FrictionLaw law = pair.friction->stiffened(stiffening * hint.own.shear);
  if (!hint.multiplier) return law;
  return law.stiffened(contact::steadying(law, normal_traction, hint.duration));
}

/// The law's answer, or the branch that the hint keeps it in.
template <int Dim>
[[nodiscard]] contact::TangentialResponse<Dim> linearised_branch(
    const contact::FrictionLaw& law, const contact::TangentialResponse<Dim>& response,
    const Vec<Dim - 1>& trial, double normal, const Mat<Dim, Dim - 1>& frame,
    const contact::Sliding& sliding, const BranchHint<Dim>& hint) {
  if (hint.predict && hint.assumed.branch == contact::Branch::stick)
    return contact::stick_response<Dim>(trial);  // also on the limit, whatever round-off says
  if (hint.assumed.branch != contact::Branch::slip) return response;
  const Vec<Dim - 1> before = frame.transpose() * hint.assumed.direction;
  const double size = before.norm();
  if (!(size > 0) && hint.predict)  // slides whichever way it likes
    return contact::slip_response<Dim>(Vec<Dim - 1>::Zero(), 0, {});
  if (!(size > 0)) return response;
  if (hint.predict) {
    const contact::SlipLimit limit = contact::predicted_limit(law, trial.norm(), normal, sliding);
    return contact::slip_response<Dim>(before / size, std::max(limit.value, trial.norm()), limit);
  }
  const bool reversed = response.status == contact::Status::slip && before.dot(trial) < 0;
  return reversed ? contact::stick_response<Dim>(trial) : response;
}

/// Whether an open point is linearised as if it were in contact, and how. Where a body slides along
/// a curved master, the correction leaves the tangent plane: the gap opens by the square of the
/// way, while the gap above the tangent plane at the last place, which the correction was to close,
/// is closed. To open all these points would leave nothing of the contact it was made with.
template <int Dim>
[[nodiscard]] std::optional<KeptContact> keeps_contact(
    const PairDefinition<Dim>& pair, Points<Dim> x, const contact::PointHistory<Dim>& history,
    const Placed<Dim>& placed, const BranchHint<Dim>& hint, const Vec<Dim>& point) {
  constexpr int most = 4;
  const Projection<Dim>& p = placed.projection;
  const AssumedBranch<Dim>& before = hint.assumed;
  if (!before.closed || before.kept_on >= most || hint.predict || pair.damping) return {};
  if (p.feature != projection::Feature::face || p.beyond_end || p.facet != before.facet ||
      !contact::inside_domain(placed.kinematics) ||
      normal_response(pair, history, placed.kinematics.gap, hint).active)
    return {};
  Projection<Dim> last;
  last.feature = projection::Feature::face;
  last.facet = before.facet;
  last.xi = before.xi;
  const double linearised = place(pair.master, last, point, x).kinematics.gap;
  const contact::NormalResponse response = normal_response(pair, history, linearised, hint);
  if (!response.active) return {};
  return KeptContact{response, placed.kinematics.gap - linearised};
}

/// The answer of law and enforcement at a sample with this gap and frame, and the branch that the
/// active set keeps it in. `predictor(eps_T, share)` is the elastic predictor of the slip since the
/// last converged state; around a multiplier the slip of the whole increment counts, also that of a
/// point that was open at its start.
///
/// Source     KS2D Tables 1 and 2 with docs/errata.md; KSVD section 3; AC91 (multipliers)
/// Tested by  tests/unit/pairing/test_branches.cpp, test_multipliers.cpp, test_mortar.cpp
template <int Dim, class PredictorOf>
[[nodiscard]] Response<Dim> respond(const PairDefinition<Dim>& pair,
                                    const contact::PointHistory<Dim>& history, double gap,
                                    const Mat<Dim, Dim - 1>& frame, const BranchHint<Dim>& hint,
                                    const contact::NormalResponse& normal_law,
                                    const PredictorOf& predictor) {
  Response<Dim> r;
  r.traction.normal = hint.kept ? hint.kept->response : normal_law;
  r.has_shear = pair.friction.has_value();
  if (!r.traction.normal.active || !pair.friction) return r;
  const double normal = r.traction.normal.traction;
  const contact::FrictionLaw law = friction_law(pair, normal, hint);
  const double stiffness = r.traction.stiffness = contact::stiffness(law);
  const contact::Sliding sliding = sliding_of(history, hint);
  const double linearised_gap = gap - (hint.kept ? hint.kept->farther : 0);
  const Trial<Dim> trial =
      predictor(stiffness, hint.multiplier ? ContactShare{}
                                           : contact_share(pair, history, linearised_gap, hint));
  r.slip = trial.slip;
  r.law = contact::response<Dim>(law, trial.value, normal, sliding);
  r.slid = contact::slid<Dim>(trial.value, r.law, stiffness);
  r.dissipated = contact::dissipated<Dim>(trial.value, r.law, stiffness);
  if (!hint.multiplier) r.stored = 0.5 * r.law.traction.squaredNorm() / stiffness;
  r.traction.tangential =
      linearised_branch<Dim>(law, r.law, trial.value, normal, frame, sliding, hint);
  r.traction.d_trial = trial.variation;
  return r;
}

/// The traction of an open point that stays in contact: that at the linearised gap, continued along
/// its tangent to the present gap.
template <int Dim>
[[nodiscard]] contact::Traction<Dim> pulled(contact::Traction<Dim> t, const KeptContact& kept) {
  const double more = t.normal.d_traction * kept.farther;
  t.normal.traction += more;
  t.tangential.traction += more * t.tangential.d_normal;
  return t;
}

}  // namespace osculate::pairing
