#include "osculate/io/inp/cards.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "osculate/io/gmsh.hpp"
#include "osculate/io/inp/parts.hpp"

namespace osculate::io::inp {
namespace {

constexpr std::size_t deepest_include = 32, most_includes = 10'000;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Where a comma outside of quotes is; npos: none, or a quotation has no end before it.
std::size_t next_comma(std::string_view text) {
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') quoted = !quoted;
    if (text[i] == ',' && !quoted) return i;
  }
  return std::string_view::npos;
}

std::string without_blanks(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (!is_blank(c)) result += c;
  return result;
}

/// The path as written: blanks may belong to it.
std::string path_of(std::string_view field) {
  std::string path(trimmed(field));
  std::erase(path, '"');
  return path;
}

/// Puts the lines of a file and of those that it includes into the deck.
class Reader {
 public:
  Reader(Deck& deck, const Opener& open) : deck_(deck), open_(open) {}

  void read(std::string_view content, const std::string& name) {
    begin_file(name);
    rest_ = content.starts_with("\xEF\xBB\xBF") ? content.substr(3) : content;
    while (!rest_.empty()) take(next_line());
    within_.pop_back();
  }

 private:
  void begin_file(const std::string& name) {
    deck_.files.push_back(name);
    within_.push_back(std::filesystem::path(name).lexically_normal().string());
    at_ = {static_cast<std::uint32_t>(deck_.files.size() - 1), 0};
  }

  std::string_view next_line() {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++at_.line;
    return trimmed(line);
  }

  void take(std::string_view line) {
    if (line.empty() || line.starts_with("**")) return;
    if (line.front() == '*') return begin_card(line);
    if (deck_.cards.empty()) return;
    deck_.lines.push_back({line, at_});
    ++deck_.cards.back().line_count;
  }

  /// A keyword line with the lines that continue it.
  std::string_view whole_card(std::string_view line) {
    if (!line.ends_with(',')) return line;
    std::string whole(line);
    while (whole.ends_with(',')) {
      const std::string_view rest = rest_;
      const Place before = at_;
      std::string_view next;
      while (!rest_.empty() && (next.empty() || next.starts_with("**"))) next = next_line();
      if (next.starts_with('*') || next.empty()) {  // nothing continues it
        rest_ = rest;
        at_ = before;
        break;
      }
      whole += next;
    }
    return deck_.texts.emplace_back(std::move(whole));
  }

  void begin_card(std::string_view first) {
    Card card;
    card.at = at_;
    const std::string_view line = whole_card(first);
    if (std::count(line.begin(), line.end(), '"') % 2 != 0)
      fail(deck_, card.at, "a quotation mark is missing in " + shown(line));
    std::size_t comma = next_comma(line);
    card.keyword = capitals(without_blanks(line.substr(1, std::min(comma, line.size()) - 1)));
    if (card.keyword.empty()) fail(deck_, card.at, "expected a keyword behind '*'");
    while (comma < line.size()) {
      const std::size_t begin = comma + 1;
      comma = next_comma(line.substr(begin));
      comma = comma == std::string_view::npos ? line.size() : begin + comma;
      add_parameter(card, trimmed(line.substr(begin, comma - begin)));
    }
    if (card.keyword == "INCLUDE") return include(card);
    if (card.keyword == "RESTART" && find_parameter(card, "READ")) return go_on(card);
    card.first_line = deck_.lines.size();
    deck_.cards.push_back(card);
    if ((card.keyword == "NODE" || card.keyword == "ELEMENT") && find_parameter(card, "INPUT"))
      include(card);
  }

  static void add_parameter(Card& card, std::string_view text) {
    if (text.empty()) return;
    const std::size_t equals = text.find('=');
    Parameter parameter;
    parameter.name = capitals(without_blanks(text.substr(0, equals)));
    parameter.is_flag = equals == std::string_view::npos;
    if (!parameter.is_flag)
      parameter.value = parameter.name == "INPUT" ? path_of(text.substr(equals + 1))
                                                  : name_of(text.substr(equals + 1));
    card.parameters.push_back(std::move(parameter));
  }

