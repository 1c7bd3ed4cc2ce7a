// Constructed points and what is decided at them, against CGAL over GMP rationals.
#include <array>
#include <cmath>
#include <vector>

#include <CGAL/intersections.h>
#include <gtest/gtest.h>

#include "algebra3d/kernel/exact/detail/homogeneous.h"
#include "algebra3d/kernel/exact/intersection_point.h"
#include "algebra3d/kernel/exact/plane.h"
#include "unit/exact/point_families.h"

namespace algebra3d {
namespace {

using namespace point_families;
using Plane = Kernel::Plane_3;
using Line = Kernel::Line_3;

CGAL::Gmpq number(const Rational& value) {
  return CGAL::Gmpq(value.text());
}
Oracle in_oracle(const RationalVec3& p) {
  return {number(p.x), number(p.y), number(p.z)};
}
// Without those whose intersections may lie beyond the range of doubles.
class Constructions : public testing::TestWithParam<Family> {};
INSTANTIATE_TEST_SUITE_P(exact, Constructions,
                         testing::Values(Family::uniform, Family::grid, Family::near_plane, Family::thirds,
                                         Family::far_thirds, Family::mixed_thirds));

Plane oracle_plane(const std::vector<TestPoint>& p, std::size_t first) {
  return {p[first].oracle, p[first + 1].oracle, p[first + 2].oracle};
}
TriangleRef triangle(const std::vector<TestPoint>& p, std::size_t first) {
  return {p[first].ours.ref(), p[first + 1].ours.ref(), p[first + 2].ours.ref()};
}

bool is_in_range(const Oracle& p) {
  const auto is_small = [](const CGAL::Gmpq& value) { return std::abs(CGAL::to_double(value)) < 1e300; };
  return is_small(p.x()) && is_small(p.y()) && is_small(p.z());
}

TEST_P(Constructions, plane_through_is_one_for_all_triangles_in_it_that_turn_the_same_way) {
  Random random(1);
  int in_common_plane = 0;
  for (int i = 0; i < 2000; ++i) {
    auto p = make_points(GetParam(), random, 6);
    const auto u = p[1].oracle - p[0].oracle, v = p[2].oracle - p[0].oracle;
    for (std::size_t k = 3; k < 6 && i % 2 == 0; ++k)
      p[k] = TestPoint(p[0].oracle + integer(random, -3, 3) * u + integer(random, -3, 3) * v);
    const Plane s = oracle_plane(p, 0), t = oracle_plane(p, 3);
    if (s.is_degenerate() || t.is_degenerate()) continue;
    const IntegerPlane ours = IntegerPlane::through(triangle(p, 0)), other = IntegerPlane::through(triangle(p, 3));
    for (const TestPoint& point : p) {
      const int side = sign_of(s.oriented_side(point.oracle));
      ASSERT_EQ(ours.exact().evaluate(point.ours.rational()).sign(), side);
      ASSERT_EQ(ours.side(point.ours), side);
      const int rounded = detail::filter_rounded_side(ours.rounded(), point.ours.approx());
      ASSERT_TRUE(rounded == side || rounded == detail::kUndecided);
      ASSERT_EQ(ours.flipped().side(point.ours), -side);
    }
    const bool is_same = s == t;
    in_common_plane += is_same ? 1 : 0;
    ASSERT_EQ(ours == other, is_same);
    const ExactPlane turned = IntegerPlane::through({p[2].ours.ref(), p[1].ours.ref(), p[0].ours.ref()}).exact();
    ASSERT_EQ(turned.normal, RationalVec3() - ours.exact().normal);
    ASSERT_EQ(turned.offset, -ours.exact().offset);
  }
  EXPECT_GT(in_common_plane, 200);
}

TEST_P(Constructions, line_and_plane_meet_in_the_exact_point) {
  Random random(2);
  int count = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto p = make_points(GetParam(), random, 5);
    const Plane plane = oracle_plane(p, 0);
    if (plane.is_degenerate() || p[3].oracle == p[4].oracle) continue;
    const Line line(p[3].oracle, p[4].oracle);
    const auto common = CGAL::intersection(line, plane);
    const Oracle* expected = common ? boost::get<Oracle>(&*common) : nullptr;
    if (expected == nullptr || !is_in_range(*expected)) continue;
    const ExactPoint met = intersect_line_plane(p[3].ours, p[4].ours, IntegerPlane::through(triangle(p, 0)));
    ASSERT_EQ(in_oracle(met.rational()), *expected);
    ASSERT_EQ(met, intersect_line_plane(p[4].ours, p[3].ours, IntegerPlane::through(triangle(p, 0))));
    for (const ExactPoint& of_triangle : {intersect_line_plane(p[3].ours, p[4].ours, triangle(p, 0)),
                                          intersect_line_plane(p[4].ours, p[3].ours, triangle(p, 0))}) {
      ASSERT_EQ(in_oracle(of_triangle.rational()), *expected);
      ASSERT_EQ(of_triangle, met);
      ASSERT_EQ(of_triangle.hash(), met.hash());
    }
    ++count;
  }
  EXPECT_GT(count, 100);
}

// Integers without a common divisor from the fraction, and as they come from the planes.
TEST_P(Constructions, points_are_equal_however_they_are_made) {
  Random random(6);
  int count = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto p = make_points(GetParam(), random, 5);
    const Plane plane = oracle_plane(p, 0);
    if (plane.is_degenerate() || p[3].oracle == p[4].oracle) continue;
    const auto common = CGAL::intersection(Line(p[3].oracle, p[4].oracle), plane);
    const Oracle* expected = common ? boost::get<Oracle>(&*common) : nullptr;
    if (expected == nullptr || !is_in_range(*expected)) continue;
    const ExactPoint met = intersect_line_plane(p[3].ours, p[4].ours, triangle(p, 0));
    const ExactPoint same = TestPoint(*expected).ours;
    ASSERT_EQ(met, same);
    ASSERT_EQ(met.hash(), same.hash());
    const ExactPoint near(met.rational() + RationalVec3(Rational(1, 3) * Rational(0x1p-200), 0, 0));
    ASSERT_NE(met, near);
    ASSERT_NE(near, met);
    ++count;
  }
  EXPECT_GT(count, 100);
}

