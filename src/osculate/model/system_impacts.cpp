// Steps with inertia: the impacts that increments end at.
#include <algorithm>
#include <cmath>

#include "osculate/model/system_motion.hpp"

namespace osculate::model {
namespace {

using PointName = std::array<std::size_t, 2>;  ///< pair and point

/// A point that was open is in contact, or one that was in contact has come onto another part of
/// the master.
template <int Dim>
bool met(const contact::PointHistory<Dim>& before, const pairing::PointResult<Dim>& now) {
  if (now.status == contact::Status::open) return false;
  return !before.active || before.facet != now.history.facet ||
         before.feature != now.history.feature;
}

std::vector<PointName> without(std::vector<PointName> points,
                               const std::vector<PointName>& skipped) {
  std::erase_if(points, [&](const PointName& name) {
    return std::find(skipped.begin(), skipped.end(), name) != skipped.end();
  });
  return points;
}

template <int Dim>
double largest_acceleration(const BasicDofSpace<Dim>& dofs, const Eigen::VectorXd& acceleration) {
  double most = 0;
  for (Index node = 0; node < dofs.nodes(); ++node)
    most = std::max(most, acceleration.segment<Dim>(Dim * node).norm());
  for (Dof d = Dim * dofs.nodes(); d < dofs.dofs(); d += body::motions<Dim>)
    most = std::max(most, acceleration.segment<Dim>(d).norm());
  return most;
}

}  // namespace

template <int Dim>
bool BasicSystem<Dim>::Impl::Motion::watches(std::size_t pair, std::size_t point) const {
  const pairing::PairDefinition<Dim>& definition = model.pairs[pair].definition;
  if (point >= definition.slave.points.size()) return false;  // an edge-edge contact
  const ImpactTimes times = settings.impact_times;
  if (times != ImpactTimes::automatic) return times == ImpactTimes::all;
  const Index body = dofs.body_of(definition.slave.points[point].nearest_node());
  return body >= 0 && inertia.body_has_mass(static_cast<std::size_t>(body));
}

template <int Dim>
bool BasicSystem<Dim>::Impl::Motion::watches_any(std::size_t pair) const {
  for (std::size_t i = 0; i < model.pairs[pair].definition.slave.points.size(); ++i)
    if (watches(pair, i)) return true;
  return false;
}

template <int Dim>
void BasicSystem<Dim>::Impl::Motion::evaluate_path(const State& committed, std::size_t pair,
                                                   std::span<const Vec<Dim>> x, double duration) {
  pairing::ActiveSet<Dim> active_set;
  active_set.duration = duration;
  active_set.relief = system.contact.relief(model.pairs[pair].definition, committed.fraction);
  const bool has_multipliers = pair < committed.multipliers.size();
  pairing::evaluate<Dim>(model.pairs[pair].definition, x, committed.pairs[pair], false, paths[pair],
                         active_set, has_multipliers ? &committed.multipliers[pair] : nullptr);
}

/// A contact force far above all other forces stops a mass; the next increment has nothing like it.
template <int Dim>
void BasicSystem<Dim>::Impl::Motion::forget_impulses(
    std::vector<pairing::PairMultipliers<Dim>>& multipliers) const {
  if (!(h > 0) || settings.scheme.impact == solve::Impact::average) return;
  constexpr double far_above = 3;
  const double usual =
      far_above * std::max(last.forces.internal.norm(), last.forces.external.norm());
  for (std::size_t p = 0; p < multipliers.size(); ++p)
    for (std::size_t i = 0; i < multipliers[p].points.size(); ++i) {
      const pairing::PointResult<Dim>& point = last.contact[p].points[i];
      if (point.weight * std::abs(point.normal_traction) > usual) multipliers[p].points[i] = {};
    }
}

template <int Dim>
std::vector<PointName> BasicSystem<Dim>::Impl::Motion::met_on_path(const State& committed,
                                                                   double duration) {
  std::vector<Vec<Dim>> x = system.positions(committed.u);
  for (std::size_t n = 0; n < x.size(); ++n)
    x[n] += duration *
            committed.rates.velocity.template segment<Dim>(Dim * static_cast<Eigen::Index>(n));
  std::vector<PointName> points;
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    if (!watches_any(p)) continue;
    evaluate_path(committed, p, x, duration);
    const std::vector<contact::PointHistory<Dim>>& before = committed.pairs[p].points;
    const std::vector<pairing::PointResult<Dim>>& now = paths[p].points;
    for (std::size_t i = 0; i < std::min(before.size(), now.size()); ++i)
      if (watches(p, i) && met(before[i], now[i])) points.push_back({p, i});
  }
  return points;
}