  /// The steps of an earlier deck, from the file that CalculiX takes its restart from.
  void go_on(const Card& card) {
    const bool first = std::all_of(deck_.cards.begin(), deck_.cards.end(),
                                   [](const Card& c) { return c.keyword == "HEADING"; });
    if (!first || within_.size() > 1)
      fail(deck_, card, "READ stands before all other keywords of a deck");
    const Parameter* const step = find_parameter(card, "STEP");
    const std::int32_t steps =
        step ? number_of(deck_, card.at, step->value, "the number of a step") : 0;
    const std::string name = deck_.files[at_.file];
    const std::string path = std::filesystem::path(name).replace_extension(".rin").string();
    read_other(card, path, [&](std::string_view text) {
      if (!text.starts_with(restart_head))
        fail(
            deck_, card,
            fmt::format("{} is no file that `osculate ccx` has written for a restart (JOBNAME.rout "
                        "of a deck with *RESTART, WRITE)",
                        shown(path)));
    });
    keep_steps(card, steps);
  }

  /// Drops what stands behind the end of a step; 0: nothing.
  void keep_steps(const Card& card, std::int32_t steps) {
    std::int32_t ended = 0;
    for (std::size_t c = 0; c < deck_.cards.size() && steps > 0; ++c) {
      if (deck_.cards[c].keyword != "ENDSTEP" || ++ended < steps) continue;
      deck_.lines.resize(deck_.cards[c].first_line);
      deck_.cards.resize(c + 1);
      return;
    }
    if (ended < steps)
      fail(deck_, card, fmt::format("there are {} steps to go on from, not {}", ended, steps));
  }

  void include(const Card& card) {
    const Parameter* const input = find_parameter(card, "INPUT");
    if (!input || input->value.empty())
      fail(deck_, card, "expected 'INPUT=' with the name of a file");
    const std::filesystem::path folder = std::filesystem::path(deck_.files[at_.file]).parent_path();
    read_other(card, (folder / input->value).string(), [](std::string_view) {});
  }

  /// The lines of another file in place of a card, if its text passes a check.
  template <class Check>
  void read_other(const Card& card, const std::string& path, const Check& check) {
    const std::string plain = std::filesystem::path(path).lexically_normal().string();
    if (std::find(within_.begin(), within_.end(), plain) != within_.end())
      fail(deck_, card, fmt::format("the file {} includes itself", shown(path)));
    if (within_.size() >= deepest_include || ++includes_ > most_includes)
      fail(deck_, card, "too many files include each other");
    try {
      deck_.texts.push_back(open_(path));
    } catch (const core::InputError& error) {
      fail(deck_, card, error.what());
    }
    check(deck_.texts.back());
    const std::string_view rest = rest_;
    const Place at = at_;
    read(deck_.texts.back(), path);
    rest_ = rest;
    at_ = at;
  }

  Deck& deck_;
  const Opener& open_;
  std::vector<std::string> within_;  ///< the files being read, outermost first
  std::size_t includes_ = 0;
  std::string_view rest_;
  Place at_;
};

}  // namespace

Deck read_cards(std::string_view content, const std::string& name, const Opener& open) {
  Deck deck;
  Reader(deck, open).read(content, name);
  if (deck.cards.empty())
    fail(deck, Place{}, "there is no keyword like '*NODE': not an Abaqus or CalculiX input file");
  give_sections_to_instances(deck);
  return deck;
}

Deck read_cards(std::string_view content, const std::string& name) {
  return read_cards(content, name, [](const std::string& path) { return read_file(path); });
}

std::string restart_text(const Deck& deck) {
  std::string text(restart_head);
  text += '\n';
  for (const Card& card : deck.cards) {
    if (card.keyword == "RESTART") continue;
    text += '*' + card.keyword;
    for (const Parameter& p : card.parameters) {
      if (p.name == "INPUT") continue;  // its lines are there
      text += ", " + p.name;
      if (!p.is_flag) text += "=\"" + p.value + '"';
    }
    text += '\n';
    for (const Line& line : lines_of(deck, card)) text.append(line.text) += '\n';
  }
  return text;
}

std::span<const Line> lines_of(const Deck& deck, const Card& card) {
  return std::span(deck.lines).subspan(card.first_line, card.line_count);
}

const Parameter* find_parameter(const Card& card, std::string_view name) {
  for (const Parameter& parameter : card.parameters)
    if (parameter.name == name) return &parameter;
  return nullptr;
}

core::SourceMark mark(const Deck& deck, Place at) {
  constexpr std::uint32_t most = std::numeric_limits<int>::max();
  return {deck.files[at.file], static_cast<int>(std::min(at.line, most)), ""};
}

void fail(const Deck& deck, Place at, const std::string& message) {
  throw core::InputError(mark(deck, at), message);
}

void fail(const Deck& deck, const Card& card, const std::string& message) {
  const std::string keyword = shown("*" + card.keyword);
  fail(deck, card.at, keyword.substr(1, keyword.size() - 2) + ": " + message);
}

}  // namespace osculate::io::inp
