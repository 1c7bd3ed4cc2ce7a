// Deep, long and broken input: an error, never a crash. Runs with AddressSanitizer.
#include <gtest/gtest.h>

#include <random>

#include "unit/language/language_samples.h"

namespace queries {
namespace {

std::string repeated(std::string_view part, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += part;
  return text;
}

void expect_limit(const std::string& text) {
  const auto expression = parse_expression(text, full_registry());
  ASSERT_FALSE(expression.ok()) << text.substr(0, 40);
  EXPECT_EQ(expression.error().code, algebra3d::ErrorCode::limit_exceeded) << expression.error().text();
}

constexpr std::size_t kMany = 100'000;

TEST(Limits, nesting_up_to_the_limit_is_accepted) {
  const std::size_t count = kMaxBracketDepth - 10;
  EXPECT_EQ(type_of(repeated("(", count) + "1" + repeated(")", count)), "int");
  EXPECT_EQ(type_of(repeated("not(", count) + "TRUE" + repeated(")", count)), "bool");
  const std::size_t long_count = kMaxExpressionHeight - 10;
  EXPECT_EQ(type_of("1" + repeated(" + 1", long_count)), "int");
  EXPECT_EQ(type_of("Parts feed" + repeated(" head[1]", long_count)), type_of("Parts feed"));
  EXPECT_EQ(type_of("Parts feed" + repeated(" extend[A: 1] project[Name]", long_count / 2)),
            "(stream (tuple ((Name string))))");
}

TEST(Limits, nested_brackets) {
  expect_limit(repeated("(", kMany) + "1" + repeated(")", kMany));
  expect_limit(repeated("(", kMany));
  expect_limit(repeated("[", kMany));
  expect_limit(repeated("[", kMany) + repeated("]", kMany));
  expect_limit(repeated("not(", kMany));
  expect_limit(repeated("f(", kMany));
  expect_limit(repeated("s filter[", kMany));
  expect_limit(repeated("s extend[A: ", kMany));
  expect_limit(repeated("fun() ", kMany) + "1");
}

TEST(Limits, nested_types) {
  expect_limit("[const " + repeated("rel(", kMany));
  expect_limit("[const " + repeated("[A: ", kMany));
  expect_limit("[const " + repeated("typeOf([const ", kMany));
  expect_limit("fun(a: " + repeated("map(int, ", kMany));
}

TEST(Limits, operators_in_a_row) {
  expect_limit("1" + repeated(" + 1", kMany));
  expect_limit("1" + repeated(" < 1", kMany));
  expect_limit("r" + repeated(" feed", kMany));
  expect_limit("r" + repeated(" {x}", kMany));
  expect_limit("r" + repeated(" filter[TRUE]", kMany));
}

TEST(Limits, rows_within_brackets_add_up) {
  std::string text = "1";
  for (int level = 0; level < 40; ++level) text = "(" + text + ")" + repeated(" + 1", 40);
  expect_limit(text);
}

TEST(Limits, nested_lists) {
  const std::string open = repeated("(", kMany);
  for (const std::string& text : {"[const volume3d value " + open, "[const volume3d value " + open + "]",
                                  "[const volume3d value " + open + repeated(")", kMany) + "]", "[const " + open})
    EXPECT_FALSE(parse_expression(text, full_registry()).ok());
}

TEST(Limits, long_lists_are_no_deep_ones) {
  EXPECT_TRUE(parse_expression("[1" + repeated(", 1", kMany) + "]", full_registry()).ok());
  EXPECT_EQ(type_of("[const points3d value (" + repeated("(1 2 3)", kMany) + ")]"), "points3d");
}

TEST(Limits, huge_words_and_numbers) {
  const std::string word = repeated("a", 1'000'000);
  EXPECT_TRUE(parse_expression(word, full_registry()).ok());
  EXPECT_TRUE(parse_expression("\"" + word + "\"", full_registry()).ok());
  EXPECT_FALSE(parse_expression(repeated("9", 1'000'000), full_registry()).ok());
  EXPECT_TRUE(parse_expression("0." + repeated("9", 1'000'000), full_registry()).ok());
  EXPECT_FALSE(parse_expression(repeated("+", 1'000'000), full_registry()).ok());
  EXPECT_FALSE(parse_expression(repeated(" $", 100'000), full_registry()).ok());
}

TEST(Limits, many_operands_without_an_operator) {
  EXPECT_FALSE(parse_expression(repeated("1 ", kMany), full_registry()).ok());
}

// What every way through the parser begins with.
const std::vector<std::string>& valid_commands() {
  static const std::vector<std::string> commands = {
      "query [const rel(tuple([A: int, S: string])) value ((1 \"a\") (undefined \"b;\") _! c !_ )] feed consume",
      "let f = fun(a: int, b: rel([N: text])) a + [const (rel (tuple ((A int)))) value ()] count",
      "query Parts feed {p} filter[(.Name_p = \"x\") and not(isdefined(.Solid_p))] sortby[Name_p desc] head[3] count",
      "query Parts feed groupby[Name; N: group count, V: group feed extend[V: volume(.Solid)] sum[V]] consume",
      "query Parts feed {a} Parts feed {b} symmjoin[.Name_a = ..Name_b] projectextend[Name_a; W: $1.Name_a] consume",
      "update Limit := -5 + 2.5e-3 * (1 - .5) div 7 mod 'text' <text>x</text--->",
      "create x : map(int, typeOf(1 + 2))",
      "query Parts feed extend[B: bbox(.Solid translate[[const vector3d value (1/3 0 1e5)]])] {5} {memory 64} count",
      "list type constructors",
      "delete database d",
  };
  return commands;
}

// Neither parser nor checker may crash; what they say does not matter here.
void survive(const std::string& text) {
  const auto command = parse_command(text, full_registry());
  if (!command) {
    EXPECT_FALSE(command.error().text().empty());
    return;
  }
  const auto* query = std::get_if<Query>(&command->content);
  if (query == nullptr) return;
  to_nested(*query->value);
  TypesOnly objects = sample_objects();
  algebra3d::Diagnostics diagnostics;
  Context context{diagnostics, nullptr, {}};
  Checker(full_registry(), objects, context).check(*query->value).ok();
}

TEST(Robustness, every_beginning_of_a_command) {
  for (const std::string& command : valid_commands())
    for (std::size_t length = 0; length <= command.size(); ++length) survive(command.substr(0, length));
}

TEST(Robustness, every_command_with_a_piece_cut_out) {
  for (const std::string& command : valid_commands())
    for (std::size_t begin = 0; begin < command.size(); ++begin)
      for (const std::size_t length : {1U, 2U, 5U, 17U})
        survive(command.substr(0, begin) + command.substr(std::min(command.size(), begin + length)));
}

TEST(Robustness, random_bytes_in_valid_commands) {
  std::mt19937 random(20261121);
  for (int round = 0; round < 4000; ++round) {
    std::string command = valid_commands()[random() % valid_commands().size()];
    for (std::size_t change = random() % 4 + 1; change > 0; --change)
      command[random() % command.size()] = static_cast<char>(random() % 256);
    survive(command);
  }
}

TEST(Robustness, random_sequences_of_tokens) {
  std::vector<std::string> tokens = {
      "(",     ")",     "[",       "]",     "{",       "}",     ",",     ";",   ":",     ":=",     "::",       ".",
      "..",    ".Name", "..Solid", "$1",    "$2.Name", "1",     "-",     "2.5", "\"s\"", "'t'",    "TRUE",     "Parts",
      "Limit", "twice", "fun",     "const", "value",   "tuple", "group", "int", "rel",   "typeOf", "undefined"};
  for (const algebra3d::Operator* op : full_registry().operators()) tokens.push_back(op->name);
  std::mt19937 random(7);
  for (int round = 0; round < 20000; ++round) {
    std::string text = "query";
    for (std::size_t length = random() % 12 + 1; length > 0; --length) text += " " + tokens[random() % tokens.size()];
    survive(text);
  }
}

}  // namespace
}  // namespace queries
