#pragma once
#include "osculate/core/ranks.hpp"

namespace osculate::core {

/// A number that processes of one machine have in common, and those of others have not.
[[nodiscard]] double mark_of_machine();

/// The sum over the processes of this machine, of which each has a value and a mark.
///
/// Tested by  tests/unit/core/test_machine.cpp
[[nodiscard]] double sum_on_machine(const Ranks& ranks, double value, double mark);

}  // namespace osculate::core
