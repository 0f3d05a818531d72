#pragma once
#include <string>

namespace osculate::app {

/// Exit codes of the programs (a contract: scripts depend on them).
enum ExitCode { done = 0, check_failed = 1, bad_input = 2, analysis_stopped = 3, defect = 4 };

/// Folder of the program itself.
[[nodiscard]] std::string program_folder();

/// Runs a program: what it throws becomes one message and an exit code.
[[nodiscard]] int guarded(int (*program)(int argc, char** argv), int argc, char** argv);

}  // namespace osculate::app