template <int Dim>
std::vector<double> BasicSystem<Dim>::Impl::Motion::speeds_on_path(
    const State& committed, const std::vector<PointName>& points, double duration, double more) {
  std::vector<double> sinking(points.size());
  for (const double sign : {1.0, -1.0}) {
    met_on_path(committed, sign > 0 ? duration + more : duration + 2 * more);
    for (std::size_t i = 0; i < points.size(); ++i)
      sinking[i] += sign * paths[points[i][0]].points[points[i][1]].gap / more;
  }
  return sinking;
}

template <int Dim>
std::optional<solve::ImpactAhead> BasicSystem<Dim>::Impl::Motion::impact_ahead(
    const State& committed, double fraction) {
  if (committed.rates.empty()) return std::nullopt;
  const ImpactTimes times = settings.impact_times;
  const bool average = settings.scheme.impact == solve::Impact::average;
  const double span = system.time_between(committed, fraction);
  if (times == ImpactTimes::off || (times == ImpactTimes::automatic && average) || !(span > 0))
    return std::nullopt;
  if (paths.size() != model.pairs.size()) {
    paths.resize(model.pairs.size());
    for (std::size_t p = 0; p < model.pairs.size(); ++p)  // the same trees in every process
      evaluate_path(committed, p, model.reference, span);
  }
  // Slower than what the forces make of a body at rest within a few nominal increments is no impact
  // but the trembling of a contact that rests.
  constexpr double horizon = 1.25, trembling = 4, beyond = 0.01, smallest = 1e-4;
  const double slowest = trembling * step.duration / step.increments *
                         largest_acceleration(dofs, committed.rates.acceleration);
  std::vector<PointName> skipped;
  for (;;) {
    double low = 0, high = horizon;
    std::vector<PointName> points = without(met_on_path(committed, high * span), skipped);
    if (points.empty()) return std::nullopt;
    while (high - low > smallest) {
      const double middle = 0.5 * (low + high);
      std::vector<PointName> there = without(met_on_path(committed, middle * span), skipped);
      (there.empty() ? low : high) = middle;
      if (!there.empty()) points = std::move(there);
    }
    const std::vector<double> sinking =
        speeds_on_path(committed, points, high * span, beyond * span);
    solve::ImpactAhead ahead{high, {}};
    for (std::size_t i = 0; i < points.size(); ++i)
      (sinking[i] > slowest ? ahead.points : skipped).push_back(points[i]);
    if (!ahead.points.empty()) return ahead;
  }
}

template <int Dim>
std::optional<solve::ImpactAhead> BasicSystem<Dim>::impact_ahead(const State& committed,
                                                                 double fraction) const {
  if (!impl_->motion) return std::nullopt;
  return impl_->motion->impact_ahead(committed, fraction);
}

template <int Dim>
bool BasicSystem<Dim>::has_met(const State& committed, const solve::ImpactAhead& expected) const {
  return std::any_of(expected.points.begin(), expected.points.end(), [&](const PointName& name) {
    return met(committed.pairs[name[0]].points[name[1]],
               impl_->last.contact[name[0]].points[name[1]]);
  });
}

template std::optional<solve::ImpactAhead> BasicSystem<2>::impact_ahead(const State&, double) const;
template std::optional<solve::ImpactAhead> BasicSystem<3>::impact_ahead(const State3&,
                                                                        double) const;
template bool BasicSystem<2>::has_met(const State&, const solve::ImpactAhead&) const;
template bool BasicSystem<3>::has_met(const State3&, const solve::ImpactAhead&) const;
template struct BasicSystem<2>::Impl::Motion;
template struct BasicSystem<3>::Impl::Motion;

}  // namespace osculate::model
