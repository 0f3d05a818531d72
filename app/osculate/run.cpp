#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <memory>

#include "commands.hpp"
#include "osculate/api/run.hpp"

namespace osculate::app {
namespace {

std::atomic<bool> interrupted{false};
/// The first ends the run after the iteration that is under way, the second at once.
void on_interrupt(int) {
  if (interrupted.exchange(true)) std::_Exit(analysis_stopped);
}

struct RunFlags {
  api::RunOptions options;
  bool json = false, quiet = false;
};

int run(RunFlags& flags) {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error of writing
  const bool terminal = isatty(STDERR_FILENO) != 0;
  if (!flags.quiet) {
    flags.options.say = [terminal](std::string_view text) {
      fmt::print(stderr, "{}{}\n", terminal ? "\r\033[K" : "", text);
    };
    flags.options.progress = [terminal](std::string_view text) {
      fmt::print(stderr, "{}{}{}", terminal ? "\r\033[K" : "", text, terminal ? "" : "\n");
      std::fflush(stderr);
    };
  }
  flags.options.interrupted = flags.options.abandoned = [] { return interrupted.load(); };
  const api::RunOutcome outcome = api::run(flags.options);
  if (flags.json) fmt::print("{}\n", outcome.summary_json);
  if (flags.quiet && outcome.status != api::RunStatus::done)
    fmt::print(stderr, "stopped: {}\n", outcome.message);
  return outcome.status == api::RunStatus::done ? done : analysis_stopped;
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  CLI::App* const command = app.add_subcommand("run", "Run the analysis of a model file");
  auto flags = std::make_shared<RunFlags>();
  command->add_option("model", flags->options.model, "Model file (YAML)")->required();
  command->add_option("-o,--output", flags->options.folder,
                      "Result folder (default: MODEL's stem + .results)");
  command->add_option("--threads", flags->options.threads, "Threads for assembly")
      ->check(CLI::Range(1, 1024));
  command->add_option("--until", flags->options.until, "Last step to run, inclusive");
  command->add_flag("--json", flags->json, "Print the summary as JSON on stdout");
  command->add_flag("--quiet", flags->quiet, "Print nothing but errors");
  command->add_flag("--restart", flags->options.restart,
                    "Go on from the last checkpoint in the result folder");
  command->callback([flags, &exit_code] { exit_code = run(*flags); });
}

}  // namespace osculate::app
