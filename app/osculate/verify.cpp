#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../../verification/case.hpp"
#include "commands.hpp"
#include "osculate/core/error.hpp"
#include "osculate/core/text.hpp"
#include "osculate/io/atomic_file.hpp"

namespace osculate::app {
namespace {

using namespace verification;

struct VerifyOptions {
  std::vector<std::string> names;
  bool list = false, slow = false;
  std::string json, curves, plots;
  int threads = 1;
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

std::vector<const Case*> selected(const VerifyOptions& options) {
  std::vector<const Case*> cases;
  std::vector<std::string> known;
  for (const Case& c : all_cases()) known.emplace_back(c.name);
  for (const std::string& name : options.names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw core::InputError({}, core::unknown_name_message("verification case", name, known));
  for (const Case& c : all_cases()) {
    const bool named =
        std::find(options.names.begin(), options.names.end(), c.name) != options.names.end();
    if (named || (options.names.empty() && (options.slow || !c.slow))) cases.push_back(&c);
  }
  return cases;
}

void write_curves(const std::string& folder, const Case& c, const CaseResult& result) {
  if (folder.empty()) return;
  std::filesystem::create_directories(folder);
  for (const Curve& curve : result.curves) {
    std::ofstream file(folder + "/" + std::string(c.name) + "." + curve.name + ".csv");
    file << fmt::format("{}\n", fmt::join(curve.columns, ","));
    for (const auto& row : curve.rows) file << fmt::format("{:.10g}\n", fmt::join(row, ","));
  }
}

void write_plots(const std::string& folder, const Case& c, const CaseResult& result) {
  if (folder.empty()) return;
  std::filesystem::create_directories(folder);
  for (const Picture& picture : result.pictures)
    io::write_file(folder + "/" + std::string(c.name) + "." + picture.name + ".svg",
                   io::plot_svg(picture.plot));
  for (const Drawing& drawing : result.drawings)
    io::write_file(folder + "/" + std::string(c.name) + "." + drawing.name + ".svg",
                   io::scene_svg(drawing.scene));
}

void print_row(const Row& row) {
  const bool ok = passes(row);
  std::string judged = row.relation == Relation::info ? "info" : (ok ? "ok" : "FAIL");
  fmt::print("  {:<58} {:>13.6g} {} {:>11.6g}  {:>10.2e}  {:>4}  {}\n", row.quantity, row.computed,
             relation_text(row.relation), row.reference, deviation(row), judged, row.source);
}

int verify(const VerifyOptions& options) {
  if (options.list) {
    for (const Case& c : all_cases())
      fmt::print("{:<28} {}{}\n", c.name, c.requirement, c.slow ? " (--long)" : "");
    return done;
  }
  const std::string folder = cases_folder();
  nlohmann::json out = nlohmann::json::array();
  int passed = 0, failed = 0, shown = 0;
  for (const Case* const c : selected(options)) {
    fmt::print("{}: {}\n", c->name, c->requirement);
    std::fflush(stdout);
    const auto start = std::chrono::steady_clock::now();
    CaseResult result;
    try {
      result = c->run({folder + "/" + std::string(c->name), options.threads});
    } catch (const std::exception& error) {
      result.rows.push_back(
          {fmt::format("case ended with: {}", error.what()), 1, 0, Relation::equal, 0, ""});
    }
    if (result.rows.empty())
      result.rows.push_back({"the case gave no row at all", 1, 0, Relation::equal, 0, ""});
    for (const Row& row : result.rows) {
      print_row(row);
      if (row.relation == Relation::info)
        ++shown;
      else
        ++(passes(row) ? passed : failed);
      const auto number = [](double v) {
        return std::isfinite(v) ? nlohmann::json(v) : nlohmann::json(nullptr);
      };
      out.push_back({{"case", c->name},
                     {"quantity", row.quantity},
                     {"computed", number(row.computed)},
                     {"reference", number(row.reference)},
                     {"relation", relation_text(row.relation)},
                     {"deviation", number(deviation(row))},
                     {"tolerance", row.tolerance},
                     {"pass", passes(row)},
                     {"source", row.source}});
    }
    write_curves(options.curves, *c, result);
    write_plots(options.plots, *c, result);
    fmt::print("  ({:.1f} s)\n",
               std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  if (!options.json.empty()) {
    std::ofstream file(options.json);
    file << out.dump(1) << "\n";
    if (!file) throw core::InputError({}, "cannot write '" + options.json + "'");
  }
  fmt::print("verify: {} passed, {} failed, {} info\n", passed, failed, shown);
  return failed == 0 ? done : check_failed;
}

}  // namespace

void add_verify(CLI::App& app, int& exit_code) {
  CLI::App* const command = app.add_subcommand(
      "verify",
      "Run the verification cases: computed | reference | deviation | tolerance | source");
  auto options = std::make_shared<VerifyOptions>();
  command->add_option("name", options->names, "Cases to run (default: all but the long ones)");
  command->add_flag("--list", options->list, "List the cases");
  command->add_flag("--long", options->slow, "Include the long cases");
  command->add_option("--json", options->json, "Also write the table to this file");
  command->add_option("--curves", options->curves,
                      "Write the curves of the cases as CSV to this folder");
  command->add_option("--plots", options->plots,
                      "Write the plots of the cases as SVG to this folder");
  command->add_option("--threads", options->threads, "Threads for assembly");
  command->callback([options, &exit_code] { exit_code = verify(*options); });
}

}  // namespace osculate::app
