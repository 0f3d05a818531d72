#include "osculate/model/process_records.hpp"

#include <algorithm>

#include "osculate/core/memory.hpp"

namespace osculate::model {

std::vector<ProcessRecord> records_of(const core::Ranks* ranks, double seconds, double in_calls) {
  if (!ranks) return {};
  const auto count = static_cast<std::size_t>(ranks->count());
  const std::size_t here = 2 * static_cast<std::size_t>(ranks->rank());
  std::vector<double> all(2 * count, core::Ranks::nothing);
  all[here] = seconds - in_calls;
  all[here + 1] = core::most_resident();
  ranks->sum(all);
  std::vector<ProcessRecord> out;
  for (std::size_t p = 0; p < count; ++p) out.push_back({all[2 * p], all[2 * p + 1]});
  return out;
}

std::size_t slowest(const std::vector<ProcessRecord>& processes) {
  return static_cast<std::size_t>(std::ranges::max_element(processes, {}, &ProcessRecord::working) -
                                  processes.begin());
}

double imbalance(const std::vector<ProcessRecord>& processes) {
  double sum = 0;
  for (const ProcessRecord& p : processes) sum += p.working;
  if (!(sum > 0)) return 1;
  return processes[slowest(processes)].working * static_cast<double>(processes.size()) / sum;
}

}  // namespace osculate::model
