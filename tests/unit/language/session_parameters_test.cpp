#include "queries/language/session_parameters.h"

#include <gtest/gtest.h>

#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "queries/language/parser.h"
#include "unit/language/language_samples.h"

namespace queries {
namespace {

using algebra3d::ErrorCode;
using algebra3d::Value;

SessionParameters given(const std::string& name, SessionParameter parameter) {
  SessionParameters parameters;
  parameters.values.emplace(name, std::move(parameter));
  return parameters;
}

// The nested list of `query $p`, without the command word; or the error.
std::string operand(const SessionParameters& parameters) {
  const auto command = parse_command("query $p", full_registry(), {"", 1, 1}, &parameters);
  if (!command) return command.error().text();
  return to_nested(*std::get<Query>(command->content).value).print();
}

TEST(SessionParameters, of_types_with_literals_are_literals) {
  EXPECT_EQ(operand(given("p", Value::of<std::int64_t>(-3))), "-3");
  EXPECT_EQ(operand(given("p", Value::of<double>(2.5))), "2.5");
  EXPECT_EQ(operand(given("p", Value::of<bool>(true))), "TRUE");
  EXPECT_EQ(operand(given("p", Value::of<std::string>("a \"b\"; c"))), NestedList(std::string("a \"b\"; c")).print());
  EXPECT_EQ(operand(given("p", Value::of<algebra3d::Text>({"it's"}))), NestedList::text("it's").print());
}

TEST(SessionParameters, of_other_types_are_kept_as_values) {
  EXPECT_EQ(operand(given("p", Value::of<algebra3d::Box3>({{0, 1, 2}, {3, 4, 5}}))),
            "(const rect3 value (0.0 3.0 1.0 4.0 2.0 5.0))");
  EXPECT_EQ(operand(given("p", Value(algebra3d::TypeOf<double>::type()))), "(const real value undefined)");
  const auto command =
      parse_command("query $p", full_registry(), {"", 1, 1},
                    std::make_unique<SessionParameters>(given("p", Value::of<algebra3d::Volume3d>({}))).get());
  EXPECT_TRUE(std::holds_alternative<HostValue>(std::get<Query>(command->content).value->node));
}

TEST(SessionParameters, that_are_numbers_out_of_range_are_no_strings) {
  for (const char* number : {"1e999", "-1e999", "12345678901234567890"}) {
    const auto parameter = parse_session_parameter(std::string("x=") + number, full_registry());
    ASSERT_FALSE(parameter.ok()) << number;
    EXPECT_EQ(parameter.error().code, ErrorCode::wrong_usage);
    EXPECT_EQ(parameter.error().text(),
              fmt::format("-p \"x={0}\": the number is out of range; if it is to be a string, write x:string=\"{0}\"",
                          number));
  }
  for (const char* text : {"x:string=1e999", "x=007", "x=+5", "x=1e", "x=-", "x="}) {
    const auto parameter = parse_session_parameter(text, full_registry());
    ASSERT_TRUE(parameter.ok()) << text << ": " << parameter.error().text();
    EXPECT_EQ(std::get<WrittenConstant>(parameter->second).type, "string") << text;
  }
}

TEST(SessionParameters, stand_for_names_of_files) {
  const SessionParameters file = given("p", Value::of<std::string>("a b.list"));
  const auto command = parse_command("save Parts to $p", full_registry(), {"", 1, 1}, &file);
  ASSERT_TRUE(command.ok()) << command.error().text();
  EXPECT_EQ(std::get<SaveObject>(command->content).file, "a b.list");
  const SessionParameters number = given("p", Value::of<double>(1));
  EXPECT_EQ(parse_command("save Parts to $p", full_registry(), {"", 1, 1}, &number).error().text(),
            "'$p': expected a string or a text, got real");
}

TEST(SessionParameters, that_are_missing_are_named_with_what_the_host_can_do) {
  SessionParameters none;
  EXPECT_EQ(operand(none), "there is no parameter '$p'; start the program with -p p=VALUE");
  none.advice = "state '{}'";
  EXPECT_EQ(operand(none), "there is no parameter '$p'; state 'p'");
  EXPECT_EQ(operand(given("q", Value::of<double>(1))), "there is no parameter '$p'; the parameters are $q");
}

}  // namespace
}  // namespace queries
