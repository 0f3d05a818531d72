#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "commands.hpp"
#include "osculate/api/tangent_check.hpp"
#include "osculate/result/result_folder.hpp"

namespace osculate::app {
namespace {

struct Flags {
  std::string model, folder;
  int threads = 1;
  int state = 0;
  std::vector<std::string> settings;
  bool json = false;
};

int tangent(const Flags& flags) {
  const api::TangentReport report = api::check_tangent(
      flags.model, flags.threads, flags.state, result::result_folder(flags.model, flags.folder),
      settings_of(flags.settings));
  print(flags.json ? stderr : stdout, "{}", api::to_text(report));
  if (flags.json) print(stdout, "{}\n", api::to_json(report));
  if (!flags.folder.empty()) {
    const std::string folder = result::choose_folder(flags.model, flags.folder);
    result::open_folder(folder, true);
    result::write_text(folder + "/tangent.json", api::to_json(report) + "\n");
  }
  const bool ok = std::all_of(report.rows.begin(), report.rows.end(),
                              [](const api::TangentRow& row) { return row.passed(); });
  return ok ? done : check_failed;
}

}  // namespace

void add_tangent(CLI::App& app, int& exit_code) {
  CLI::App* const command = app.add_subcommand(
      "tangent", "Check the assembled tangent against finite differences, by convergence order");
  auto flags = std::make_shared<Flags>();
  command->add_option("model", flags->model, "Model file (YAML)")->required();
  command->add_option("-o,--output", flags->folder,
                      "Result folder with checkpoints; also write tangent.json to it");
  command->add_option("--state", flags->state, "Converged increment (0 = initial)")
      ->check(CLI::Range(0, 1'000'000'000));
  command->add_option("--threads", flags->threads, "Threads for bodies and contact")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--json", flags->json, "Print JSON on stdout");
  add_settings(*command, flags->settings);
  command->callback([flags, &exit_code] { exit_code = tangent(*flags); });
}

}  // namespace osculate::app
