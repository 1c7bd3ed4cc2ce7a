#include "algebra3d/database/value.h"

#include <limits>
#include <sstream>
#include <type_traits>
#include <unordered_set>
#include <utility>

#include <gtest/gtest.h>

namespace algebra3d::database {
namespace {

using std::chrono::milliseconds;
using std::chrono::sys_days;
using namespace std::chrono_literals;

Solid unit_cube() {
  return *Solid::box({0, 0, 0}, {1, 1, 1});
}

TEST(DatabaseValue, has_the_type_of_what_it_was_made_of) {
  EXPECT_EQ(Value(true).type(), "bool");
  EXPECT_EQ(Value(7).type(), "int");
  EXPECT_EQ(Value(7U).type(), "int");
  EXPECT_EQ(Value(std::size_t{7}).type(), "int");
  EXPECT_EQ(Value(1.5).type(), "real");
  EXPECT_EQ(Value(1.5F).type(), "real");
  EXPECT_EQ(Value("seven").type(), "string");
  EXPECT_EQ(Value(std::string_view("seven")).type(), "string");
  EXPECT_EQ(Value::text("seven").type(), "text");
  EXPECT_EQ(Value::point({1, 2, 3}).type(), "point3d");
  EXPECT_EQ(Value::vector({1, 2, 3}).type(), "vector3d");
  EXPECT_EQ(Value::points(std::vector<Vec3>{{1, 2, 3}}).type(), "points3d");
  EXPECT_EQ(Value(Box3::of({1, 2, 3})).type(), "rect3");
  EXPECT_EQ(Value(unit_cube()).type(), "volume3d");
  EXPECT_EQ(Value(boundary(unit_cube())).type(), "surface3d");
  EXPECT_EQ(Value(Instant()).type(), "instant");
  EXPECT_EQ(Value(Duration()).type(), "duration");
}

TEST(DatabaseValue, gives_back_what_it_was_made_of) {
  EXPECT_EQ(*Value(true).get<bool>(), true);
  EXPECT_EQ(*Value(-7).get<std::int64_t>(), -7);
  EXPECT_EQ(*Value(7).get<double>(), 7.0);
  EXPECT_EQ(*Value(1.5).get<double>(), 1.5);
  EXPECT_EQ(*Value("a \"b\"").get<std::string>(), "a \"b\"");
  EXPECT_EQ(*Value::text("it's").get<std::string>(), "it's");
  EXPECT_EQ(*Value::point({1, 2, 3}).get<Vec3>(), (Vec3{1, 2, 3}));
  EXPECT_EQ(*Value::vector({1, 2, 3}).get<Vec3>(), (Vec3{1, 2, 3}));
  // A set of points: in order, each once.
  EXPECT_EQ(*Value::points(std::vector<Vec3>{{4, 0, 0}, {1, 2, 3}, {4, 0, 0}}).get<std::vector<Vec3>>(),
            (std::vector<Vec3>{{1, 2, 3}, {4, 0, 0}}));
  EXPECT_EQ(*Value(Box3{{0, 1, 2}, {3, 4, 5}}).get<Box3>(), (Box3{{0, 1, 2}, {3, 4, 5}}));
  EXPECT_EQ(*Value(unit_cube()).get<Solid>(), unit_cube());
  EXPECT_EQ(*Value(boundary(unit_cube())).get<Surface>(), boundary(unit_cube()));
  const Instant moon = sys_days{std::chrono::July / 20 / 1969} + 20h + 17min + 40s;
  EXPECT_EQ(*Value(moon).get<Instant>(), moon);
  EXPECT_EQ(*Value(Duration(-5)).get<Duration>(), Duration(-5));
}

TEST(DatabaseValue, is_printed_in_the_notation_of_the_language) {
  std::ostringstream out;
  out << Value(2.5) << " " << Value("a") << " " << Value::text("a") << " " << Value::point({1, 0.5, 0}) << " "
      << Value(Instant(sys_days{std::chrono::July / 20 / 1969})) << " " << *Value::undefined("int");
  EXPECT_EQ(out.str(), "2.5 \"a\" 'a' (1.0 0.5 0.0) \"1969-07-20\" undefined");
  EXPECT_EQ(Value(Box3{{0, 1, 2}, {3, 4, 5}}).text(), "(0.0 3.0 1.0 4.0 2.0 5.0)");
}

TEST(DatabaseValue, of_any_type_is_read_from_its_notation) {
  const Value plane = *Value::parse("plane3d", "(0.0 0.0 0.0 1.0)");
  EXPECT_EQ(plane.type(), "plane3d");
  EXPECT_EQ(plane.text(), "(0.0 0.0 0.0 1.0)");
  EXPECT_EQ(Value::parse("point3d", "(1/3 0 0)")->text(), "(1/3 0.0 0.0)");
  EXPECT_EQ(Value::parse("volum3d", "()").error().text(), "unknown type 'volum3d', did you mean 'volume3d'?");
  EXPECT_EQ(Value::parse("int", "\"x\"").error().code, ErrorCode::invalid_value);
  EXPECT_EQ(Value::parse("int", "(1").error().code, ErrorCode::invalid_value);
  // A single triangle bounds no solid.
  const Value open = *Value::parse("volume3d", "(((0 0 0) (1 0 0) (0 1 0)))");
  EXPECT_FALSE(open.is_defined());
  EXPECT_NE(open.reason().find("3 boundary edges"), std::string_view::npos) << open.reason();
}

TEST(DatabaseValue, that_the_language_does_not_have_is_undefined) {
  EXPECT_EQ(Value(std::numeric_limits<double>::quiet_NaN()).reason(), "not a finite number");
  EXPECT_EQ(Value(std::numeric_limits<double>::infinity()).reason(), "not a finite number");
  EXPECT_EQ(Value(std::uint64_t{1} << 63U).reason(), "an integer of more than 64 bits");
  EXPECT_TRUE(Value((std::uint64_t{1} << 63U) - 1).is_defined());
  EXPECT_EQ(*Value(std::numeric_limits<std::int64_t>::min()).get<std::int64_t>(),
            std::numeric_limits<std::int64_t>::min());
  EXPECT_FALSE(Value::point({0, Box3::kInfinity, 0}).is_defined());
  EXPECT_FALSE(Value(Box3()).is_defined());
  EXPECT_FALSE(Value(Instant(sys_days{std::chrono::January / 1 / 10000})).is_defined());
}

TEST(DatabaseValue, of_another_type_or_undefined_is_an_error_with_the_reason) {
  EXPECT_EQ(Value("1").get<std::int64_t>().error().text(), "expected a value of type int, got string");
  EXPECT_EQ(Value("1").get<std::int64_t>().error().code, ErrorCode::type_error);
  EXPECT_EQ(Value(1.0).get<std::int64_t>().error().code, ErrorCode::type_error);
  EXPECT_EQ(Value(1).get<Vec3>().error().text(), "expected a value of type point3d or vector3d, got int");
  EXPECT_EQ(Value(1).get<std::string>().error().text(), "expected a value of type string or text, got int");
  const Value nothing = *Value::undefined("real");
  EXPECT_EQ(nothing.get<double>().error().code, ErrorCode::not_evaluable);
  EXPECT_EQ(nothing.get<double>().error().text(), "the value is undefined");
  EXPECT_EQ(nothing.get_or(4.5), 4.5);
  EXPECT_EQ(Value(2.5).get_or(4.5), 2.5);
  EXPECT_EQ(Value(Box3()).get<Box3>().error().text(), "the value is undefined: an empty or unbounded box");
  EXPECT_EQ(Value::undefined("rael").error().code, ErrorCode::unknown_name);
}

TEST(DatabaseValue, is_read_as_any_integer_type_that_has_it) {
  EXPECT_EQ(*Value(300).get<int>(), 300);
  EXPECT_EQ(*Value(300).get<std::size_t>(), 300U);
  EXPECT_EQ(*Value(300).get<long long>(), 300);
  EXPECT_EQ(*Value(-128).get<std::int8_t>(), -128);
  EXPECT_EQ(Value(300).get<std::uint8_t>().error().code, ErrorCode::invalid_value);
  EXPECT_EQ(Value(300).get<std::uint8_t>().error().text(),
            "the int 300 is not in the range of unsigned integers of 8 bits");
  EXPECT_FALSE(Value(-1).get<unsigned>().ok());
  EXPECT_EQ(Value(1.0).get<int>().error().code, ErrorCode::type_error);
  EXPECT_EQ(Value(300).get<int>().value_or(7), 300);
  EXPECT_EQ(Value(300).get<std::uint8_t>().value_or(7), 7);
  EXPECT_EQ(Value(300).get_or(7), 300);
  EXPECT_EQ(Value("300").get_or(7), 7);
  EXPECT_EQ(Value("a").get_or("b"), "a");
  EXPECT_EQ(Value(1).get_or("b"), "b");
}

TEST(DatabaseValue, nested_relations_have_types_with_arguments) {
  const Value relation =
      *Value::parse("(arel (tuple ((A int) (R (arel (tuple ((S string))))))))", R"(((1 (("a"))) (2 ())))");
  EXPECT_TRUE(relation.is_defined());
  EXPECT_EQ(relation.text(), R"(((1 (("a"))) (2 ())))");
  EXPECT_EQ(Value::parse("(arel (tuple ((A int))))", "((x))").error().code, ErrorCode::invalid_value);
  EXPECT_FALSE(Value::undefined("(arel (tuple ((A int))))")->is_defined());
}

TEST(DatabaseValue, of_a_relation_is_not_made_outside_of_a_database) {
  for (const char* type : {"rel(tuple([A: int]))", "(rel (tuple ((A int))))", "tuple([A: int])", "rtree3", "map"}) {
    const Result<Value> value = Value::parse(type, "((1))");
    ASSERT_FALSE(value.ok()) << type;
    EXPECT_EQ(value.error().code, ErrorCode::type_error) << value.error().text();
  }
  EXPECT_EQ(Value::undefined("rel(tuple([A: int]))").error().text(),
            "expected a type that an attribute can have, got 'rel(tuple([A: int]))'; write [const TYPE value NOTATION] "
            "in a statement");
}

TEST(DatabaseValue, of_bytes_that_are_no_text_is_printed_as_text) {
  const std::string bytes("a\xff\0b", 4);
  const Value value(bytes);
  EXPECT_EQ(*value.get<std::string>(), bytes);
  EXPECT_EQ(value.text(), R"("a\xff\x00b")");
}

TEST(DatabaseValue, of_more_points_than_can_be_numbered_is_undefined) {
  const Vec3 one;
  const Value many = Value::points(std::span(&one, std::size_t{1} << 33U));  // never looked at
  EXPECT_EQ(many.reason(), "more than 4294967295 points");
}

TEST(DatabaseValue, is_not_made_of_pointers_and_wide_integers) {
  static_assert(!std::is_constructible_v<Value, const Solid*> && !std::is_constructible_v<Value, const char8_t*> &&
                !std::is_constructible_v<Value, std::nullptr_t>);
  const char* const missing = nullptr;
  EXPECT_EQ(Value(missing).type(), "string");
  EXPECT_EQ(Value(missing).reason(), "a null pointer");
}

TEST(DatabaseValue, that_was_moved_from_keeps_its_content) {
  Value value("long enough to be shared and not stored in place");
  const Value taken = std::move(value);
  EXPECT_EQ(value, taken);  // NOLINT(bugprone-use-after-move): what is tested
}

TEST(DatabaseValue, is_compared_by_type_and_content) {
  EXPECT_EQ(Value(1), Value(1L));
  EXPECT_NE(Value(1), Value(1.0));
  EXPECT_NE(Value("a"), Value::text("a"));
  EXPECT_LT(Value(1), Value(2));
  EXPECT_LT(Value(2), Value(1.0));  // "int" before "real"
  EXPECT_LT(*Value::undefined("int"), Value(std::numeric_limits<std::int64_t>::min()));
  EXPECT_EQ(*Value::undefined("real"), Value(std::numeric_limits<double>::infinity()));  // reasons do not count
  const Solid halves = *unite(*Solid::box({0, 0, 0}, {0.5, 1, 1}), *Solid::box({0.5, 0, 0}, {1, 1, 1}));
  EXPECT_EQ(Value(halves), Value(unit_cube()));
}

TEST(DatabaseValue, equal_ones_have_equal_hashes) {
  std::unordered_set<Value> values = {Value(1), Value(1.0), Value("a"), Value(unit_cube()), *Value::undefined("int")};
  EXPECT_EQ(values.size(), 5U);
  EXPECT_TRUE(values.contains(Value(unit_cube())));
  EXPECT_TRUE(values.contains(Value(std::uint64_t{1} << 63U)));  // undefined, too
  EXPECT_FALSE(values.contains(Value(2)));
}

static_assert(std::is_nothrow_move_constructible_v<Value> && std::is_nothrow_move_assignable_v<Value>);
static_assert(!std::is_constructible_v<Value, char>);

}  // namespace
}  // namespace algebra3d::database
