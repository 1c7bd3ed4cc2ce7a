// Distances of random sets of triangles, segments and points against CGAL's, over GMP rationals: the smallest of the
// squared distances of all pairs, each from those of edges with edges and corners with triangles. Half of the sets have
// coordinates on a small grid, so that faces meet, overlap, and are equally far from each other.
#include <CGAL/Cartesian.h>
#include <CGAL/Gmpq.h>
#include <CGAL/intersections.h>
#include <CGAL/squared_distance_3.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <set>

#include "algebra3d/distance/distance.h"

namespace algebra3d {
namespace {

using Kernel = CGAL::Cartesian<CGAL::Gmpq>;
using Point = Kernel::Point_3;
using Corners = std::vector<Point>;  // different ones of a face: one to three

int round_count() {
  const char* rounds = std::getenv("ALGEBRA3D_ROUNDS");
  return rounds == nullptr ? 60 : std::atoi(rounds);
}

CGAL::Gmpq number(const Rational& value) {
  return CGAL::Gmpq(value.text());
}
Point point(const RationalVec3& p) {
  return {number(p.x), number(p.y), number(p.z)};
}

Corners corners_of(const TriangleMesh& mesh, FaceId face) {
  std::set<Point> corners;
  for (const PointRef& corner : mesh.corners(face)) corners.insert(point(corner.rational()));
  return {corners.begin(), corners.end()};
}

CGAL::Gmpq between_edges(const Corners& a, const Corners& b) {
  std::optional<CGAL::Gmpq> least;
  const auto take = [&](const CGAL::Gmpq& distance) { least = least ? std::min(*least, distance) : distance; };
  for (const Point& p : a)
    for (const Point& q : b) take(CGAL::squared_distance(p, q));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = i + 1; j < a.size(); ++j) {
      const Kernel::Segment_3 edge(a[i], a[j]);
      for (const Point& q : b) take(CGAL::squared_distance(edge, q));
      for (std::size_t k = 0; k < b.size(); ++k)
        for (std::size_t l = k + 1; l < b.size(); ++l)
          take(CGAL::squared_distance(edge, Kernel::Segment_3(b[k], b[l])));
    }
  return *least;
}

CGAL::Gmpq squared_distance(const Corners& a, const Corners& b) {
  CGAL::Gmpq least = std::min(between_edges(a, b), between_edges(b, a));
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
    if (to.size() < 3) continue;
    const Kernel::Triangle_3 triangle(to[0], to[1], to[2]);
    for (const Point& p : from) least = std::min(least, CGAL::squared_distance(p, triangle));
    for (std::size_t i = 0; i < from.size(); ++i)
      for (std::size_t j = i + 1; j < from.size(); ++j)
        if (CGAL::do_intersect(Kernel::Segment_3(from[i], from[j]), triangle)) return 0;
  }
  return least;
}

CGAL::Gmpq squared_distance(const TriangleMesh& a, const TriangleMesh& b) {
  std::optional<CGAL::Gmpq> least;
  for (std::size_t f = 0; f < a.face_count(); ++f)
    for (std::size_t g = 0; g < b.face_count(); ++g) {
      const CGAL::Gmpq distance = squared_distance(corners_of(a, FaceId(f)), corners_of(b, FaceId(g)));
      least = least ? std::min(*least, distance) : distance;
    }
  return *least;
}

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
  for (int round = 0; round < round_count(); ++round)
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
