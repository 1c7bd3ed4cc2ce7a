// Distances of boxes and single points, which follow from their coordinates, against those of their triangles.
#include <gtest/gtest.h>

#include <vector>

#include "algebra3d/values/spatial_relations/nearest_points.h"
#include "unit/arrangement/random_solids.h"

namespace algebra3d {
namespace {

/// A box, which may be flat, or a point, whose coordinates may be fractions.
struct BoxOrPoint {
  Box3 box;
  std::vector<ExactPoint> point;

  SpatialSet set() const { return point.empty() ? SpatialSet(box) : SpatialSet(PointSet{point}); }
};

BoxOrPoint drawn(solids::Chance& chance) {
  BoxOrPoint result;
  if (chance.below(2) == 0) {
    const auto third = [&] { return Rational(static_cast<std::int64_t>(chance.below(60)), 3); };
    result.point = {ExactPoint(RationalVec3(third(), third(), third()))};
    return result;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.box.min[axis] = static_cast<double>(chance.below(20)) * 0.3;
    result.box.max[axis] = result.box.min[axis] + static_cast<double>(chance.below(4)) * 0.7;
  }
  return result;
}

TEST(BoxDistances, are_those_of_the_triangles) {
  solids::Chance chance(7);
  int apart = 0;
  for (int i = 0; i < 500; ++i) {
    const BoxOrPoint a = drawn(chance), b = drawn(chance);
    const auto nearest = nearest_points(a.set(), b.set());
    const auto square = squared_distance_of(a.set(), b.set());
    ASSERT_TRUE(nearest.ok() && nearest->has_value() && square.ok() && square->has_value());
    EXPECT_EQ(**square, (*nearest)->squared_distance);
    apart += (*square)->sign() > 0 ? 1 : 0;
  }
  EXPECT_GT(apart, 300);
  EXPECT_LT(apart, 500);
}

TEST(BoxDistances, of_no_points_is_none) {
  EXPECT_FALSE(squared_distance_of(PointSet{}, Box3{{0, 0, 0}, {1, 1, 1}})->has_value());
}

}  // namespace
}  // namespace algebra3d
