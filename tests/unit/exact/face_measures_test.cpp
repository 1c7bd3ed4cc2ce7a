// Normals, areas, means and distances of polygons in space against GMP rationals: a double is the nearest to a root if
// the root is between the middles to its neighbours, which squares decide exactly.
#include "algebra3d/kernel/exact/face_measures.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/exact/counters.h"
#include "algebra3d/kernel/exact/plane.h"
#include "support/rounds.h"
#include "unit/exact/point_families.h"

namespace algebra3d {
namespace {

using CGAL::Gmpq;
using Polygon = std::vector<RationalVec3>;

Gmpq theirs(const Rational& value) {
  return Gmpq(value.text());
}
Gmpq theirs(double value) {
  Gmpq result;
  mpq_set_d(result.mpq(), value);
  return result;
}
std::array<Gmpq, 3> theirs(const RationalVec3& v) {
  return {theirs(v.x), theirs(v.y), theirs(v.z)};
}

/// True if `number` is the double nearest to the root of `square`; on a tie, either neighbour passes.
bool is_nearest_root(double number, const Gmpq& square) {
  if (number == 0) return square == Gmpq(0);
  const Gmpq low = (theirs(number) + theirs(std::nextafter(number, 0.0))) / Gmpq(2);
  const Gmpq high = (theirs(number) + theirs(std::nextafter(number, 1e308))) / Gmpq(2);
  return low * low <= square && square <= high * high;
}
bool is_nearest(double number, const Gmpq& exact) {
  const double infinity = std::numeric_limits<double>::infinity();
  const Gmpq low = (theirs(number) + theirs(std::nextafter(number, -infinity))) / Gmpq(2);
  const Gmpq high = (theirs(number) + theirs(std::nextafter(number, infinity))) / Gmpq(2);
  return low <= exact && exact <= high;
}

/// Twice the vector area by Newell's sums over edges, not by triangles.
std::array<Gmpq, 3> newell(const Polygon& polygon) {
  std::array<Gmpq, 3> sum{Gmpq(0), Gmpq(0), Gmpq(0)};
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto p = theirs(polygon[i]), q = theirs(polygon[(i + 1) % polygon.size()]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t j = (axis + 1) % 3, k = (axis + 2) % 3;
      sum[axis] += (p[j] - q[j]) * (p[k] + q[k]);
    }
  }
  return sum;
}

void expect_nearest(const Polygon& polygon) {
  PointArray points;
  for (const RationalVec3& p : polygon) points.push_back(ExactPoint(p));
  std::vector<std::uint32_t> corners(polygon.size());
  std::iota(corners.begin(), corners.end(), 0U);
  const VectorArea measured = nearest_vector_area(points, corners);
  const auto doubled = newell(polygon);
  const Gmpq square = doubled[0] * doubled[0] + doubled[1] * doubled[1] + doubled[2] * doubled[2];
  ASSERT_TRUE(is_nearest_root(measured.area, square / Gmpq(4))) << measured.area;
  ASSERT_EQ(measured.has_normal(), square != Gmpq(0));
  const Vec3 mean = nearest_mean(points, corners);
  const RationalVec3 exact = exact_doubled_vector_area(points, corners);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ASSERT_EQ(theirs(exact[axis]), doubled[axis]);
    const double component = measured.normal[axis];
    if (square != Gmpq(0)) {
      ASSERT_TRUE(is_nearest_root(std::abs(component), doubled[axis] * doubled[axis] / square)) << component;
    }
    ASSERT_EQ(component > 0, doubled[axis] > Gmpq(0));
    ASSERT_EQ(component < 0, doubled[axis] < Gmpq(0));
    Gmpq sum(0);
    for (const RationalVec3& p : polygon) sum += theirs(p[axis]);
    ASSERT_TRUE(is_nearest(mean[axis], sum / Gmpq(static_cast<int>(polygon.size())))) << mean[axis];
  }
  const auto p = theirs(polygon[0]), q = theirs(polygon[1]);
  Gmpq distance(0);
  for (std::size_t axis = 0; axis < 3; ++axis) distance += (p[axis] - q[axis]) * (p[axis] - q[axis]);
  ASSERT_TRUE(is_nearest_root(nearest_distance(points[0], points[1]), distance));
}

