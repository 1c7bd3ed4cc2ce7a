#include "queries/language/command_reader.h"

#include <gtest/gtest.h>

namespace queries {
namespace {

/// The commands in a script, each as `LINE:COLUMN TEXT`.
std::vector<std::string> commands(std::string_view script) {
  CommandReader reader("script");
  std::vector<std::string> result;
  const auto add = [&](const CommandText& command) {
    result.push_back(fmt::format("{}:{} {}", command.start.line, command.start.column, command.text));
  };
  while (!script.empty()) {
    const std::size_t end = script.find('\n');
    for (const CommandText& command : reader.add_line(script.substr(0, end))) add(command);
    script.remove_prefix(end == std::string_view::npos ? script.size() : end + 1);
  }
  if (const auto last = reader.finish()) add(*last);
  return result;
}

using Commands = std::vector<std::string>;

TEST(CommandReader, a_semicolon_ends_a_command) {
  EXPECT_EQ(commands("query 1;\nquery 2;\n"), (Commands{"1:1 query 1", "2:1 query 2"}));
}

TEST(CommandReader, a_marked_block_that_is_not_closed_is_known_by_its_first_line) {
  CommandReader reader("script", CommandReader::Skipping::marked_blocks);
  for (const char* line : {"query 1;", "/* one", "*/", "/* two", "query 2;"}) reader.add_line(line);
  ASSERT_TRUE(reader.open_block().has_value());
  EXPECT_EQ(reader.open_block()->line, 4);
  reader.add_line("*/");
  EXPECT_FALSE(reader.open_block().has_value());
}

TEST(CommandReader, a_semicolon_inside_a_line_ends_a_command) {
  EXPECT_EQ(commands("query 1;  query 2; query 3"), (Commands{"1:1 query 1", "1:11 query 2", "1:20 query 3"}));
}

TEST(CommandReader, an_empty_line_ends_a_command) {
  EXPECT_EQ(commands("query 1\n  \nquery 2\n\n\n"), (Commands{"1:1 query 1", "3:1 query 2"}));
}

TEST(CommandReader, the_end_of_the_input_ends_a_command) {
  EXPECT_EQ(commands("query\n1"), (Commands{"1:1 query\n1"}));
}

TEST(CommandReader, white_space_at_the_end_of_a_line_is_ignored) {
  EXPECT_EQ(commands("query 1  \t\r\n + 2 ; \r\n"), (Commands{"1:1 query 1\n + 2"}));
}

TEST(CommandReader, a_line_that_begins_with_a_number_sign_is_skipped_anywhere) {
  EXPECT_EQ(commands("# comment; query 0;\nquery 1\n# in the middle\n + 2;"), (Commands{"2:1 query 1\n + 2"}));
  EXPECT_EQ(commands("query 1\n # 2;"), (Commands{"1:1 query 1\n # 2"}));
}

TEST(CommandReader, no_semicolon_ends_a_command_inside_brackets) {
  EXPECT_EQ(commands("query r groupby[A;\n N: 1] (;) {;} count;"),
            (Commands{"1:1 query r groupby[A;\n N: 1] (;) {;} count"}));
}

TEST(CommandReader, no_semicolon_ends_a_command_inside_literals) {
  EXPECT_EQ(commands(R"(query "a;(" + 'b;\';' + <text>;'"</text---> _! ;" !_; query 2)"),
            (Commands{R"(1:1 query "a;(" + 'b;\';' + <text>;'"</text---> _! ;" !_)", "1:55 query 2"}));
  EXPECT_EQ(commands(R"(query <file>it's; (1</file--->; query 2)"),
            (Commands{R"(1:1 query <file>it's; (1</file--->)", "1:33 query 2"}));
}

TEST(CommandReader, escaped_backslash_does_not_escape_the_quote) {
  EXPECT_EQ(commands(R"(query "\\"; query 2;)"), (Commands{R"(1:1 query "\\")", "1:13 query 2"}));
}

TEST(CommandReader, literals_may_span_lines) {
  EXPECT_EQ(commands("query 'a;\nb';query 2;"), (Commands{"1:1 query 'a;\nb'", "2:4 query 2"}));
}

TEST(CommandReader, literals_keep_the_white_space_at_the_end_of_their_lines) {
  EXPECT_EQ(commands("query 'a  \t\nb '  \n + 1;"), (Commands{"1:1 query 'a  \t\nb '\n + 1"}));
  EXPECT_EQ(commands("query \"a  \r\nb\" ;\r\n"), (Commands{"1:1 query \"a  \nb\""}));
  EXPECT_EQ(commands("query \"a\r\r\nb\";"), (Commands{"1:1 query \"a\r\nb\""}));
  EXPECT_EQ(commands("query <text>a  \nb</text---> _! c  \nd !_;"),
            (Commands{"1:1 query <text>a  \nb</text---> _! c\nd !_"}));
}

TEST(CommandReader, an_empty_line_ends_a_command_whose_bracket_was_forgotten) {
  EXPECT_EQ(commands("query (1;\n\nquery 2;"), (Commands{"1:1 query (1;", "3:1 query 2"}));
}

TEST(CommandReader, an_empty_line_ends_a_command_whose_quote_was_forgotten) {
  EXPECT_EQ(commands("query 'a;\n\nquery 2;"), (Commands{"1:1 query 'a;", "3:1 query 2"}));
}

TEST(CommandReader, a_bracket_too_many_does_not_swallow_the_rest) {
  EXPECT_EQ(commands("query 1)); query 2;"), (Commands{"1:1 query 1))", "1:12 query 2"}));
}

TEST(CommandReader, empty_commands_are_left_out) {
  EXPECT_TRUE(commands(";;\n ; \n\n;").empty());
}

TEST(CommandReader, pending_while_a_command_is_begun) {
  CommandReader reader;
  EXPECT_FALSE(reader.is_pending());
  reader.add_line("query");
  EXPECT_TRUE(reader.is_pending());
  reader.add_line("1;");
  EXPECT_FALSE(reader.is_pending());
}

}  // namespace
}  // namespace queries
