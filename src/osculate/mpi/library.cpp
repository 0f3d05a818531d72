// The processes that mpirun has started, and the solvers that they share: a library by itself,
// which the program loads where it was started so, and otherwise knows nothing of.
#include <dmumps_c.h>
#include <mpi.h>

#include <cstdlib>
#include <numeric>
#include <string_view>
#include <vector>

#include "osculate/la/shared_solvers.hpp"
#include "osculate/la/timed.hpp"

namespace osculate::mpi {
namespace {

class World final : public core::Ranks {
 public:
  World() {
    MPI_Comm_size(MPI_COMM_WORLD, &count_);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  }
  [[nodiscard]] int count() const override { return count_; }
  [[nodiscard]] int rank() const override { return rank_; }
  void sum(std::span<double> values) const override { reduce(values, MPI_SUM); }
  void largest(std::span<double> values) const override { reduce(values, MPI_MAX); }
  void spread(std::span<double> values, int from) const override {
    const la::Timed timed(seconds_);
    MPI_Bcast(values.data(), static_cast<int>(values.size()), MPI_DOUBLE, from, MPI_COMM_WORLD);
  }
  void spread(std::span<int> values, int from) const override {
    const la::Timed timed(seconds_);
    MPI_Bcast(values.data(), static_cast<int>(values.size()), MPI_INT, from, MPI_COMM_WORLD);
  }
  void gather(std::span<const int> mine, std::span<int> all) const override {
    const la::Timed timed(seconds_);
    const int size = static_cast<int>(mine.size());
    std::vector<int> sizes(static_cast<std::size_t>(count_)), starts(sizes.size());
    MPI_Gather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, 0, MPI_COMM_WORLD);
    std::exclusive_scan(sizes.begin(), sizes.end(), starts.begin(), 0);
    MPI_Gatherv(mine.data(), size, MPI_INT, all.data(), sizes.data(), starts.data(), MPI_INT, 0,
                MPI_COMM_WORLD);
  }
  void exchange(std::span<const double> values, std::span<const int> to, std::span<double> received,
                std::span<const int> from) const override {
    const la::Timed timed(seconds_);
    std::vector<MPI_Request> open;
    const auto each = [&](std::span<const int> counts, const auto& begin) {
      int at = 0;
      for (int p = 0; p < count_; at += counts[static_cast<std::size_t>(p++)])
        if (const int count = counts[static_cast<std::size_t>(p)]; count > 0)
          begin(p, at, count, &open.emplace_back());
    };
    each(from, [&](int p, int at, int count, MPI_Request* request) {
      MPI_Irecv(received.data() + at, count, MPI_DOUBLE, p, 0, MPI_COMM_WORLD, request);
    });
    each(to, [&](int p, int at, int count, MPI_Request* request) {
      MPI_Isend(values.data() + at, count, MPI_DOUBLE, p, 0, MPI_COMM_WORLD, request);
    });
    MPI_Waitall(static_cast<int>(open.size()), open.data(), MPI_STATUSES_IGNORE);
  }
  [[nodiscard]] double seconds() const override { return seconds_; }
  void finish() const override { MPI_Finalize(); }
  [[noreturn]] void end_all(int code) const override {
    MPI_Abort(MPI_COMM_WORLD, code);
    __builtin_unreachable();
  }

 private:
  void reduce(std::span<double> values, MPI_Op by) const {
    const la::Timed timed(seconds_);
    MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, by,
                  MPI_COMM_WORLD);
  }
  int count_ = 1, rank_ = 0;
  mutable double seconds_ = 0;  ///< one thread alone calls (MPI_THREAD_FUNNELED)
};

/// As mpirun of Open MPI says it.
bool on_one_machine() {
  const char* const all = std::getenv("OMPI_COMM_WORLD_SIZE");
  const char* const here = std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
  return all != nullptr && here != nullptr && std::string_view(all) == here;
}

/// What is sent within one machine goes through its memory. Open MPI would look for networks first,
/// for 0.2 s of each run. What the command line or the environment has chosen stays.
void begin_mpi() {
  constexpr const char* messages = "OMPI_MCA_pml";
  const bool by_memory = on_one_machine() && std::getenv(messages) == nullptr;
  if (by_memory) (void)setenv(messages, "ob1", 0);
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  if (by_memory) (void)unsetenv(messages);  // what this program starts is not told of it
}

void call_mumps(void* structure) { dmumps_c(static_cast<DMUMPS_STRUC_C*>(structure)); }

}  // namespace
}  // namespace osculate::mpi

extern "C" void osculate_begin_ranks(osculate::la::RanksLibrary& library) {
  osculate::mpi::begin_mpi();
  static const osculate::mpi::World world;
  library.ranks = &world;
  library.solvers.mumps = {osculate::mpi::call_mumps,
                           static_cast<int>(MPI_Comm_c2f(MPI_COMM_WORLD))};
}
