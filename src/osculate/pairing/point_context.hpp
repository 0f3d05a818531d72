#pragma once
// What is known of a contact sample before its laws are asked; for sources of this layer.
#include <optional>

#include "osculate/pairing/point_penalty.hpp"

namespace osculate::pairing {

/// The normal law's answer at the linearised gap of an open point that stays in contact for the
/// next correction, and how much farther than that gap the point is (keeps_contact).
struct KeptContact {
  contact::NormalResponse response;
  double farther = 0;
};

/// What is known of a point before the law is asked: its branch, and the multiplier its penalties
/// act around.
template <int Dim>
struct PointContext {
  ActiveBranch<Dim> active{};
  bool predict = false;
  bool known = false;   ///< `active_set` is of an iteration (or predicted), not made up
  double duration = 0;  ///< of the increment
  double relieved = 0;  ///< part of the gap that does not count (PairState::overlap)
  double way = 0;       ///< of the gap in the increment, with ActiveSet::mean_onset
  const contact::Multiplier<Dim>* multiplier = nullptr;
  double stiffening = 1;
  RelativeStiffness own{};  ///< factors of the point's penalties
  std::optional<KeptContact> kept{};
};

/// The context of point i.
template <int Dim>
[[nodiscard]] PointContext<Dim> context_of(const PairDefinition<Dim>& pair,
                                           const ActiveSet<Dim>& active_set,
                                           const PairMultipliers<Dim>* multipliers, std::size_t i) {
  PointContext<Dim> context;
  context.own = relative_stiffness(pair, i);
  if (!active_set.branch.empty()) {
    context.active = active_set.branch[i];
    context.predict = active_set.predict;
    context.known = true;
  }
  context.duration = active_set.duration;
  if (multipliers) {
    context.stiffening = multipliers->stiffening;
    if (i < multipliers->points.size()) context.multiplier = &multipliers->points[i];
  }
  return context;
}

}  // namespace osculate::pairing
