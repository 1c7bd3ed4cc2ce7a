// Values share what does not lie in them, and give it back.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/value.h"

namespace algebra3d {
namespace {

Value name() {
  return Value::of(std::string("a name too long for the inside of a string"));
}

TEST(Value, copies_share_one_object) {
  const Value first = name();
  const Value second = first;  // NOLINT(performance-unnecessary-copy-initialization)
  EXPECT_EQ(&first.get<std::string>(), &second.get<std::string>());
}

TEST(Value, an_object_lives_as_long_as_its_last_value) {
  std::vector<Value> values(3, name());
  const std::string* const object = &values[2].get<std::string>();
  values.erase(values.begin(), values.begin() + 2);
  EXPECT_EQ(&values[0].get<std::string>(), object);
  EXPECT_EQ(compare(values[0], name()), std::strong_ordering::equal);
}

TEST(Value, is_undefined_after_it_was_moved_from) {
  Value from = name();
  Value to = Value::of(1);
  to = std::move(from);
  EXPECT_FALSE(from.is_defined());  // NOLINT(bugprone-use-after-move,clang-analyzer-cplusplus.Move)
  EXPECT_EQ(&from.type(), &TypeOf<std::string>::type());
  EXPECT_EQ(compare(to, name()), std::strong_ordering::equal);
}

TEST(Value, can_be_assigned_to_itself) {
  Value value = name();
  const Value& same = value;
  value = same;
  EXPECT_EQ(compare(value, name()), std::strong_ordering::equal);
}

}  // namespace
}  // namespace algebra3d
