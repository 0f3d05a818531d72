#pragma once
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace osculate::io {

/// One row of a table as it is written: a line, or several where a quoted cell holds line breaks.
struct CsvRecord {
  std::string_view text;
  int line = 0;  ///< where it begins, 1-based
};

/// Reads a table of any length block by block; the same rules as read_csv() in csv.hpp: commas,
/// optional double quotes, `\n` or `\r\n`, blank lines are skipped, a byte order mark is ignored.
///
/// Errors     core::InputError for a file that cannot be read, has no header line, a column name
///            that is there twice, an open quote, a row of more than 16 MiB
/// Tested by  tests/unit/io/test_csv_records.cpp
class CsvRecords {
 public:
  explicit CsvRecords(std::string path);
  [[nodiscard]] const std::string& file() const { return path_; }
  [[nodiscard]] const std::vector<std::string>& columns() const { return columns_; }
  /// Position of a column; core::InputError with those that are there if there is none.
  [[nodiscard]] std::size_t find(const std::string& column) const;
  /// The next rows (some thousand); none at the end of the file. Valid until the next call.
  [[nodiscard]] std::span<const CsvRecord> next();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void read_more();
  [[nodiscard]] bool take_record();
  [[noreturn]] void fail(int line, const std::string& message) const;

  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::vector<std::string> columns_;
  std::string buffer_;
  std::size_t used_ = 0;  ///< of the buffer: what the records of the last call stood in
  int line_ = 1;
  int header_line_ = 1;
  bool at_end_ = false;
  std::vector<CsvRecord> records_;
};

/// Which columns of a table are numbers that somebody wants.
struct CsvPick {
  std::string file;
  std::vector<std::string> columns;  ///< of the table
  std::vector<std::size_t> wanted;   ///< positions, increasing or not, each once
};

/// The wanted cells of a row as numbers: `nan`, `inf` and numbers beyond the range of doubles are
/// not finite, an empty cell is NaN.
///
/// Errors     core::InputError with line and column for any other cell that is no number, with the
///            line for a row of another length than the header
void read_numbers(const CsvPick& pick, const CsvRecord& record, std::span<double> values);

/// Appends a number with 17 significant digits: as csv_number(), but fast.
void append_csv_number(std::string& text, double value);

}  // namespace osculate::io
