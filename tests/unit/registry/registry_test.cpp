#include "algebra3d/registry/registry.h"

#include <gtest/gtest.h>

#include "algebra3d/registry/overload.h"
#include "algebra3d/types/scalars.h"

namespace algebra3d {
namespace {

double half(double x) {
  return x / 2;
}
std::int64_t twice(std::int64_t x) {
  return 2 * x;
}
Maybe<double> inverse(double x) {
  if (x == 0) return Undefined{"division by zero"};
  return 1 / x;
}
double overflowing(double x) {
  return x * 1e308 * 10;
}
bool is_missing(std::optional<double> x) {
  return !x;
}
Result<double> failing(double) {
  return Error{ErrorCode::io_error, "the disk is gone"};
}
std::vector<std::int64_t> both(std::int64_t a, std::int64_t b) {
  return {a, b};
}

class RegistryTest : public testing::Test {
 protected:
  Registry registry;
  Diagnostics diagnostics;
  Context context{diagnostics, nullptr, {}};

  void add(const std::string& name, std::vector<Overload> overloads) {
    registry.add({.name = name, .syntax = name + "(_ ...)", .overloads = std::move(overloads)});
  }
  Result<std::variant<Value, std::vector<Value>>> call(const std::string& name, const std::vector<Value>& arguments) {
    std::vector<TypeExpr> types;
    for (const Value& argument : arguments) types.emplace_back(argument.type().name());
    ASSIGN_OR_RETURN(const ResolvedCall resolved, registry.resolve(*registry.find_operator(name), types));
    return Registry::call(resolved, arguments, context);
  }
  Value single(const std::string& name, const Value& argument) { return std::get<Value>(*call(name, {argument})); }
};

TEST_F(RegistryTest, an_exact_overload_wins_over_promotion) {
  add("f", {overload<&half>("x"), overload<&twice>("x")});
  EXPECT_EQ(single("f", Value::of<std::int64_t>(3)).get<std::int64_t>(), 6);
  EXPECT_EQ(single("f", Value::of<double>(3)).get<double>(), 1.5);
}

TEST_F(RegistryTest, int_is_promoted_to_real) {
  add("f", {overload<&half>("x")});
  EXPECT_EQ(single("f", Value::of<std::int64_t>(3)).get<double>(), 1.5);
  EXPECT_FALSE(single("f", Value(TypeOf<std::int64_t>::type())).is_defined());
}

TEST_F(RegistryTest, wrong_types_are_an_error_that_says_what_is_possible) {
  add("f", {overload<&half>("x"), overload<&both>("a", "b")});
  const auto result = call("f", {Value::of<bool>(true)});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().message, "f: expected (real) or (int int), got (bool)");
}

TEST_F(RegistryTest, undefined_in_gives_undefined_out_without_a_new_reason) {
  add("f", {overload<&half>("x")});
  EXPECT_FALSE(single("f", Value(TypeOf<double>::type())).is_defined());
  EXPECT_TRUE(diagnostics.empty());
}

TEST_F(RegistryTest, a_new_undefined_has_a_reason_with_the_operators_name) {
  add("inverse", {overload<&inverse>("x")});
  add("overflowing", {overload<&overflowing>("x")});
  EXPECT_FALSE(single("inverse", Value::of<double>(0)).is_defined());
  EXPECT_FALSE(single("overflowing", Value::of<double>(1)).is_defined());
  EXPECT_EQ(diagnostics.summary(),
            (std::vector<std::string>{"inverse: division by zero", "overflowing: the result is no finite number"}));
}

TEST_F(RegistryTest, an_optional_parameter_takes_undefined) {
  add("f", {overload<&is_missing>("x")});
  EXPECT_TRUE(registry.find_operator("f")->accepts_undefined());
  EXPECT_TRUE(single("f", Value(TypeOf<double>::type())).get<bool>());
}

TEST_F(RegistryTest, errors_stay_errors) {
  add("f", {overload<&failing>("x")});
  EXPECT_EQ(call("f", {Value::of<double>(1)}).error().message, "the disk is gone");
}

TEST_F(RegistryTest, a_vector_is_a_stream) {
  add("f", {overload<&both>("a", "b")});
  EXPECT_EQ(registry.find_operator("f")->overloads[0].signature(), "(int int) -> (stream int)");
  const auto result = call("f", {Value::of<std::int64_t>(1), Value::of<std::int64_t>(2)});
  EXPECT_EQ(std::get<std::vector<Value>>(*result).size(), 2U);
}

TEST(NearestName, finds_slips_and_nothing_far) {
  const std::vector<std::string> names = {"volume", "feed", "filter"};
  EXPECT_EQ(nearest_name("volum", names), "volume");
  EXPECT_EQ(nearest_name("fillter", names), "filter");
  EXPECT_EQ(nearest_name("banana", names), "");
}

TEST(NearestName, a_swap_of_neighbours_is_one_edit) {
  const std::vector<std::string> names = {"Parts", "count", "Name", "Bolts"};
  EXPECT_EQ(nearest_name("Parst", names), "Parts");
  EXPECT_EQ(nearest_name("Prats", names), "Parts");
  EXPECT_EQ(nearest_name("cuont", names), "count");
  EXPECT_EQ(nearest_name("Nmae", names), "Name");
  EXPECT_EQ(nearest_name("amNe", names), "");
  EXPECT_EQ(nearest_name("ba", std::vector<std::string>{"ab", "aa"}), "ab");
}

TEST(NearestName, letters_that_differ_only_in_case_are_nearer) {
  const std::vector<std::string> names = {"R", "or", "select"};
  EXPECT_EQ(nearest_name("rr", names), "or");
  EXPECT_EQ(nearest_name("rr", std::vector<std::string>{"R"}), "R");
  EXPECT_EQ(nearest_name("SELECT", names), "select");
  EXPECT_EQ(nearest_name("r", names), "R");
  EXPECT_EQ(nearest_name("q", names), "");
}

TEST(NearestName, short_words_are_near_to_no_operator) {
  Registry registry;
  for (const char* name : {"or", "and"}) {
    Operator op;
    op.name = name;
    op.syntax = std::string("_ ") + name + " _";
    registry.add(std::move(op));
  }
  EXPECT_EQ(registry.suggestion("rr"), "");
  EXPECT_EQ(registry.suggestion("OR"), "or");
  EXPECT_EQ(registry.suggestion("adn"), "and");
  EXPECT_EQ(registry.suggestion("nda"), "");
  EXPECT_EQ(registry.suggestion("annd"), "and");
}

}  // namespace
}  // namespace algebra3d
