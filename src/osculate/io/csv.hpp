#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "osculate/io/append_file.hpp"

namespace osculate::io {

/// A row of history.csv.
struct HistoryRow {
  std::string step;
  int increment = 0;
  double time = 0;
  std::vector<double> values;
};

/// Writes `history.csv` row by row: `step,increment,time` and one column per request. Every row is
/// in the file when row() returns, so that a running analysis can be watched, and the file ends
/// with a whole row even when the disk is full.
///
/// Errors     WriteError; std::invalid_argument if a row has not the number of columns
/// Tested by  tests/unit/io/test_csv.cpp
class HistoryWriter {
 public:
  /// Replaces the file by one of these rows.
  HistoryWriter(std::string path, const std::vector<std::string>& columns,
                std::span<const HistoryRow> rows = {});
  void row(const HistoryRow& row);

 private:
  [[nodiscard]] std::string line(const HistoryRow& row) const;
  [[nodiscard]] std::uint64_t begin(const std::vector<std::string>& columns,
                                    std::span<const HistoryRow> rows) const;
  std::string path_;
  std::size_t columns_;
  AppendFile file_;
};

/// A number with 17 significant digits: reading it back gives the same bits. `nan`, `inf`, `-inf`.
[[nodiscard]] std::string csv_number(double value);
/// A text, in quotes where it needs them.
[[nodiscard]] std::string csv_text(const std::string& text);

/// A table with a header line.
struct CsvTable {
  std::string file;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< each with columns.size() cells
  std::vector<int> lines;                      ///< of the rows in the file, 1-based
  /// Position of a column, -1 if there is none.
  [[nodiscard]] int find(std::string_view column) const;
  /// All values of a column as numbers (`nan` and `inf` included, an empty cell is NaN).
  /// core::InputError names the line of a cell that is no number.
  [[nodiscard]] std::vector<double> numbers(int column) const;
};

/// Commas, optional double quotes, `\n` or `\r\n`; blank lines are skipped, blanks around cells
/// dropped. core::InputError for rows of another length than the header, an open quote, a column
/// name that is there twice, or a file that cannot be read.
[[nodiscard]] CsvTable read_csv(const std::string& path);
[[nodiscard]] CsvTable parse_csv(std::string_view content, const std::string& name);

}  // namespace osculate::io
