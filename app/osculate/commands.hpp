#pragma once
#include <CLI/CLI.hpp>

namespace osculate::app {

/// Exit codes of the program (a contract: scripts depend on them).
enum ExitCode { done = 0, check_failed = 1, bad_input = 2, analysis_stopped = 3, defect = 4 };

// One file a command. Each adds its subcommand; the callback stores the exit code.
void add_run(CLI::App& app, int& exit_code);
void add_check(CLI::App& app, int& exit_code);
void add_tangent(CLI::App& app, int& exit_code);
void add_verify(CLI::App& app, int& exit_code);
void add_project(CLI::App& app, int& exit_code);
void add_report(CLI::App& app, int& exit_code);
void add_schema(CLI::App& app, int& exit_code);
void add_doc(CLI::App& app, int& exit_code);
void add_domain(CLI::App& app, int& exit_code);

/// Folder of the program itself.
[[nodiscard]] std::string program_folder();

}  // namespace osculate::app
