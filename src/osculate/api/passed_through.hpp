#pragma once
#include <string>
#include <vector>

#include "osculate/model/model.hpp"

namespace osculate::api {

/// Gaps of the points of a pair, which tell the next increment where they came from.
template <int Dim>
[[nodiscard]] std::vector<double> gaps_of(const pairing::PairEvaluation<Dim>& contact);

/// A warning where points that were in front of the master at the beginning of an increment are
/// behind one of its faces at the end, and not in contact: the increment carried them beyond where
/// contact is looked for (search: {depth}, the reach of mortar). Else empty.
///
/// Tested by  tests/unit/api/test_passed_through.cpp
template <int Dim>
[[nodiscard]] std::string passed_through(const model::BasicModel<Dim>& model,
                                         const model::BasicContactPair<Dim>& pair,
                                         const std::vector<double>& before,
                                         const pairing::PairEvaluation<Dim>& contact,
                                         const std::vector<Vec<Dim>>& positions);

}  // namespace osculate::api
