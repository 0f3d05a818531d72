#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <memory>

#include "../together.hpp"
#include "commands.hpp"
#include "osculate/api/run.hpp"

namespace osculate::app {
namespace {

std::atomic<bool> interrupted{false};
constexpr unsigned patience = 2;  ///< seconds

/// The first ends the run after the iteration that is under way, and where that takes its time
/// (a large factorisation) in the middle of it; the second at once. What has converged is in the
/// folder, and `--restart` goes on from there.
void on_interrupt(int) {
  if (interrupted.exchange(true)) std::_Exit(analysis_stopped);
  alarm(patience);
}
void on_alarm(int) {
  constexpr char text[] =
      "\nstopped in the middle of an iteration: everything that converged before is kept\n";
  if (write(STDERR_FILENO, text, sizeof text - 1) < 0) std::_Exit(analysis_stopped);
  std::_Exit(analysis_stopped);
}
/// Asked between two iterations.
bool was_interrupted() {
  if (!interrupted.load()) return false;
  alarm(0);  // the end of the run takes the time it takes
  return true;
}

/// What fits on one line of the terminal.
std::size_t line_width() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return known ? size.ws_col - 1U : 79U;
}

}  // namespace

api::RunOutcome run_until_interrupted(api::RunOptions& options) {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  std::signal(SIGALRM, on_alarm);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error of writing
  options.interrupted = options.abandoned = was_interrupted;
  return api::run(options);
}

namespace {

struct RunFlags {
  api::RunOptions options;
  std::vector<std::string> settings;
  bool json = false, quiet = false;
};

int run(RunFlags& flags) {
  flags.options.settings = settings_of(flags.settings);
  const bool terminal = isatty(STDERR_FILENO) != 0;
  flags.options.with_outlook = terminal;  // lines in a file are for scripts, too
  if (!flags.quiet) {
    flags.options.say = [terminal](std::string_view text) {
      print(stderr, "{}{}\n", terminal ? "\r\033[K" : "", text);
    };
    flags.options.progress = [terminal](std::string_view text) {
      if (terminal) text = text.substr(0, line_width());  // a longer one could not be replaced
      print(stderr, "{}{}{}", terminal ? "\r\033[K" : "", text, terminal ? "" : "\n");
      std::fflush(stderr);
    };
  }
  const api::RunOutcome outcome = run_until_interrupted(flags.options);
  if (flags.json) print(stdout, "{}\n", outcome.summary_json);
  if (flags.quiet && outcome.status != api::RunStatus::done)
    print(stderr, "stopped: {}\n", outcome.message);
  return outcome.status == api::RunStatus::done ? done : analysis_stopped;
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  CLI::App* const command = app.add_subcommand("run", "Run the analysis of a model file");
  auto flags = std::make_shared<RunFlags>();
  flags->options.threads = 0;
  command->add_option("model", flags->options.model, "Model file (YAML)")->required();
  command->add_option("-o,--output", flags->options.folder,
                      "Result folder (default: MODEL's stem + .results)");
  command
      ->add_option("--threads", flags->options.threads,
                   "Threads for bodies, contact and multigrid; results do not depend on them "
                   "(default: OMP_NUM_THREADS, else the processors there are, up to 4; small "
                   "models 1)")
      ->check(CLI::Range(1, 1024));
  command->add_option("--until", flags->options.until, "Last step to run, inclusive");
  command->add_flag("--json", flags->json, "Print the summary as JSON on stdout");
  command->add_flag("--quiet", flags->quiet, "Print nothing but errors");
  command->add_flag("--restart", flags->options.restart,
                    "Go on from the last checkpoint in the result folder");
  add_limits(*command, flags->options);
  add_settings(*command, flags->settings);
  command->callback([flags, &exit_code] {
    exit_code = join([&](const model::Together& together) {
      flags->options.together = together;
      return run(*flags);
    });
  });
}

}  // namespace osculate::app
