#include "osculate/io/csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <random>

#include "osculate/core/error.hpp"
#include "osculate/io/gmsh.hpp"

namespace osculate::io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

void expect_error(const std::string& content, const std::string& message) {
  try {
    const CsvTable table = parse_csv(content, "t.csv");
    for (std::size_t k = 0; k < table.columns.size(); ++k) (void)table.numbers(static_cast<int>(k));
    ADD_FAILURE() << "accepted; expected: " << message;
  } catch (const core::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(message));
  }
}

TEST(Csv, HistoryHoldsEveryBit) {
  const std::string path = ::testing::TempDir() + "/history_bits.csv";
  std::mt19937_64 random(1);
  std::vector<std::array<double, 2>> rows;
  {
    HistoryWriter writer(path, {"top.ux", "floor.normal_force"});
    for (int i = 0; i < 2000; ++i) {
      std::array<double, 2> row{};
      for (double& value : row) {
        do value = std::bit_cast<double>(random());
        while (!std::isnormal(value));
      }
      rows.push_back(row);
      writer.row({"press", i, row[0], {row.begin(), row.end()}});
    }
  }
  const CsvTable table = read_csv(path);
  EXPECT_THAT(table.columns,
              ElementsAre("step", "increment", "time", "top.ux", "floor.normal_force"));
  ASSERT_EQ(table.rows.size(), rows.size());
  const std::vector<double> a = table.numbers(table.find("top.ux"));
  const std::vector<double> b = table.numbers(table.find("floor.normal_force"));
  EXPECT_EQ(table.numbers(2), a);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a[i]), std::bit_cast<std::uint64_t>(rows[i][0]));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(b[i]), std::bit_cast<std::uint64_t>(rows[i][1]));
  }
  std::filesystem::remove(path);
}

TEST(Csv, EveryRowIsOnDiskAtOnce) {
  const std::string path = ::testing::TempDir() + "/history_rows.csv";
  HistoryWriter writer(path, {"a,b"});
  EXPECT_EQ(read_file(path), "step,increment,time,\"a,b\"\n");
  writer.row({"say \"hi\"", 1, 0.1, {-1e300}});
  EXPECT_EQ(read_file(path),
            "step,increment,time,\"a,b\"\n"
            "\"say \"\"hi\"\"\",1,0.10000000000000001,-1.0000000000000001e+300\n");
  EXPECT_THROW(writer.row({"s", 2, 0, {}}), std::invalid_argument);
  const CsvTable table = read_csv(path);
  EXPECT_EQ(table.columns.back(), "a,b");
  EXPECT_EQ(table.rows[0][0], "say \"hi\"");
  std::filesystem::remove(path);
}

TEST(Csv, WhereNothingCanBeWrittenThereIsAnError) {
  try {
    HistoryWriter writer("/nowhere/h.csv", {});
    ADD_FAILURE();
  } catch (const WriteError& error) {
    EXPECT_STREQ(error.what(), "/nowhere/h.csv: cannot write: No such file or directory");
  }
  try {
    HistoryWriter writer("/dev/full", {});
    ADD_FAILURE();
  } catch (const WriteError& error) {
    EXPECT_STREQ(error.what(), "/dev/full: cannot write: No space left on device");
    EXPECT_EQ(error.path(), "/dev/full");
  }
}

TEST(Csv, QuotesBlanksAndLineEnds) {
  const CsvTable table = parse_csv(
      "\xEF\xBB\xBF x , \"y, z\" ,w\r\n\r\n1, 2 ,3\r\n+4,,\"nan\"\n\n-inf,1e3,\"0.5\"", "t.csv");
  EXPECT_THAT(table.columns, ElementsAre("x", "y, z", "w"));
  ASSERT_THAT(table.rows, SizeIs(3));
  EXPECT_THAT(table.lines, ElementsAre(3, 4, 6));
  EXPECT_EQ(table.find("w"), 2);
  EXPECT_EQ(table.find("q"), -1);
  EXPECT_THAT(table.numbers(0), ElementsAre(1, 4, -std::numeric_limits<double>::infinity()));
  const std::vector<double> y = table.numbers(1);
  EXPECT_EQ(y[0], 2);
  EXPECT_TRUE(std::isnan(y[1]));
  EXPECT_EQ(y[2], 1000);
  EXPECT_TRUE(std::isnan(table.numbers(2)[1]));
}

TEST(Csv, LinesAreCountedThroughQuotes) {
  const CsvTable table = parse_csv("a\n\"two\nlines\"\n3\n", "t.csv");
  EXPECT_THAT(table.lines, ElementsAre(2, 4));
  EXPECT_EQ(table.rows[0][0], "two\nlines");
}

TEST(Csv, HeaderOnlyIsATableWithoutRows) { EXPECT_THAT(parse_csv("x,y", "t").rows, IsEmpty()); }

TEST(Csv, BrokenTables) {
  expect_error("", "t.csv: the table is empty");
  expect_error("\n \n", "t.csv: the table is empty");
  expect_error("x,y\n1,2\n3\n", "t.csv:3: 1 values where the header has 2 columns");
  expect_error("x\n1,2\n", "t.csv:2: 2 values where the header has 1 columns");
  expect_error("x,y\n1,two\n", "t.csv:2: y: expected a number, found 'two'");
  expect_error("x\n1.5.2\n", "t.csv:2: x: expected a number, found '1.5.2'");
  expect_error("x\n1e999\n", "t.csv:2: x: the number '1e999' is too large or too small");
  expect_error("x\n\"1\n", "t.csv:2: a quote is not closed");
  expect_error("x\n\"1\"2\n", "t.csv:2: text follows a closing quote");
  expect_error("x,x\n", "t.csv:1: the column 'x' is there twice");
}

}  // namespace
}  // namespace osculate::io
