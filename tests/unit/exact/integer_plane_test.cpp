#include "algebra3d/kernel/exact/integer_plane.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace algebra3d {
namespace {

IntegerPlane through(const Vec3& a, const Vec3& b, const Vec3& c) {
  const ExactPoint p(a), q(b), r(c);
  return IntegerPlane::through({p.ref(), q.ref(), r.ref()});
}

// Coefficients that no power of two brings into the range of doubles made the flipped plane another one.
TEST(IntegerPlane, turned_over_is_that_of_the_corners_in_the_other_order) {
  struct Corners {
    Vec3 a, b, c;
  };
  const std::vector<Corners> cases = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                      {{1, 2, 3}, {4, 5, -6}, {0.1, 7, 1e20}},
                                      {{5e-324, 1e100, 5e-324}, {1, 5e-324, 5e-324}, {5e-324, 5e-324, 1e308}},
                                      {{1e308, 0, 0}, {0, 5e-324, 0}, {0, 0, 1}},
                                      // An offset beyond the range, in terms of the normal.
                                      {{-1e308, -1e308, 1.5e-323}, {-1e308, 0, -1e308}, {-5e-324, -1e308, -1e308}},
                                      {{1e308, 1e308, 0}, {1e308, 0, 1e308}, {0, 1e308, 1e308}}};
  for (const auto& [a, b, c] : cases) {
    EXPECT_TRUE(through(a, b, c).flipped() == through(a, c, b));
    EXPECT_TRUE(through(a, b, c).flipped().flipped() == through(a, b, c));
    EXPECT_FALSE(through(a, b, c) == through(a, c, b));
  }
}

// A flipped plane has the integers of the other one with the opposite signs, and shares them.
TEST(IntegerPlane, turned_over_has_opposite_sides_and_numbers) {
  const IntegerPlane plane = through({0.1, 0.2, 0.3}, {1.5, 0.1, 0}, {0, 1.25, 0.7}), flipped = plane.flipped();
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(flipped.rounded()[i], -plane.rounded()[i]);
  const ExactPlane exact = plane.exact(), turned = flipped.exact();
  EXPECT_EQ(turned.normal, Rational(-1) * exact.normal);
  EXPECT_EQ(turned.offset, -exact.offset);
  // Far off, in the plane, and so near to it that integers decide.
  const ExactPoint near(RationalVec3(Rational(0.1), Rational(0.2), Rational(0.3) + Rational(1, std::int64_t{1} << 62)));
  for (const ExactPoint& point : {ExactPoint(Vec3{5, 5, 5}), ExactPoint(Vec3{0.1, 0.2, 0.3}), near})
    EXPECT_EQ(flipped.side(point), -plane.side(point));
  EXPECT_EQ(plane.side(Vec3{0.1, 0.2, 0.3}), 0);
  EXPECT_NE(plane.side(near), 0);
  EXPECT_TRUE(IntegerPlane(flipped).flipped() == plane);
  EXPECT_TRUE(IntegerPlane() == IntegerPlane());
}

}  // namespace
}  // namespace algebra3d
