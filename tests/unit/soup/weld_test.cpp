#include "algebra3d/kernel/soup/weld.h"

#include <cmath>
#include <map>
#include <random>

#include <gtest/gtest.h>

namespace algebra3d {
namespace {

using Soup = std::vector<TriangleSoup::Triangle>;

/// The definition, with an ordered map in place of a hash table.
void expect_welded(const Soup& soup, const WeldedTriangles& welded) {
  ASSERT_EQ(welded.triangles.size(), soup.size());
  std::map<Vec3, std::uint32_t> numbers;
  for (std::size_t t = 0; t < soup.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 corner = soup[t][i] + Vec3{0.0, 0.0, 0.0};
      const auto number = numbers.try_emplace(corner, static_cast<std::uint32_t>(numbers.size())).first->second;
      ASSERT_EQ(welded.triangles[t][i], number) << "triangle " << t << " corner " << i;
      ASSERT_EQ(welded.points.approx()[number], corner);
    }
  }
  EXPECT_EQ(welded.points.size(), numbers.size());
}

Soup random_soup(std::size_t count, int range, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> coordinate(-range, range);
  Soup soup(count);
  for (auto& triangle : soup)
    for (Vec3& p : triangle) p = {coordinate(random) * 0.1, coordinate(random) * 1e-300, coordinate(random) * 1e300};
  return soup;
}

TEST(weld, no_triangles_give_no_points) {
  const WeldedTriangles welded = weld(Soup());
  EXPECT_TRUE(welded.triangles.empty());
  EXPECT_EQ(welded.points.size(), 0U);
}

TEST(weld, points_are_numbered_in_order_of_first_use) {
  for (const std::size_t count : {1U, 31U, 32U, 33U, 1000U, 20000U})
    for (const int range : {1, 5, 1000}) {
      const Soup soup =
          random_soup(count, range, static_cast<std::uint32_t>(count) + static_cast<std::uint32_t>(range));
      expect_welded(soup, weld(soup));
    }
}

TEST(weld, negative_zero_is_zero) {
  const WeldedTriangles welded = weld(Soup{{Vec3{-0.0, 0.0, 1.0}, Vec3{0.0, -0.0, 1.0}, Vec3{0.0, 0.0, 1.0}}});
  ASSERT_EQ(welded.points.size(), 1U);
  EXPECT_FALSE(std::signbit(welded.points.approx()[0].x));
  EXPECT_FALSE(std::signbit(welded.points.approx()[0].y));
}

TEST(weld, neighbouring_doubles_stay_apart) {
  const double next = std::nextafter(1.0, 2.0);
  const WeldedTriangles welded = weld(Soup{{Vec3{1.0, 0.0, 0.0}, Vec3{next, 0.0, 0.0}, Vec3{1.0, 0.0, 0.0}}});
  EXPECT_EQ(welded.points.size(), 2U);
  EXPECT_EQ(welded.triangles[0], (TriangleMesh::Triangle{0, 1, 0}));
}

TEST(weld, exact_corners_are_joined_by_their_rationals) {
  const ExactPoint third(RationalVec3(Rational(1, 3), 0, 0));
  const ExactPoint near_third(Vec3{1.0 / 3.0, 0.0, 0.0});  // the same double, another number
  const ExactPoint third_again(RationalVec3(Rational(2, 6), 0, 0));
  const ExactPoint one(Vec3{1.0, 0.0, 0.0});
  const WeldedTriangles welded = weld(std::vector<std::array<ExactPoint, 3>>{
      {third, near_third, third_again}, {one, third, ExactPoint(RationalVec3(1, 0, 0))}});
  ASSERT_EQ(welded.points.size(), 3U);
  EXPECT_EQ(welded.triangles[0], (TriangleMesh::Triangle{0, 1, 0}));
  EXPECT_EQ(welded.triangles[1], (TriangleMesh::Triangle{2, 0, 2}));
  EXPECT_EQ(welded.points.exact_count(), 1U);
  EXPECT_EQ(welded.points.point(0), third);
  EXPECT_EQ(welded.points.point(1), near_third);
}

TEST(weld, exact_and_double_versions_agree_on_doubles) {
  const Soup soup = random_soup(500, 3, 7);
  std::vector<std::array<ExactPoint, 3>> exact;
  for (const auto& t : soup) exact.push_back({ExactPoint(t[0]), ExactPoint(t[1]), ExactPoint(t[2])});
  const WeldedTriangles a = weld(soup);
  const WeldedTriangles b = weld(exact);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.points.approx(), b.points.approx());
  EXPECT_EQ(b.points.exact_count(), 0U);
}

}  // namespace
}  // namespace algebra3d
