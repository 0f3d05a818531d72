#include "osculate/core/memory.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>

namespace osculate::core {
namespace {

/// A number behind a word of a table of the system [kB there]; 0: it is not there.
double of_system(const std::string& word) {
  std::ifstream file("/proc/meminfo");
  std::string key;
  for (double value = 0; file >> key >> value; file.ignore(1000, '\n'))
    if (key == word + ":") return 1024 * value;
  return 0;
}

/// The first number of a file; 0: none.
double number_in(const char* path) {
  std::ifstream file(path);
  double value = 0;
  return file >> value ? value : 0;
}

/// The smaller one, of those that are known.
double least(double a, double b) { return a > 0 && b > 0 ? std::min(a, b) : std::max(a, b); }

double address_limit() {
  rlimit limit{};
  return getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY
             ? static_cast<double>(limit.rlim_cur)
             : 0;
}

/// Asks for large pages where the next blocks will lie: small runs spend their time in faults of
/// pages. (Not everywhere: large runs wait for large pages longer than they save.)
void use_large_pages_first(std::size_t bytes) {
  void* const first = std::malloc(bytes);  // not touched, so nothing is taken
  const std::uintptr_t page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const std::uintptr_t begin = (reinterpret_cast<std::uintptr_t>(first) + page - 1) / page * page;
  if (first != nullptr) (void)madvise(reinterpret_cast<void*>(begin), bytes - page, MADV_HUGEPAGE);
  std::free(first);
}

constexpr const char* group_limit = "/sys/fs/cgroup/memory.max";
constexpr const char* group_use = "/sys/fs/cgroup/memory.current";

}  // namespace

double memory_in_all() {
  return least(least(of_system("MemTotal") + of_system("SwapTotal"), address_limit()),
               number_in(group_limit));
}

double memory_available() {
  const double pages = number_in("/proc/self/statm") * static_cast<double>(sysconf(_SC_PAGESIZE));
  double available = of_system("MemAvailable") + of_system("SwapFree");
  if (const double limit = address_limit(); limit > 0)
    available = least(available, std::max(limit - pages, 1.0));
  if (const double limit = number_in(group_limit); limit > 0)
    available = least(available, std::max(limit - number_in(group_use), 1.0));
  return available;
}

double most_resident() {
  constexpr double kilobyte = 1024;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return kilobyte * static_cast<double>(usage.ru_maxrss);
}

bool can_allocate(std::size_t bytes) {
  void* const probe = std::malloc(bytes);  // not touched, so nothing is taken
  std::free(probe);
  return probe != nullptr;
}

void keep_freed_memory() {
  constexpr int largest_block = 32 << 20, most = 128 << 20, first_pages = 24 << 20;
  (void)mallopt(M_MMAP_THRESHOLD, largest_block);
  (void)mallopt(M_TRIM_THRESHOLD, most);
  (void)mallopt(M_ARENA_MAX, 1);  // each thread would have one, of 64 MB of addresses
  use_large_pages_first(first_pages);
}

std::string memory_text(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.0f} MB", std::max(1.0, 1e-6 * bytes))
                     : fmt::format("{:.1f} GB", 1e-9 * bytes);
}

std::string out_of_memory_text(const std::bad_alloc& error) {
  const std::string text = error.what();
  return text == std::bad_alloc{}.what() ? "not enough memory" : text;
}

}  // namespace osculate::core
