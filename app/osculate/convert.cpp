#include <filesystem>
#include <memory>

#include "commands.hpp"
#include "osculate/core/error.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/io/atomic_file.hpp"
#include "osculate/io/gmsh.hpp"

namespace osculate::app {
namespace {

struct Flags {
  std::string deck, output;
};

/// The mesh is named relative to the folder of the model file.
void lead_to_mesh(deck::SourceNode& root, const Flags& flags) {
  const std::filesystem::path from = std::filesystem::absolute(flags.output).parent_path();
  for (deck::SourceEntry& entry : root.entries)
    if (entry.key == "mesh")
      entry.value.text = std::filesystem::absolute(flags.deck).lexically_relative(from).string();
}

int convert(const Flags& flags) {
  if (!deck::names_a_deck(flags.deck))
    throw core::InputError({flags.deck, 0, ""},
                           "expected an Abaqus or CalculiX input file, whose name ends in .inp");
  keep_inputs({flags.output}, {flags.deck});
  deck::TranslatedDeck model = deck::translate_deck(io::read_file(flags.deck), flags.deck);
  for (const std::string& note : model.notes) print(stderr, "note: {}\n", note);
  if (!flags.output.empty()) lead_to_mesh(model.root, flags);
  const std::string text = deck::to_yaml(model.root);
  if (flags.output.empty()) {
    print(stdout, "{}", text);
    return done;
  }
  io::write_file(flags.output, text);
  print(stdout, "wrote {}\n", flags.output);
  return done;
}

}  // namespace

void add_convert(CLI::App& app, int& exit_code) {
  CLI::App* const command =
      app.add_subcommand("convert", "Write an Abaqus or CalculiX input file as a model file");
  auto flags = std::make_shared<Flags>();
  command->add_option("deck", flags->deck, "Input file (.inp), which stays the mesh")->required();
  command->add_option("-o,--output", flags->output,
                      "Model file to write (default: standard output)");
  command->callback([flags, &exit_code] { exit_code = convert(*flags); });
}

}  // namespace osculate::app
