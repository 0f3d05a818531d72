#include "program.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <new>

#include "osculate/core/error.hpp"
#include "osculate/io/atomic_file.hpp"

namespace osculate::app {
namespace {

bool cpu_supported() {
#if defined(__AVX2__) && defined(__x86_64__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return true;
#endif
}

}  // namespace

std::string program_folder() {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? std::string(".") : self.parent_path().string();
}

int guarded(int (*program)(int argc, char** argv), int argc, char** argv) {
  if (!cpu_supported()) {
    std::fputs(
        "osculate: this build needs a CPU with AVX2 and FMA (x86-64-v3); configure with "
        "-DOSCULATE_BASELINE=ON for older ones\n",
        stderr);
    return defect;
  }
  try {
    return program(argc, argv);
  } catch (const core::InputError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return bad_input;
  } catch (const io::WriteError& error) {
    fmt::print(stderr, "stopped: {}; what was written before is kept\n", error.what());
    return analysis_stopped;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "error: not enough memory for this model\n");
    return bad_input;
  } catch (const std::exception& error) {
    fmt::print(stderr, "osculate: internal error, please report it with your input: {}\n",
               error.what());
    return defect;
  }
}

}  // namespace osculate::app
