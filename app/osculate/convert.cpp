#include <filesystem>
#include <memory>

#include "commands.hpp"
#include "osculate/core/error.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/deck/to_inp.hpp"
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

int write(const Flags& flags, const std::string& text) {
  if (flags.output.empty()) {
    print(stdout, "{}", text);
    return done;
  }
  io::write_file(flags.output, text);
  print(stdout, "wrote {}\n", flags.output);
  return done;
}

/// A model file, or another input file, as an input file of its own.
int convert_back(const Flags& flags) {
  if (!flags.output.empty() && !deck::names_a_deck(flags.output))
    throw core::InputError({flags.deck, 0, ""},
                           "expected an Abaqus or CalculiX input file, whose name ends in .inp, or "
                           "a model file and an output that ends in .inp");
  const deck::Description description = deck::read_model(flags.deck);
  for (const std::string& note : description.notes) print(stderr, "note: {}\n", note);
  const deck::WrittenDeck written =
      deck::write_deck(description, deck::build_any(description, deck::load_mesh(description)));
  for (const std::string& note : written.notes) print(stderr, "note: {}\n", note);
  return write(flags, written.text);
}

int convert(const Flags& flags) {
  keep_inputs({flags.output}, {flags.deck});
  if (!deck::names_a_deck(flags.deck) || deck::names_a_deck(flags.output))
    return convert_back(flags);
  deck::TranslatedDeck model = deck::translate_deck(io::read_file(flags.deck), flags.deck);
  for (const std::string& note : model.notes) print(stderr, "note: {}\n", note);
  if (!flags.output.empty()) lead_to_mesh(model.root, flags);
  return write(flags, deck::to_yaml(model.root));
}

}  // namespace

void add_convert(CLI::App& app, int& exit_code) {
  CLI::App* const command = app.add_subcommand(
      "convert",
      "Write an Abaqus or CalculiX input file as a model file, the other way round, or anew");
  auto flags = std::make_shared<Flags>();
  command->add_option("deck", flags->deck, "Input file (.inp), which stays the mesh, or model file")
      ->required();
  command->add_option("-o,--output", flags->output,
                      "Model file, or input file (.inp) to write (default: standard output)");
  command->callback([flags, &exit_code] { exit_code = convert(*flags); });
}

}  // namespace osculate::app
