#pragma once
#include <cstddef>
#include <vector>

#include "osculate/core/ranks.hpp"

namespace osculate::model {

/// What one of several processes has done.
struct ProcessRecord {
  double working = 0;  ///< seconds without those in which it sent messages or waited for others
  double memory = 0;   ///< most that it has had at once [bytes]
};

/// Of all processes, told to each of them; nothing of one process alone.
///
/// Input      seconds: of this process, of which so many went by in calls of `ranks`
/// Tested by  tests/unit/model/test_process_records.cpp, tests/ranks
[[nodiscard]] std::vector<ProcessRecord> records_of(const core::Ranks* ranks, double seconds,
                                                    double in_calls);
/// The process that has worked longest; of equal ones the first.
[[nodiscard]] std::size_t slowest(const std::vector<ProcessRecord>& processes);
/// How long that has worked over the mean of all: 1 where all have worked alike.
[[nodiscard]] double imbalance(const std::vector<ProcessRecord>& processes);

}  // namespace osculate::model
