#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/tuple_number.h"
#include "algebra3d/values/types/value.h"

namespace algebra3d {
namespace {

template <typename T>
void expect_prefixes_in_order(const std::vector<T>& contents) {
  std::vector<Value> values;
  for (const T& content : contents) values.push_back(Value::of(content));
  for (const Value& a : values) {
    EXPECT_TRUE(order_prefix(a) > 0 || !a.type().is_whole_in_prefix(0));
    for (const Value& b : values) {
      if (compare(a, b) >= 0) continue;
      EXPECT_TRUE(order_prefix(a) < order_prefix(b) ||
                  (order_prefix(a) == order_prefix(b) && !a.type().is_whole_in_prefix(order_prefix(a))))
          << a.to_nested().print() << " " << b.to_nested().print();
    }
  }
}

TEST(OrderPrefix, agrees_with_the_order_of_values) {
  expect_prefixes_in_order<std::int64_t>(
      {INT64_MIN, INT64_MIN + 1, -5'000'000'000, -5, -1, 0, 1, 2, 5'000'000'000, INT64_MAX - 1, INT64_MAX});
  expect_prefixes_in_order<double>({-1e300, -1.5, -1e-300, -0.0, 0.0, 1e-300, 2.0, 2.5, 1e300});
  expect_prefixes_in_order<bool>({false, true});
  expect_prefixes_in_order<std::string>(
      {"", "a", "aa", "ab", "abcdefgh", "abcdefghi", "abcdefgi", "b", "\u00e4", "\u20ac"});
  expect_prefixes_in_order<TupleNumber>({TupleNumber{1}, TupleNumber{2}, TupleNumber{std::int64_t{1} << 40}});
  EXPECT_EQ(order_prefix(Value(TypeOf<double>::type())), 0U);
}

TEST(OrderPrefix, of_numbers_differs_where_they_differ) {
  EXPECT_LT(order_prefix(Value::of(1)), order_prefix(Value::of(2)));
  EXPECT_LT(order_prefix(Value::of(-2)), order_prefix(Value::of(-1)));
  EXPECT_LT(order_prefix(Value::of(-2.5)), order_prefix(Value::of(-2.0)));
}

TEST(HeapBytes, grow_with_the_value) {
  EXPECT_EQ(heap_bytes(Value::of(7)), 0U);
  EXPECT_LT(heap_bytes(Value::of(std::string("short"))), 100U);
  EXPECT_GT(heap_bytes(Value::of(std::string(10'000, 'x'))), 10'000U);
}

}  // namespace
}  // namespace algebra3d
