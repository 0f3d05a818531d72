#pragma once
#include <string>
#include <vector>

#include "osculate/deck/build.hpp"

namespace osculate::deck {

struct WrittenDeck {
  std::string text;
  std::vector<std::string> notes;  ///< plain sentences: what was left out
};

/// A model file as an input file of CalculiX: nodes, elements, sets, surfaces, materials, sections,
/// equations, contact pairs, ties and steps. Read again (translate_deck) it is the same analysis.
///
/// Input      built: of the description
/// Errors     core::InputError with file, line and key for everything that such a file cannot say,
///            or that is not written; only `solver` and `output` are left out, which a note says
/// Tested by  tests/unit/deck/test_to_inp.cpp, tests/system/test_decks.py
[[nodiscard]] WrittenDeck write_deck(const Description& description, const AnyBuilt& built);

}  // namespace osculate::deck
