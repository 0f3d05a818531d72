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
struct BranchHint {
  AssumedBranch<Dim> assumed{};
  bool predict = false;
  bool known = false;   ///< `assumed` is of an iteration (or predicted), not made up
  double duration = 0;  ///< of the increment
  double relieved = 0;  ///< part <= 0 of the gap that does not count (PairState::overlap)
  double way = 0;       ///< of the gap in the increment, with Assumed::mean_onset
  const contact::Multiplier<Dim>* multiplier = nullptr;
  double stiffening = 1;
  RelativeStiffness own{};  ///< factors of the point's penalties
  std::optional<KeptContact> kept{};
};

/// The hint of point i.
template <int Dim>
[[nodiscard]] BranchHint<Dim> hint_of(const PairDefinition<Dim>& pair, const Assumed<Dim>& assumed,
                                      const PairMultipliers<Dim>* multipliers, std::size_t i) {
  BranchHint<Dim> hint;
  hint.own = relative_stiffness(pair, i);
  if (!assumed.branch.empty()) {
    hint.assumed = assumed.branch[i];
    hint.predict = assumed.predict;
    hint.known = true;
  }
  hint.duration = assumed.duration;
  if (multipliers) {
    hint.stiffening = multipliers->stiffening;
    if (i < multipliers->points.size()) hint.multiplier = &multipliers->points[i];
  }
  return hint;
}

}  // namespace osculate::pairing
