// What the options of several commands share.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "commands.hpp"
#include "osculate/core/error.hpp"

namespace osculate::app {

CLI::Validator finite() {
  return {[](std::string& text) {
            const double value = std::strtod(text.c_str(), nullptr);
            return std::isfinite(value) ? std::string{} : "'" + text + "' is not finite";
          },
          "", "finite"};
}

void add_limits(CLI::App& command, api::RunOptions& options) {
  command
      .add_option("--max-iterations", options.max_iterations,
                  "Stop after so many iterations of all increments together (exit code 3)")
      ->check(CLI::Range(1, 1'000'000'000));
  command
      .add_option("--max-minutes", options.max_minutes,
                  "Stop after so many minutes, between two iterations (exit code 3)")
      ->check(finite())
      ->check(CLI::PositiveNumber);
}

void add_settings(CLI::App& command, std::vector<std::string>& texts) {
  command
      .add_option("--set", texts,
                  "NAME=VALUE: a value of `parameters` of the model file; again for "
                  "more")
      ->allow_extra_args(false);
}

std::vector<deck::Setting> settings_of(const std::vector<std::string>& texts) {
  std::vector<deck::Setting> settings;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
      throw core::InputError({}, fmt::format("--set: expected NAME=VALUE, got '{}'", text));
    settings.push_back({text.substr(0, equals), text.substr(equals + 1)});
    for (std::size_t i = 0; i + 1 < settings.size(); ++i)
      if (settings[i].name == settings.back().name)
        throw core::InputError({}, fmt::format("--set: '{}' is given twice", settings[i].name));
  }
  return settings;
}

void keep_inputs(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
  std::error_code ignored;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const std::string& out = outputs[i];
    if (out.empty()) continue;
    for (const std::string& in : inputs)
      for (const std::string& file : {in, in.substr(0, in.rfind(':'))})
        if (std::filesystem::equivalent(out, file, ignored))
          throw core::InputError({}, fmt::format("'{}' is the input: name another file", out));
    for (std::size_t j = 0; j < i; ++j)
      if (outputs[j] == out)
        throw core::InputError({}, fmt::format("'{}' is named for two outputs", out));
  }
}

}  // namespace osculate::app
