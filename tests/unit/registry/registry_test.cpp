#include "algebra3d/operators/registry/registry.h"

#include <gtest/gtest.h>
#include <atomic>
#include <thread>

#include "algebra3d/operators/registry/aggregate.h"
#include "algebra3d/operators/registry/detail/host_name.h"
#include "algebra3d/operators/registry/overload.h"
#include "algebra3d/values/types/scalars.h"
#include "base/propagate.h"

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

/// A number and its half, once for each number up to `last`.
Rows<std::int64_t, std::optional<double>> halves(std::int64_t last) {
  using Next = Result<std::optional<std::tuple<std::int64_t, std::optional<double>>>>;
  return Rows<std::int64_t, std::optional<double>>([last, next = std::int64_t{0}](Context&) mutable -> Next {
    if (++next > last) return Next(std::nullopt);
    return Next(std::tuple(next, next == 2 ? std::optional<double>() : std::optional(static_cast<double>(next) / 2)));
  });
}
Maybe<std::tuple<double, double>> quotient_and_product(double a, double b) {
  if (b == 0) return Undefined{"division by zero"};
  return std::tuple(a / b, a * b);
}

/// The last value and how many there were.
class Last {
 public:
  void step(const std::int64_t& value) { last_ = value; }
  void combine(Last&& later) {
    if (later.last_) last_ = later.last_;
  }
  Maybe<std::int64_t> finish() const {
    if (!last_) return Undefined{"there is none"};
    return *last_;
  }

 private:
  std::optional<std::int64_t> last_;
};

class RegistryTest : public testing::Test {
 protected:
  Registry registry;
  Diagnostics diagnostics;
  Context context{diagnostics, nullptr, {}};

  void add(const std::string& name, std::vector<Overload> overloads) {
    registry.add({.name = name, .syntax = name + "(_ ...)", .overloads = std::move(overloads)});
  }
  Result<ResolvedCall> resolve(const std::string& name, const std::vector<Value>& arguments) {
    std::vector<TypeExpr> types;
    for (const Value& argument : arguments) types.emplace_back(argument.type().name());
    return registry.resolve(*registry.find_operator(name), types);
  }
  Result<Value> call(const std::string& name, std::vector<Value> arguments) {
    A3D_ASSIGN(const ResolvedCall resolved, resolve(name, arguments));
    return Registry::call(resolved, arguments, context);
  }
  Value single(const std::string& name, const Value& argument) { return *call(name, {argument}); }
  // Each row as text.
  std::vector<std::string> table_rows(const std::string& name, std::vector<Value> arguments) {
    const auto resolved = resolve(name, arguments);
    const auto source = Registry::rows(*resolved, arguments, context);
    std::vector<std::string> rows;
    while (const auto row = *(*source)->next(context)) {
      rows.emplace_back();
      for (const Value& cell : *row) rows.back() += (rows.back().empty() ? "" : " ") + cell.to_nested().print();
    }
    return rows;
  }
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
  EXPECT_EQ(result.error().text(), "f: expected (real) or (int int), got (bool)");
}

TEST_F(RegistryTest, of_many_overloads_those_that_fit_best_are_told) {
  std::vector<Overload> overloads;
  for (int i = 0; i < 9; ++i) {  // other numbers of arguments, and none that fits
    Overload other = overload<&half>("x");
    other.parameters.resize(static_cast<std::size_t>(i % 3 == 0 ? 3 : 1), other.parameters.front());
    if (i % 3 != 0) other.parameters[0].type = &TypeOf<bool>::type();
    overloads.push_back(std::move(other));
  }
  Overload with_bool = overload<&both>("a", "b");
  with_bool.parameters[1].type = &TypeOf<bool>::type();
  overloads.push_back(with_bool);
  add("f", std::move(overloads));
  const auto result = call("f", {Value::of<std::int64_t>(1), Value::of<std::int64_t>(2)});
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().text(), "f: expected (int bool), (real real real) or (bool), got (int int)");
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
            (std::vector<std::string>{"inverse: division by zero", "overflowing: the result is not a finite number"}));
}

