#pragma once
#include <string>

#include "osculate/model/model.hpp"

namespace osculate::result {

/// A warning where the law of surfaces that may part pulls: at the end of a step, by more than a
/// hundredth of its pressure. Else empty.
///
/// Formula    sum w max(N, 0) / sum w max(-N, 0) > 0.01
/// Tested by  tests/unit/api/test_pulling.cpp
template <int Dim>
[[nodiscard]] std::string pulling(const model::BasicContactPair<Dim>& pair,
                                  const pairing::PairEvaluation<Dim>& contact,
                                  const std::string& step);

}  // namespace osculate::result
