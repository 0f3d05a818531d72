#include "osculate/result/iteration_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "osculate/io/csv.hpp"

namespace osculate::result {
namespace {

std::string iterations_path(const std::string& folder) { return folder + "/iterations.csv"; }

std::uint64_t iterations_kept(const std::string& folder, bool go_on) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(iterations_path(folder), error);
  return error || !go_on ? 0 : size;
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
