#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "osculate/result/checkpoint.hpp"

namespace osculate::result {

/// Takes the points of an accepted increment into account.
///
/// Formula    share = max over points in contact of -gap / h, h the least height of the cells
///            behind the point ; needed = max eps_N (-gap) / (target h)
/// Tested by  tests/unit/api/test_point_penalties.cpp
template <int Dim>
void measure_penetration(const model::BasicContactPair<Dim>& pair,
                         const pairing::PairEvaluation<Dim>& contact, Penetration& found);

/// Penalties: of the pair, and the smallest, the mean and the largest of its points'.
template <int Dim>
[[nodiscard]] nlohmann::json penalty_json(const pairing::PairDefinition<Dim>& pair);

/// Penalties used, penetration reached.
template <int Dim>
[[nodiscard]] nlohmann::json penetration_json(const model::BasicContactPair<Dim>& pair,
                                              const Penetration& found);

/// A warning where the target is missed, else empty.
template <int Dim>
[[nodiscard]] std::string missed_target(const model::BasicModel<Dim>& model,
                                        const model::BasicContactPair<Dim>& pair,
                                        const Penetration& found);

}  // namespace osculate::result
