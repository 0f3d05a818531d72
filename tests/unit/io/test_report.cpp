#include "osculate/io/report.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "osculate/core/error.hpp"
#include "osculate/io/report_bundle.hpp"

namespace osculate::io {
namespace {

std::string source_file(const std::string& path) {
  std::ifstream in(std::string(OSCULATE_SOURCE_DIR) + "/" + path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// The page is too long to be printed by a matcher that fails.
bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

std::size_t occurrences(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    ++count;
  return count;
}

/// What the page reads as its data: the text of the element with the id report-data.
std::string embedded_data(const std::string& html) {
  const std::string open = "id=\"report-data\">";
  const std::size_t begin = html.find(open) + open.size();
  return html.substr(begin, html.find("</script>", begin) - begin);
}

/// The inverse of base64, written independently: by looking up each letter's value.
std::vector<std::uint8_t> decode(const std::string& text) {
  std::vector<std::uint8_t> bytes;
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    if (c == '=') break;
    int v = 63;
    if (c >= 'A' && c <= 'Z') v = c - 'A';
    if (c >= 'a' && c <= 'z') v = c - 'a' + 26;
    if (c >= '0' && c <= '9') v = c - '0' + 52;
    if (c == '+') v = 62;
    bits = bits << 6 | static_cast<std::uint32_t>(v);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> held & 0xffU));
  }
  return bytes;
}

TEST(ReportBundle, IsTheCommittedFileByteForByte) {
  EXPECT_GT(report_bundle().size(), 50000u);
  EXPECT_EQ(std::string(report_bundle()), source_file("web/dist/report.js"));
  EXPECT_EQ(std::string(report_template()), source_file("web/page.html"));
}

TEST(ReportBundle, CannotEndItsOwnScript) {
  EXPECT_FALSE(contains(report_bundle(), "</script"));
  EXPECT_FALSE(contains(report_bundle(), "<!--"));
}

TEST(ReportHtml, HoldsTitleBundleAndData) {
  const std::string data =
      R"({"model": [{"title": "no"}], "title": "Block & <base>", "status": "done"})";
  const std::string html = report_html(data);
  EXPECT_TRUE(contains(html, "<title>Block &amp; &lt;base></title>"));
  EXPECT_TRUE(contains(html, report_bundle()));
  EXPECT_EQ(embedded_data(html),
            R"({"model": [{"title": "no"}], "title": "Block & \u003cbase>", "status": "done"})");
  EXPECT_EQ(html.rfind("</html>\n"), html.size() - 8);
}

TEST(ReportHtml, DataCannotEndTheScript) {
  const std::string html = report_html(R"({"title": "</script><script>x()</script><!--"})");
  EXPECT_EQ(occurrences(html, "</script>"), 2u);
  EXPECT_FALSE(contains(html, "<!--"));
  EXPECT_EQ(embedded_data(html),
            R"({"title": "\u003c/script>\u003cscript>x()\u003c/script>\u003c!--"})");
}

TEST(ReportHtml, MarksInTheDataStay) {
  const std::string html = report_html(R"({"title": "@DATA@ @BUNDLE@"})");
  EXPECT_TRUE(contains(html, "<title>@DATA@ @BUNDLE@</title>"));
  EXPECT_EQ(embedded_data(html), R"({"title": "@DATA@ @BUNDLE@"})");
  EXPECT_EQ(occurrences(html, std::string(report_bundle())), 1u);
}

TEST(ReportHtml, OfARunThatGoesOnAsksItsOwnServerAlone) {
  const std::string html = live_html("a <b>");
  EXPECT_TRUE(contains(html, "<title>a &lt;b></title>"));
  EXPECT_TRUE(contains(html, "default-src 'none'"));
  EXPECT_TRUE(contains(html, "connect-src 'self'"));
  EXPECT_EQ(embedded_data(html), R"({"live":true})");
  EXPECT_TRUE(contains(report_html("{}"), "connect-src 'none'"));
}

TEST(ReportHtml, AsksForNothingFromTheNetwork) {
  const std::string html = report_html("{}");
  EXPECT_TRUE(contains(html, "default-src 'none'"));
  EXPECT_EQ(occurrences(html, " src="), 0u);
  EXPECT_EQ(occurrences(html, "@import"), 0u);
  EXPECT_TRUE(contains(html, "<title>Osculate</title>"));
}

TEST(ReportHtml, RefusesWhatIsNotAnObjectAndNamesTheLine) {
  for (const std::string bad : {"", "[]", "3", "\"text\"", "{\"a\": 1} x"})
    EXPECT_THROW((void)report_html(bad), core::InputError) << bad;
  try {
    (void)report_html("{\"title\": \"a\",\n\"status\": }");
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_EQ(error.mark().line, 2);
    EXPECT_EQ(error.mark().file, "report.json");
  }
}

TEST(Base64, KnownValues) {
  EXPECT_EQ(base64_f32({}), "");
  const std::vector<float> one{1.0f};  // 00 00 80 3f
  EXPECT_EQ(base64_f32(one), "AACAPw==");
  const std::vector<float> two{1.0f, -2.0f};  // 00 00 80 3f 00 00 00 c0
  EXPECT_EQ(base64_f32(two), "AACAPwAAAMA=");
  const std::vector<float> three{0.0f, 1.0f, std::numeric_limits<float>::infinity()};
  EXPECT_EQ(base64_f32(three), "AAAAAAAAgD8AAIB/");
}

TEST(Base64, EveryBitSurvives) {
  std::vector<float> values;
  std::uint32_t state = 12345;
  for (int i = 0; i < 1000; ++i) {
    state = state * 1664525u + 1013904223u;
    values.push_back(std::bit_cast<float>(state & 0xff7fffffu));  // finite: no signalling NaN
  }
  for (std::size_t n : {1u, 2u, 3u, 4u, 5u, 1000u}) {
    const std::string text = base64_f32(std::span(values).first(n));
    EXPECT_EQ(text.size(), (4 * n + 2) / 3 * 4);
    const std::vector<std::uint8_t> bytes = decode(text);
    ASSERT_EQ(bytes.size(), 4 * n);
    for (std::size_t i = 0; i < n; ++i) {
      std::uint32_t bits = 0;
      for (std::size_t k = 0; k < 4; ++k) bits |= std::uint32_t{bytes[4 * i + k]} << (8 * k);
      ASSERT_EQ(bits, std::bit_cast<std::uint32_t>(values[i])) << i;
    }
  }
}

}  // namespace
}  // namespace osculate::io
