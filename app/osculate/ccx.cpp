#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "commands.hpp"
#include "osculate/core/error.hpp"
#include "osculate/core/version.hpp"
#include "osculate/io/atomic_file.hpp"
#include "osculate/io/gmsh.hpp"
#include "osculate/io/inp/cards.hpp"

// `osculate ccx` is called as CalculiX's solver is, and answers as that does: files beside the
// deck, messages on standard output, exit code 0 or 201.
namespace osculate::app {
namespace {

constexpr int ccx_error = 201;
constexpr const char* line = "________________________________________";

struct Flags {
  std::string job, other_job;
  bool version = false;
};

/// As CalculiX takes it from the environment; 1 where nothing is said.
int threads() {
  for (const char* const name :
       {"CCX_NPROC_STIFFNESS", "CCX_NPROC_EQUATION_SOLVER", "OMP_NUM_THREADS"})
    if (const char* const text = std::getenv(name))
      if (const int number = std::atoi(text); number > 0) return std::min(number, 1024);
  return 1;
}

api::RunOutcome run_job(const std::string& job) {
  api::RunOptions options;
  options.model = job + ".inp";
  options.folder = job + ".results";
  options.answers = job;
  options.threads = threads();
  options.say = options.progress = [](std::string_view text) {
    print(stdout, " {}\n", text);
    std::fflush(stdout);
  };
  return run_until_interrupted(options);
}

/// JOBNAME.rout, where the deck asks for it by `*RESTART, WRITE` and anything was solved.
void write_restart(const std::string& job) {
  const std::string content = io::read_file(job + ".inp");
  const io::inp::Deck deck = io::inp::read_cards(content, job + ".inp");
  const auto writes = [](const io::inp::Card& card) {
    return card.keyword == "RESTART" && io::inp::find_parameter(card, "WRITE");
  };
  const auto solves_nothing = [](const io::inp::Card& card) {
    return card.keyword == "NOANALYSIS";
  };
  if (std::none_of(deck.cards.begin(), deck.cards.end(), writes)) return;
  if (std::any_of(deck.cards.begin(), deck.cards.end(), solves_nothing)) return;
  io::AtomicFile file(job + ".rout");
  file.write(io::inp::restart_text(deck));
  file.commit();
}

int solve(std::string job) {
  const auto start = std::chrono::steady_clock::now();
  if (job.ends_with(".inp")) job.erase(job.rfind(".inp"));
  print(stdout, "\nOsculate {}, called as CalculiX 2.20 is\n\n", core::version);
  std::string error;
  try {
    const api::RunOutcome outcome = run_job(job);
    if (outcome.status != api::RunStatus::done) error = outcome.message;
    if (error.empty()) write_restart(job);
  } catch (const core::InputError& input) {
    error = input.what();
  } catch (const io::WriteError& file) {
    error = file.what();
  }
  if (!error.empty()) {
    print(stdout, "\n *ERROR: {}\n\n", error);
    return ccx_error;
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  print(stdout, "\n Job finished\n\n{}\n\nTotal Osculate Time: {:.6f}\n{}\n\n", line,
        seconds.count(), line);
  return done;
}

int ccx(const Flags& flags) {
  if (flags.version) {
    print(stdout, "\nThis is Version 2.20 of the files of CalculiX, written by Osculate {}\n\n",
          core::version);
    return ccx_error;
  }
  // FreeCAD says "-i ", whose blank is taken for the name
  const bool named = flags.job.find_first_not_of(' ') != std::string::npos;
  const std::string& job = named ? flags.job : flags.other_job;
  if (!job.empty()) return solve(job);
  print(stdout, "Usage: CalculiX.exe -i jobname (here: osculate ccx -i jobname)\n");
  return ccx_error;
}

}  // namespace

void add_ccx(CLI::App& app, int& exit_code) {
  CLI::App* const command = app.add_subcommand(
      "ccx", "Run JOBNAME.inp as CalculiX does: JOBNAME.frd, .dat, .sta and .cvg beside it");
  auto flags = std::make_shared<Flags>();
  command->add_option("-i", flags->job, "Name of the deck without .inp");
  command->add_option("jobname", flags->other_job, "The same without -i");
  command->add_flag("-v", flags->version, "Print a line with the version, as CalculiX does");
  command->callback([flags, &exit_code] { exit_code = ccx(*flags); });
}

}  // namespace osculate::app
