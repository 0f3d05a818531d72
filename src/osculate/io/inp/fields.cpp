#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "osculate/io/inp/cards.hpp"

namespace osculate::io::inp {
namespace {

constexpr std::string_view blanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::string_view without_plus(std::string_view text) {
  const bool plus = text.size() > 1 && text.front() == '+' && text[1] != '-';
  return text.substr(plus ? 1 : 0);
}

char capital(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

/// A number with e or Fortran's d before the exponent; too small ones are zero.
std::optional<double> real_of(std::string_view field) {
  std::string_view text = without_plus(field);
  std::string copy;
  if (text.find_first_of("dD") != std::string_view::npos) {
    copy = text;
    std::replace_if(
        copy.begin(), copy.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
    text = copy;
  }
  double value = 0;
  const char* const end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, value);
  if (result.ptr != end) return {};
  if (result.ec == std::errc::result_out_of_range && text.find("-", 1) != text.npos) return 0.0;
  if (result.ec != std::errc{} || !std::isfinite(value)) return {};
  return value;
}

}  // namespace

std::optional<std::string_view> Fields::next() {
  if (rest_.empty()) return {};
  bool quoted = false;
  std::size_t comma = 0;
  for (; comma < rest_.size() && (quoted || rest_[comma] != ','); ++comma)
    if (rest_[comma] == '"') quoted = !quoted;
  const std::string_view field = trimmed(rest_.substr(0, comma));
  rest_.remove_prefix(std::min(comma + 1, rest_.size()));
  rest_ = trimmed(rest_);
  return field;
}

void Fields::fail(const std::string& message) const { inp::fail(*deck_, at_, message); }

std::string_view Fields::expected(const char* what) {
  const std::optional<std::string_view> field = next();
  if (!field) fail(fmt::format("the line ends where {} is expected", what));
  return *field;
}

std::int32_t Fields::number(const char* what) {
  return number_of(*deck_, at_, expected(what), what);
}

double Fields::real_or_zero(const char* what) {
  const bool empty = rest_.empty() || rest_.front() == ',';
  if (!empty) return real(what);
  (void)next();
  return 0;
}

double Fields::real(const char* what) {
  const std::string_view field = expected(what);
  const std::optional<double> value = real_of(field);
  if (!value) fail(fmt::format("expected {} (a finite number), found {}", what, shown(field)));
  return *value;
}

void Fields::expect_end() const {
  if (!done()) fail("unexpected " + shown(rest_) + " at the end of the line");
}

std::optional<std::int32_t> number_of(std::string_view field) {
  const std::string_view text = without_plus(field);
  std::int32_t value = 0;
  const char* const end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc{} || result.ptr != end || value < 1) return {};
  return value;
}

std::int32_t number_of(const Deck& deck, Place at, std::string_view field, std::string_view what) {
  if (const std::optional<std::int32_t> value = number_of(field)) return *value;
  fail(deck, at,
       fmt::format("expected {} (a whole number from 1 to 2147483647), found {}", what,
                   shown(field)));
}

bool is_number(std::string_view field) {
  if (!field.empty() && (field.front() == '+' || field.front() == '-')) field.remove_prefix(1);
  return !field.empty() &&
         std::all_of(field.begin(), field.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::string name_of(std::string_view field) {
  std::string name;
  bool quoted = false;
  for (const char c : trimmed(field)) {
    if (c == '"')
      quoted = !quoted;
    else if (quoted || blanks.find(c) == std::string_view::npos)
      name += c;
  }
  return name;
}

std::string capitals(std::string_view name) {
  std::string result(name);
  std::transform(result.begin(), result.end(), result.begin(), capital);
  return result;
}

std::string shown(std::string_view text) {
  constexpr std::size_t most = 40;
  std::string result;
  for (const char c : text.substr(0, most)) result += (c >= ' ' && c < 127) ? c : '?';
  return "'" + result + (text.size() > most ? "..." : "") + "'";
}

}  // namespace osculate::io::inp
