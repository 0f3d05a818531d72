#include "osculate/io/utf8.hpp"

#include <gtest/gtest.h>

namespace osculate::io {
namespace {

TEST(PlainText, AnyScriptIsPlain) {
  for (const char* text :
       {"", "bottom edge", "a/b#1~", "gr\xC3\xB6\xC3\x9F", "\xC2\xA0", "\xE4\xB8\x8B\xE8\xBE\xB9",
        "\xED\x9F\xBF", "\xEE\x80\x80", "\xF0\x9F\x98\x80", "\xF4\x8F\xBF\xBD"})
    EXPECT_TRUE(is_plain_text(text)) << text;
}

TEST(PlainText, ControlCharactersAreNot) {
  for (const char* text :
       {"a\tb", "a\n", "\x1b[2J", "\x7f", "\xC2\x80", "\xC2\x9F", "\xEF\xBF\xBE"})
    EXPECT_FALSE(is_plain_text(text));
  EXPECT_FALSE(is_plain_text(std::string_view("a\0b", 3)));
}

TEST(PlainText, MalformedUtf8IsNot) {
  for (const char* text : {"\x80", "\xC3", "\xC3(", "\xC0\xAF", "\xC1\xBF", "\xE0\x80\xAF",
                           "\xE0\x9F\xBF", "\xE4\xB8", "\xED\xA0\x80", "\xED\xBF\xBF",
                           "\xF0\x8F\xBF\xBF", "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xFF"})
    EXPECT_FALSE(is_plain_text(text));
}

}  // namespace
}  // namespace osculate::io
