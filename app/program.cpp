#include "program.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <new>

#include "osculate/core/memory.hpp"
#include "osculate/core/processor.hpp"

namespace osculate::app {
namespace {

bool cpu_supported() {
#if defined(__AVX2__) && defined(__x86_64__)
  return core::has_avx2();
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

int report(const core::InputError& error) {
  print(stderr, "error: {}\n", error.what());
  return bad_input;
}
int report(const io::WriteError& error) {
  print(stderr, "stopped: {}; what was written before is kept\n", error.what());
  return analysis_stopped;
}

namespace {

/// A stream that is closed fails when it is written to: no file of the program takes its place, to
/// be written into by messages. A pipe that is closed is an error of writing, too.
void prepare_streams() {
  std::signal(SIGPIPE, SIG_IGN);
  for (int stream = 0; stream < 3; ++stream)
    if (::fcntl(stream, F_GETFD) < 0)
      (void)::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

int after_printing(int code) {
  const bool lost = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  if (lost) print(stderr, "stopped: standard output cannot be written\n");
  return code == done && (lost || std::ferror(stderr) != 0) ? analysis_stopped : code;
}

int code_of(int (*program)(int argc, char** argv), int argc, char** argv) {
  try {
    return program(argc, argv);
  } catch (const core::InputError& error) {
    return report(error);
  } catch (const io::WriteError& error) {
    return report(error);
  } catch (const std::bad_alloc& error) {
    print(stderr, "stopped: {}; what was written before is kept\n",
          core::out_of_memory_text(error));
    std::fflush(stdout);
    std::_Exit(
        analysis_stopped);  // the threads of libraries that wait for memory are not waited for
  } catch (const std::exception& error) {
    print(stderr, "osculate: internal error, please report it with your input: {}\n", error.what());
    return defect;
  }
}

}  // namespace

int guarded(int (*program)(int argc, char** argv), int argc, char** argv) {
  prepare_streams();
  if (!cpu_supported()) {
    print(stderr,
          "osculate: this build needs a CPU with AVX2 and FMA (x86-64-v3); configure with "
          "-DOSCULATE_BASELINE=ON for older ones\n");
    return defect;
  }
  return after_printing(code_of(program, argc, argv));
}

}  // namespace osculate::app
