#include "osculate/io/plot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>
#include <stdexcept>

namespace osculate::io {
namespace {

/// Numbers of the groups of all matches.
std::vector<std::vector<double>> numbers(const std::string& text, const std::string& pattern) {
  std::vector<std::vector<double>> found;
  const std::regex expression(pattern);
  for (std::sregex_iterator i(text.begin(), text.end(), expression), end; i != end; ++i) {
    found.emplace_back();
    for (std::size_t k = 1; k < i->size(); ++k) found.back().push_back(std::stod((*i)[k]));
  }
  return found;
}
std::vector<std::vector<double>> circles(const std::string& svg) {
  return numbers(svg, "<circle cx=\"([0-9.-]+)\" cy=\"([0-9.-]+)\"");
}

LinePlot sample() {
  return {"Tip & ring",
          {"elements", false, {}},
          {"u < v", false, {}},
          {{"one", {1, 2, 3}, {5, 7, 6}, PlotStyle::line_and_marks}},
          {{"exact", 6.5}}};
}

TEST(Plot, PointsKeepTheirProportionsOnLinearAxes) {
  const auto at = circles(plot_svg(sample()));
  ASSERT_EQ(at.size(), 4u);  // three points and the key
  EXPECT_NEAR(at[1][0] - at[0][0], at[2][0] - at[1][0], 0.11);
  EXPECT_NEAR(at[0][1] - at[2][1], 0.5 * (at[0][1] - at[1][1]), 0.11);
  EXPECT_GT(at[0][1], at[1][1]);  // a picture's y goes down
}

TEST(Plot, EqualFactorsAreEqualDistancesOnLogarithmicAxes) {
  LinePlot p = sample();
  p.x = {"elements", true, {8, 16, 32}};
  p.y.logarithmic = true;
  p.curves[0] = {"error", {8, 16, 32}, {1e-1, 1e-3, 1e-5}, PlotStyle::line_and_marks};
  p.levels.clear();
  const std::string svg = plot_svg(p);
  const auto at = circles(svg);
  ASSERT_EQ(at.size(), 4u);
  EXPECT_NEAR(at[1][0] - at[0][0], at[2][0] - at[1][0], 0.11);
  EXPECT_NEAR(at[1][1] - at[0][1], at[2][1] - at[1][1], 0.11);
  for (const char* const tick : {">8<", ">16<", ">32<", ">1e-5<", ">0.1<"})
    EXPECT_NE(svg.find(tick), std::string::npos) << tick;
}

TEST(Plot, EverythingLiesInsideThePicture) {
  LinePlot p = sample();
  p.curves.push_back({std::string(80, 'w'), {-4e6}, {1e-7}, PlotStyle::marks});
  const std::string svg = plot_svg(p);
  const auto size = numbers(svg, "viewBox=\"0 0 ([0-9.]+) ([0-9.]+)\"");
  ASSERT_EQ(size.size(), 1u);
  for (const auto& at :
       numbers(svg, "(?:x|x1|x2|cx)=\"([0-9.-]+)\" (?:y|y1|y2|cy)=\"([0-9.-]+)\"")) {
    EXPECT_GE(at[0], 0);
    EXPECT_LE(at[0], size[0][0]);
    EXPECT_GE(at[1], 0);
    EXPECT_LE(at[1], size[0][1]);
  }
  EXPECT_GT(size[0][0], 80 * 6.0);
}

TEST(Plot, TextIsEscaped) {
  const std::string svg = plot_svg(sample());
  EXPECT_NE(svg.find("Tip &amp; ring"), std::string::npos);
  EXPECT_NE(svg.find("u &lt; v"), std::string::npos);
}

TEST(Plot, ValuesThatCannotBeShownInterruptTheLine) {
  LinePlot p = sample();
  p.curves[0] = {
      "gap", {1, 2, 3, 4, 5}, {1, 2, std::nan(""), 3, std::numeric_limits<double>::infinity()}, {}};
  const std::string svg = plot_svg(p);
  EXPECT_EQ(circles(svg).size(), 4u);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_TRUE(std::regex_search(svg, std::regex("d=\"M[0-9. ]+L[0-9. ]+M[0-9. ]+\"")));
}

TEST(Plot, ConstantAndEmptyCurvesHaveAxes) {
  for (const std::vector<double>& y : {std::vector<double>{0, 0}, {3e-9, 3e-9}, {}})
    for (const bool logarithmic : {false, true}) {
      LinePlot p;
      p.y.logarithmic = logarithmic;
      p.curves.push_back({"c", std::vector<double>(y.size(), 1), y, PlotStyle::line});
      const std::string svg = plot_svg(p);
      EXPECT_EQ(svg.find("nan"), std::string::npos);
      EXPECT_NE(svg.find("text-anchor=\"end\""), std::string::npos);  // numbers of the y axis
    }
}

TEST(Plot, CurvesOfUnequalLengthAreRefused) {
  LinePlot p = sample();
  p.curves[0].y.pop_back();
  EXPECT_THROW((void)plot_svg(p), std::invalid_argument);
}

}  // namespace
}  // namespace osculate::io
