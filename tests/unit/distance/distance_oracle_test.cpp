// Distances of random sets of triangles, segments and points against CGAL's (exact_distances.h). Half of the sets have
// coordinates on a small grid, so that faces meet, overlap, and are equally far from each other.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <set>

#include "support/rounds.h"
#include "unit/distance/exact_distances.h"

namespace algebra3d {
namespace {

using namespace exact_distances;

class RandomSets {
 public:
  enum class Coordinates { grid, thirds, doubles };

  explicit RandomSets(unsigned seed) : random_(seed) {}

  /// Triangles, some of them with equal corners; none with three different corners on a line.
  TriangleMesh next(Coordinates kind, double offset) {
    PointArray points;
    for (int i = 0; i < 9; ++i) {
      const RationalVec3 p(coordinate(kind) + Rational(offset), coordinate(kind), coordinate(kind));
      points.push_back(ExactPoint(p));
    }
    std::vector<TriangleMesh::Triangle> triangles;
    const std::size_t count = 1 + random_() % 6;
    while (triangles.size() < count) {
      const auto corner = [&] { return static_cast<std::uint32_t>(random_() % points.size()); };
      const TriangleMesh::Triangle t{corner(), corner(), corner()};
      std::set<ExactPoint> places;
      for (const std::uint32_t c : t) places.insert(points.point(c));
      const std::size_t indices = std::set<std::uint32_t>(t.begin(), t.end()).size();
      if (places.size() != indices) continue;
      if (indices == 3 && collinear(points[t[0]], points[t[1]], points[t[2]])) continue;
      triangles.push_back(t);
    }
    return {std::move(points), triangles};
  }

 private:
  Rational coordinate(Coordinates kind) {
    if (kind == Coordinates::doubles) return Rational(std::uniform_real_distribution<double>(0, 1)(random_));
    const auto steps = static_cast<std::int64_t>(random_() % 5);
    return kind == Coordinates::grid ? Rational(steps) : Rational(steps, 3);
  }

  std::mt19937 random_;
};

/// The distance of each point from the set that it is said to belong to.
void expect_points_of(const ClosestPoints& closest, const TriangleMesh& a, const TriangleMesh& b) {
  const Corners first{point(closest.first.rational())}, second{point(closest.second.rational())};
  EXPECT_EQ(squared_distance(first, corners_of(a, closest.first_face)), 0);
  EXPECT_EQ(squared_distance(second, corners_of(b, closest.second_face)), 0);
  EXPECT_EQ(CGAL::squared_distance(first[0], second[0]), number(closest.squared_distance));
}

void expect_agreement(const TriangleMesh& a, const TriangleMesh& b) {
  const BoxHierarchy boxes_of_a(a), boxes_of_b(b);
  const DistanceOperand first{&a, &boxes_of_a}, second{&b, &boxes_of_b};
  const CGAL::Gmpq expected = squared_distance(a, b);
  const auto found = closest_points(first, second);
  ASSERT_TRUE(found.ok() && found.value());
  EXPECT_EQ(number((*found)->squared_distance), expected);
  expect_points_of(**found, a, b);
  EXPECT_EQ((*closest_points(second, first))->squared_distance, (*found)->squared_distance);

  const double distance = (*found)->squared_distance.nearest_root();
  for (const double d : {std::nextafter(distance, 0.0), distance, std::nextafter(distance, 10.0), distance / 2, 2.0})
    EXPECT_EQ(*are_within(first, second, Rational(d)), expected <= number(Rational(d)) * number(Rational(d))) << d;
}

TEST(DistanceOracle, RandomSets) {
  using Coordinates = RandomSets::Coordinates;
  RandomSets sets(1);
  for (int round = 0; round < rounds(15); ++round)
    for (const Coordinates kind : {Coordinates::grid, Coordinates::thirds, Coordinates::doubles})
      for (const double offset : {0.0, 2.0, 1e6}) {
        SCOPED_TRACE(testing::Message() << "round " << round << ", coordinates " << int(kind) << ", " << offset);
        const TriangleMesh a = sets.next(kind, 0), b = sets.next(kind, offset);
        expect_agreement(a, b);
        if (testing::Test::HasFailure()) return;
      }
}

}  // namespace
}  // namespace algebra3d
