// A table of points: what is written, and that nothing is when the input is bad.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "osculate/api/project.hpp"
#include "osculate/core/error.hpp"
#include "osculate/io/csv.hpp"

namespace osculate::api {
namespace {

class Project : public ::testing::Test {
 protected:
  std::string folder_ = ::testing::TempDir() + "osculate_project_" +
                        ::testing::UnitTest::GetInstance()->current_test_info()->name() + "/";
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ + name, std::ios::binary) << text;
    return folder_ + name;
  }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_ + name, std::ios::binary).rdbuf();
    return text.str();
  }
  [[nodiscard]] ProjectOptions options(const std::string& surface,
                                       const std::string& points) const {
    ProjectOptions o;
    o.surface = write("surface.yaml", surface);
    o.points = write("points.csv", points);
    o.output = folder_ + "out.csv";
    return o;
  }
};

constexpr const char* square =
    "{osculate_surface: 1, dimension: 3, nodes: [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]], "
    "facets: {quad4: [[0, 1, 2, 3]]}}";

TEST_F(Project, EveryRowGetsARow) {
  const ProjectOutcome done =
      project(options(square, "x,y,z,name\n1,0.5,3,a\n\n1,-1,0,b\nnan,0,0,c\n3,3,0,d\n"));
  EXPECT_TRUE(done.complete);
  EXPECT_EQ(done.points, 4);
  EXPECT_EQ(done.status[3], 1);
  EXPECT_EQ(done.feature[1], 1);
  EXPECT_EQ(done.feature[2], 1);
  EXPECT_EQ(done.feature[3], 1);
  EXPECT_THAT(done.message, ::testing::HasSubstr("1 face, 1 edge, 1 corner; 0 ambiguous"));
  const io::CsvTable table = io::read_csv(folder_ + "out.csv");
  EXPECT_EQ(table.columns,
            (std::vector<std::string>{"id", "feature", "facet", "xi1", "xi2", "x", "y", "z",
                                      "distance", "unique", "margin", "status"}));
  ASSERT_EQ(table.rows.size(), 4U);
  const std::vector<std::string> face{"0",   "face", "0", "0", "-0.5", "1",
                                      "0.5", "0",    "3", "1", "inf",  "projected"};
  for (std::size_t k = 0; k < face.size(); ++k)
    EXPECT_EQ(table.rows[0][k] == "-0" ? "0" : table.rows[0][k], face[k]) << table.columns[k];
  EXPECT_EQ(table.rows[1][1], "edge");
  EXPECT_EQ(table.rows[3][1], "corner");
  EXPECT_EQ(read("out.csv").find("2,,,,,,,,,,,invalid\n") != std::string::npos, true);
}

TEST_F(Project, AColumnThatDoesNotApplyIsEmpty) {
  ProjectOptions o = options("polyline: {points: [[1, 1], [1, -1]]}", "y,x\n0,3\n");
  o.fast = true;
  (void)project(o);
  const io::CsvTable table = io::read_csv(folder_ + "out.csv");
  ASSERT_EQ(table.rows.size(), 1U);
  for (const char* const empty : {"xi2", "z", "unique", "margin"})
    EXPECT_EQ(table.rows[0][static_cast<std::size_t>(table.find(empty))], "") << empty;
  EXPECT_NEAR(table.numbers(table.find("distance"))[0], 2, 1e-12);
  EXPECT_NEAR(table.numbers(table.find("x"))[0], 1, 1e-12);
}

TEST_F(Project, TheSameBytesForAnyNumberOfThreads) {
  std::string points = "x,y,z\n";
  for (int i = 0; i < 20'000; ++i)
    points += io::csv_number(3 * std::sin(1.3 * i)) + "," + io::csv_number(2 * std::cos(0.7 * i)) +
              "," + io::csv_number(std::sin(0.1 * i * i)) + "\n";
  ProjectOptions o = options(square, points);
  (void)project(o);
  const std::string one = read("out.csv");
  o.threads = 3;
  (void)project(o);
  EXPECT_EQ(one, read("out.csv"));
  EXPECT_EQ(std::count(one.begin(), one.end(), '\n'), 20'001);
}

std::string refusal(const ProjectOptions& o) {
  try {
    (void)project(o);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return {};
}

TEST_F(Project, NothingIsWrittenOverWhenTheInputIsBad) {
  std::string points = "x,y,z\n";
  for (int i = 0; i < 30'000; ++i) points += "1,2,3\n";
  ProjectOptions o = options(square, points + "1,2,three\n");
  (void)write("out.csv", "kept");
  EXPECT_EQ(refusal(o), o.points + ":30002: z: expected a number, found 'three'");
  o.points = write("flat.csv", "x,y\n1,2\n");
  EXPECT_EQ(refusal(o), o.points + ":1: there is no column 'z' in the header line; it has: x, y");
  o.surface = folder_ + "none.yaml";
  EXPECT_EQ(refusal(o), o.surface + ": no such file");
  EXPECT_EQ(read("out.csv"), "kept");
  EXPECT_FALSE(std::filesystem::exists(folder_ + "out.csv.part"));
}

TEST_F(Project, TheOutputIsNoInput) {
  ProjectOptions o = options(square, "x,y,z\n1,2,3\n");
  o.output = o.points;
  EXPECT_EQ(refusal(o),
            o.points + ": the output would take the place of its input; choose another name");
  EXPECT_EQ(read("points.csv"), "x,y,z\n1,2,3\n");
}

TEST_F(Project, InterruptedItLeavesTheOutputAlone) {
  ProjectOptions o = options(square, "x,y,z\n1,2,3\n");
  o.interrupted = [] { return true; };
  const ProjectOutcome done = project(o);
  EXPECT_FALSE(done.complete);
  EXPECT_EQ(done.message, "interrupted after 0 points; " + o.output + " was not written");
  EXPECT_FALSE(std::filesystem::exists(o.output));
  EXPECT_FALSE(std::filesystem::exists(o.output + ".part"));
}

TEST_F(Project, ATableWithoutRowsGivesOne) {
  (void)project(options(square, "x,y,z\n"));
  EXPECT_EQ(read("out.csv"), "id,feature,facet,xi1,xi2,x,y,z,distance,unique,margin,status\n");
}

}  // namespace
}  // namespace osculate::api