TEST_F(RegistryTest, an_optional_parameter_takes_undefined) {
  add("f", {overload<&is_missing>("x")});
  EXPECT_TRUE(registry.find_operator("f")->accepts_undefined());
  EXPECT_TRUE(single("f", Value(TypeOf<double>::type())).get<bool>());
}

TEST_F(RegistryTest, errors_stay_errors) {
  add("f", {overload<&failing>("x")});
  EXPECT_EQ(call("f", {Value::of<double>(1)}).error().text(), "the disk is gone");
}

using Texts = std::vector<std::string>;

TEST_F(RegistryTest, a_vector_is_a_table_of_one_column) {
  add("f", {overload<&both>("a", "b")});
  const Operator& op = *registry.find_operator("f");
  EXPECT_EQ(op.kind(), OperatorKind::table);
  EXPECT_EQ(op.overloads[0].signature(), "(int int) -> (stream int)");
  EXPECT_EQ(table_rows("f", {Value::of<std::int64_t>(1), Value::of<std::int64_t>(2)}), (Texts{"1", "2"}));
}

TEST_F(RegistryTest, a_table_has_named_columns_and_gives_its_rows_one_by_one) {
  add("halves", {table<&halves>({"Number", "Half"}, "last")});
  const Operator& op = *registry.find_operator("halves");
  EXPECT_EQ(op.kind(), OperatorKind::table);
  EXPECT_EQ(op.overloads[0].signature(), "(int) -> (stream (tuple ((Number int) (Half real))))");
  EXPECT_EQ(table_rows("halves", {Value::of<std::int64_t>(3)}), (Texts{"1 0.5", "2 undefined", "3 1.5"}));
  EXPECT_EQ(table_rows("halves", {Value(TypeOf<std::int64_t>::type())}), Texts());
  EXPECT_TRUE(diagnostics.empty());
}

TEST_F(RegistryTest, several_numbers_are_a_table_of_one_row) {
  add("f", {table<&quotient_and_product>({"Quotient", "Product"}, "a", "b")});
  EXPECT_EQ(table_rows("f", {Value::of<double>(3), Value::of<double>(2)}), (Texts{"1.5 6.0"}));
  EXPECT_EQ(table_rows("f", {Value::of<double>(3), Value::of<std::int64_t>(0)}), Texts());
  EXPECT_EQ(diagnostics.summary(), (Texts{"f: division by zero"}));
}

TEST_F(RegistryTest, an_aggregate_takes_values_and_leaves_out_undefined_ones) {
  Overload last = aggregate<Last>("values");
  last.counts_undefined = true;
  add("last", {last});
  const Operator& op = *registry.find_operator("last");
  EXPECT_EQ(op.kind(), OperatorKind::aggregate);
  EXPECT_EQ(op.overloads[0].signature(), "(int*) -> int");
  const ResolvedCall call{&op, &op.overloads[0]};
  Aggregation first(call), second(call);
  ASSERT_TRUE(first.step(Value::of<std::int64_t>(4), context).ok());
  ASSERT_TRUE(first.step(Value(TypeOf<std::int64_t>::type()), context).ok());
  ASSERT_TRUE(second.step(Value(TypeOf<std::int64_t>::type()), context).ok());
  ASSERT_TRUE(first.combine(second, context).ok());
  EXPECT_EQ(first.finish(context)->get<std::int64_t>(), 4);
  EXPECT_EQ(diagnostics.summary(), (Texts{"last: left out 2 undefined values"}));
}

TEST_F(RegistryTest, the_syntax_of_an_aggregate_follows_from_its_kind) {
  registry.add({.name = "last", .overloads = {aggregate<Last>("values")}});
  EXPECT_EQ(registry.find_operator("last")->syntax, "_ last[attribute]");
  Aggregation none({registry.find_operator("last"), &registry.find_operator("last")->overloads[0]});
  EXPECT_FALSE(none.finish(context)->is_defined());
  EXPECT_EQ(diagnostics.summary(), (Texts{"last: there is none"}));
}

