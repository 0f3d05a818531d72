#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "commands.hpp"
#include "osculate/core/error.hpp"

namespace osculate::app {
namespace {

/// Goes on as the program of the verification cases, which stands beside this one.
[[noreturn]] void become_verify(const std::vector<std::string>& arguments) {
  std::string program = program_folder() + "/osculate-verify";
  std::vector<char*> argv{program.data()};
  std::vector<std::string> copies = arguments;
  for (std::string& argument : copies) argv.push_back(argument.data());
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  if (errno != ENOENT)
    throw core::InputError({}, "cannot start '" + program + "': " + std::strerror(errno));
  throw core::InputError(
      {},
      "the verification cases are a program of their own, osculate-verify, which is not beside "
      "this "
      "one: build it with 'cmake --build --preset release --target osculate-verify', or install "
      "the package osculate-verification");
}

}  // namespace

void add_verify(CLI::App& app, int&) {
  CLI::App* const command = app.add_subcommand(
      "verify",
      "Run the verification cases: computed | reference | deviation | tolerance | source");
  command->prefix_command();   // all that follows is for the other program,
  command->set_help_flag("");  // which has its own help
  command->callback([command] { become_verify(command->remaining()); });
}

}  // namespace osculate::app
