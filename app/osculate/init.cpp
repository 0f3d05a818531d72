#include "osculate/api/init.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "commands.hpp"
#include "osculate/core/error.hpp"
#include "osculate/io/atomic_file.hpp"

namespace osculate::app {
namespace {

struct Flags {
  std::string mesh, output;
  bool force = false;
};

int init(Flags& flags) {
  namespace fs = std::filesystem;
  if (flags.output.empty()) flags.output = fs::path(flags.mesh).replace_extension(".yaml").string();
  keep_inputs({flags.output}, {flags.mesh});
  std::error_code ignored;
  if (!flags.force && fs::exists(fs::symlink_status(flags.output, ignored)))
    throw core::InputError({}, fmt::format("'{}' is there already, and is not replaced: name "
                                           "another file with -o, or say --force",
                                           flags.output));
  const api::StartedModel model = api::start_model(flags.mesh, flags.output);
  io::write_file(flags.output, model.text);
  print(stdout, "wrote {}\n", flags.output);
  if (model.refused.empty()) return done;
  print(stderr, "`osculate check` does not accept it yet: {}\n", model.refused);
  return check_failed;
}

}  // namespace

void add_init(CLI::App& app, int& exit_code) {
  CLI::App* const command = app.add_subcommand(
      "init",
      "Write a commented model file to begin with, for a mesh: its sets, a section a body, "
      "contact of groups that face each other");
  auto flags = std::make_shared<Flags>();
  command->add_option("mesh", flags->mesh, "Mesh file (Gmsh, .inp)")->required();
  command->add_option("-o,--output", flags->output,
                      "Model file to write (default: MESH's stem + .yaml, beside it)");
  command->add_flag("--force", flags->force, "Replace a file that is there");
  command->callback([flags, &exit_code] { exit_code = init(*flags); });
}

}  // namespace osculate::app
