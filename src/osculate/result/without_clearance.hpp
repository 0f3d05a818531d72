#pragma once
#include <string>

#include "osculate/model/model.hpp"
#include "osculate/model/state.hpp"

namespace osculate::result {

/// A warning where points of a pair with a clearance are in contact that had no place on the master
/// at the start, and so the gap of the mesh. Else empty.
///
/// Tested by  tests/unit/api/test_without_clearance.cpp
template <int Dim>
[[nodiscard]] std::string without_clearance(const model::BasicModel<Dim>& model,
                                            const model::BasicContactPair<Dim>& pair,
                                            const pairing::PairEvaluation<Dim>& contact,
                                            const pairing::PairState<Dim>& state);

}  // namespace osculate::result
