#pragma once
#include <string>

#include "osculate/result/checkpoint.hpp"

namespace osculate::result {

/// Takes the sliding of an accepted increment into account.
///
/// Formula    give = sum over closed points of |t| / eps_T ; way = sum over points and increments
/// of
///            |s|, which the give is a part of
/// Tested by  tests/unit/api/test_soft_friction.cpp
template <int Dim>
void measure_sticking(const model::BasicContactPair<Dim>& pair,
                      const pairing::PairEvaluation<Dim>& contact, Penetration& found);

/// A warning where the friction penalty gave way instead of friction; else empty.
template <int Dim>
[[nodiscard]] std::string soft_friction(const model::BasicContactPair<Dim>& pair,
                                        const Penetration& found);

}  // namespace osculate::result
