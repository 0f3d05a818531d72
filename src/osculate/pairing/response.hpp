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
  if (is<NeverPart>(pair.separation)) return history.active;
  return is<TiedNormal>(pair.separation) && history.held;
}

/// The gap at which the normal law begins to count: half thicknesses, what a held point keeps, and
/// the initial overlap that does not count.
template <int Dim>
[[nodiscard]] double rest_gap(const PairDefinition<Dim>& pair,
                              const contact::PointHistory<Dim>& history,
                              const PointContext<Dim>& context) {
  return pair.offset + history.rest + context.relieved;
}

/// At the start: holds a point that is near the master.
template <int Dim>
void hold(const PairDefinition<Dim>& pair, contact::PointHistory<Dim>& history) {
  const auto* const tied = std::get_if<TiedNormal>(&pair.separation);
  if (!tied) return;
  const double gap = history.gap - pair.offset;
  history.held = std::abs(gap) <= tied->tolerance;
  if (history.held) history.rest = gap;
}

/// The way of the gap over the same facet since the last converged state, where it is asked for.
template <int Dim>
[[nodiscard]] double way_of_gap(const PairDefinition<Dim>& pair, const ActiveSet<Dim>& active_set,
                                const contact::PointHistory<Dim>& history, Index facet,
                                double gap) {
  const bool asked = active_set.mean_onset && !pair.damping && history.facet >= 0;
  return asked && history.facet == facet ? std::abs(gap - history.gap) : 0.0;
}

/// Whether the normal law gives a traction at this gap.
template <int Dim>
[[nodiscard]] bool is_closed(const PairDefinition<Dim>& pair,
                             const contact::PointHistory<Dim>& history, double gap,
                             const PointContext<Dim>& context = {}) {
  if (gap < -pair.depth) return false;
  if (is_held(pair, history)) return true;
  return !is<TiedNormal>(pair.separation) &&
         gap - pair.offset - context.relieved - 0.5 * context.way <=
             contact::onset_gap(pair.normal);
}

/// What a law of damping may ask.
template <int Dim>
[[nodiscard]] contact::Closing closing_of(const PairDefinition<Dim>& pair,
                                          const contact::PointHistory<Dim>& history,
                                          const PointContext<Dim>& context) {
  return {history.gap - rest_gap(pair, history, context), history.deepest,
          history.facet >= 0 ? context.duration : 0.0};
}

/// A normal law with its damping, around the multiplier where there is one.
template <int Dim>
[[nodiscard]] contact::NormalResponse response_of(const contact::NormalLaw& law,
                                                  const PairDefinition<Dim>& pair,
                                                  const contact::PointHistory<Dim>& history,
                                                  double gap, const PointContext<Dim>& context) {
  const bool held = is_held(pair, history);
  const double of_law = gap - rest_gap(pair, history, context);
  contact::NormalResponse r;
  if (context.multiplier) {
    if (gap < -pair.depth || (is<TiedNormal>(pair.separation) && !held)) return {};
    r = contact::augmented(context.stiffening * contact::penalty_of(law), of_law,
                           context.multiplier->normal, held);
    if (r.active && is<ByAugmentedLagrange>(pair.enforcement))
      r.stored = contact::stored_energy(law, of_law, true);
    return r;
  }
  if (!is_closed(pair, history, gap, context)) return {};
  if (pair.damping)
    return contact::damped(*pair.damping, law, of_law, closing_of(pair, history, context));
  const bool passes = !held && std::abs(of_law - contact::onset_gap(law)) < 0.5 * context.way;
  r = passes ? contact::mean_response(law, of_law, context.way)
             : contact::response(law, of_law, held);
  r.stored = contact::stored_energy(law, of_law, held);
  return r;
}

/// The answer of the point's normal law: the pair's, with the penalty of the point. (Around a
/// multiplier the stiffening comes with it.)
template <int Dim>
[[nodiscard]] contact::NormalResponse normal_response(const PairDefinition<Dim>& pair,
                                                      const contact::PointHistory<Dim>& history,
                                                      double gap,
                                                      const PointContext<Dim>& context) {
  const double factor = context.own.normal * (context.multiplier ? 1 : context.stiffening);
  if (factor == 1) return response_of(pair.normal, pair, history, gap, context);
  return response_of(pair.normal.stiffened(factor), pair, history, gap, context);
}

