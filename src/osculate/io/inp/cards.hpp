#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "osculate/core/error.hpp"

namespace osculate::io::inp {

/// Line of a file of the deck; `file` counts in Deck::files.
struct Place {
  std::uint32_t file = 0, line = 0;
};

/// `NAME=value` or a flag behind a keyword.
struct Parameter {
  std::string name;   ///< in capitals, without blanks
  std::string value;  ///< as written; blanks outside of quotes and the quotes are gone
  bool is_flag = false;
};

/// A line of data, trimmed; never a comment, never blank.
struct Line {
  std::string_view text;
  Place at;
};

/// A keyword line with the lines of data that follow it.
struct Card {
  std::string keyword;  ///< in capitals, without star and blanks: SOLIDSECTION
  std::vector<Parameter> parameters;
  Place at;
  std::size_t first_line = 0, line_count = 0;  ///< in Deck::lines
};

/// What an Abaqus or CalculiX input file and the files it includes say, card by card. Nothing is
/// interpreted but `*INCLUDE` and the parameter INPUT of cards with data, which are replaced by
/// the files' lines, and sections of parts.
struct Deck {
  std::vector<std::string> files;  ///< their names
  std::vector<Line> lines;
  std::vector<Card> cards;
  std::deque<std::string> texts;  ///< what the lines point into, apart from the content given
};

/// Content of an included file; throws core::InputError.
using Opener = std::function<std::string(const std::string& path)>;

/// First line of the file that a restart goes on from.
inline constexpr std::string_view restart_head =
    "** Osculate: the steps that *RESTART, READ goes on from";

/// Reads the cards. `content` must live as long as the deck; `name` appears in messages, and paths
/// of `*INCLUDE` are relative to the file that names them.
///
/// A line that begins with a star is a keyword, `KEYWORD, NAME=value, FLAG`, and goes on in the
/// next one where it ends in a comma; two stars begin a comment. What stands before the first
/// keyword is skipped. `*RESTART, READ, STEP=n` stands for the cards of the file beside it that
/// ends in .rin instead of .inp, up to the end of its step n (the last one, where none is said):
/// what `restart_text` has written. Keywords and names of parameters are the same in capital and
/// small letters, with and without blanks. Sections in parts are given to the instances
/// (give_sections_to_instances).
///
/// Errors     core::InputError with file and line: no keyword at all, a star without keyword, a
///            quotation without end, an included file that includes itself or is missing
/// Tested by  tests/unit/io/test_inp_cards.cpp, test_inp_broken.cpp, tests/fuzz/fuzz_inp.cpp
[[nodiscard]] Deck read_cards(std::string_view content, const std::string& name,
                              const Opener& open);
[[nodiscard]] Deck read_cards(std::string_view content, const std::string& name);

/// The cards as one file that includes no other, for `*RESTART, READ`.
///
/// Tested by  tests/unit/io/test_inp_cards.cpp
[[nodiscard]] std::string restart_text(const Deck& deck);

[[nodiscard]] std::span<const Line> lines_of(const Deck& deck, const Card& card);
/// The parameter of that name (in capitals); null: not given.
[[nodiscard]] const Parameter* find_parameter(const Card& card, std::string_view name);

[[nodiscard]] core::SourceMark mark(const Deck& deck, Place at);
[[noreturn]] void fail(const Deck& deck, Place at, const std::string& message);
/// Throws at the keyword: `*NODE: message`.
[[noreturn]] void fail(const Deck& deck, const Card& card, const std::string& message);

/// The fields of a line of data, one after the other.
class Fields {
 public:
  Fields(const Deck& deck, const Line& line) : deck_(&deck), rest_(line.text), at_(line.at) {}

  /// The next field, trimmed; none behind the last one. A comma at the end of the line opens no
  /// field.
  [[nodiscard]] std::optional<std::string_view> next();
  /// Whole number from 1 to 2 147 483 647.
  [[nodiscard]] std::int32_t number(const char* what);
  [[nodiscard]] double real(const char* what);          ///< finite; also with Fortran's D
  [[nodiscard]] double real_or_zero(const char* what);  ///< zero: an empty field, or none
  [[nodiscard]] bool done() const { return rest_.empty(); }
  void expect_end() const;
  [[nodiscard]] Place at() const { return at_; }
  [[noreturn]] void fail(const std::string& message) const;

 private:
  [[nodiscard]] std::string_view expected(const char* what);

  const Deck* deck_;
  std::string_view rest_;
  Place at_;
};

/// The number that a field holds, as Fields::number; none if it is something else.
[[nodiscard]] std::optional<std::int32_t> number_of(std::string_view field);
/// Fails unless the field is a number in range: `expected WHAT (...), found 'field'`.
[[nodiscard]] std::int32_t number_of(const Deck& deck, Place at, std::string_view field,
                                     std::string_view what);
/// Whether a field is written as a number: a sign or a digit first, then only digits.
[[nodiscard]] bool is_number(std::string_view field);

/// A name as the deck means it: without quotes, and without blanks outside of them.
[[nodiscard]] std::string name_of(std::string_view field);
/// A name in capitals, as names are compared.
[[nodiscard]] std::string capitals(std::string_view name);
/// Printable and short, in quotes, for messages.
[[nodiscard]] std::string shown(std::string_view text);

}  // namespace osculate::io::inp
