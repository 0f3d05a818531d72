#pragma once
#include "osculate/model/model.hpp"
#include "osculate/model/state.hpp"

namespace osculate::model {

/// The pairs of `now` as they are in a step of `original`, of which it is a copy: all changes up to
/// there are made. Pairs that are not active touch nothing, however deep.
template <int Dim>
void change_pairs(const BasicModel<Dim>& original, std::size_t step, BasicModel<Dim>& now);

/// The state in which a step begins: pairs that it makes active, and those whose points it ties no
/// more, begin anew, without shear.
///
/// Tested by  tests/unit/deck/test_pair_changes.cpp, verification/pair_changes
template <int Dim>
[[nodiscard]] BasicState<Dim> begin_anew(const BasicModel<Dim>& original, std::size_t step,
                                         const BasicModel<Dim>& now, BasicState<Dim> state);

}  // namespace osculate::model
