#include "osculate/core/machine.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace osculate::core {

double mark_of_machine() {
  std::string name;
  std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), name);
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) == 0) name += host.data();
  constexpr unsigned exact = 12;  // bits of the hash that a number has not, and a sign
  return static_cast<double>(std::hash<std::string>{}(name) >> exact);
}

int processors_of(const std::string& cpu_max) {
  std::istringstream in(cpu_max);
  double time = 0, period = 0;  // `max` is no number
  constexpr double most = 1e6;
  return in >> time >> period && time > 0 && period > 0
             ? static_cast<int>(std::ceil(std::min(time / period, most)))
             : 0;
}

int processors_here() {
  cpu_set_t set;
  const int may = sched_getaffinity(0, sizeof(set), &set) == 0
                      ? std::max(1, CPU_COUNT(&set))
                      : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::string line;
  std::getline(std::ifstream("/sys/fs/cgroup/cpu.max"), line);
  const int of_group = processors_of(line);
  return of_group > 0 ? std::min(may, of_group) : may;
}

double sum_on_machine(const Ranks& ranks, double value, double mark) {
  const auto count = static_cast<std::size_t>(ranks.count());
  const auto here = static_cast<std::size_t>(ranks.rank());
  std::vector<double> of_all(2 * count, Ranks::nothing);  // marks, then values
  of_all[here] = mark;
  of_all[count + here] = value;
  ranks.sum(of_all);
  double sum = 0;
  for (std::size_t r = 0; r < count; ++r)
    if (of_all[r] == mark) sum += of_all[count + r];
  return sum;
}

}  // namespace osculate::core
