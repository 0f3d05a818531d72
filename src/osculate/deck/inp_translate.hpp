#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "osculate/deck/source_tree.hpp"
#include "osculate/io/inp/cards.hpp"

namespace osculate::deck {

/// A deck as a model file.
struct TranslatedDeck {
  SourceNode root;
  std::vector<std::string> notes;  ///< what of the deck is left out, or means something else here
  bool check_only = false;         ///< a step has `*NO ANALYSIS`
};

/// Translates an Abaqus or CalculiX input file into a model file whose mesh is the deck itself. The
/// lines of the tree are those of the deck.
///
/// Static steps with sections of elastic or elastoplastic solids, contact pairs, tied surfaces,
/// equations, boundary conditions and loads are translated; docs/inp.md has the table. A keyword
/// that would change the answer and has no counterpart is an error, one that would not is a note.
///
/// Input      file: name of the deck as the user gave it; included files are relative to it
/// Errors     core::InputError with file and line
/// Tested by  tests/unit/deck/test_inp_translate.cpp, tests/fuzz/fuzz_inp.cpp
[[nodiscard]] TranslatedDeck translate_deck(std::string_view content, const std::string& file);
[[nodiscard]] TranslatedDeck translate_deck(const io::inp::Deck& deck);

/// Whether a file is a deck by its name: it ends in .inp.
[[nodiscard]] bool names_a_deck(std::string_view file);

/// The tree as a model file is written.
[[nodiscard]] std::string to_yaml(const SourceNode& root);

}  // namespace osculate::deck
