#include "together.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "osculate/core/error.hpp"
#include "osculate/core/memory.hpp"
#include "program.hpp"

namespace osculate::app {
namespace {

/// As Open MPI, MPICH (hydra) and Slurm tell those that they start.
int processes_started() {
  for (const char* const name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* const text = std::getenv(name)) return std::atoi(text);
  const char* const of_slurm = std::getenv("SLURM_STEP_NUM_TASKS");
  return of_slurm && std::getenv("SLURM_MPI_TYPE") ? std::atoi(of_slurm) : 1;
}

core::RanksLibrary begin(int processes) {
  const std::string path =
      program_folder() + "/" OSCULATE_LIBRARIES_FROM_PROGRAM "/libosculate-mpi.so";
  if (!std::filesystem::exists(path))
    throw core::InputError(
        {}, fmt::format("started as {} processes, but this build is for one: build it with "
                        "'-D OSCULATE_MPI=ON', or start it without mpirun",
                        processes));
  // Open MPI's parts look for its symbols among all that are loaded, and it does not bear
  // unloading.
  void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_GLOBAL | RTLD_NODELETE);
  void* const found = library ? dlsym(library, core::begin_ranks) : nullptr;
  if (!found) {
    const char* const why = dlerror();
    throw core::InputError({}, fmt::format("cannot load '{}': {}", path, why ? why : ""));
  }
  core::RanksLibrary out;
  reinterpret_cast<void (*)(core::RanksLibrary&)>(found)(out);
  return out;
}

}  // namespace

Joined::Joined() {
  const int processes = processes_started();
  if (processes <= 1) return;
  const core::RanksLibrary library = begin(processes);
  together_ = {library.ranks, {library.mumps, library.communicator}};
  if (library.ranks->rank() == 0) return;
  voice_ = ::dup(STDERR_FILENO);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  ::close(nowhere);
}

Joined::~Joined() {
  if (together_.ranks) together_.ranks->finish();
}

void Joined::end_all(const std::exception& why) const {
  if (!together_.ranks) return;
  const auto* const memory = dynamic_cast<const std::bad_alloc*>(&why);
  const std::string text =
      fmt::format("stopped: process {} cannot go on: {}; what was written before is kept\n",
                  together_.ranks->rank(), memory ? core::out_of_memory_text(*memory) : why.what());
  if (::write(voice_, text.data(), text.size()) < 0) together_.ranks->end_all(defect);
  together_.ranks->end_all(memory ? analysis_stopped : defect);
}

}  // namespace osculate::app
