#pragma once
#include <string>

#include "osculate/model/analysis.hpp"

namespace osculate::result {

/// What contact points of a model can be beside open.
struct PointStates {
  bool hold = false;   ///< of pairs with friction or ties: they stick or slide
  bool close = false;  ///< of pairs without
};
template <int Dim>
[[nodiscard]] PointStates point_states(const model::BasicModel<Dim>& model);

/// Contact points by state, those that there can be: `open 3 stick 4 slipping 5 closed 7`; nothing
/// without contact.
[[nodiscard]] std::string counts_text(const solve::StateCounts& counts, PointStates states);

/// The line of log.txt for a converged increment.
[[nodiscard]] std::string increment_text(const std::string& step, const model::Progress& p,
                                         const solve::IncrementRecord& record, PointStates states);

/// The same in explicit time integration.
[[nodiscard]] std::string time_steps_text(const std::string& step, const model::Progress& p,
                                          const solve::IncrementRecord& record, PointStates states);

/// One frequency of a harmonic step: the vibration that swings most.
[[nodiscard]] std::string swing_text(const std::string& step, const model::Progress& p,
                                     const Eigen::VectorXcd& amounts);

/// The vibrations that a step has found, then what speaks against them: some are missing, or they
/// are not exact.
[[nodiscard]] std::vector<std::string> vibrations_text(const std::string& step,
                                                       const model::Vibrations& modes);
/// The factors that a step has found at which its loads buckle what there is, and doubts.
[[nodiscard]] std::vector<std::string> buckling_text(const std::string& step,
                                                     const model::Buckling& found);
/// The line of one iteration of an attempt that was dropped; they count from 1.
[[nodiscard]] std::string iteration_text(int number, const solve::IterationRecord& iteration,
                                         PointStates states);

}  // namespace osculate::result
