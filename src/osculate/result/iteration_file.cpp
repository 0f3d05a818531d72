#include "osculate/result/iteration_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "osculate/io/csv.hpp"

namespace osculate::result {
namespace {

std::string iterations_path(const std::string& folder) { return folder + "/iterations.csv"; }

/// The whole rows that are there: of one that a kill has cut off nothing.
std::uint64_t iterations_kept(const std::string& folder, bool go_on) {
  std::ifstream file(iterations_path(folder), std::ios::binary | std::ios::ate);
  if (!file || !go_on) return 0;
  std::streamoff kept = file.tellg();
  for (char last = 0; kept > 0; --kept) {
    file.seekg(kept - 1);
    if (!file.get(last) || last == '\n') break;
  }
  return static_cast<std::uint64_t>(std::max<std::streamoff>(kept, 0));
}

}  // namespace

IterationFile::IterationFile(const std::string& folder, bool go_on)
    : file_(iterations_path(folder), iterations_kept(folder, go_on)) {
  if (file_.size() == 0)
    file_.append(
        "step,increment,time,iteration,residual,energy,step_length,open,stick,slipping,closed\n");
}

void IterationFile::add(const model::Progress& aim, int number,
                        const solve::IterationRecord& iteration) {
  const solve::StateCounts& counts = iteration.counts;
  file_.append(fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", aim.step + 1, aim.increment,
                           io::csv_number(aim.time), number, io::csv_number(iteration.residual),
                           io::csv_number(iteration.energy), io::csv_number(iteration.step),
                           counts.open, counts.stick, counts.slipping, counts.closed));
}

}  // namespace osculate::result
