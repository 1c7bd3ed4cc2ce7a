// Half-spaces beside rational arithmetic, with points next to their planes and numbers of all sizes.
#include "algebra3d/kernel/distance/detail/half_space.h"

#include <gtest/gtest.h>

#include <random>

#include "algebra3d/kernel/exact/plane.h"

namespace algebra3d::distances {
namespace {

RationalVec3 rational(const Vec3& v) {
  return {Rational(v.x), Rational(v.y), Rational(v.z)};
}

TEST(HalfSpace, HasWhatRationalsSay) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&](double size) {
    const double x = size * any(random), y = size * any(random), z = size * any(random);
    return Vec3{x, y, z};
  };
  std::size_t inside = 0, count = 0;
  for (const double size : {1.0, 1e-320, 1e-160, 1e150, 1e300})
    for (const double of_normal : {1.0, 1e-310, 1e300}) {
      for (int round = 0; round < 200; ++round) {
        const Vec3 point = vector(size), unit = vector(1), normal = of_normal * unit, along = vector(size);
        // Thirds are not doubles.
        const Rational third(Rational(1) / Rational(3));
        const RationalVec3 exact_normal = third * rational(normal);
        const HalfSpace half_space(rational(point), exact_normal);
        // In the plane but for roundings.
        const Vec3 in_plane = point + along - (dot(unit, along) / dot(unit, unit)) * unit;
        for (const Vec3& at : {point, point + along, in_plane}) {
          const bool expected = dot(exact_normal, rational(at) - rational(point)).sign() >= 0;
          ASSERT_EQ(half_space.has(PointRef(at)), expected);
          inside += expected ? 1 : 0;
          ++count;
        }
      }
    }
  EXPECT_GT(inside, count / 3);
  EXPECT_LT(inside, count);
}

TEST(HalfSpace, WithoutANormalHasAllPoints) {
  const HalfSpace half_space(rational({1, 2, 3}), rational({0, 0, 0}));
  EXPECT_TRUE(half_space.has(PointRef(Vec3{-5, 0, 7})));
}

}  // namespace
}  // namespace algebra3d::distances
