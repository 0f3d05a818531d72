#pragma once
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

#include "osculate/core/error.hpp"
#include "osculate/io/atomic_file.hpp"

namespace osculate::app {

/// Exit codes of the programs (a contract: scripts depend on them).
enum ExitCode { done = 0, check_failed = 1, bad_input = 2, analysis_stopped = 3, defect = 4 };

/// Folder of the program itself.
[[nodiscard]] std::string program_folder();

/// Prints. That it could not be is no reason to end what is under way: `guarded` remembers it.
template <class... T>
void print(std::FILE* to, fmt::format_string<T...> text, T&&... values) {
  const std::string all = fmt::format(text, std::forward<T>(values)...);
  std::fwrite(all.data(), 1, all.size(), to);
}

/// Says what a program has thrown for bad input or files. Returns the exit code.
[[nodiscard]] int report(const core::InputError& error);
[[nodiscard]] int report(const io::WriteError& error);

/// Runs a program: what it throws becomes one message and an exit code; so does what could not be
/// printed (pipe closed, disk full), where there is no worse to tell.
[[nodiscard]] int guarded(int (*program)(int argc, char** argv), int argc, char** argv);

}  // namespace osculate::app
