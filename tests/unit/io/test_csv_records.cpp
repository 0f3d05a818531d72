// Tables read block by block: the rules of read_csv, and every mistake with its message.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "osculate/core/error.hpp"
#include "osculate/io/csv.hpp"
#include "osculate/io/csv_records.hpp"

namespace osculate::io {
namespace {

class CsvRecordsTest : public ::testing::Test {
 protected:
  std::string path_ = ::testing::TempDir() + "osculate_records_" +
                      ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv";
  void write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }
  void TearDown() override { std::filesystem::remove(path_); }

  /// The wanted columns of all rows, one after the other.
  [[nodiscard]] std::vector<double> numbers(const std::vector<std::string>& wanted) const {
    CsvRecords table(path_);
    CsvPick pick{table.file(), table.columns(), {}};
    for (const std::string& name : wanted) pick.wanted.push_back(table.find(name));
    std::vector<double> all, row(wanted.size());
    for (std::span<const CsvRecord> block = table.next(); !block.empty(); block = table.next())
      for (const CsvRecord& record : block) {
        read_numbers(pick, record, row);
        all.insert(all.end(), row.begin(), row.end());
      }
    return all;
  }
  [[nodiscard]] std::string refusal(const std::string& text,
                                    const std::vector<std::string>& wanted = {"x", "y"}) const {
    write(text);
    try {
      (void)numbers(wanted);
    } catch (const core::InputError& error) {
      const std::string message = error.what();
      return message.starts_with(path_) ? message.substr(path_.size()) : message;
    }
    return {};
  }
};

TEST_F(CsvRecordsTest, ColumnsInAnyOrderAndOthersIgnored) {
  write("name,y,x\nfirst,1,2\nsecond,3.5,-4e-1\n");
  EXPECT_EQ(numbers({"x", "y"}), (std::vector<double>{2, 1, -0.4, 3.5}));
}

TEST_F(CsvRecordsTest, WindowsLineEndsByteOrderMarkBlankLinesAndBlanks) {
  write("\xEF\xBB\xBFx , y\r\n\r\n 1 ,\t2\r\n   \r\n3,4");
  EXPECT_EQ(numbers({"x", "y"}), (std::vector<double>{1, 2, 3, 4}));
}

TEST_F(CsvRecordsTest, QuotedCellsMayHoldCommasQuotesAndLineBreaks) {
  write("note,\"x\",y\n\"a, \"\"b\"\"\nc\",1,\"2\"\n\"\",+3,4\n");
  EXPECT_EQ(numbers({"x", "y"}), (std::vector<double>{1, 2, 3, 4}));
}

TEST_F(CsvRecordsTest, WhatIsNotFiniteAndWhatIsMissing) {
  write("x,y\nnan,-inf\nNaN,Infinity\n,1e999\n-1e999,1e-999\n");
  const std::vector<double> v = numbers({"x", "y"});
  const double inf = std::numeric_limits<double>::infinity();
  ASSERT_EQ(v.size(), 8U);
  EXPECT_TRUE(std::isnan(v[0]) && std::isnan(v[2]) && std::isnan(v[4]));
  EXPECT_EQ(v[1], -inf);
  EXPECT_EQ(v[3], inf);
  EXPECT_EQ(v[5], inf);
  EXPECT_EQ(v[6], -inf);
  EXPECT_EQ(v[7], 0);
}

TEST_F(CsvRecordsTest, MistakesNameLineAndColumn) {
  EXPECT_EQ(refusal("x,y\n1,2\n\n1,abc\n"), ":4: y: expected a number, found 'abc'");
  EXPECT_EQ(refusal("x,y\n1,0x10\n"), ":2: y: expected a number, found '0x10'");
  EXPECT_EQ(refusal("x,y\n1,2 3\n"), ":2: y: expected a number, found '2 3'");
  EXPECT_EQ(refusal("x,y\n1,-\n"), ":2: y: expected a number, found '-'");
  EXPECT_EQ(refusal("x,y\n1,+-2\n"), ":2: y: expected a number, found '+-2'");
  EXPECT_EQ(refusal("x,y\n1\n"), ":2: 1 values where the header has 2 columns");
  EXPECT_EQ(refusal("x,y\n1,2,3\n"), ":2: 3 values where the header has 2 columns");
  EXPECT_EQ(refusal("x,y\n0,5,0,5\n"), ":2: 4 values where the header has 2 columns");
  EXPECT_EQ(refusal("x,y\n\"1\"2,2\n"), ":2: text follows a closing quote");
  EXPECT_EQ(refusal("x,y\n1,2\n\"1,2\n"), ":3: a quote is not closed");
  EXPECT_EQ(refusal("n,x,y\n\"a\nb\",1,2\nc,1,two\n"), ":4: y: expected a number, found 'two'");
}

TEST_F(CsvRecordsTest, MistakesInTheHeader) {
  EXPECT_EQ(refusal(""), ": the table is empty: expected a header line");
  EXPECT_EQ(refusal("\n \n"), ": the table is empty: expected a header line");
  EXPECT_EQ(refusal("x,y,x\n1,2,3\n"), ":1: the column 'x' is there twice");
  EXPECT_EQ(refusal("0.5,0.25\n"),
            ":1: there is no column 'x' in the header line; it has: 0.5, 0.25");
  EXPECT_EQ(refusal("x;y\n1;2\n"), ":1: there is no column 'x' in the header line; it has: x;y");
  EXPECT_EQ(refusal("x,yy\n1,2\n"), ":1: there is no column 'y' in the header line; it has: x, yy");
}

TEST_F(CsvRecordsTest, FilesThatCannotBeRead) {
  EXPECT_THROW((void)CsvRecords(path_ + ".none"), core::InputError);
  EXPECT_THROW((void)CsvRecords(::testing::TempDir()), core::InputError);
}

TEST_F(CsvRecordsTest, LongTablesComeInBlocks) {
  std::string text = "x,y\n";
  constexpr int rows = 300'000;
  for (int i = 0; i < rows; ++i) text += std::to_string(i) + ",\"" + std::to_string(-i) + "\"\n";
  write(text);
  const std::vector<double> v = numbers({"x", "y"});
  ASSERT_EQ(v.size(), 2U * rows);
  for (int i = 0; i < rows; ++i) {
    ASSERT_EQ(v[2 * static_cast<std::size_t>(i)], i);
    ASSERT_EQ(v[2 * static_cast<std::size_t>(i) + 1], -i);
  }
  CsvRecords table(path_);
  EXPECT_LT(table.next().size(), static_cast<std::size_t>(rows) / 2);
}

TEST_F(CsvRecordsTest, ARowOfAnyReasonableLength) {
  write("x,y,note\n1,2," + std::string(3'000'000, 'a') + "\n3,4,\n");
  EXPECT_EQ(numbers({"x", "y"}), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(refusal("x,y\n1," + std::string(17U << 20U, '2')), ":2: the row is longer than 16 MiB");
}

TEST(CsvNumber, FastWritingGivesTheSameText) {
  for (const double value : {0.0, -0.0, 1.0, 0.1, 1.0 / 3, 1e300, -2.5e-300, 5e-324, 123456789.0,
                             1e16, 1e17, std::numeric_limits<double>::infinity()}) {
    std::string text;
    append_csv_number(text, value);
    EXPECT_EQ(text, csv_number(value));
  }
}

}  // namespace
}  // namespace osculate::io
