#include "algebra3d/values/types/utf8.h"

#include <gtest/gtest.h>

namespace algebra3d {
namespace {

using std::string_literals::operator""s;

TEST(utf8, the_first_byte_that_no_text_has) {
  EXPECT_EQ(first_no_text(""), std::string_view::npos);
  EXPECT_EQ(first_no_text("gr\xC3\xBC\xC3\x9F"
                          "e \xF0\x9F\x94\xA7"),
            std::string_view::npos);
  EXPECT_EQ(first_no_text("a\xFF\0"s), 1U);
  EXPECT_EQ(first_no_text("a\0\xFF"s), 1U);
  EXPECT_EQ(first_no_text("0123456789abcdef\xE2\x82"), 16U);
}

TEST(utf8, what_is_wrong_with_it) {
  EXPECT_EQ(no_text_message('\xFF'), "expected UTF-8, found the byte 0xff");
  EXPECT_EQ(no_text_message('\0'), "expected text, found a zero byte");
}

TEST(utf8, foreign_bytes_are_shown_as_text) {
  EXPECT_EQ(shown_as_text("gr\xC3\xBC\xC3\x9F"
                          "e"),
            "gr\xC3\xBC\xC3\x9F"
            "e");
  EXPECT_EQ(shown_as_text("caf\xE9.stl"), "caf\\xe9.stl");
  EXPECT_EQ(shown_as_text("\0\xFF"s), "\\x00\\xff");
}

TEST(utf8, places_count_characters_and_lines) {
  const auto place = [](std::string_view text) {
    const SourcePlace found = place_behind(text, {"file", 3, 10});
    return fmt::format("{}:{}:{}", found.file, found.line, found.column);
  };
  EXPECT_EQ(place(""), "file:3:10");
  EXPECT_EQ(place("\xC3\xBC"
                  "b"),
            "file:3:12");
  EXPECT_EQ(place("a\n\n\xC3\xBC"), "file:5:2");
}

}  // namespace
}  // namespace algebra3d
