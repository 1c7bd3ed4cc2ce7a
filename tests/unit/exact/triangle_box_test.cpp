// The separating axes against CGAL's test over GMP rationals.

#include <algorithm>

#include <CGAL/Iso_cuboid_3.h>
#include <CGAL/intersections.h>
#include <gtest/gtest.h>

#include "algebra3d/kernel/exact/triangle_box.h"
#include "support/rounds.h"
#include "unit/exact/point_families.h"

namespace algebra3d {
namespace {

using namespace point_families;

class TriangleBox : public testing::TestWithParam<Family> {};
INSTANTIATE_TEST_SUITE_P(families, TriangleBox, testing::ValuesIn(kFamilies));

TEST_P(TriangleBox, meets_as_cgal_says) {
  Random random(7);
  int met = 0, tested = 0;
  for (int i = 0; i < rounds(750); ++i) {
    const auto p = make_points(GetParam(), random, 5);
    if (collinear(p[0].ours, p[1].ours, p[2].ours)) continue;
    // Boxes have doubles as corners.
    const Box3 box = unite(Box3::of(p[3].ours.approx()), Box3::of(p[4].ours.approx()));
    const Kernel::Iso_cuboid_3 cuboid(TestPoint(box.min).oracle, TestPoint(box.max).oracle);
    const Kernel::Triangle_3 triangle(p[0].oracle, p[1].oracle, p[2].oracle);
    const bool expected = CGAL::do_intersect(triangle, cuboid);
    ASSERT_EQ(meets_box({p[0].ours, p[1].ours, p[2].ours}, box), expected) << "sample " << i;
    met += expected ? 1 : 0;
    ++tested;
  }
  EXPECT_GT(met, tested / 100);
  EXPECT_LT(met, tested);
}

TEST(TriangleBox, touching_counts) {
  const Box3 box{{0, 0, 0}, {1, 1, 1}};
  // A corner touched from outside by a plane, by an edge and by a corner, and the same a hair farther.
  for (const double gap : {0.0, 0x1p-50}) {
    const double x = 1 + gap;
    const bool touches = gap == 0;
    EXPECT_EQ(meets_box({Vec3{3 * x, 0, 0}, Vec3{0, 3 * x, 0}, Vec3{0, 0, 3 * x}}, box), touches);
    EXPECT_EQ(meets_box({Vec3{x, 2, 0.5}, Vec3{x, -2, 0.5}, Vec3{4, 0, 0}}, box), touches);
    EXPECT_EQ(meets_box({Vec3{x, x, x}, Vec3{4, 2, 2}, Vec3{2, 4, 2}}, box), touches);
  }
  EXPECT_TRUE(meets_box({Vec3{0.25, 0.25, 0.25}, Vec3{0.5, 0.25, 0.25}, Vec3{0.25, 0.5, 0.25}}, box));
}

}  // namespace
}  // namespace algebra3d
