#include "queries/shell/detail/table.h"

#include <gtest/gtest.h>

#include "algebra3d/values/types/planar.h"
#include "algebra3d/values/types/spatial.h"
#include "queries/exchange/exchange_values.h"
#include "support/cloud_type.h"

namespace queries {
namespace {

TEST(DisplayText, a_type_says_that_its_values_are_summarised) {
  const auto one = algebra3d::Value::of(Cloud{{{1, 2, 3}}});
  EXPECT_TRUE(is_summarised(one));
  EXPECT_EQ(display_text(one), "cloud3d: 1 sample, box (1 1) (2 2) (3 3)");
  EXPECT_EQ(display_text(algebra3d::Value::of(Cloud{{{0, 0, 0}, {1, 2, 3}}})),
            "cloud3d: 2 samples, box (0 1) (0 2) (0 3)");
  EXPECT_EQ(display_text(algebra3d::Value::of(Cloud{})), "cloud3d: empty");
}

TEST(DisplayText, other_types_are_shown_as_their_lists) {
  EXPECT_FALSE(is_summarised(algebra3d::Value::of(algebra3d::Point3d{algebra3d::Vec3{1, 2, 3}})));
  EXPECT_EQ(display_text(algebra3d::Value::of(algebra3d::Point3d{algebra3d::Vec3{1, 2, 3}})), "(1.0 2.0 3.0)");
  EXPECT_FALSE(is_summarised(algebra3d::Value(algebra3d::TypeOf<algebra3d::Region>::type())));
}

}  // namespace
}  // namespace queries