/// A family of coordinates.
template <typename Coordinate>
void expect_nearest_of(int count, Coordinate coordinate) {
  std::mt19937_64 random(7);
  for (int i = 0; i < count; ++i) {
    Polygon polygon;
    for (std::size_t corner = 0; corner < 3 + static_cast<std::size_t>(i % 4); ++corner)
      polygon.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    ASSERT_NO_FATAL_FAILURE(expect_nearest(polygon)) << i;
  }
}

TEST(FaceMeasures, are_rounded_once) {
  expect_nearest_of(rounds(1000),
                    [](auto& random) { return Rational(std::uniform_real_distribution(-1.0, 1.0)(random)); });
  expect_nearest_of(rounds(1000), [](auto& random) { return Rational(std::uniform_int_distribution(-3, 3)(random)); });
  expect_nearest_of(rounds(500),
                    [](auto& random) { return Rational(0.1 * std::uniform_int_distribution(-3, 3)(random)); });
  // Far from the origin, and of all sizes.
  expect_nearest_of(rounds(500),
                    [](auto& random) { return Rational(1e6 + std::uniform_real_distribution(0.0, 1.0)(random)); });
  expect_nearest_of(rounds(250), [](auto& random) {
    return Rational(
        std::ldexp(std::uniform_real_distribution(-1.0, 1.0)(random), std::uniform_int_distribution(-90, 190)(random)));
  });
}

TEST(FaceMeasures, are_rounded_once_beyond_the_estimate) {
  expect_nearest_of(
      300, [](auto& random) { return Rational(std::ldexp(std::uniform_real_distribution(-1.0, 1.0)(random), -200)); });
  expect_nearest_of(
      300, [](auto& random) { return Rational(std::ldexp(std::uniform_real_distribution(-1.0, 1.0)(random), 400)); });
  expect_nearest_of(300, [](auto& random) { return Rational(std::uniform_int_distribution(-50, 50)(random), 7); });
}

TEST(FaceMeasures, slivers_are_as_good) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a{number(random), number(random), number(random)}, b{number(random), number(random), number(random)};
    const double t = number(random);
    // The third corner nearly on the line through the others.
    const Vec3 c = a + t * (b - a);
    ASSERT_NO_FATAL_FAILURE(expect_nearest({RationalVec3(a), RationalVec3(b), RationalVec3(c)})) << i;
  }
}

TEST(FaceMeasures, polygons_without_area_have_no_normal) {
  const PointArray points(std::vector<Vec3>{{0, 0, 0}, {0.1, 0.2, 0.3}, {0.2, 0.4, 0.6}});
  const VectorArea line = nearest_vector_area(points, std::vector<std::uint32_t>{0, 1, 2});
  EXPECT_EQ(line.area, 0);
  EXPECT_FALSE(line.has_normal());
  EXPECT_EQ(nearest_distance(points[1], points[1]), 0);
}

TEST(FaceMeasures, rationals_are_rare) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<Vec3> doubles;
  for (int i = 0; i < 3000; ++i) doubles.push_back({number(random), number(random), number(random)});
  const PointArray points(std::move(doubles));
  reset_exact_counters();
  for (std::uint32_t i = 0; i < 3000; i += 3) nearest_vector_area(points, std::vector<std::uint32_t>{i, i + 1, i + 2});
  // A mean of four is the middle between two doubles for every fourth number or so.
  for (std::uint32_t i = 0; i + 4 <= 3000; i += 4)
    nearest_mean(points, std::vector<std::uint32_t>{i, i + 1, i + 2, i + 3});
  EXPECT_EQ(exact_counters().filter_failures, 0U);
}

}  // namespace
}  // namespace algebra3d
