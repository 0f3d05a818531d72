#pragma once
#include <string>

#include "osculate/result/checkpoint.hpp"

namespace osculate::result {

/// A warning where a pair touched, but never pressed, and one of its bodies has nothing that holds
/// it: it follows the other one. Else empty. Of static steps and penalties.
///
/// Tested by  tests/unit/api/test_without_force.cpp
template <int Dim>
[[nodiscard]] std::string without_force(const model::BasicModel<Dim>& model,
                                        const model::BasicContactPair<Dim>& pair,
                                        const Penetration& found);

}  // namespace osculate::result