/// The part in contact of a point that was open at the start of the increment (`history`).
template <int Dim>
[[nodiscard]] ContactTimeFraction contact_time_fraction(const PairDefinition<Dim>& pair,
                                                        const contact::PointHistory<Dim>& history,
                                                        double gap,
                                                        const PointContext<Dim>& context) {
  const double onset =
      rest_gap(pair, history, context) + contact::onset_gap(pair.normal) + 0.5 * context.way;
  if (history.active || history.facet < 0 || !(history.gap > onset)) return {};
  const double range = history.gap - gap;
  return {(onset - gap) / range, -(history.gap - onset) / (range * range)};
}

/// What the friction law may ask beside the tractions.
template <int Dim>
[[nodiscard]] contact::Sliding sliding_of(const contact::PointHistory<Dim>& history,
                                          const PointContext<Dim>& context) {
  if (!history.active) return {0.0, context.duration};
  return {history.slid, context.duration, history.memory};
}

/// The friction law with the stiffness it has in this evaluation.
template <int Dim>
[[nodiscard]] contact::FrictionLaw friction_law(const PairDefinition<Dim>& pair,
                                                double normal_traction,
                                                const PointContext<Dim>& context) {
  const double stiffening = context.multiplier ? context.stiffening : 1;
  const contact::FrictionLaw law = pair.friction->stiffened(stiffening * context.own.shear);
  if (!context.multiplier) return law;
  return law.stiffened(contact::steadying(law, normal_traction, context.duration));
}

/// The law's answer, or the branch that the context keeps it in.
template <int Dim>
[[nodiscard]] contact::TangentialResponse<Dim> linearised_branch(
    const contact::FrictionLaw& law, const contact::TangentialResponse<Dim>& response,
    const Vec<Dim - 1>& trial, double normal, const Mat<Dim, Dim - 1>& frame,
    const contact::Sliding& sliding, const PointContext<Dim>& context) {
  if (context.predict && context.active.branch == contact::Branch::stick)
    return contact::stick_response<Dim>(trial);  // also on the limit, whatever round-off says
  if (context.active.branch != contact::Branch::slip) return response;
  const Vec<Dim - 1> before = frame.transpose() * context.active.direction;
  const double size = before.norm();
  if (!(size > 0) && context.predict)  // slides whichever way it likes
    return contact::slip_response<Dim>(Vec<Dim - 1>::Zero(), 0, {});
  if (!(size > 0)) return response;
  if (context.predict) {
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
    const ProjectedPoint<Dim>& projected, const PointContext<Dim>& context, const Vec<Dim>& point) {
  constexpr int most = 4;
  const Projection<Dim>& p = projected.projection;
  const ActiveBranch<Dim>& before = context.active;
  if (!before.closed || before.kept_on >= most || context.predict || pair.damping) return {};
  if (p.feature != projection::Feature::face || p.beyond_end || p.facet != before.facet ||
      !contact::inside_domain(projected.kinematics) ||
      normal_response(pair, history, projected.kinematics.gap, context).active)
    return {};
  Projection<Dim> last;
  last.feature = projection::Feature::face;
  last.facet = before.facet;
  last.xi = before.xi;
  const double linearised = projected_point(pair.master, last, point, x).kinematics.gap;
  const contact::NormalResponse response = normal_response(pair, history, linearised, context);
  if (!response.active) return {};
  return KeptContact{response, projected.kinematics.gap - linearised};
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
                                    const Mat<Dim, Dim - 1>& frame,
                                    const PointContext<Dim>& context,
                                    const contact::NormalResponse& normal_law,
                                    const PredictorOf& predictor) {
  Response<Dim> r;
  r.traction.normal = context.kept ? context.kept->response : normal_law;
  r.has_shear = pair.friction.has_value();
  if (!r.traction.normal.active || !pair.friction) return r;
  const double normal = r.traction.normal.traction;
  const contact::FrictionLaw law = friction_law(pair, normal, context);
  const double stiffness = r.traction.stiffness = contact::stiffness(law);
  const contact::Sliding sliding = sliding_of(history, context);
  const double linearised_gap = gap - (context.kept ? context.kept->farther : 0);
  const ElasticPredictor<Dim> trial =
      predictor(stiffness, context.multiplier
                               ? ContactTimeFraction{}
                               : contact_time_fraction(pair, history, linearised_gap, context));
  r.slip = trial.slip;
  r.law = contact::response<Dim>(law, trial.value, normal, sliding);
  r.slid = contact::slid<Dim>(trial.value, r.law, stiffness);
  r.memory = contact::remembered(law, r.slid, sliding);
  r.dissipated = contact::dissipated<Dim>(trial.value, r.law, stiffness);
  if (!context.multiplier) r.stored = 0.5 * r.law.traction.squaredNorm() / stiffness;
  r.traction.tangential =
      linearised_branch<Dim>(law, r.law, trial.value, normal, frame, sliding, context);
  r.traction.d_predictor = trial.variation;
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
