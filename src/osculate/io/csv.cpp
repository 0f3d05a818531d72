#include "osculate/io/csv.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "osculate/core/error.hpp"
#include "osculate/io/gmsh.hpp"

namespace osculate::io {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Reads records one after the other.
struct Reader {
  std::string_view data;
  const std::string& name;
  std::size_t at = 0;
  int line = 1;

  [[noreturn]] void fail(int where, const std::string& message) const {
    throw core::InputError({name, where, ""}, message);
  }

  std::string quoted() {
    const int begin = line;
    std::string text;
    for (++at; at < data.size(); ++at) {
      if (data[at] == '\n') ++line;
      if (data[at] == '"') {
        if (at + 1 == data.size() || data[at + 1] != '"') {
          ++at;
          return text;
        }
        ++at;
      }
      text += data[at];
    }
    fail(begin, "a quote is not closed");
  }

  std::string cell() {
    while (at < data.size() && is_blank(data[at])) ++at;
    const bool is_quoted = at < data.size() && data[at] == '"';
    std::string text = is_quoted ? quoted() : std::string{};
    const std::size_t begin = at;
    while (at < data.size() && data[at] != ',' && data[at] != '\n') ++at;
    const std::string_view rest = trimmed(data.substr(begin, at - begin));
    if (is_quoted && !rest.empty()) fail(line, "text follows a closing quote");
    return is_quoted ? text : std::string(rest);
  }

  /// The cells of the next line; empty at a blank line.
  std::vector<std::string> record() {
    std::vector<std::string> cells{cell()};
    while (at < data.size() && data[at] == ',') {
      ++at;
      cells.push_back(cell());
    }
    if (at < data.size()) ++at;
    if (cells.size() == 1 && cells[0].empty()) cells.clear();
    return cells;
  }
};

}  // namespace

std::string csv_number(double value) { return fmt::format("{:.17g}", value); }

std::string csv_text(const std::string& text) {
  const bool plain = text.find_first_of(",\"\n\r") == std::string::npos && trimmed(text) == text;
  if (plain) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + "\"";
}

// ---- writing ------------------------------------------------------------------------------------

HistoryWriter::HistoryWriter(std::string path, const std::vector<std::string>& columns,
                             std::span<const HistoryRow> rows)
    : path_(std::move(path)), columns_(columns.size()), file_(path_, begin(columns, rows)) {}

std::uint64_t HistoryWriter::begin(const std::vector<std::string>& columns,
                                   std::span<const HistoryRow> rows) const {
  std::string text = "step,increment,time";
  for (const std::string& column : columns) text += "," + csv_text(column);
  text += "\n";
  for (const HistoryRow& row : rows) text += line(row);
  write_file(path_, text);
  return text.size();
}

std::string HistoryWriter::line(const HistoryRow& row) const {
  if (row.values.size() != columns_)
    throw std::invalid_argument(
        fmt::format("{}: {} values for {} columns", path_, row.values.size(), columns_));
  std::string text =
      fmt::format("{},{},{}", csv_text(row.step), row.increment, csv_number(row.time));
  for (const double value : row.values) text += "," + csv_number(value);
  return text + "\n";
}

void HistoryWriter::row(const HistoryRow& row) { file_.append(line(row)); }

// ---- reading ------------------------------------------------------------------------------------

int CsvTable::find(std::string_view column) const {
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i] == column) return static_cast<int>(i);
  return -1;
}

std::vector<double> CsvTable::numbers(int column) const {
  std::vector<double> values;
  values.reserve(rows.size());
  const auto k = static_cast<std::size_t>(column);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string& cell = rows[i][k];
    double value = std::numeric_limits<double>::quiet_NaN();
    const char* const begin = cell.data() + (cell.starts_with('+') ? 1 : 0);
    const char* const end = cell.data() + cell.size();
    const std::from_chars_result result = std::from_chars(begin, end, value);
    if (!cell.empty() && (result.ec == std::errc::invalid_argument || result.ptr != end))
      throw core::InputError({file, lines[i], columns[k]},
                             fmt::format("expected a number, found '{}'", cell));
    if (result.ec == std::errc::result_out_of_range)
      throw core::InputError({file, lines[i], columns[k]},
                             fmt::format("the number '{}' is too large or too small", cell));
    values.push_back(value);
  }
  return values;
}

CsvTable parse_csv(std::string_view content, const std::string& name) {
  if (content.starts_with("\xEF\xBB\xBF")) content.remove_prefix(3);
  Reader reader{content, name};
  CsvTable table;
  table.file = name;
  while (reader.at < content.size()) {
    const int line = reader.line;
    std::vector<std::string> cells = reader.record();
    ++reader.line;
    if (cells.empty()) continue;
    if (table.columns.empty()) {
      std::set<std::string> used;
      for (const std::string& cell : cells)
        if (!used.insert(cell).second)
          reader.fail(line, fmt::format("the column '{}' is there twice", cell));
      table.columns = std::move(cells);
      continue;
    }
    if (cells.size() != table.columns.size())
      reader.fail(line, fmt::format("{} values where the header has {} columns", cells.size(),
                                    table.columns.size()));
    table.rows.push_back(std::move(cells));
    table.lines.push_back(line);
  }
  if (table.columns.empty()) reader.fail(0, "the table is empty: expected a header line");
  return table;
}

CsvTable read_csv(const std::string& path) { return parse_csv(read_file(path), path); }

}  // namespace osculate::io
