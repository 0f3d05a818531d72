#pragma once
#include <string>
#include <vector>

#include "osculate/result/checkpoint.hpp"

namespace osculate::result {

/// Takes an accepted increment into account; `touched`: within it.
template <int Dim>
void measure_closing(const pairing::PairEvaluation<Dim>& contact, bool touched, Penetration& found);

/// A sentence for each contact of which no point was ever closed, with the reason as far as it can
/// be found in the configuration `x` at the end: a warning where the reason is a fault of the
/// model, or where no other contact closed either. Pairs of one `all`, and both passes of a pair,
/// are one contact; points that are tied have no need to close.
///
/// Tested by  tests/unit/api/test_never_closed.cpp
template <int Dim>
[[nodiscard]] std::vector<std::string> never_closed(const model::BasicModel<Dim>& model,
                                                    const std::vector<Penetration>& found,
                                                    const std::vector<Vec<Dim>>& x);

}  // namespace osculate::result
