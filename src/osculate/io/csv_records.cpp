#include "osculate/io/csv_records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <set>

#include "osculate/core/error.hpp"
#include "osculate/core/text.hpp"
#include "osculate/io/readable.hpp"

namespace osculate::io {
namespace {

constexpr std::size_t piece = std::size_t{1} << 20U;
constexpr std::size_t longest_record = std::size_t{16} << 20U;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// At most 40 bytes, made fit for a message.
std::string shown(std::string_view text) {
  std::string out(text.substr(0, 40));
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  return text.size() > 40 ? out + "..." : out;
}

/// One cell after the other.
struct Cells {
  const std::string& file;
  const CsvRecord& record;
  std::size_t at = 0;
  bool more = true;

  [[noreturn]] void fail(const std::string& message) const {
    throw core::InputError({file, record.line, ""}, message);
  }

  /// The text up to the next comma, or between quotes (doubled ones stay doubled).
  std::string_view next() {
    const std::string_view text = record.text;
    while (at < text.size() && is_blank(text[at])) ++at;
    if (at < text.size() && text[at] == '"') return quoted();
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const std::string_view cell = trimmed(text.substr(at, comma - at));
    step_over(comma);
    return cell;
  }

 private:
  void step_over(std::size_t comma) {
    more = comma < record.text.size();
    at = comma + 1;
  }

  std::string_view quoted() {
    const std::string_view text = record.text;
    const std::size_t begin = ++at;
    for (;; ++at) {
      at = text.find('"', at);
      if (at == std::string_view::npos) fail("a quote is not closed");
      if (at + 1 >= text.size() || text[at + 1] != '"') break;
      ++at;
    }
    const std::string_view cell = text.substr(begin, at - begin);
    const std::size_t comma = std::min(text.find(',', ++at), text.size());
    if (!trimmed(text.substr(at, comma - at)).empty()) fail("text follows a closing quote");
    step_over(comma);
    return cell;
  }
};

std::string unquoted(std::string_view cell) {
  std::string text(cell);
  for (std::size_t at = 0; (at = text.find("\"\"", at)) != std::string::npos; ++at)
    text.erase(at, 1);
  return text;
}

/// True if the cell is a number; `value` is then set.
bool read_number(std::string_view cell, double& value) {
  value = std::numeric_limits<double>::quiet_NaN();
  if (cell.empty()) return true;
  if (cell.front() == '+' && cell.size() > 1 && cell[1] != '-' && cell[1] != '+')
    cell.remove_prefix(1);
  const char* const end = cell.data() + cell.size();
  const auto [stop, code] = std::from_chars(cell.data(), end, value);
  if (stop != end) return false;
  if (code == std::errc::result_out_of_range)  // too large, or too small: tells them apart
    value = std::strtod(std::string(cell).c_str(), nullptr);
  return code != std::errc::invalid_argument;
}

}  // namespace

CsvRecords::CsvRecords(std::string path) : path_(std::move(path)) {
  (void)readable_status(path_);
  errno = 0;
  file_.reset(std::fopen(path_.c_str(), "rb"));
  if (!file_) fail(0, std::string("cannot read: ") + std::strerror(errno));
  read_more();
  if (buffer_.starts_with("\xEF\xBB\xBF")) used_ = 3;
  while (!take_record()) {
    if (at_end_) fail(0, "the table is empty: expected a header line");
    read_more();
  }
  Cells cells{path_, records_.front()};
  header_line_ = records_.front().line;
  std::set<std::string> names;
  while (cells.more) {
    columns_.push_back(unquoted(cells.next()));
    if (!names.insert(columns_.back()).second)
      fail(header_line_, fmt::format("the column '{}' is there twice", shown(columns_.back())));
  }
  records_.clear();
}

std::size_t CsvRecords::find(const std::string& column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found != columns_.end()) return static_cast<std::size_t>(found - columns_.begin());
  std::vector<std::string> known;
  for (const std::string& name : columns_) known.push_back(shown(name));
  fail(header_line_, fmt::format("there is no column '{}' in the header line; it has: {}", column,
                                 core::join(known)));
}

void CsvRecords::fail(int line, const std::string& message) const {
  throw core::InputError({path_, line, ""}, message);
}

void CsvRecords::read_more() {
  const std::size_t before = buffer_.size();
  buffer_.resize(before + piece);
  errno = 0;
  const std::size_t got = std::fread(buffer_.data() + before, 1, piece, file_.get());
  if (std::ferror(file_.get()) != 0) fail(0, std::string("cannot read: ") + std::strerror(errno));
  buffer_.resize(before + got);
  at_end_ = got < piece;
}

/// The record at used_, if the buffer holds its end; blank lines are passed over.
bool CsvRecords::take_record() {
  for (;;) {
    std::size_t end = used_;
    int breaks = 0;
    bool open = false;  // between quotes
    for (std::size_t from = used_;; from = end + 1) {
      end = buffer_.find('\n', from);
      const bool last = end == std::string::npos;
      if (last && !at_end_) {
        if (buffer_.size() - used_ > longest_record)
          fail(line_, open ? "a quote is not closed" : "the row is longer than 16 MiB");
        return false;
      }
      if (last) end = buffer_.size();
      const auto begin = buffer_.begin() + static_cast<std::ptrdiff_t>(from);
      const auto stop = buffer_.begin() + static_cast<std::ptrdiff_t>(end);
      if (std::count(begin, stop, '"') % 2 != 0) open = !open;
      if (last && open) fail(line_, "a quote is not closed");
      breaks += last ? 0 : 1;
      if (!open) break;
    }
    const std::string_view text = std::string_view(buffer_).substr(used_, end - used_);
    const int line = line_;
    line_ += breaks;
    used_ = std::min(end + 1, buffer_.size());
    if (!trimmed(text).empty()) {
      records_.push_back({text, line});
      return true;
    }
    if (end == buffer_.size()) return false;
  }
}

std::span<const CsvRecord> CsvRecords::next() {
  records_.clear();
  buffer_.erase(0, used_);
  used_ = 0;
  if (!at_end_) read_more();
  while (records_.empty()) {
    while (take_record()) {
    }
    if (at_end_) break;
    if (records_.empty()) read_more();
  }
  return records_;
}

void read_numbers(const CsvPick& pick, const CsvRecord& record, std::span<double> values) {
  Cells cells{pick.file, record};
  std::size_t column = 0;
  for (; cells.more; ++column) {
    const std::string_view cell = cells.next();
    for (std::size_t i = 0; i < pick.wanted.size(); ++i)
      if (pick.wanted[i] == column && !read_number(cell, values[i]))
        throw core::InputError({pick.file, record.line, pick.columns[column]},
                               fmt::format("expected a number, found '{}'", shown(cell)));
  }
  if (column != pick.columns.size())
    throw core::InputError(
        {pick.file, record.line, ""},
        fmt::format("{} values where the header has {} columns", column, pick.columns.size()));
}

void append_csv_number(std::string& text, double value) {
  std::array<char, 40> digits{};
  const std::to_chars_result result = std::to_chars(digits.data(), digits.data() + digits.size(),
                                                    value, std::chars_format::general, 17);
  text.append(digits.data(), result.ptr);
}

}  // namespace osculate::io