TEST_P(Constructions, three_planes_meet_in_the_exact_point) {
  Random random(3);
  int count = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto p = make_points(GetParam(), random, 9);
    const Plane a = oracle_plane(p, 0), b = oracle_plane(p, 3), c = oracle_plane(p, 6);
    if (a.is_degenerate() || b.is_degenerate() || c.is_degenerate()) continue;
    const auto common = CGAL::intersection(a, b, c);
    const Oracle* expected = common ? boost::get<Oracle>(&*common) : nullptr;
    if (expected == nullptr || !is_in_range(*expected)) continue;
    const IntegerPlane x = IntegerPlane::through(triangle(p, 0)), y = IntegerPlane::through(triangle(p, 3)),
                       z = IntegerPlane::through(triangle(p, 6));
    const ExactPoint met = intersect_planes(x, y, z);
    ASSERT_EQ(in_oracle(met.rational()), *expected);
    ASSERT_EQ(met, intersect_planes(z, x, y));
    ASSERT_EQ(met, intersect_planes(y, x, z));
    ++count;
  }
  EXPECT_GT(count, 100);
}

TEST_P(Constructions, planes_through_one_line_have_no_common_point) {
  Random random(7);
  int count = 0;
  for (int i = 0; i < 100; ++i) {
    const auto p = make_points(GetParam(), random, 5);
    const auto through = [&](std::size_t j) { return TriangleRef{p[0].ours, p[1].ours, p[j].ours}; };
    const auto is_degenerate = [&](std::size_t j) {
      return Plane(p[0].oracle, p[1].oracle, p[j].oracle).is_degenerate();
    };
    if (is_degenerate(2) || is_degenerate(3) || is_degenerate(4)) continue;
    const IntegerPlane x = IntegerPlane::through(through(2)), y = IntegerPlane::through(through(3)),
                       z = IntegerPlane::through(through(4));
    ASSERT_FALSE(common_point(x, y, z));
    ASSERT_FALSE(common_point(x, x.flipped(), z));
    ++count;
  }
  EXPECT_GT(count, 50);
}

