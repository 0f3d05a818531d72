#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace osculate::deck {

/// What becomes of a keyword of an Abaqus or CalculiX input file.
enum class KeywordUse : std::uint8_t {
  mesh,        ///< makes the mesh: read where the file is a model's mesh, too
  silent,      ///< changes no answer: titles, what is printed and written
  translated,  ///< becomes a key of a model file
  none         ///< says what there is no counterpart for
};

struct InpKeyword {
  std::string_view keyword;  ///< in capitals, with blanks: `SOLID SECTION`
  /// Those that are read; behind a semicolon those without effect on the answer. Any other stops.
  std::string_view parameters;
  std::string_view data;  ///< what its lines hold
  KeywordUse use;
  std::string_view here;  ///< what it becomes: sets, the key of a model file; none: why not
};

/// The keywords of CalculiX for mechanics and contact, and those that Abaqus/CAE writes beside
/// them.
///
/// Source     CalculiX CrunchiX User's Manual, "Input deck format"; Abaqus Keywords Guide
/// Tested by  tests/unit/deck/test_inp_keywords.cpp (docs/inp.md shows the table)
[[nodiscard]] std::span<const InpKeyword> inp_keywords();

/// By a name in capitals without blanks, as io::inp::Card has it; null: not in the table.
[[nodiscard]] const InpKeyword* find_inp_keyword(std::string_view keyword);

/// The names of a list of parameters, `NSET, REF NODE; NAME`; a value that they must have, too.
[[nodiscard]] std::vector<std::string> inp_parameter_names(std::string_view list);

}  // namespace osculate::deck
