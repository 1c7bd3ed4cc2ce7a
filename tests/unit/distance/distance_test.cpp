#include "algebra3d/kernel/distance/distance.h"

#include <gtest/gtest.h>

#include <atomic>

#include "unit/distance/triangle_set.h"

namespace algebra3d {
namespace {

using Set = TriangleSet;

ClosestPoints closest(const Set& a, const Set& b) {
  return closest_points(a.operand(), b.operand()).value().value();
}

const Set& ground() {
  static const Set kGround({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}});
  return kGround;
}

TEST(Distance, CornerOverTheInsideOfATriangle) {
  const Set above({{1, 1, 0.5}, {1, 1, 3}, {2, 1, 3}}, {{0, 1, 2}});
  const ClosestPoints points = closest(above, ground());
  EXPECT_EQ(points.squared_distance, Rational(1, 4));
  EXPECT_EQ(points.first, ExactPoint(Vec3{1, 1, 0.5}));
  EXPECT_EQ(points.second, ExactPoint(Vec3{1, 1, 0}));
}

TEST(Distance, EdgesThatPassEachOther) {
  // The edge from (0, 4, 0) to (4, 0, 0) has its middle at (2, 2, 0); the other one leads past it at the height 1.
  const Set other({{2, 2, 1}, {3, 3, 3}, {5, 5, 1}}, {{0, 2, 1}});
  const ClosestPoints points = closest(ground(), other);
  EXPECT_EQ(points.squared_distance, 1);
  const Set crossing({{1, 1, 1}, {5, 5, 1}, {9, 9, 9}}, {{0, 1, 2}});
  EXPECT_EQ(closest(ground(), crossing).squared_distance, 1);
}

TEST(Distance, FractionsAreExact) {
  // The foot of (1, 1, 1) on the line through (3, 0, 0) and (0, 0, 0) + ... of the plane x + y + z = 1 is (1/3, 1/3,
  // 1/3).
  const Set plane({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}});
  const Set point({{1, 1, 1}}, {{0, 0, 0}});
  const ClosestPoints points = closest(point, plane);
  const Rational third(1, 3);
  EXPECT_EQ(points.second, ExactPoint(RationalVec3(third, third, third)));
  EXPECT_EQ(points.squared_distance, Rational(4, 3));
}

TEST(Distance, PointsAndSegments) {
  const Set points({{0, 0, 0}, {10, 0, 0}}, {{0, 0, 0}, {1, 1, 1}});
  const Set segment({{4, 3, 0}, {9, 3, 0}}, {{0, 1, 1}});
  EXPECT_EQ(closest(points, segment).squared_distance, 10);
  EXPECT_EQ(closest(segment, points).second_face, FaceId(1));
}

TEST(Distance, ParallelFacesAreAllAtOneDistance) {
  // Two plates of 2 * 30 * 30 triangles each, an eighth apart: thousands of pairs are equally near.
  const auto plate = [](double z) {
    std::vector<Vec3> points;
    std::vector<TriangleMesh::Triangle> triangles;
    constexpr std::uint32_t kSide = 30;
    for (std::uint32_t y = 0; y <= kSide; ++y)
      for (std::uint32_t x = 0; x <= kSide; ++x) points.push_back({static_cast<double>(x), static_cast<double>(y), z});
    for (std::uint32_t y = 0; y < kSide; ++y)
      for (std::uint32_t x = 0; x < kSide; ++x) {
        const std::uint32_t corner = y * (kSide + 1) + x;
        triangles.push_back({corner, corner + 1, corner + kSide + 2});
        triangles.push_back({corner, corner + kSide + 2, corner + kSide + 1});
      }
    return Set(std::move(points), std::move(triangles));
  };
  const Set lower = plate(0), upper = plate(0.125);
  EXPECT_EQ(closest(lower, upper).squared_distance, Rational(1, 64));
  EXPECT_TRUE(*are_within(lower.operand(), upper.operand(), Rational(1, 8)));
  EXPECT_FALSE(*are_within(lower.operand(), upper.operand(), Rational(0.125 - 0x1p-56)));
}

TEST(Distance, WholeRangeOfDoubles) {
  const Set low({{-1.5e308, 0, 0}}, {{0, 0, 0}}), high({{1.5e308, 0, 0}}, {{0, 0, 0}});
  EXPECT_EQ(closest(low, high).squared_distance, Rational(1.5e308) * Rational(1.5e308) * 4);
  EXPECT_TRUE(*are_within(low.operand(), low.operand(), 0));
  EXPECT_FALSE(*are_within(low.operand(), high.operand(), Rational(1.7e308)));

  constexpr double kLeast = 0x1p-1074;
  const Set one({{0, 0, 0}, {kLeast, 0, 0}, {0, kLeast, 0}}, {{0, 1, 2}}), other({{0, 0, 3 * kLeast}}, {{0, 0, 0}});
  EXPECT_EQ(closest(one, other).squared_distance, Rational(3 * kLeast) * Rational(3 * kLeast));
}

TEST(Distance, EmptySetsHaveNone) {
  const Set nothing({}, {});
  EXPECT_FALSE(closest_points(nothing.operand(), ground().operand()).value());
  EXPECT_FALSE(*are_within(nothing.operand(), ground().operand(), Rational(1000)));
}

TEST(Distance, CanBeCancelled) {
  const std::atomic<bool> cancel = true;
  EXPECT_EQ(closest_points(ground().operand(), ground().operand(), &cancel).error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d
