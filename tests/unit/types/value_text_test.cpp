#include "algebra3d/values/types/value_text.h"

#include <gtest/gtest.h>

#include "algebra3d/values/types/all.h"
#include "algebra3d/values/types/spatial.h"
#include "unit/types/reading.h"

namespace algebra3d {
namespace {

std::string text_of(const Value& value) {
  std::string text = "before ";
  append_text(value, text);
  return text;
}

TEST(ValueText, is_that_of_the_nested_list_for_every_type) {
  for (const Type* const type : all_types()) {
    const Value value = *reading_of(*type, type->example()).value;
    EXPECT_EQ(text_of(value), "before " + value.to_nested().print()) << type->name();
    EXPECT_EQ(text_of(Value(*type)), "before undefined") << type->name();
  }
}

TEST(ValueText, of_geometry_with_fractions_and_of_none) {
  const Value solid =
      *reading_of(TypeOf<Volume3d>::type(),
                  "(((0 0 0) (0 1 0) (1/3 0 0)) ((0 0 0) (1/3 0 0) (0 0 1/7)) ((0 0 0) (0 0 1/7) (0 1 0)) "
                  "((1/3 0 0) (0 1 0) (0 0 1/7)))")
           .value;
  EXPECT_EQ(text_of(solid), "before " + solid.to_nested().print());
  EXPECT_EQ(text_of(Value::of(Surface3d())), "before ()");
}

}  // namespace
}  // namespace algebra3d
