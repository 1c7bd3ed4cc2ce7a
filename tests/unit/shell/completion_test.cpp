#include "queries/shell/detail/completion.h"

#include <gtest/gtest.h>

#include "algebra3d/operators/descriptions/all.h"
#include "queries/language/command_list.h"
#include "queries/language/command_reader.h"
#include "queries/language/parser.h"
#include "queries/shell/detail/command_table.h"
#include "queries/streams/all.h"

namespace queries {
namespace {

CompletionNames names() {
  CompletionNames names;
  names.operators = {{"createCube", "("}, {"count", " "}, {"volume", "("}};
  names.objects = {"Cubes", "Parts", "Über"};
  names.types = {"volume3d", "int"};
  names.attributes = {"Colour", "Solid"};
  names.databases = {"garage", "gears"};
  names.files = [](const std::string& beginning) {
    EXPECT_EQ(beginning, "parts/c");
    return std::vector<std::string>{"parts/cube.stl", "parts/cones/"};
  };
  return names;
}

/// The candidates at the end of `text`.
std::vector<std::string> ways(const std::string& text) {
  std::vector<std::string> result;
  for (const Candidate& candidate : complete(text, text.size(), names()).candidates) result.push_back(candidate.text);
  return result;
}

using Words = std::vector<std::string>;

TEST(Completion, first_words_are_commands) {
  EXPECT_EQ(ways("qu"), (Words{"query", "quit"}));
  EXPECT_EQ(ways("  let"), (Words{"let", "let_"}));
  EXPECT_EQ(ways("let A = 1; che"), (Words{"check"}));
  EXPECT_EQ(ways("zzz"), Words{});
}

TEST(Completion, further_words_of_commands_come_from_their_table) {
  EXPECT_EQ(ways("list o"), (Words{"objects", "operators"}));
  EXPECT_EQ(ways("open "), (Words{"database"}));
  EXPECT_EQ(ways("open database g"), (Words{"garage", "gears"}));
  EXPECT_EQ(ways("create database "), Words{});
  EXPECT_EQ(ways("begin t"), (Words{"transaction"}));
  EXPECT_EQ(ways("delete P"), (Words{"Parts"}));
  EXPECT_EQ(ways("changename Parts t"), (Words{"to"}));
  EXPECT_EQ(ways("set \"t"), (Words{"\"timing\""}));
}

TEST(Completion, after_help_come_operators_and_commands) {
  EXPECT_EQ(ways("help vol"), (Words{"volume"}));
  EXPECT_EQ(ways("help c"), (Words{"changename", "check", "close", "commit", "count", "create", "createCube"}));
}

TEST(Completion, expressions_hold_operators_objects_types_and_attributes) {
  EXPECT_EQ(ways("query vol"), (Words{"volume", "volume3d"}));
  EXPECT_EQ(ways("query Parts feed filter[C"), (Words{"Colour", "Cubes"}));
  EXPECT_EQ(ways("let X=cr"), (Words{"createCube"}));
  EXPECT_EQ(ways("update Parts := c"), (Words{"count", "createCube"}));
  EXPECT_EQ(ways("create P : vo"), (Words{"volume", "volume3d"}));
  EXPECT_EQ(ways("query "), (Words{"Cubes", "Parts", "Über"}));
  EXPECT_EQ(ways("query\nPar"), (Words{"Parts"}));
}

TEST(Completion, after_a_dot_come_attributes) {
  EXPECT_EQ(ways("query Parts feed filter[."), (Words{"Colour", "Solid"}));
  EXPECT_EQ(ways("query Parts feed filter[.C"), (Words{"Colour"}));
}

TEST(Completion, between_quotes_come_files_and_between_double_quotes_nothing) {
  EXPECT_EQ(ways("query importSTL('parts/c"), (Words{"parts/cones/", "parts/cube.stl"}));
  EXPECT_EQ(ways("@@parts/c"), (Words{"parts/cones/", "parts/cube.stl"}));
  EXPECT_EQ(ways("query \"vol"), Words{});
  EXPECT_EQ(ways("query \"it's\" + vol"), (Words{"volume", "volume3d"}));
}

TEST(Completion, after_then_and_do_come_commands_too) {
  EXPECT_EQ(ways("if TRUE then que"), (Words{"query"}));
  EXPECT_EQ(ways("while TRUE do upd"), (Words{"update"}));
}

TEST(Completion, a_single_way_brings_what_follows_it) {
  const auto suffix = [](const std::string& text) {
    const Completion completion = complete(text, text.size(), names());
    return completion.candidates.size() == 1 ? completion.candidates[0].suffix : "several";
  };
  EXPECT_EQ(suffix("quer"), " ");
  EXPECT_EQ(suffix("quit"), "");
  EXPECT_EQ(suffix("query createC"), "(");
  EXPECT_EQ(suffix("query Parts feed filter[.S"), "");
}

TEST(Completion, only_what_stands_before_the_cursor_counts) {
  const Completion completion = complete("query Pa feed", 8, names());
  EXPECT_EQ(completion.begin, 6U);
  EXPECT_EQ(completion.candidates, (std::vector<Candidate>{{"Parts", " "}}));
}

TEST(Completion, common_beginning_is_that_of_all) {
  EXPECT_EQ(common_beginning({{"query"}, {"quit"}}), "qu");
  EXPECT_EQ(common_beginning({{"query"}}), "query");
  EXPECT_EQ(common_beginning({{"a"}, {"b"}}), "");
  EXPECT_EQ(common_beginning({}), "");
}

// The table is what people see; the parser is what there is.
TEST(CommandTable, the_parser_or_the_shell_knows_every_command) {
  const algebra3d::Registry registry = algebra3d::make_registry();
  for (const CommandDescription& command : command_list()) {
    const std::string word(command.syntax.substr(0, command.syntax.find(' ')));
    if (is_shell_command(word) || word == "{") continue;  // { holds commands of its own
    const auto parsed = parse_command(word + " ?", registry);
    ASSERT_FALSE(parsed) << word;
    EXPECT_EQ(parsed.error().text().find("expected a command"), std::string::npos) << parsed.error().text();
  }
}

TEST(CommandTable, help_finds_operators_and_commands_and_suggests_the_nearest) {
  const algebra3d::Registry registry = algebra3d::make_registry();
  EXPECT_NE(shell_help("volume", registry).value().find("volume(_)"), std::string::npos);
  EXPECT_NE(shell_help("let", registry).value().find("let NAME = EXPRESSION"), std::string::npos);
  const auto unknown = shell_help("volumme", registry);
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().text(),
            "there is no operator or command 'volumme', and no description has the word; did you mean 'volume'?");
}

TEST(CommandTable, help_finds_parts_of_names_and_words_of_descriptions) {
  algebra3d::Registry registry = algebra3d::make_registry();
  register_stream_operators(registry);
  const std::string sphere = shell_help("SPHERE", registry).value();
  EXPECT_TRUE(sphere.starts_with("Operators with 'SPHERE' in their names\n  boundingSphere(_)")) << sphere;
  const std::string duplicates = shell_help("equal any earlier tuple", registry).value();
  EXPECT_NE(duplicates.find("Operators with 'equal any earlier tuple' in their descriptions\n  _ rduph"),
            std::string::npos)
      << duplicates;
  EXPECT_NE(shell_help("transaction", registry).value().find("commit transaction"), std::string::npos);
}

TEST(CommandTable, help_explains_tables) {
  algebra3d::Registry registry = algebra3d::make_registry();
  register_stream_operators(registry);
  const std::string tables = shell_help("table", registry).value();
  EXPECT_TRUE(tables.starts_with("A table is a relation")) << tables;
  EXPECT_NE(tables.find("\n  components(_)"), std::string::npos) << tables;
  EXPECT_EQ(tables, shell_help("tables", registry).value());
  // The families that it names.
  for (const char* family : {"streams", "attributes", "order", "groups", "joins", "sorted streams", "indexes",
                             "changes of relations", "aggregates", "tables from files"}) {
    EXPECT_NE(tables.find(family), std::string::npos) << family;
    EXPECT_TRUE(shell_help(family, registry)->starts_with(std::string(family) + "\n  ")) << family;
  }
}

TEST(CommandTable, help_lists_families_of_operators) {
  algebra3d::Registry registry = algebra3d::make_registry();
  register_stream_operators(registry);
  const std::string families = shell_help("families", registry).value();
  for (const algebra3d::Family& family : registry.families()) {
    EXPECT_NE(families.find("\n  " + family.name + " "), std::string::npos) << family.name;
    EXPECT_NE(families.find("  " + family.doc + "\n"), std::string::npos) << family.name;
  }
  const std::string joins = shell_help("Joins", registry).value();
  EXPECT_TRUE(joins.starts_with("joins\n  Joins of two streams.\n\n  _ _ hashjoin[")) << joins;
  EXPECT_NE(joins.find("_ _ symmjoin[fun(TUPLE, TUPLE2)]"), std::string::npos);
  EXPECT_EQ(joins.find("createCube"), std::string::npos);
  for (const algebra3d::Operator* op : registry.operators_of("joins"))
    EXPECT_NE(joins.find("  " + op->doc + "\n"), std::string::npos) << op->name;
  const std::string all = shell_help(registry);
  EXPECT_NE(all.find(families), std::string::npos);
  EXPECT_EQ(all.find("_ _ symmjoin"), std::string::npos);
  for (const algebra3d::Operator* op : registry.operators()) EXPECT_FALSE(op->family.empty()) << op->name;
}

}  // namespace
}  // namespace queries
