// The verification cases: started by `osculate verify`, or by itself.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "../../verification/case.hpp"
#include "../processes.hpp"
#include "../program.hpp"
#include "../together.hpp"
#include "osculate/core/error.hpp"
#include "osculate/core/text.hpp"
#include "osculate/core/version.hpp"
#include "osculate/io/atomic_file.hpp"

namespace osculate::app {
namespace {

using namespace verification;

struct VerifyOptions {
  std::vector<std::string> names;
  bool list = false, slow = false;
  std::string json, curves, plots;
  int threads = 1;
  model::Together together;  ///< processes that run the same cases
  int jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
};

/// verification/ beside the sources (build tree) or under share/ (installed).
std::string cases_folder() {
  namespace fs = std::filesystem;
  const fs::path here = program_folder();
  for (const fs::path& candidate : {here / "../share/osculate/verification",
                                    here / "../../../verification", fs::path("verification")})
    if (fs::is_directory(candidate)) return fs::weakly_canonical(candidate).string();
  throw core::InputError({},
                         "the folder of the verification cases was not found beside the program");
}

std::vector<const Case*> selected(const std::vector<Case>& all, const VerifyOptions& options) {
  std::vector<const Case*> cases;
  std::vector<std::string> known;
  for (const Case& c : all) known.push_back(c.name);
  for (const std::string& name : options.names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw core::InputError({}, core::unknown_name_message("verification case", name, known));
  for (const Case& c : all) {
    const bool named =
        std::find(options.names.begin(), options.names.end(), c.name) != options.names.end();
    if (named || (options.names.empty() && (options.slow || !c.slow))) cases.push_back(&c);
  }
  return cases;
}

void create_folder(const std::string& folder) {
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) throw io::WriteError(folder, "cannot create folder", error.value());
}

void write_curves(const std::string& folder, const Case& c, const CaseResult& result) {
  if (folder.empty()) return;
  for (const Curve& curve : result.curves) {
    std::string text = fmt::format("{}\n", fmt::join(curve.columns, ","));
    for (const auto& row : curve.rows) text += fmt::format("{:.10g}\n", fmt::join(row, ","));
    io::write_file(folder + "/" + c.name + "." + curve.name + ".csv", text);
  }
}

void write_plots(const std::string& folder, const Case& c, const CaseResult& result) {
  if (folder.empty()) return;
  for (const Picture& picture : result.pictures)
    io::write_file(folder + "/" + c.name + "." + picture.name + ".svg", io::plot_svg(picture.plot));
  for (const Drawing& drawing : result.drawings)
    io::write_file(folder + "/" + c.name + "." + drawing.name + ".svg",
                   io::scene_svg(drawing.scene));
}

std::string row_text(const Row& row) {
  const std::string_view judged =
      row.relation == Relation::info ? "info" : (passes(row) ? "ok" : "FAIL");
  return fmt::format("  {:<58} {:>13.6g} {} {:>11.6g}  {:>10.2e}  {:>4}  {}\n", row.quantity,
                     row.computed, relation_text(row.relation), row.reference, deviation(row),
                     judged, row.source);
}

nlohmann::json row_json(const Case& c, const Row& row) {
  const auto number = [](double v) {
    return std::isfinite(v) ? nlohmann::json(v) : nlohmann::json(nullptr);
  };
  return {{"case", c.name},
          {"quantity", row.quantity},
          {"computed", number(row.computed)},
          {"reference", number(row.reference)},
          {"relation", relation_text(row.relation)},
          {"deviation", number(deviation(row))},
          {"tolerance", row.tolerance},
          {"pass", passes(row)},
          {"source", row.source}};
}

/// A case without an answer of its own fails with this sentence.
Row failure(std::string sentence) { return {std::move(sentence), 1, 0, Relation::equal, 0, ""}; }

/// What is printed of a case, and its rows: {"text", "rows"}.
nlohmann::json answer(const Case& c, const CaseResult& result, double seconds) {
  std::string text = fmt::format("{}: {}\n", c.name, c.requirement);
  nlohmann::json rows = nlohmann::json::array();
  for (const Row& row : result.rows) {
    text += row_text(row);
    rows.push_back(row_json(c, row));
  }
  text += fmt::format("  ({:.1f} s)\n", seconds);
  return {{"text", std::move(text)}, {"rows", std::move(rows)}};
}

nlohmann::json run_case(const Case& c, const VerifyOptions& options, const std::string& folder) {
  const auto start = std::chrono::steady_clock::now();
  CaseResult result;
  try {
    result = c.run({folder + "/" + c.name, {options.threads, options.together}});
  } catch (const std::exception& error) {
    const bool of_all = dynamic_cast<const core::InputError*>(&error) ||
                        dynamic_cast<const la::NotEnoughMemory*>(&error);
    if (options.together.ranks && !of_all) throw;
    result.rows.push_back(failure(fmt::format("case ended with: {}", error.what())));
  }
  if (result.rows.empty()) result.rows.push_back(failure("the case gave no row at all"));
  write_curves(options.curves, c, result);
  write_plots(options.plots, c, result);
  return answer(c, result,
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

int verify(const VerifyOptions& options) {
  const std::string folder = cases_folder();
  const std::vector<Case> all = all_cases(folder);
  if (options.list) {
    for (const Case& c : all)
      print(stdout, "{:<28} {}{}\n", c.name, c.requirement, c.slow ? " (--long)" : "");
    return done;
  }
  const std::vector<const Case*> cases = selected(all, options);
  create_folder(options.curves);
  create_folder(options.plots);
  std::optional<io::AtomicFile> json;  // what cannot be written is told of before, not after hours
  if (!options.json.empty()) json.emplace(options.json);
  nlohmann::json out = nlohmann::json::array();
  int passed = 0, failed = 0, shown = 0;
  const auto take = [&](std::size_t i, const ProcessEnd& end) {
    nlohmann::json said = nlohmann::json::parse(end.said, nullptr, false);
    if (!end.fault.empty() || said.is_discarded())
      said = answer(*cases[i], {{failure("case ended with: " + end.fault)}, {}, {}, {}}, 0);
    print(stdout, "{}", said["text"].get<std::string>());
    std::fflush(stdout);
    for (nlohmann::json& row : said["rows"]) {
      if (row["relation"] == relation_text(Relation::info))
        ++shown;
      else
        ++(row["pass"].get<bool>() ? passed : failed);
      out.push_back(std::move(row));
    }
  };
  std::map<std::size_t, ProcessEnd> ended;  // those behind one that is still under way
  std::size_t next = 0;
  const auto work = [&](std::size_t i) { return run_case(*cases[i], options, folder).dump(); };
  if (options.together.ranks)
    for (std::size_t i = 0; i < cases.size(); ++i) take(i, {work(i), ""});
  else
    run_processes(cases.size(), options.jobs, work, [&](std::size_t i, const ProcessEnd& end) {
      for (ended.emplace(i, end); ended.contains(next); ++next) take(next, ended.at(next));
    });
  if (json) {
    json->write(out.dump(1) + "\n");
    json->commit();
  }
  print(stdout, "verify: {} passed, {} failed, {} info\n", passed, failed, shown);
  return failed == 0 ? done : check_failed;
}

int run_program(int argc, char** argv) {
  CLI::App app{
      "Osculate's verification cases: computed | reference | deviation | tolerance | source",
      "osculate verify"};
  app.set_version_flag("--version", fmt::format("osculate-verify {}", core::version));
  VerifyOptions options;
  app.add_option("name", options.names, "Cases to run (default: all but the long ones)");
  app.add_flag("--list", options.list, "List the cases");
  app.add_flag("--long", options.slow, "Include the long cases");
  app.add_option("--json", options.json, "Also write the table to this file");
  app.add_option("--curves", options.curves, "Write the curves of the cases as CSV to this folder");
  app.add_option("--plots", options.plots, "Write the plots of the cases as SVG to this folder");
  app.add_option("--threads", options.threads, "Threads for bodies, contact and multigrid");
  app.add_option("--jobs", options.jobs, "Cases that run at the same time")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? done : after_the_first(bad_input);
  }
  return join([&](const model::Together& together) {
    options.together = together;
    if (together.ranks && together.ranks->rank() > 0)  // the first one writes
      options.json = options.curves = options.plots = "";
    return verify(options);
  });
}

}  // namespace
}  // namespace osculate::app

int main(int argc, char** argv) {
  osculate::app::let_the_first_speak();
  return osculate::app::guarded(osculate::app::run_program, argc, argv);
}
