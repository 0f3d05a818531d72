#include "osculate/deck/scalar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>

#include "osculate/core/text.hpp"

namespace osculate::deck {
namespace {

[[noreturn]] void wrong_type(std::string_view expected, const SourceNode& node,
                             const core::SourceMark& mark) {
  throw core::InputError(mark, fmt::format("expected {}, got {}", expected, describe(node)));
}

bool is_plain(const SourceNode& node) {
  return node.kind == SourceNode::Kind::scalar && !node.quoted;
}

/// from_chars takes no leading plus.
std::string_view without_plus(std::string_view text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  return plus ? text.substr(1) : text;
}

/// `210 GPa`, `0,3`: what is wrong with it, behind a message; else empty.
std::string fault_of_number(std::string_view text) {
  double value{};
  const std::string_view digits = without_plus(text);
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const std::string_view rest = digits.substr(static_cast<std::size_t>(end - digits.data()));
  if (code != std::errc{} || rest.size() < 2) return {};
  const char next = rest[rest[0] == ' ' ? 1 : 0];
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (rest[0] == ',' && is_digit(rest[1])) {
    const bool thousands = rest.size() == 4 && std::all_of(rest.begin() + 1, rest.end(), is_digit);
    return thousands ? "; numbers are written without separators, decimals with a point"
                     : "; decimals are written with a point";
  }
  if (rest[0] == ' ' && ((next >= 'a' && next <= 'z') || (next >= 'A' && next <= 'Z')))
    return "; numbers have no units: all are in one consistent system";
  return {};
}

bool is_not_finite_word(std::string_view text) {
  std::string lower;
  for (const char c : text.substr(0, 16))
    if (c != '.' && c != '+' && c != '-')
      lower += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return lower == "nan" || lower == "inf" || lower == "infinity";
}

template <class T>
std::optional<T> whole(std::string_view text, std::errc& error) {
  T value{};
  const std::string_view digits = without_plus(text);
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  error = code;
  if (end != digits.data() + digits.size()) {
    error = std::errc::invalid_argument;
    return std::nullopt;
  }
  return code == std::errc{} ? std::optional<T>(value) : std::nullopt;
}

void check_range(const Spec& spec, double value, const SourceNode& node,
                 const core::SourceMark& mark) {
  const bool low_ok =
      !spec.low || value > spec.low->value || (spec.low->inclusive && value == spec.low->value);
  const bool high_ok =
      !spec.high || value < spec.high->value || (spec.high->inclusive && value == spec.high->value);
  if (!low_ok || !high_ok)
    throw core::InputError(
        mark, fmt::format("must be {}, got {}", describe_range(spec), printable(node.text)));
}

}  // namespace

std::string describe(const SourceNode& node) {
  switch (node.kind) {
    case SourceNode::Kind::nothing:
      return "nothing";
    case SourceNode::Kind::list:
      return "a list";
    case SourceNode::Kind::map:
      return "a map";
    case SourceNode::Kind::scalar:
      break;
  }
  std::errc error{};
  if (is_plain(node) && whole<double>(node.text, error)) return printable(node.text);
  return fmt::format("the {}text '{}'", node.quoted ? "quoted " : "", printable(node.text));
}

bool looks_like_number(const SourceNode& node) {
  if (!is_plain(node) || node.text.empty()) return false;
  const std::size_t start = node.text.find_first_not_of("+-.");
  if (start == std::string::npos) return false;
  const char c = node.text[start];
  return (c >= '0' && c <= '9') || is_not_finite_word(node.text);
}

double read_number(const Spec& spec, const SourceNode& node, const core::SourceMark& mark) {
  if (!is_plain(node)) wrong_type("a number", node, mark);
  if (is_not_finite_word(node.text))
    throw core::InputError(mark, "must be a finite number, got " + printable(node.text));
  std::errc error{};
  const std::optional<double> value = whole<double>(node.text, error);
  constexpr double largest = 1e100;  // powers of larger ones overflow
  if (error == std::errc::result_out_of_range || (value && std::abs(*value) > largest))
    throw core::InputError(mark, fmt::format("{} is out of range: use numbers between 1e-300 and "
                                             "1e100",
                                             printable(node.text)));
  if (!value || !std::isfinite(*value))
    throw core::InputError(mark, fmt::format("expected a number, got {}{}", describe(node),
                                             fault_of_number(node.text)));
  check_range(spec, *value, node, mark);
  return *value;
}

int read_integer(const Spec& spec, const SourceNode& node, const core::SourceMark& mark) {
  if (!is_plain(node)) wrong_type("an integer", node, mark);
  std::errc error{};
  const std::optional<int> value = whole<int>(node.text, error);
  if (error == std::errc::result_out_of_range)
    throw core::InputError(mark, printable(node.text) + " is too large for an integer");
  if (!value) wrong_type("an integer", node, mark);
  check_range(spec, *value, node, mark);
  return *value;
}

bool read_boolean(const SourceNode& node, const core::SourceMark& mark) {
  if (is_plain(node) && node.text == "true") return true;
  if (is_plain(node) && node.text == "false") return false;
  wrong_type("true or false", node, mark);
}

/// Where the known words are too many for a message.
std::string where_words_are(const std::vector<std::string>& known, const SourceNode& node,
                            const core::SourceMark& mark) {
  if (known.size() <= 20 || !core::nearest_name(printable(node.text), known).empty()) return {};
  std::string key;
  bool index = false;
  for (const char c : mark.key) {
    index = c == '[' || (index && c != ']');
    if (!index && c != ']') key += c == '.' ? ' ' : c;
  }
  return fmt::format(" (`osculate doc {}` says what they mean)", key);
}

const Choice& read_choice(const Spec& spec, const SourceNode& node, const core::SourceMark& mark) {
  if (node.kind != SourceNode::Kind::scalar) wrong_type(describe(spec), node, mark);
  const auto found = std::find_if(spec.choices.begin(), spec.choices.end(),
                                  [&](const Choice& c) { return c.name == node.text; });
  const std::vector<std::string> known = choice_names(spec);
  if (found == spec.choices.end())
    throw core::InputError(mark, core::unknown_name_message("value", printable(node.text), known) +
                                     where_words_are(known, node, mark) + spec.hint);
  if (!found->available)
    throw core::InputError(
        mark, fmt::format("'{}' is not available yet{}", found->name,
                          known.empty() ? std::string{} : "; use " + core::join(known, " or ")));
  return *found;
}

void check_text_rule(const Spec& spec, const std::string& text, const core::SourceMark& mark) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw core::InputError(mark, "must not be empty");
  const auto is_name_byte = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || static_cast<std::uint8_t>(c) >= 0x80;
  };
  if (spec.rule == TextRule::name && !std::all_of(text.begin(), text.end(), is_name_byte))
    throw core::InputError(
        mark, fmt::format("'{}' cannot be a name; use letters, digits, _ and -", printable(text)));
  if (spec.rule == TextRule::column && text.find_first_of(",\"\r\n") != std::string::npos)
    throw core::InputError(
        mark, fmt::format("'{}' cannot head a column; leave out commas, quotes and line breaks",
                          printable(text)));
}

}  // namespace osculate::deck
