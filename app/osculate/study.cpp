#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "../processes.hpp"
#include "commands.hpp"
#include "osculate/core/error.hpp"
#include "osculate/core/version.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/io/atomic_file.hpp"
#include "osculate/result/result_folder.hpp"
#include "study_table.hpp"

namespace osculate::app {
namespace {

namespace fs = std::filesystem;

volatile std::sig_atomic_t study_interrupts = 0;
void count_interrupt(int) { study_interrupts = study_interrupts + 1; }

struct StudyFlags {
  api::RunOptions run;
  std::string folder;
  std::vector<std::string> values, columns;
  bool together = false, list = false, again = false, quiet = false;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
};

struct StudyRun {
  std::string name, folder;
  bool done = false;  ///< by an earlier study, of the same model, meshes, parameters and program
};

bool is_done(const std::string& folder, const deck::Description& description,
             const std::string& content) {
  const std::string file = folder + "/summary.json";
  if (!fs::exists(file) || !fs::exists(folder + "/history.csv")) return false;
  const nlohmann::json summary = nlohmann::json::parse(result::read_text(file), nullptr, false);
  nlohmann::json parameters;
  for (const deck::Setting& parameter : description.parameters)
    parameters[parameter.name] = parameter.value;
  return summary.is_object() && summary.value("status", "") == "done" &&
         summary.value("model_content", "") == content &&
         summary.value("osculate", "") == core::version &&
         summary.value("parameters", nlohmann::json()) == parameters &&
         summary.value("mesh_contents", nlohmann::json::object()) ==
             result::mesh_contents(description.mesh);
}

/// Reads the model with the values of each run, so that bad ones are told of before the first.
std::vector<StudyRun> planned(const StudyFlags& flags, const std::vector<Point>& points) {
  constexpr std::size_t longest_name = 200;
  const std::string content = result::owner_json(flags.run.model).at("model_content");
  std::vector<StudyRun> runs;
  std::set<std::string> names;
  for (const Point& point : points) {
    StudyRun run{name_of(point), {}, false};
    run.folder = flags.folder + "/" + run.name;
    if (run.name.size() > longest_name || !names.insert(run.name).second)
      throw core::InputError({}, fmt::format("'{}' cannot be the name of a folder: it is too long, "
                                             "or that of two runs",
                                             run.name));
    try {
      const deck::Description description = deck::read_model(flags.run.model, point);
      (void)result::choose_folder(flags.run.model, run.folder);
      run.done = !flags.again && is_done(run.folder, description, content);
    } catch (const core::InputError& error) {
      throw core::InputError({}, fmt::format("{}: {}", run.name, error.what()));
    }
    runs.push_back(std::move(run));
  }
  return runs;
}

/// The columns that a run will write. Asked in a process of its own: this one starts no threads,
/// since what is forked from it would not have them.
std::vector<std::string> columns_of(const std::string& model, const Point& point) {
  nlohmann::json said;
  const auto ask = [&](std::size_t) -> std::string {
    try {
      return api::check(model, point).json;
    } catch (const core::InputError& error) {
      return nlohmann::json{{"refused", error.what()}}.dump();
    }
  };
  run_processes(1, 1, ask, [&](std::size_t, const ProcessEnd& end) {
    if (!end.fault.empty())
      throw core::InputError({}, fmt::format("the check of the model ended with {}", end.fault));
    said = nlohmann::json::parse(end.said);
  });
  if (said.contains("refused")) throw core::InputError({}, said["refused"].get<std::string>());
  return said.at("history");
}

/// One run, in a process of its own; what was wrong with it as text.
std::string do_run(const StudyFlags& flags, const Point& point, const std::string& folder) {
  api::RunOptions options = flags.run;
  options.folder = folder;
  options.settings = point;
  // of signals that came before those of a run are heeded
  options.converged = [](const api::LiveIncrement&) { return study_interrupts == 0; };
  try {
    (void)run_until_interrupted(options);
    return {};
  } catch (const std::exception& error) {
    return error.what();
  }
}

void write_summary(const StudyFlags& flags, const StudyTable& table, const char* status) {
  nlohmann::json summary = result::owner_json(flags.run.model);
  summary["status"] = status;
  summary["runs"] = table.points.size();
  summary["done"] = std::ranges::count(table.rows, "done", &StudyRow::status);
  result::write_text(flags.folder + "/summary.json", result::json_text(summary, 1) + "\n");
}

void say(const StudyRun& run, const StudyTable& table, const StudyRow& row) {
  const auto ended =
      std::ranges::count_if(table.rows, [](const StudyRow& r) { return !r.status.empty(); });
  print(stderr, "{} of {}  {}: {}, {} iterations, {:.1f} s\n", ended, table.rows.size(), run.name,
        row.status, row.iterations, row.seconds);
}

/// Runs what is not done, and writes the table after each.
int run_all(const StudyFlags& flags, const std::vector<StudyRun>& runs, StudyTable& table) {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (runs[i].done)
      table.rows[i] = row_of(runs[i].folder, "", table.outputs);
    else
      open.push_back(i);
  if (open.size() < runs.size() && !flags.quiet)
    print(stderr, "{} of {} are done already\n", runs.size() - open.size(), runs.size());
  write_table(table, flags.folder);
  std::signal(SIGINT, count_interrupt);
  std::signal(SIGTERM, count_interrupt);
  run_processes(
      open.size(), flags.jobs,
      [&](std::size_t k) { return do_run(flags, table.points[open[k]], runs[open[k]].folder); },
      [&](std::size_t k, const ProcessEnd& end) {
        StudyRow& row = table.rows[open[k]];
        row = row_of(runs[open[k]].folder, end.fault.empty() ? end.said : end.fault, table.outputs);
        write_table(table, flags.folder);
        if (!flags.quiet) say(runs[open[k]], table, row);
      },
      [] { return static_cast<int>(study_interrupts); });
  const bool all = std::ranges::all_of(table.rows, [](const StudyRow& r) {  //
    return r.status == "done";
  });
  write_summary(flags, table, all ? "done" : "stopped");
  if (study_interrupts != 0)
    print(stderr, "interrupted: the same command does the runs that are left\n");
  if (!flags.quiet) print(stderr, "{}/table.csv\n", flags.folder);
  return all ? done : analysis_stopped;
}

int study(StudyFlags& flags) {
  if (flags.folder.empty()) flags.folder = fs::path(flags.run.model).stem().string() + ".study";
  flags.folder = result::choose_folder(flags.run.model, flags.folder);
  if (fs::exists(flags.folder + "/history.csv"))
    throw core::InputError({}, fmt::format("folder '{}' holds the results of a run; name another "
                                           "one with -o",
                                           flags.folder));
  StudyTable table;
  table.title = fs::path(flags.run.model).filename().string();
  table.ranges = ranges_of(settings_of(flags.values));
  table.points = points_of(table.ranges, flags.together);
  table.rows.resize(table.points.size());
  const std::vector<StudyRun> runs = planned(flags, table.points);
  table.outputs = outputs_of(flags.columns, columns_of(flags.run.model, table.points.front()));
  check_headings(table);
  if (flags.list) {
    for (const StudyRun& run : runs) print(stdout, "{}{}\n", run.name, run.done ? "  done" : "");
    return done;
  }
  const result::FolderLock lock(flags.folder, true);
  write_summary(flags, table, "running");
  return run_all(flags, runs, table);
}

}  // namespace

void add_study(CLI::App& app, int& exit_code) {
  CLI::App* const command = app.add_subcommand(
      "study", "Run a model for many values of its parameters: a table, and a plot an output");
  auto flags = std::make_shared<StudyFlags>();
  command->add_option("model", flags->run.model, "Model file (YAML)")->required();
  command
      ->add_option("--set", flags->values,
                   "NAME=VALUES of `parameters` of the model file: 0.1,0.2 or from:to:count or "
                   "from:to:count:log; again for more, all combinations of which are run")
      ->required()
      ->allow_extra_args(false);
  command->add_flag("--together", flags->together,
                    "The first values of all parameters, then the second ones, ...");
  command
      ->add_option("--column", flags->columns,
                   "Output of a run: a column of history.csv, its last value, or with max: or min: "
                   "before it; again for more (default: all columns)")
      ->allow_extra_args(false);
  command->add_option("-o,--output", flags->folder,
                      "Folder of the study (default: MODEL's stem + .study)");
  command->add_option("-j,--jobs", flags->jobs, "Runs at the same time (default: one a processor)")
      ->check(CLI::Range(1, 1024));
  command->add_option("--threads", flags->run.threads, "Threads of each run")
      ->check(CLI::Range(1, 1024));
  add_limits(*command, flags->run);
  command->add_flag("--again", flags->again, "Do also what is done already");
  command->add_flag("--list", flags->list, "Print the runs, and which are done; run nothing");
  command->add_flag("--quiet", flags->quiet, "Print nothing but errors");
  command->callback([flags, &exit_code] { exit_code = study(*flags); });
}

}  // namespace osculate::app
