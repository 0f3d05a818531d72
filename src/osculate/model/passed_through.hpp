#pragma once
#include <string>
#include <vector>

#include "osculate/model/model.hpp"

namespace osculate::model {

/// By point of a pair: whether it was before a face of the master, or on it and in contact.
template <int Dim>
[[nodiscard]] std::vector<char> in_front(const pairing::PairState<Dim>& state, double offset);

/// What happened where points that were in front of the master at the beginning of an increment are
/// behind one of its faces at the end, and not in contact: the increment carried them beyond where
/// contact is looked for (search: {depth}, the reach of mortar). Else empty.
///
/// Tested by  tests/unit/api/test_passed_through.cpp
template <int Dim>
[[nodiscard]] std::string passed_through(const BasicModel<Dim>& model,
                                         const BasicContactPair<Dim>& pair,
                                         const std::vector<char>& before,
                                         const pairing::PairEvaluation<Dim>& contact,
                                         const std::vector<Vec<Dim>>& positions);

}  // namespace osculate::model
