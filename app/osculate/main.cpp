#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "../together.hpp"
#include "commands.hpp"
#include "osculate/core/memory.hpp"
#include "osculate/core/text.hpp"
#include "osculate/core/version.hpp"
#include "osculate/la/blas_at_start.hpp"

namespace {

/// What is wrong with the first word, if it is no command; `reversed`: the arguments from behind.
std::string unknown_command(const CLI::App& app, const std::vector<std::string>& reversed) {
  if (reversed.empty() || reversed.back().starts_with('-')) return {};
  const std::string& word = reversed.back();
  std::vector<std::string> names;
  for (const CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  if (std::ranges::find(names, word) != names.end()) return {};
  if (word.find_first_of("./") != std::string::npos)
    return "'" + word + "' is no command; for a model file or deck: `osculate run " + word + "`";
  return osculate::core::unknown_name_message("command", word, names);
}

int run_program(int argc, char** argv) {
  using namespace osculate::app;
  CLI::App app{"Osculate: contact mechanics in the coordinates of the master surface", "osculate"};
  app.set_version_flag("--version",
                       std::string("osculate ") + std::string(osculate::core::version));
  app.require_subcommand(1);
  int exit_code = done;
  add_init(app, exit_code);
  add_run(app, exit_code);
  add_study(app, exit_code);
  add_check(app, exit_code);
  add_tangent(app, exit_code);
  add_verify(app, exit_code);
  add_project(app, exit_code);
  add_report(app, exit_code);
  add_schema(app, exit_code);
  add_doc(app, exit_code);
  add_domain(app, exit_code);
  add_convert(app, exit_code);
  add_ccx(app, exit_code);
  add_compare(app, exit_code);
  add_view(app, exit_code);
  add_completion(app, exit_code);
  // A link of the name ccx stands for `osculate ccx`: programs call it without a command.
  std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  if (argc > 0 && std::filesystem::path(argv[0]).stem() == "ccx")
    arguments.insert(arguments.begin(), "ccx");
  std::ranges::reverse(arguments);
  if (const std::string wrong = unknown_command(app, arguments); !wrong.empty()) {
    std::fprintf(stderr, "error: %s\n", wrong.c_str());
    return after_the_first(bad_input);
  }
  app.parse_complete_callback([&app] {
    const std::string name = app.get_subcommands().front()->get_name();
    if (name != "run" && name != "verify" && !is_alone(name)) throw CLI::RuntimeError(bad_input);
  });
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? done : after_the_first(bad_input);
  }
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  osculate::app::let_the_first_speak();
  osculate::core::keep_freed_memory();
  osculate::la::prepare_blas();
  return osculate::app::guarded(run_program, argc, argv);
}
