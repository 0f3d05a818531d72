#pragma once
#include <algorithm>

#include "osculate/model/model.hpp"

namespace osculate::model {

/// Least height of the cells behind contact point i; 0: unknown.
template <int Dim>
[[nodiscard]] double height_behind(const BasicContactPair<Dim>& pair, std::size_t i) {
  return i < pair.heights.size() ? pair.heights[i] : pair.height;
}

/// sum force depth / height over sum force; what pulls, and what has no height, does not count.
class DepthMean {
 public:
  void add(double depth, double height, double force) {
    if (!(height > 0) || !(force > 0)) return;
    sum_ += force * depth / height;
    force_ += force;
  }
  [[nodiscard]] double share() const { return force_ > 0 ? sum_ / force_ : 0.0; }

 private:
  double sum_ = 0, force_ = 0;
};

/// How deep the points of a pair are, in the mean over the force that they carry: a corner whose
/// pressure has no limit does not count for more than it carries.
///
/// Formula    sum A |N| (-gap / h) / sum A |N| over points in contact, h the least height of the
///            cells behind them
/// Tested by  tests/unit/model/test_penetration.cpp
template <int Dim>
[[nodiscard]] double mean_share(const BasicContactPair<Dim>& pair,
                                const pairing::PairEvaluation<Dim>& contact) {
  DepthMean mean;
  for (std::size_t i = 0; i < contact.points.size(); ++i) {
    const pairing::PointResult<Dim>& point = contact.points[i];
    if (point.status != contact::Status::open)
      mean.add(-point.gap, height_behind(pair, i), -point.weight * point.normal_traction);
  }
  return mean.share();
}

/// The same of a committed state, as if all points had the same penalty and area.
template <int Dim>
[[nodiscard]] double committed_share(const BasicContactPair<Dim>& pair,
                                     const pairing::PairState<Dim>& state) {
  DepthMean mean;
  for (std::size_t i = 0; i < state.points.size(); ++i)
    if (const contact::PointHistory<Dim>& point = state.points[i]; point.active)
      mean.add(-point.gap, height_behind(pair, i), -point.gap);
  return mean.share();
}

/// Whether the program may change the normal penalty of a pair: it has chosen it, nothing else
/// corrects the tractions, and gaps are measured from nothing but contact. Springs that change
/// would make energy: not in models with inertia.
template <int Dim>
[[nodiscard]] bool adapts_penalty(const BasicModel<Dim>& model, const BasicContactPair<Dim>& pair) {
  const auto moves = [](const Step& step) { return step.dynamics.has_value(); };
  return pair.automatic && pairing::is<pairing::ByPenalty>(pair.definition.enforcement) &&
         pairing::is<pairing::MayPart>(pair.definition.separation) &&
         !pairing::edges_of(pair.definition) &&
         std::none_of(model.steps.begin(), model.steps.end(), moves);
}

/// What a penalty that the program has chosen, and multiplied by `used` since, is multiplied by: it
/// was chosen for small strains, and pressures above a tenth of the modulus miss the target.
///
/// Formula    1 where share <= target, else min(10, 2 share / target): the pressure may double
///            before the next correction; in all at most 1000
/// Decision   docs/decisions/036-penalties-that-follow-the-pressure.md
/// Tested by  tests/unit/model/test_penetration.cpp
[[nodiscard]] inline double wanted_stiffening(double share, double used) {
  constexpr double room = 2, most = 10, most_in_all = 1000;
  if (!(share > penetration_target)) return 1;
  return std::max(1.0, std::min({most, room * share / penetration_target, most_in_all / used}));
}

}  // namespace osculate::model
