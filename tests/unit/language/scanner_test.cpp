#include "queries/language/scanner.h"

#include <gtest/gtest.h>

namespace queries {
namespace {

using Kind = Token::Kind;

/// Every token as `kind:text`, one after the other.
std::string scanned(std::string_view text) {
  static constexpr std::array<const char*, 13> kNames = {"end",     "word", "int",     "real",      "bool",
                                                         "string",  "text", "file",    "attribute", "parameter",
                                                         "special", "name", "constant"};
  Scanner scanner(text);
  std::string result;
  while (scanner.peek().kind != Kind::end) {
    const Token token = scanner.take();
    std::string content = token.text;
    if (token.kind == Kind::integer) content = std::to_string(token.integer);
    if (token.kind == Kind::real) content = fmt::format("{}", token.real);
    if (token.parameter > 0) content = fmt::format("{}/{}", token.parameter, token.text);
    result += fmt::format("{}{}:{}", result.empty() ? "" : " ", kNames[static_cast<std::size_t>(token.kind)], content);
  }
  if (scanner.error()) result += " error:" + scanner.error()->message;
  return result;
}

TEST(Scanner, words_have_letters_digits_and_underscores) {
  EXPECT_EQ(scanned("a_1 B2 _x let_"), "word:a_1 word:B2 word:_x word:let_");
}

TEST(Scanner, dollars_stand_before_numbers_and_names_of_parameters) {
  EXPECT_EQ(scanned("$1 $2.A $limit $a_1+$b"),
            "parameter:1/ attribute:2/A constant:limit constant:a_1 special:+ constant:b");
  EXPECT_EQ(scanned("$").substr(0, 15), "special:$ error");
}

TEST(Scanner, numbers) {
  EXPECT_EQ(scanned("0 12 .5 5. 1e-3 2.5E+2"), "int:0 int:12 real:0.5 real:5 real:0.001 real:250");
}

TEST(Scanner, a_sign_is_a_token_of_its_own) {
  EXPECT_EQ(scanned("a -3"), "word:a special:- int:3");
  EXPECT_EQ(scanned("1--1"), "int:1 special:- special:- int:1");
  EXPECT_EQ(scanned("x<-1"), "word:x special:< special:- int:1");
}

TEST(Scanner, the_magnitude_of_the_smallest_int_is_a_token) {
  EXPECT_EQ(scanned("9223372036854775808"), "int:9223372036854775808");
}

TEST(Scanner, numbers_out_of_range_are_errors) {
  EXPECT_NE(scanned("9223372036854775809").find("error:the integer 9223372036854775809 is beyond the range of ints"),
            std::string::npos);
  EXPECT_NE(scanned("1e999").find("error:the number 1e999 is beyond the range of reals"), std::string::npos);
}

TEST(Scanner, strings_and_texts_with_escapes) {
  EXPECT_EQ(scanned(R"("a\"b\\c\d" 'it\'s')"), R"(string:a"b\c\d text:it's)");
  EXPECT_EQ(scanned("<text>it's \"raw\"\n</text--->"), "text:it's \"raw\"\n");
}

TEST(Scanner, a_file_atom_is_one_token) {
  EXPECT_EQ(scanned("<file>it's; (1</file---> x"), "file:it's; (1 word:x");
  EXPECT_NE(scanned("<file>a").find("error:a file atom is not closed: expected </file--->"), std::string::npos);
}

TEST(Scanner, attributes_and_parameters) {
  EXPECT_EQ(scanned(".Name ..Name $2.Name"), "attribute:1/Name attribute:2/Name attribute:2/Name");
  EXPECT_EQ(scanned(". .. $3"), "parameter:1/ parameter:2/ parameter:3/");
}

TEST(Scanner, runs_of_special_characters_are_one_token) {
  EXPECT_EQ(scanned("a<=b:=c#d"), "word:a special:<= word:b special::= word:c special:# word:d");
  EXPECT_EQ(scanned("{{ }} [(;,)]"),
            "special:{{ special:}} special:[ special:( special:; special:, special:) special:]");
}

TEST(Scanner, what_does_not_belong_to_the_language_is_named_whole) {
  EXPECT_EQ(scanned("1 \u00e4"), "int:1 special:\u00e4 error:the character '\u00e4' does not belong to the language");
  EXPECT_EQ(scanned("~$"), "special:~ special:$ error:the character '$' does not belong to the language");
}

TEST(Scanner, names_in_backquotes) {
  EXPECT_EQ(scanned("`union` union`x_1`"), "name:union word:union name:x_1");
  EXPECT_EQ(scanned("`1a`"), "name:1a error:expected a name between backquotes: a letter, then letters, digits and _");
}

TEST(Scanner, places_count_lines_and_characters) {
  Scanner scanner("ab \"\u00e4\u00f6\" cd\n  ef", {"file", 7, 5});
  EXPECT_EQ(scanner.take().place.column, 5);
  EXPECT_EQ(scanner.take().place.column, 8);
  EXPECT_EQ(scanner.take().place.column, 13);
  const SourcePlace place = scanner.take().place;
  EXPECT_EQ(place.line, 8);
  EXPECT_EQ(place.column, 3);
  EXPECT_EQ(place.file, "file");
}

TEST(Scanner, raw_text_ends_at_its_bracket_only) {
  Scanner scanner("x (\"]\" ']' (a) _! ] !_ b) ] rest");
  scanner.take();
  EXPECT_EQ(scanner.take_raw_until(']').value_or("none"), " (\"]\" ']' (a) _! ] !_ b) ");
  EXPECT_EQ(scanner.take().text, "]");
  EXPECT_EQ(scanner.take().text, "rest");
}

TEST(Scanner, raw_text_steps_back_over_what_was_looked_at) {
  Scanner scanner("(\u00a7 1) ] rest");
  scanner.peek(1);
  EXPECT_EQ(scanner.take_raw_until(']').value_or("none"), "(\u00a7 1) ");
  EXPECT_FALSE(scanner.error());
  EXPECT_EQ(scanner.take().place.column, 7);
}

TEST(Scanner, raw_text_without_its_bracket) {
  EXPECT_FALSE(Scanner("(a b").take_raw_until(']'));
  EXPECT_FALSE(Scanner("a b)").take_raw_list());
  Scanner scanner("  (\"never closed");
  EXPECT_FALSE(scanner.take_raw_until(']'));
  ASSERT_TRUE(scanner.error());
  EXPECT_EQ(scanner.error()->message, "a string is not closed: expected \"");
  EXPECT_EQ(scanner.error()->place.column, 4);
}

TEST(Scanner, raw_list_is_cut_out_whole) {
  Scanner scanner(" (a (b) \")\") c");
  EXPECT_EQ(scanner.take_raw_list().value_or("none"), "(a (b) \")\")");
  EXPECT_EQ(scanner.take().text, "c");
}

}  // namespace
}  // namespace queries
