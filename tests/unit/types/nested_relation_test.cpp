// Types of nested relations, and the order, hash and memory of their values.
#include "algebra3d/values/types/nested_relation.h"

#include <algorithm>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include "algebra3d/values/types/scalars.h"
#include "reading.h"

namespace algebra3d {
namespace {

TypeExpr pair_of_ints() {
  return TypeExpr::tuple({{"A", "int"}, {"B", "int"}});
}

const NestedRelationType& pairs() {
  return **NestedRelationType::of(pair_of_ints());
}

/// `levels` relations, each but the innermost with one attribute that is the next.
TypeExpr nested_levels(std::size_t levels) {
  TypeExpr tuple = TypeExpr::tuple({{"A", "int"}});
  for (std::size_t level = 1; level < levels; ++level) tuple = TypeExpr::tuple({{"A", TypeExpr("arel", {tuple})}});
  return tuple;
}

TEST(NestedRelation, a_type_for_each_tuple_type) {
  EXPECT_EQ(&pairs(), *NestedRelationType::of(pair_of_ints()));
  EXPECT_EQ(&pairs(), value_type(TypeExpr("arel", {pair_of_ints()})));
  EXPECT_EQ(pairs().term().text(), "(arel (tuple ((A int) (B int))))");
  EXPECT_NE(&pairs(), *NestedRelationType::of(TypeExpr::tuple({{"A", "int"}, {"C", "int"}})));
  EXPECT_EQ(value_type(TypeExpr("int")), &TypeOf<std::int64_t>::type());
  EXPECT_EQ(value_type(TypeExpr("nonsense")), nullptr);
  EXPECT_EQ(value_type(TypeExpr::rel(pair_of_ints())), nullptr);
  EXPECT_EQ(value_type(pair_of_ints()), nullptr);
}

TEST(NestedRelation, threads_get_the_same_type) {
  constexpr std::size_t kThreads = 4;
  std::array<const NestedRelationType*, kThreads> found = {};
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < kThreads; ++i)
    threads.emplace_back([&found, i] { found[i] = *NestedRelationType::of(TypeExpr::tuple({{"OnlyHere", "real"}})); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_TRUE(std::ranges::all_of(found, [&](const auto* type) { return type == found[0]; }));
}

TEST(NestedRelation, refused_tuple_types) {
  const auto message = [](const TypeExpr& tuple) { return NestedRelationType::of(tuple).error().text(); };
  EXPECT_EQ(message(TypeExpr::tuple({})), "arel: expected a tuple type with attributes, got (tuple ())");
  EXPECT_EQ(message(TypeExpr::tuple({{"R", TypeExpr::rel(pair_of_ints())}})),
            "arel: an attribute cannot be of type (rel (tuple ((A int) (B int))))");
  EXPECT_EQ(message(TypeExpr::tuple({{"S", TypeExpr("set", {TypeExpr("int")})}})),
            "arel: an attribute cannot be of type (set int)");
  EXPECT_TRUE(NestedRelationType::of(nested_levels(NestedRelationType::kMaxDepth)).ok());
  const auto deep = NestedRelationType::of(nested_levels(NestedRelationType::kMaxDepth + 1));
  ASSERT_FALSE(deep.ok());
  EXPECT_EQ(deep.error().code, ErrorCode::limit_exceeded);
}

TEST(NestedRelation, equal_in_any_order) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    std::vector<std::array<std::int64_t, 2>> rows(random() % 7);
    for (auto& row : rows) row = {static_cast<std::int64_t>(random() % 3), static_cast<std::int64_t>(random() % 2)};
    const auto made = [&] {
      std::vector<Value> values;
      for (const auto& row : rows)
        for (const std::int64_t number : row) values.push_back(Value::of(number));
      return *pairs().value_of(std::move(values));
    };
    const Value first = made();
    std::ranges::shuffle(rows, random);
    const Value second = made();
    EXPECT_EQ(compare(first, second), std::strong_ordering::equal);
    EXPECT_EQ(hash(first), hash(second));
    if (rows.empty()) continue;
    rows.front()[0] += 1;
    const Value other = made();
    EXPECT_NE(compare(first, other), std::strong_ordering::equal);
    EXPECT_EQ(compare(first, other) < 0, compare(other, first) > 0);
  }
}

// Against the definition: number of tuples, then the sorted tuples.
TEST(NestedRelation, the_order_is_total) {
  const std::vector<std::string> ascending = {
      "undefined",          "()", "((undefined 5))", "((1 1))", "((2 0))", "((2 undefined) (1 1))", "((1 1) (2 0))",
      "((0 0) (0 0) (0 0))"};
  std::vector<Value> values;
  for (const std::string& text : ascending) values.push_back(*reading_of(pairs(), text).value);
  for (std::size_t i = 0; i < values.size(); ++i)
    for (std::size_t j = 0; j < values.size(); ++j)
      EXPECT_EQ(compare(values[i], values[j]), i <=> j) << ascending[i] << " " << ascending[j];
}

TEST(NestedRelation, lists_are_read_and_written) {
  const Reading reading = reading_of(pairs(), "((1 2) (undefined 3))");
  ASSERT_TRUE(reading.value.ok());
  EXPECT_EQ(reading.value->to_nested().print(), "((1 2) (undefined 3))");
  EXPECT_EQ(reading.value->header().size, 2U);
  EXPECT_TRUE(reading.value->header().box.is_empty());
  EXPECT_EQ(reading_of(pairs(), "5").value.error().text(), "arel: expected a list of tuples, got 5");
  EXPECT_EQ(reading_of(pairs(), "((1 2) 3)").value.error().text(), "arel: tuple 2: expected a list of 2 values, got 3");
  EXPECT_TRUE(
      reading_of(pairs(), "((1 2) (1 x))").value.error().text().starts_with("arel: tuple 2, attribute B: int: "));
}

TEST(NestedRelation, memory_grows_with_the_content) {
  const Type& texts = **NestedRelationType::of(TypeExpr::tuple({{"S", "text"}}));
  const auto bytes_of = [&](std::size_t count, std::size_t length) {
    const std::vector<Value> values(count, Value::of(Text{std::string(length, 'x')}));
    return heap_bytes(*as_nested_relation(texts)->value_of(values));
  };
  EXPECT_GE(bytes_of(10, 10'000), 100'000U);
  EXPECT_GE(bytes_of(1000, 1), 1000 * sizeof(Value));
  EXPECT_LT(bytes_of(0, 0), 1000U);
}

}  // namespace
}  // namespace algebra3d
