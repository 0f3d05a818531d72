#include <fmt/format.h>

#include <memory>

#include "commands.hpp"
#include "osculate/api/run.hpp"
#include "osculate/deck/explain.hpp"
#include "osculate/deck/parse_surface.hpp"
#include "osculate/deck/schema.hpp"

namespace osculate::app {

void add_schema(CLI::App& app, int&) {
  CLI::App* const command = app.add_subcommand("schema", "Print the JSON schema of the model file");
  auto surface = std::make_shared<bool>(false);
  command->add_flag("--surface", *surface, "Of the surface file of `osculate project`");
  command->callback(
      [surface] { fmt::print("{}\n", *surface ? deck::surface_schema() : deck::model_schema()); });
}

void add_doc(CLI::App& app, int&) {
  CLI::App* const command = app.add_subcommand("doc", "Explain a key of the model file");
  struct Flags {
    std::string key;
    bool surface = false;
  };
  auto flags = std::make_shared<Flags>();
  command->add_option("key", flags->key,
                      "Path such as contact.friction.coulomb.mu (default: the whole file)");
  command->add_flag("--surface", flags->surface, "Of the surface file of `osculate project`");
  command->callback([flags] {
    fmt::print("{}\n", flags->surface ? deck::explain_surface_key(flags->key)
                                      : deck::explain_model_key(flags->key));
  });
}

void add_report(CLI::App& app, int&) {
  CLI::App* const command =
      app.add_subcommand("report", "Write report.html of a result folder again");
  auto folder = std::make_shared<std::string>();
  command->add_option("folder", *folder, "Result folder")->required();
  command->callback([folder] {
    api::rewrite_report(*folder);
    fmt::print("{}/report.html\n", *folder);
  });
}

void add_check(CLI::App& app, int&) {
  CLI::App* const command = app.add_subcommand(
      "check", "Validate a model file and say what it consists of; solve nothing");
  struct Flags {
    std::string model;
    bool json = false;
  };
  auto flags = std::make_shared<Flags>();
  command->add_option("model", flags->model, "Model file (YAML)")->required();
  command->add_flag("--json", flags->json, "Print JSON on stdout");
  command->callback([flags] {
    const api::CheckReport report = api::check(flags->model);
    fmt::print(flags->json ? stderr : stdout, "{}", report.text);
    if (flags->json) fmt::print("{}\n", report.json);
  });
}

}  // namespace osculate::app