TEST(HostName, is_the_name_in_snake_case) {
  EXPECT_EQ(snake_case("volume"), "volume");
  EXPECT_EQ(snake_case("createCube"), "create_cube");
  EXPECT_EQ(snake_case("importSTL"), "import_stl");
  EXPECT_EQ(snake_case("importGeoJSON"), "import_geo_json");
  EXPECT_EQ(snake_case("makePoint3D"), "make_point3d");
  EXPECT_EQ(snake_case("rect2region"), "rect_to_region");
  EXPECT_EQ(snake_case("mregion2volume"), "mregion_to_volume");
  EXPECT_EQ(snake_case("atan2"), "atan2");
  EXPECT_EQ(snake_case("union_aggr"), "union_aggr");
  EXPECT_TRUE(is_reserved_in_a_host("union"));
  EXPECT_TRUE(is_reserved_in_a_host("lambda"));
  EXPECT_FALSE(is_reserved_in_a_host("union_aggr"));
}

TEST_F(RegistryTest, operators_take_cost_and_name_in_other_hosts_from_their_family_and_name) {
  registry.begin_family({"halves", "Halves of numbers.", Cost::constant});
  add("halfOf", {overload<&half>("x")});
  registry.add({.name = "twice",
                .host_name = "times_two",
                .syntax = "twice(_)",
                .cost = Cost::linear,
                .overloads = {overload<&twice>("x")}});
  const Operator& first = *registry.find_operator("halfOf");
  EXPECT_EQ(first.family, "halves");
  EXPECT_EQ(first.host_name, "half_of");
  EXPECT_EQ(first.cost, Cost::constant);
  const Operator& second = *registry.find_operator("twice");
  EXPECT_EQ(second.host_name, "times_two");
  EXPECT_EQ(second.cost, Cost::linear);
  EXPECT_EQ(registry.operators_of("halves").size(), 2U);
  EXPECT_EQ(registry.families().front().doc, "Halves of numbers.");
  registry.add_language_note("twice", "Written behind its operand.");
  EXPECT_EQ(second.language_note, "Written behind its operand.");
}

// Calls of the functions that describe groups.
std::atomic<int> descriptions_of_halves = 0, descriptions_of_doubles = 0;

void register_halves(OperatorGroup& group) {
  ++descriptions_of_halves;
  group.add({.name = "halfOf", .syntax = "halfOf(_)", .overloads = {overload<&half>("x")}});
  group.add({.name = "halved", .syntax = "_ halved", .overloads = {overload<&half>("x")}});
}

void register_doubles(OperatorGroup& group) {
  ++descriptions_of_doubles;
  group.add({.name = "twice", .syntax = "twice(_)", .overloads = {overload<&twice>("x")}});
}

TEST_F(RegistryTest, groups_are_described_once_and_when_one_of_their_operators_is_asked_for) {
  descriptions_of_halves = descriptions_of_doubles = 0;
  registry.begin_family({"halves", "Halves of numbers.", Cost::constant});
  registry.add("halfOf halved", register_halves);
  registry.begin_family({"doubles", "", Cost::linear});
  registry.add("twice", register_doubles);
  registry.add_language_note("halved", "Written behind its operand.");
  EXPECT_EQ(registry.find_operator("thrice"), nullptr);
  EXPECT_EQ(registry.suggestion("halvde"), "halved");
  EXPECT_EQ(registry.families().size(), 2U);
  EXPECT_EQ(descriptions_of_halves, 0);

  std::vector<const Operator*> found(8);
  {
    std::vector<std::jthread> threads;
    for (const Operator*& place : found) threads.emplace_back([&] { place = registry.find_operator("halved"); });
  }
  for (const Operator* op : found) EXPECT_EQ(op, found.front());
  EXPECT_EQ(found.front()->family, "halves");
  EXPECT_EQ(found.front()->cost, Cost::constant);
  EXPECT_EQ(found.front()->language_note, "Written behind its operand.");
  EXPECT_EQ(registry.syntax(*found.front()).name, "halved");
  EXPECT_EQ(descriptions_of_halves, 1);
  EXPECT_EQ(descriptions_of_doubles, 0);
  EXPECT_EQ(registry.operators().size(), 3U);
  EXPECT_EQ(descriptions_of_halves, 1);
  EXPECT_EQ(descriptions_of_doubles, 1);
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
