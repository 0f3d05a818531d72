#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <memory>

#include "commands.hpp"
#include "osculate/api/project.hpp"
#include "osculate/io/atomic_file.hpp"

namespace osculate::app {
namespace {

std::atomic<bool> interrupted{false};
void on_interrupt(int) { interrupted = true; }

int project(api::ProjectOptions& options) {
  keep_inputs({options.output}, {options.surface, options.points});
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const char* const clear = terminal ? "\r\033[K" : "";
  options.say = [clear](std::string_view text) { print(stderr, "{}{}\n", clear, text); };
  if (terminal)
    options.progress = [clear](std::string_view text) {
      print(stderr, "{}{}", clear, text);
      std::fflush(stderr);
    };
  options.interrupted = [] { return interrupted.load(); };
  try {
    const api::ProjectOutcome outcome = api::project(options);
    print(stderr, "{}{}\n", clear, outcome.message);
    return outcome.complete ? done : analysis_stopped;
  } catch (const io::WriteError& error) {
    print(stderr, "{}stopped: {}\n", clear, error.what());
    return analysis_stopped;
  }
}

}  // namespace

void add_project(CLI::App& app, int& exit_code) {
  CLI::App* const command = app.add_subcommand(
      "project", "Closest points of a surface or curve: which facet, how far, is it unique");
  auto options = std::make_shared<api::ProjectOptions>();
  command
      ->add_option("surface", options->surface,
                   "Surface: YAML or JSON (docs/project.md), mesh.msh:set, or mesh.msh")
      ->required();
  command->add_option("points", options->points, "CSV with the columns x, y and, in space, z")
      ->required();
  command->add_option("-o,--output", options->output,
                      "CSV to write when it is whole (default: standard output)");
  command->add_flag("--fast", options->fast, "Without proof and without margin");
  command->add_option("--threads", options->threads, "Threads; the output does not depend on them")
      ->check(CLI::Range(1, 1024));
  command->callback([options, &exit_code] { exit_code = project(*options); });
}

}  // namespace osculate::app
