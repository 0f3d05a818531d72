#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <new>

#include "commands.hpp"
#include "osculate/core/error.hpp"
#include "osculate/core/version.hpp"
#include "osculate/io/atomic_file.hpp"

namespace osculate::app {

std::string program_folder() {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? std::string(".") : self.parent_path().string();
}

}  // namespace osculate::app

namespace {

bool cpu_supported() {
#if defined(__AVX2__) && defined(__x86_64__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return true;
#endif
}

int run_program(int argc, char** argv) {
  using namespace osculate::app;
  CLI::App app{"Osculate: contact mechanics in the coordinates of the master surface", "osculate"};
  app.set_version_flag("--version",
                       std::string("osculate ") + std::string(osculate::core::version));
  app.require_subcommand(1);
  int exit_code = done;
  add_run(app, exit_code);
  add_check(app, exit_code);
  add_tangent(app, exit_code);
  add_verify(app, exit_code);
  add_project(app, exit_code);
  add_report(app, exit_code);
  add_schema(app, exit_code);
  add_doc(app, exit_code);
  add_domain(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? done : bad_input;
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace osculate::app;
  if (!cpu_supported()) {
    std::fputs(
        "osculate: this build needs a CPU with AVX2 and FMA (x86-64-v3); configure with "
        "-DOSCULATE_BASELINE=ON for older ones\n",
        stderr);
    return defect;
  }
  try {
    return run_program(argc, argv);
  } catch (const osculate::core::InputError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return bad_input;
  } catch (const osculate::io::WriteError& error) {
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
