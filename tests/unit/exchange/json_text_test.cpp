// Texts and value lists as JSON. The expected texts follow RFC 8259.
#include "queries/exchange/json_text.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace queries {
namespace {

using algebra3d::NestedList;

std::string json_string(std::string_view text) {
  std::string json = "[";  // appended to what is there
  append_json_string(json, text);
  return json.substr(1);
}

std::string json_of(const std::string& list) {
  const auto parsed = NestedList::parse(list);
  EXPECT_TRUE(parsed.ok()) << list;
  std::string json;
  append_json(json, *parsed);
  return json;
}

TEST(JsonString, quotes_and_control_characters_are_escaped) {
  EXPECT_EQ(json_string(""), R"("")");
  EXPECT_EQ(json_string("bolt"), R"("bolt")");
  EXPECT_EQ(json_string("a\"b\\c/d"), R"("a\"b\\c/d")");
  EXPECT_EQ(json_string("a\nb\rc\td"), R"("a\nb\rc\td")");
  EXPECT_EQ(json_string("\x1b[2J\x07"), R"("\u001b[2J\u0007")");
  EXPECT_EQ(json_string(std::string_view("\0", 1)), R"("\u0000")");
  EXPECT_EQ(json_string("\x7f"), R"("\u007f")");
}

// A terminal takes U+009B as the beginning of a command.
TEST(JsonString, control_characters_of_two_bytes_are_escaped_and_letters_are_not) {
  EXPECT_EQ(json_string("\u0080\u009b\u009f"), R"("\u0080\u009b\u009f")");
  EXPECT_EQ(json_string("\u00a0\u00e9\u20ac\U0001f600"), "\"\u00a0\u00e9\u20ac\U0001f600\"");
}

// The oracle is another reader.
TEST(JsonString, another_reader_reads_every_character_back) {
  for (unsigned code = 0; code < 0x10000; ++code) {
    if (code >= 0xD800 && code < 0xE000) continue;
    std::string text;
    if (code < 0x80) {
      text += static_cast<char>(code);
    } else if (code < 0x800) {
      text += static_cast<char>(0xC0 | code >> 6);
      text += static_cast<char>(0x80 | (code & 0x3F));
    } else {
      text += static_cast<char>(0xE0 | code >> 12);
      text += static_cast<char>(0x80 | (code >> 6 & 0x3F));
      text += static_cast<char>(0x80 | (code & 0x3F));
    }
    ASSERT_EQ(nlohmann::json::parse(json_string(text)).get<std::string>(), text) << code;
  }
}

TEST(JsonList, lists_are_arrays_and_atoms_their_own_kind) {
  EXPECT_EQ(json_of("()"), "[]");
  EXPECT_EQ(json_of("(1 (2.5 TRUE) FALSE)"), "[1,[2.5,true],false]");
  EXPECT_EQ(json_of("(undefined 1/3 \"a b\" 'a\nb')"), R"([null,"1/3","a b","a\nb"])");
  // A text that says so is not undefined.
  EXPECT_EQ(json_of("('undefined')"), R"(["undefined"])");
}

TEST(JsonList, numbers_have_all_digits) {
  EXPECT_EQ(json_of("(9223372036854775807 -9223372036854775808)"), "[9223372036854775807,-9223372036854775808]");
  for (const double number : {0.1, 1e300, 5e-324, -1.0 / 3.0, 123456789012345680.0}) {
    std::string json;
    append_json(json, NestedList(number));
    EXPECT_EQ(nlohmann::json::parse(json).get<double>(), number) << json;
  }
}

}  // namespace
}  // namespace queries
