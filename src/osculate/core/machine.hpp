#pragma once
#include <string>

#include "osculate/core/ranks.hpp"

namespace osculate::core {

/// A number that processes of one machine have in common, and those of others have not.
[[nodiscard]] double mark_of_machine();

/// The sum over the processes of this machine, of which each has a value and a mark.
///
/// Tested by  tests/unit/core/test_machine.cpp
[[nodiscard]] double sum_on_machine(const Ranks& ranks, double value, double mark);

/// Processors that this process may have: those it may run on, or what the time of its group (of
/// a container) amounts to, where that is less. At least 1.
[[nodiscard]] int processors_here();
/// The number that `max` of a group's file `cpu.max` amounts to, rounded up; 0: no limit, or none
/// that is understood.
///
/// Tested by  tests/unit/core/test_machine.cpp
[[nodiscard]] int processors_of(const std::string& cpu_max);

}  // namespace osculate::core
