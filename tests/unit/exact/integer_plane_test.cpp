#include "algebra3d/exact/integer_plane.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace algebra3d
