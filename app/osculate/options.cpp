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