TEST_P(Constructions, homogeneous_coordinates_are_the_point) {
  Random random(4);
  detail::HomogeneousPoint buffer;
  for (int i = 0; i < 500; ++i) {
    const auto p = make_points(GetParam(), random, 1);
    const detail::HomogeneousView homogeneous(p[0].ours, buffer);
    ASSERT_EQ(mpz_sgn(homogeneous[3]), 1);
    const auto coordinate = [&](std::size_t axis) {
      CGAL::Gmpq value;
      mpz_set(mpq_numref(value.mpq()), homogeneous[axis]);
      mpz_set(mpq_denref(value.mpq()), homogeneous[3]);
      mpq_canonicalize(value.mpq());
      return value;
    };
    ASSERT_EQ(Oracle(coordinate(0), coordinate(1), coordinate(2)), p[0].oracle);
  }
}

/// Points of the family, and points constructed from such, which lie in planes with others.
std::vector<TestPoint> with_constructed_points(Family family, Random& random) {
  std::vector<TestPoint> result;
  while (result.size() < 4) {
    const auto p = make_points(family, random, 5);
    const Plane plane = oracle_plane(p, 0);
    if (plane.is_degenerate() || p[3].oracle == p[4].oracle) continue;
    const auto common = CGAL::intersection(Line(p[3].oracle, p[4].oracle), plane);
    const Oracle* met = common ? boost::get<Oracle>(&*common) : nullptr;
    if (met == nullptr || !is_in_range(*met)) continue;
    result = {p[0], p[1], p[2], p[3]};
    result[static_cast<std::size_t>(integer(random, 0, 3))] = TestPoint(*met);
  }
  return result;
}

TEST_P(Constructions, signs_by_integers_are_exact) {
  Random random(5);
  int zeros = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto p = i % 2 == 0 ? make_points(GetParam(), random, 4) : with_constructed_points(GetParam(), random);
    std::array<PointRef, 4> q{p[0].ours.ref(), p[1].ours.ref(), p[2].ours.ref(), p[3].ours.ref()};
    const int expected = sign_of(CGAL::orientation(p[0].oracle, p[1].oracle, p[2].oracle, p[3].oracle));
    ASSERT_EQ(detail::orient3d_by_integers({&q[0], &q[1], &q[2], &q[3]}), expected);
    ASSERT_EQ(detail::orient3d_by_integers({&q[1], &q[0], &q[2], &q[3]}), -expected);
    ASSERT_EQ(orient3d(q[0], q[1], q[2], q[3]), expected);
    for (const auto plane : {Projection::yz, Projection::zx, Projection::xy}) {
      const int turn = oracle_orient2d(plane, p[0].oracle, p[1].oracle, p[2].oracle);
      ASSERT_EQ(detail::orient2d_by_integers(plane, {&q[0], &q[1], &q[2]}), turn);
      ASSERT_EQ(detail::orient2d_by_integers(plane, {&q[2], &q[1], &q[0]}), -turn);
      ASSERT_EQ(orient2d(plane, q[0], q[1], q[2]), turn);
    }
    zeros += expected == 0 ? 1 : 0;
  }
  // Half of the samples hold a constructed point, a quarter of those a fourth point in the plane of the others.
  EXPECT_GT(zeros, 100);
}

}  // namespace
}  // namespace algebra3d
