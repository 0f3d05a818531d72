#include "osculate/io/gmsh/cursor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "osculate/core/error.hpp"

namespace osculate::io::gmsh {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// Printable and short, for messages.
std::string shown(std::string_view text) {
  std::string result;
  for (const char c : text.substr(0, 30)) result += (c >= ' ' && c < 127) ? c : '?';
  return "'" + result + (text.size() > 30 ? "..." : "") + "'";
}

}  // namespace

void Cursor::fail_at(std::size_t offset, const std::string& message) const {
  const std::string where = section_.empty() ? std::string{} : "$" + section_ + ": ";
  if (offset == nowhere) throw core::InputError({file_, 0, ""}, message);
  if (binary_)
    throw core::InputError({file_, 0, ""}, fmt::format("byte {}: {}{}", offset, where, message));
  const std::string_view before = data_.substr(0, offset);
  const auto line = std::min<std::ptrdiff_t>(std::count(before.begin(), before.end(), '\n') + 1,
                                             std::numeric_limits<int>::max());
  throw core::InputError({file_, static_cast<int>(line), ""}, where + message);
}

void Cursor::skip_blanks() {
  while (at_ < data_.size() && is_blank(data_[at_])) ++at_;
}

void Cursor::skip_blank_lines() {
  while (at_ < data_.size() && (is_blank(data_[at_]) || data_[at_] == '\n')) ++at_;
  token_ = at_;
}

std::string_view Cursor::rest_of_line() {
  token_ = at_;
  const std::size_t end = std::min(data_.find('\n', at_), data_.size());
  std::string_view line = data_.substr(at_, end - at_);
  at_ = std::min(end + 1, data_.size());
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  return line;
}

void Cursor::end_line() {
  skip_blanks();
  if (at_ < data_.size() && data_[at_] != '\n')
    fail_at(at_, "unexpected " + shown(token("end of line")) + " at the end of the line");
  if (at_ < data_.size()) ++at_;
}

// ---- sections -----------------------------------------------------------------------------------

bool Cursor::next_section(std::string& name) {
  section_.clear();
  skip_blank_lines();
  if (at_ == data_.size()) return false;
  const std::string_view line = rest_of_line();
  if (line.size() < 2 || line[0] != '$' || line.starts_with("$End"))
    fail("expected the beginning of a section like '$Nodes', found " + shown(line));
  name = section_ = line.substr(1);
  return true;
}

void Cursor::end_section() {
  skip_blank_lines();
  const std::string_view line = rest_of_line();
  if (line != "$End" + section_)
    fail(line.empty() ? "the file ends before '$End" + section_ + "'"
                      : "expected '$End" + section_ + "', found " + shown(line));
}

void Cursor::skip_section() {
  const std::size_t end = data_.find("$End" + section_, at_);
  if (end == std::string_view::npos) fail("'$End" + section_ + "' is missing");
  at_ = end;
  (void)rest_of_line();
}

// ---- text ---------------------------------------------------------------------------------------

std::string_view Cursor::token(const char* what) {
  skip_blanks();
  token_ = at_;
  if (at_ == data_.size()) fail(fmt::format("the file ends where {} is expected", what));
  std::size_t end = at_;
  while (end < data_.size() && !is_blank(data_[end]) && data_[end] != '\n') ++end;
  if (end == at_) fail(fmt::format("the line ends where {} is expected", what));
  const std::string_view text = data_.substr(at_, end - at_);
  at_ = end;
  return text;
}

std::int64_t Cursor::text_integer(const char* what) {
  const std::string_view text = token(what);
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc{} || result.ptr != end)
    fail(fmt::format("expected {} (a whole number), found {}", what, shown(text)));
  return value;
}

double Cursor::text_real(const char* what) {
  std::string_view text = token(what);
  const std::string_view whole = text;
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const char* const end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, value);
  if (result.ec == std::errc::result_out_of_range && result.ptr == end &&
      text.find_first_of("eE") != std::string_view::npos &&
      text[text.find_first_of("eE") + 1] == '-')
    return 0.0;
  if (result.ec != std::errc{} || result.ptr != end)
    fail(fmt::format("expected {} (a number), found {}", what, shown(whole)));
  if (!std::isfinite(value))
    fail(fmt::format("expected {} (a finite number), found {}", what, shown(whole)));
  return value;
}

std::int64_t Cursor::text_count(const char* what) {
  skip_blank_lines();
  const std::int64_t n = text_integer(what);
  if (n < 0) fail(fmt::format("{} is negative: {}", what, n));
  end_line();
  return n;
}

// ---- records ------------------------------------------------------------------------------------

template <class T>
T Cursor::raw(const char* what) {
  token_ = at_;
  if (data_.size() - at_ < sizeof(T)) fail(fmt::format("the file ends where {} is expected", what));
  T value;
  std::memcpy(&value, data_.data() + at_, sizeof(T));
  at_ += sizeof(T);
  return value;
}

void Cursor::begin_record() {
  if (!binary_) skip_blank_lines();
}

void Cursor::end_record() {
  if (!binary_) end_line();
}

std::int64_t Cursor::integer(const char* what) {
  if (binary_) return raw<std::int32_t>(what);
  const std::int64_t value = text_integer(what);
  if (value != static_cast<std::int32_t>(value)) fail(fmt::format("{} is too large", what));
  return value;
}

std::int64_t Cursor::count(const char* what) {
  const std::int64_t n =
      binary_ ? static_cast<std::int64_t>(raw<std::uint64_t>(what)) : text_integer(what);
  if (n < 0) fail(fmt::format("{} is negative or too large: {}", what, n));
  return n;
}

double Cursor::real(const char* what) {
  if (!binary_) return text_real(what);
  const double value = raw<double>(what);
  if (!std::isfinite(value)) fail(fmt::format("{} is not a finite number", what));
  return value;
}

void Cursor::require(std::int64_t n, std::size_t text_bytes, std::size_t binary_bytes,
                     const char* what) const {
  const std::size_t most = (data_.size() - at_) / (binary_ ? binary_bytes : text_bytes);
  // The last line of a text file may lack its end.
  if (static_cast<std::uint64_t>(n) > most + (binary_ ? 0U : 1U))
    fail(fmt::format("{} {} announced, but the rest of the file holds at most {}", n, what, most));
}

}  // namespace osculate::io::gmsh
