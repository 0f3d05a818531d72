#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "../program.hpp"
#include "osculate/api/run.hpp"
#include "osculate/deck/parameters.hpp"

namespace osculate::app {

/// For numbers: not nan, which passes every range, nor infinite.
[[nodiscard]] CLI::Validator finite();

/// Throws core::InputError if one of the outputs (empty: none) is one of the inputs, which may be
/// FILE:SET, or another output.
void keep_inputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

/// Adds `--max-iterations` and `--max-minutes` of a run.
void add_limits(CLI::App& command, api::RunOptions& options);
/// Adds `--set NAME=VALUE`, which may be given several times.
void add_settings(CLI::App& command, std::vector<std::string>& texts);
/// What was given so. Throws core::InputError for what is no NAME=VALUE and for a name given twice.
[[nodiscard]] std::vector<deck::Setting> settings_of(const std::vector<std::string>& texts);

/// api::run, which the signals of the terminal end in good order.
[[nodiscard]] api::RunOutcome run_until_interrupted(api::RunOptions& options);

// One file a command. Each adds its subcommand; the callback stores the exit code.
void add_init(CLI::App& app, int& exit_code);
void add_run(CLI::App& app, int& exit_code);
void add_study(CLI::App& app, int& exit_code);
void add_check(CLI::App& app, int& exit_code);
void add_tangent(CLI::App& app, int& exit_code);
void add_verify(CLI::App& app, int& exit_code);
void add_project(CLI::App& app, int& exit_code);
void add_report(CLI::App& app, int& exit_code);
void add_schema(CLI::App& app, int& exit_code);
void add_doc(CLI::App& app, int& exit_code);
void add_domain(CLI::App& app, int& exit_code);
void add_convert(CLI::App& app, int& exit_code);
void add_ccx(CLI::App& app, int& exit_code);
void add_compare(CLI::App& app, int& exit_code);
void add_view(CLI::App& app, int& exit_code);
void add_completion(CLI::App& app, int& exit_code);

/// All commands with their options as a manual page (man).
[[nodiscard]] std::string manual_page(const CLI::App& app);

}  // namespace osculate::app
