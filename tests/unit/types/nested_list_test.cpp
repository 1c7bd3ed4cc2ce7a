#include "algebra3d/values/types/nested_list.h"

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "algebra3d/values/types/expression_list.h"

namespace algebra3d {
namespace {

using List = NestedList;

List parsed(std::string_view source) {
  auto result = List::parse(source);
  EXPECT_TRUE(result.ok()) << source << ": " << (result.ok() ? "" : result.error().text());
  return result.ok() ? std::move(result).value() : List();
}

// "line:column code message", so that one comparison checks all of an error.
std::string error_of(std::string_view source) {
  const auto result = List::parse(source);
  if (result.ok()) return "no error, but " + result->print();
  const auto& error = result.error();
  return fmt::format("{}:{} {}: {}", error.place.line, error.place.column, describe(error.code).name, error.text());
}

TEST(nested_list, atoms_have_the_kind_that_their_spelling_says) {
  EXPECT_EQ(parsed("12"), List(12));
  EXPECT_EQ(parsed("-3"), List(-3));
  EXPECT_EQ(parsed("007"), List(7));
  EXPECT_EQ(parsed("+5"), List(5.0));
  EXPECT_EQ(parsed(".5"), List(0.5));
  EXPECT_EQ(parsed("5."), List(5.0));
  EXPECT_EQ(parsed("-.5e1"), List(-5.0));
  EXPECT_EQ(parsed("1e-3"), List(0.001));
  EXPECT_EQ(parsed("1E+3"), List(1000.0));
  EXPECT_EQ(parsed("TRUE"), List(true));
  EXPECT_EQ(parsed("FALSE"), List(false));
  EXPECT_EQ(parsed("true"), List::symbol("true"));
  EXPECT_EQ(parsed("\"a string\""), List(std::string("a string")));
  EXPECT_EQ(parsed("'a text'"), List::text("a text"));
  EXPECT_EQ(parsed("Name_2"), List::symbol("Name_2"));
  EXPECT_EQ(parsed("1/3"), List::symbol("1/3"));
  EXPECT_EQ(parsed("-7/5"), List::symbol("-7/5"));
}

TEST(nested_list, integers_beyond_64_bits_are_reals) {
  EXPECT_EQ(parsed("9223372036854775807"), List(std::numeric_limits<std::int64_t>::max()));
  EXPECT_EQ(parsed("-9223372036854775808"), List(std::numeric_limits<std::int64_t>::min()));
  EXPECT_EQ(parsed("9223372036854775808"), List(0x1p63));
  EXPECT_EQ(parsed("-100000000000000000000"), List(-1e20));
}

TEST(nested_list, integers_that_are_no_doubles_stay_exact) {
  EXPECT_EQ(parsed("9007199254740993"), List(std::int64_t{9007199254740993}));
  EXPECT_EQ(parsed("9223372036854775809"), List::symbol("9223372036854775809/1"));
  EXPECT_EQ(parsed("-99999999999999999999"), List::symbol("-99999999999999999999/1"));
}

TEST(nested_list, symbols_may_be_runs_of_special_characters) {
  for (const char* symbol : {"+", "-", "<=", "#", ":=", "->", "/", ".", "..", "*", "=", "[]", "\\", "<", "!"}) {
    EXPECT_EQ(parsed(symbol), List::symbol(symbol));
    EXPECT_EQ(parsed(std::string("(") + symbol + ")"), List::list(List::symbol(symbol)));
  }
}

TEST(nested_list, lists_nest) {
  EXPECT_EQ(parsed("()"), List());
  EXPECT_EQ(parsed("(())"), List::list(List()));
  EXPECT_EQ(parsed("(1(2)3)"), List::list(List(1), List::list(List(2)), List(3)));
  EXPECT_EQ(parsed("(const int value -3)"),
            List::list(List::symbol("const"), List::symbol("int"), List::symbol("value"), List(-3)));
  EXPECT_EQ(parsed(" \t\r\n( a\n\"b\" 'c' )\n"),
            List::list(List::symbol("a"), List(std::string("b")), List::text("c")));
}

TEST(nested_list, comments_are_white_space) {
  EXPECT_EQ(parsed("_! before !_ (a _! ( \" !_ b_! !_) _!!_"), List::list(List::symbol("a"), List::symbol("b")));
  EXPECT_EQ(parsed("(1_! a !_2)"), List::list(List(1), List(2)));
  EXPECT_EQ(parsed("\"_! no comment !_\""), List(std::string("_! no comment !_")));
}

TEST(nested_list, backslashes_escape_the_quote_and_themselves_only) {
  EXPECT_EQ(parsed(R"("a\"b\\c")"), List(std::string(R"(a"b\c)")));
  EXPECT_EQ(parsed(R"('it\'s')"), List::text("it's"));
  EXPECT_EQ(parsed(R"('C:\new')"), List::text(R"(C:\new)"));
  EXPECT_EQ(parsed(R"("\'")"), List(std::string(R"(\')")));
  EXPECT_EQ(parsed(R"('"')"), List::text("\""));
}

TEST(nested_list, tagged_texts_are_taken_literally) {
  EXPECT_EQ(parsed(R"(<text>it's a \ "quote" (</text--->)"), List::text(R"(it's a \ "quote" ()"));
  EXPECT_EQ(parsed("(<text></text---> <)"), List::list(List::text(""), List::symbol("<")));
  EXPECT_EQ(parsed("<text>one\ntwo</text--->").print(), "'one\ntwo'");
}

TEST(nested_list, every_spelling_of_undefined_is_known) {
  for (const char* spelling : {"undefined", "undef", "UNDEFINED", "UNDEF", "null", "NULL"})
    EXPECT_TRUE(parsed(spelling).is_undefined()) << spelling;
  for (const char* other : {"Undefined", "nil", "\"undefined\"", "'undefined'", "0", "()"})
    EXPECT_FALSE(parsed(other).is_undefined()) << other;
}

TEST(nested_list, prints_as_the_language_says) {
  const auto list = List::list(List(12), List(-1), List(1.0), List(0.1), List(1e300), List(-0.0), List(true),
                               List(false), List(std::string("say \"\\\"")), List::text("it's"), List::symbol("<="),
                               List::list(List(), List::symbol("1/3")));
  EXPECT_EQ(list.print(), R"((12 -1 1.0 0.1 1e+300 -0.0 TRUE FALSE "say \"\\\"" 'it\'s' <= (() 1/3)))");
  EXPECT_EQ(List().print(), "()");
  EXPECT_EQ(List(std::string()).print(), "\"\"");
}

TEST(nested_list, atoms_of_different_kinds_are_not_equal) {
  const std::vector<List> atoms{List(1),         List(1.0),         List(true),         List(std::string("1")),
                                List::text("1"), List::symbol("1"), List::list(List(1))};
  for (std::size_t i = 0; i < atoms.size(); ++i)
    for (std::size_t j = 0; j < atoms.size(); ++j) EXPECT_EQ(atoms[i] == atoms[j], i == j);
}

TEST(nested_list, print_short_cuts_and_says_so) {
  EXPECT_EQ(parsed("(1 2 3)").print_short(7), "(1 2 3)");
  EXPECT_EQ(parsed("(1 2 3)").print_short(6), "(1 2 3...");
  EXPECT_EQ(parsed("(1 2 3)").print_short(2), "(1...");
  EXPECT_EQ(List(std::string(1000, 'x')).print_short(4), "\"xxx...");
  EXPECT_EQ(parsed("\"\xC3\xA4\xC3\xB6\"").print_short(4), "\"\xC3\xA4...");
}

TEST(nested_list, of_expressions_keeps_integers_beyond_ints) {
  const auto list =
      parse_expression_list("(9223372036854775807 9223372036854775808 -9223372036854775809 3e9 +3000000000)");
  ASSERT_TRUE(list);
  EXPECT_EQ(list->print(), "(9223372036854775807 9223372036854775808/1 -9223372036854775809/1 3e+09 3e+09)");
  auto constant = *list;
  read_large_integers_as_reals(constant);
  EXPECT_EQ(constant,
            *NestedList::parse("(9223372036854775807 9223372036854775808 -9223372036854775809 3e9 +3000000000)"));
}

TEST(nested_list, errors_say_where_what_was_found_and_what_was_expected) {
  EXPECT_EQ(error_of(""), "1:1 invalid_value: expected a list or an atom, found the end of the text");
  EXPECT_EQ(error_of(" \n "), "2:2 invalid_value: expected a list or an atom, found the end of the text");
  EXPECT_EQ(error_of(")"), "1:1 invalid_value: expected a list or an atom, found )");
  EXPECT_EQ(error_of("(1 2\n  (3 4)"),
            "1:1 invalid_value: expected a closing parenthesis for this one, found the end of the text");
  EXPECT_EQ(error_of("(1)\n(2)"), "2:1 invalid_value: expected the end of the list, found (");
  EXPECT_EQ(error_of("1 two"), "1:3 invalid_value: expected the end of the list, found two");
  EXPECT_EQ(error_of("(a 12abc)"), "1:4 invalid_value: expected a number within the range of real, found 12abc");
  EXPECT_EQ(error_of("1e999"), "1:1 invalid_value: expected a number within the range of real, found 1e999");
  EXPECT_EQ(error_of("-1e999"), "1:1 invalid_value: expected a number within the range of real, found -1e999");
  EXPECT_EQ(error_of("1/-3"),
            "1:1 invalid_value: expected a fraction p/q of two integers, with at most a minus in front, found 1/-3");
  EXPECT_EQ(error_of("+1/3"),
            "1:1 invalid_value: expected a fraction p/q of two integers, with at most a minus in front, found +1/3");
  EXPECT_EQ(error_of("(a b-c)"),
            "1:4 invalid_value: expected a word, a number or a run of special characters, found b-c");
  EXPECT_EQ(error_of("(1 2, 3)"), "1:4 invalid_value: expected a number within the range of real, found 2,");
  EXPECT_EQ(error_of("(\"a\"\"b\")"), "1:5 invalid_value: expected a blank or a parenthesis after the atom, found \"");
  EXPECT_EQ(error_of("(1 \"ab)"), "1:4 invalid_value: this string is not closed by \"");
  EXPECT_EQ(error_of("'ab\\'"), "1:1 invalid_value: this text is not closed by '");
  EXPECT_EQ(error_of("(<text>ab)"), "1:2 invalid_value: this text is not closed by </text--->");
  EXPECT_EQ(error_of("(1 _! 2)"), "1:4 invalid_value: this comment is not closed by !_");
  EXPECT_EQ(error_of("(\x01)"), "1:2 invalid_value: expected a list or an atom, found the byte 0x01");
  EXPECT_EQ(error_of("(" + std::string(100, '1') + std::string(300, '0') + ")"),
            "1:2 invalid_value: expected a number within the range of real, found " + std::string(40, '1') + "...");
}

TEST(nested_list, columns_count_characters) {
  EXPECT_EQ(error_of("(\n\"\xC3\xA4\xE2\x82\xAC\" 1x)"),
            "2:6 invalid_value: expected a number within the range of real, found 1x");
}

TEST(nested_list, places_begin_where_the_source_begins) {
  const auto first_line = List::parse("(1x)", {"script", 7, 20});
  EXPECT_EQ(first_line.error().place.file, "script");
  EXPECT_EQ(first_line.error().place.line, 7);
  EXPECT_EQ(first_line.error().place.column, 21);
  const auto second_line = List::parse("(\n1x)", {"script", 7, 20});
  EXPECT_EQ(second_line.error().place.line, 8);
  EXPECT_EQ(second_line.error().place.column, 1);
}

TEST(nested_list, a_file_atom_is_a_symbol_until_it_becomes_a_value) {
  const auto list = parsed("(a <file>it's (1; \"x\")</file---> 'b')");
  EXPECT_EQ(list.elements()[1], List::symbol("<file>it's (1; \"x\")</file--->"));
  EXPECT_EQ(parsed(list.print()), list);
  EXPECT_EQ(error_of("(<file>ab)"), "1:2 invalid_value: this file atom is not closed by </file--->");
  EXPECT_EQ(error_of("(1\n <file>a\xFF</file--->)"), "2:9 invalid_value: expected UTF-8, found the byte 0xff");
}

TEST(nested_list, a_zero_byte_is_an_error_everywhere) {
  using std::string_literals::operator""s;
  for (const auto& text : {"(\"\0\")"s, "('\0')"s})
    EXPECT_EQ(error_of(text), "1:3 invalid_value: expected text, found a zero byte");
  EXPECT_EQ(error_of("(1\n<text>ab\0</text--->)"s), "2:9 invalid_value: expected text, found a zero byte");
  EXPECT_FALSE(List::parse("(a\0b)"s).ok());
  EXPECT_FALSE(List::parse("(\0)"s).ok());
}

TEST(nested_list, ill_formed_utf8_is_an_error_everywhere) {
  // A continuation alone, an overlong slash, a surrogate, beyond U+10FFFF, a sequence cut short.
  for (const char* bytes :
       {"\x80", "\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE2\x82", "\xFF"}) {
    const auto first = static_cast<unsigned>(static_cast<unsigned char>(bytes[0]));
    const auto expectation = fmt::format("1:2 invalid_value: expected UTF-8, found the byte 0x{:02x}", first);
    EXPECT_EQ(error_of(fmt::format("\"{}\"", bytes)), expectation);
    EXPECT_EQ(error_of(fmt::format("'{}'", bytes)), expectation);
    EXPECT_FALSE(List::parse(fmt::format("<text>{}</text--->", bytes)).ok());
    EXPECT_FALSE(List::parse(bytes).ok());
  }
  for (const char* text :
       {"\xC2\x80", "\xE0\xA0\x80", "\xED\x9F\xBF", "\xEE\x80\x80", "\xF0\x90\x80\x80", "\xF4\x8F\xBF\xBF"})
    EXPECT_EQ(parsed(fmt::format("'{}'", text)), List::text(text));
}

TEST(nested_list, depth_is_limited_and_the_limit_is_reached) {
  const auto nested = [](int depth) {
    return std::string(static_cast<std::size_t>(depth), '(') + std::string(static_cast<std::size_t>(depth), ')');
  };
  const auto deepest = parsed(nested(List::kMaxDepth));
  EXPECT_EQ(deepest.print(), nested(List::kMaxDepth));
  const auto copy = deepest;
  EXPECT_EQ(copy, deepest);
  EXPECT_EQ(error_of(nested(List::kMaxDepth + 1)), "1:1001 limit_exceeded: lists are nested deeper than 1000 levels");
  EXPECT_FALSE(List::parse(std::string(1'000'000, '(')).ok());
}

class RandomLists {
 public:
  List list(int depth) {
    const auto kind = below(depth > 0 ? 9 : 6);
    if (kind > 5) {
      List::List elements(below(6));
      for (auto& element : elements) element = list(depth - 1);
      return List(std::move(elements));
    }
    switch (kind) {
      case 0:
        return List(static_cast<std::int64_t>(random_()));
      case 1:
        return List(finite_double());
      case 2:
        return List(below(2) == 0);
      case 3:
        return List(characters());
      case 4:
        return List::text(characters());
      default:
        return symbol();
    }
  }

  double finite_double() {
    const auto value = std::bit_cast<double>(random_());
    return std::isfinite(value) ? value : 0.5;
  }

 private:
  std::uint64_t below(std::uint64_t limit) { return random_() % limit; }

  std::string characters() {
    static const std::vector<std::string> pieces{"\"",
                                                 "'",
                                                 "\\",
                                                 "\n",
                                                 "\r\n",
                                                 "\t",
                                                 "a",
                                                 " ",
                                                 "(",
                                                 ")",
                                                 "_!",
                                                 "!_",
                                                 "\xC3\xA9",
                                                 "\xE2\x82\xAC",
                                                 "\xF0\x9F\x98\x80",
                                                 "</text--->",
                                                 "<text>"};
    std::string result;
    for (auto count = below(12); count > 0; --count) result += pieces[below(pieces.size())];
    return result;
  }

  List symbol() {
    static const std::vector<std::string> symbols{"a",    "Name",      "x_1", "+", "<=", "#", ":=",  "1/3",
                                                  "-7/5", "undefined", "<",   "-", "..", "*", "TRUe"};
    return List::symbol(symbols[below(symbols.size())]);
  }

  std::mt19937_64 random_{20261121};
};

TEST(nested_list, what_is_printed_reads_back_equal) {
  RandomLists random;
  for (int i = 0; i < 3000; ++i) {
    const auto list = random.list(5);
    const auto text = list.print();
    EXPECT_EQ(parsed(text), list) << text;
    EXPECT_EQ(parsed(text).print(), text);
  }
}

TEST(nested_list, reals_agree_with_the_c_library) {
  RandomLists random;
  for (int i = 0; i < 3000; ++i) {
    const double value = random.finite_double();
    const auto text = List(value).print();
    EXPECT_EQ(std::bit_cast<std::uint64_t>(std::strtod(text.c_str(), nullptr)), std::bit_cast<std::uint64_t>(value));
    const auto long_form = fmt::format("{:.40e}", value);
    EXPECT_EQ(parsed(long_form).as_real(), std::strtod(long_form.c_str(), nullptr));
  }
}

TEST(nested_list, large_lists_are_read_and_printed) {
  std::string text = "(";
  for (int i = 0; i < 100'000; ++i) text += fmt::format("{}({}.5 -{} 1/3)", i == 0 ? "" : " ", i, i);
  text += ")";
  const auto list = parsed(text);
  EXPECT_EQ(list.elements().size(), 100'000U);
  EXPECT_EQ(list.elements()[99'999].print(), "(99999.5 -99999 1/3)");
}

}  // namespace
}  // namespace algebra3d
