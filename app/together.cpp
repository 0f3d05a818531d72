#include "together.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <thread>
#include <vector>

#include "osculate/api/agree.hpp"
#include "osculate/core/error.hpp"
#include "osculate/core/memory.hpp"
#include "program.hpp"

namespace osculate::app {
namespace {

int number_in(std::initializer_list<const char*> names, int otherwise) {
  for (const char* const name : names)
    if (const char* const text = std::getenv(name)) return std::atoi(text);
  return otherwise;
}

/// As Open MPI, MPICH (hydra) and Slurm (srun --mpi=...) tell those that they start.
int processes_started() {
  if (number_in({"OSCULATE_ALONE"}, 0) != 0) return 1;
  const bool by_slurm = std::getenv("PMIX_RANK") || std::getenv("PMI_RANK");
  const int by_mpirun = number_in({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}, 1);
  return by_slurm && by_mpirun <= 1 ? number_in({"SLURM_STEP_NUM_TASKS"}, 1) : by_mpirun;
}

/// Where this process can be heard, silenced or not.
int voice() {
  static const int fd = [] {
    if (processes_started() <= 1 ||
        number_in({"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"}, 0) == 0)
      return STDERR_FILENO;
    const int kept = ::dup(STDERR_FILENO);
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
    ::close(nowhere);
    return kept;
  }();
  return fd;
}

la::RanksLibrary begin(int processes) {
  const std::string path =
      program_folder() + "/" OSCULATE_LIBRARIES_FROM_PROGRAM "/libosculate-mpi.so";
  if (!std::filesystem::exists(path))
    throw core::InputError(
        {}, fmt::format("started as {} processes, but this build is for one: build it with "
                        "'-D OSCULATE_MPI=ON', or start it without mpirun (OSCULATE_ALONE=1 in the "
                        "environment: each runs by itself)",
                        processes));
  // Open MPI's parts look for its symbols among all that are loaded, and it does not bear
  // unloading.
  void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_GLOBAL | RTLD_NODELETE);
  void* const found = library ? dlsym(library, la::begin_ranks) : nullptr;
  if (!found) {
    const char* const why = dlerror();
    throw core::InputError({}, fmt::format("cannot load '{}': {}", path, why ? why : ""));
  }
  la::RanksLibrary out;
  reinterpret_cast<void (*)(la::RanksLibrary&)>(found)(out);
  return out;
}

/// The program and the libraries of Osculate beside it.
std::vector<std::string> files_of_program() {
  std::vector<std::string> files;
  std::error_code error;
  const std::filesystem::directory_iterator all(
      program_folder() + "/" OSCULATE_LIBRARIES_FROM_PROGRAM, error);
  for (const std::filesystem::directory_entry& entry : all)
    if (entry.path().filename().string().starts_with("libosculate") && entry.is_regular_file(error))
      files.push_back(entry.path().string());
  std::ranges::sort(files, {}, [](const std::string& path) {
    return std::filesystem::path(path).filename().string();
  });
  files.insert(files.begin(), "/proc/self/exe");
  return files;
}

/// Of the bytes of these files (FNV-1a, eight at a time), as numbers that a double has exactly.
std::array<double, 2> mark_of_program() {
  std::vector<std::uint64_t> words(std::size_t{1} << 15);
  const auto bytes = static_cast<std::streamsize>(words.size() * sizeof(words[0]));
  std::uint64_t mark = 14695981039346656037U;
  for (const std::string& path : files_of_program()) {
    std::ifstream file(path, std::ios::binary);
    do {
      std::ranges::fill(words, 0);
      file.read(reinterpret_cast<char*>(words.data()), bytes);
      for (const std::uint64_t word : words) mark = (mark ^ word) * 1099511628211U;
    } while (file);
  }
  return {static_cast<double>(mark >> 32U), static_cast<double>(mark & 0xffffffffU)};
}

[[noreturn]] void end_all(const core::Ranks& ranks, const std::string& why, int code) {
  const std::string text = fmt::format(
      "stopped: process {} cannot go on: {}; what was written before is kept\n", ranks.rank(), why);
  const bool heard = ::write(voice(), text.data(), text.size()) >= 0;
  ranks.end_all(heard ? code : defect);
  std::abort();
}

}  // namespace

void let_the_first_speak() { (void)voice(); }

bool is_alone(const std::string& command) {
  if (processes_started() <= 1) return true;
  (void)report(core::InputError(
      {}, fmt::format("'osculate {}' is for one process: start it without mpirun", command)));
  return false;
}

int after_the_first(int code) {
  if (voice() != STDERR_FILENO) std::this_thread::sleep_for(std::chrono::seconds(1));
  return code;
}

int join(const std::function<int(const model::Together&)>& part) {
  const int processes = processes_started();
  if (processes <= 1) return part({});
  la::RanksLibrary library = begin(processes);
  double& fewest = library.solvers.mumps.fewest_entries;
  if (const char* const text = std::getenv("OSCULATE_SHARE_FROM")) fewest = std::atof(text);
  const core::Ranks& ranks = *library.ranks;
  const bool same = ranks.agree_on(mark_of_program());
  ranks.spread({&fewest, 1}, 0);  // other machines need not have it in their environment
  // All is said before they part: mpirun kills the others when the first one has ended badly.
  const auto part_with = [&](int code) {
    std::fflush(stdout);
    ranks.finish();
    return code;
  };
  try {
    if (!same)
      throw core::InputError({},
                             "the processes are not of the same program: install the same "
                             "build of Osculate wherever they are started");
    return part_with(part({&ranks, library.solvers}));
  } catch (const core::InputError& error) {  // of all processes
    return part_with(report(error));
  } catch (const io::WriteError& error) {
    return part_with(report(error));
  } catch (const api::OneAlone& error) {
    end_all(ranks, error.what(), analysis_stopped);
  } catch (const std::bad_alloc& error) {
    end_all(ranks, core::out_of_memory_text(error), analysis_stopped);
  } catch (const std::exception& error) {
    end_all(ranks, error.what(), defect);
  }
}

}  // namespace osculate::app
