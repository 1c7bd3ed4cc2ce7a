// The predicates against CGAL's over GMP rationals.

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <CGAL/intersections.h>
#include <gtest/gtest.h>

#include "algebra3d/kernel/exact/predicates.h"
#include "support/rounds.h"
#include "unit/exact/point_families.h"

namespace algebra3d {
namespace {

using namespace point_families;

Rational power_of_two(int exponent) {
  Rational power(1);
  for (; exponent < 0; ++exponent) power = power / Rational(2);
  return power;
}

class EachFamily : public testing::TestWithParam<Family> {};
INSTANTIATE_TEST_SUITE_P(predicates, EachFamily, testing::ValuesIn(kFamilies));

TEST_P(EachFamily, orient3d_is_the_exact_sign) {
  Random random(1);
  for (int i = 0; i < sample_count(GetParam()); ++i) {
    const auto p = make_points(GetParam(), random, 4);
    const int expected = sign_of(CGAL::orientation(p[0].oracle, p[1].oracle, p[2].oracle, p[3].oracle));
    ASSERT_EQ(orient3d(p[0].ours, p[1].ours, p[2].ours, p[3].ours), expected) << "sample " << i;
    ASSERT_EQ(orient3d(p[1].ours, p[0].ours, p[2].ours, p[3].ours), -expected) << "sample " << i;
    ASSERT_EQ(orient3d(p[3].ours, p[2].ours, p[1].ours, p[0].ours), expected) << "sample " << i;
  }
}

TEST_P(EachFamily, orient2d_is_the_exact_sign_in_each_projection) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const auto p = make_points(GetParam(), random, 3);
    for (const auto plane : {Projection::yz, Projection::zx, Projection::xy}) {
      const int expected = oracle_orient2d(plane, p[0].oracle, p[1].oracle, p[2].oracle);
      ASSERT_EQ(orient2d(plane, p[0].ours, p[1].ours, p[2].ours), expected) << "sample " << i;
      ASSERT_EQ(orient2d(plane, p[2].ours, p[1].ours, p[0].ours), -expected) << "sample " << i;
    }
  }
}

TEST_P(EachFamily, comparison_and_collinearity_are_exact) {
  Random random(3);
  int collinear_count = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto p = make_points(GetParam(), random, 3);
    const auto order = compare(p[0].ours, p[1].ours);
    const auto expected = CGAL::compare_xyz(p[0].oracle, p[1].oracle);
    ASSERT_EQ(order < 0, expected == CGAL::SMALLER);
    ASSERT_EQ(order > 0, expected == CGAL::LARGER);
    ASSERT_EQ(equal(p[0].ours, p[1].ours), p[0].oracle == p[1].oracle);
    ASSERT_EQ(p[0].ours == p[1].ours, p[0].oracle == p[1].oracle);
    const bool on_line = CGAL::collinear(p[0].oracle, p[1].oracle, p[2].oracle);
    ASSERT_EQ(collinear(p[0].ours, p[1].ours, p[2].ours), on_line);
    collinear_count += on_line ? 1 : 0;
    if (!on_line) {
      const Projection plane = dominant_projection(p[0].ours, p[1].ours, p[2].ours);
      ASSERT_NE(oracle_orient2d(plane, p[0].oracle, p[1].oracle, p[2].oracle), 0);
    }
  }
  const bool is_small_grid = GetParam() == Family::grid || GetParam() == Family::thirds;
  EXPECT_GE(collinear_count, is_small_grid ? 20 : 0);
}

// Differences of coordinates from their roundings may be far below 2^-53 of these, and their products underflow.
TEST(orient3d, coordinates_that_exceed_a_double_by_hardly_anything_are_decided) {
  for (const int size : {0, -90, -100, -101, -300})
    for (const int exponent : {-60, -110, -160, -210, -270, -400, -700, -1100}) {
      const Rational off = power_of_two(exponent), side = power_of_two(size);
      const auto point = [&](const Rational& x, const Rational& y, const Rational& beyond) {
        return ExactPoint(RationalVec3(x, y, side + beyond));
      };
      const Rational third(1, 3), none(0);
      const ExactPoint a = point(none, none, none), b = point(side, none, none), c = point(none, side, none);
      EXPECT_EQ(orient3d(a, b, c, point(third, third, off)), 1) << size << ' ' << exponent;
      EXPECT_EQ(orient3d(a, b, c, point(third, third, -off)), -1) << size << ' ' << exponent;
      EXPECT_EQ(orient3d(point(none, none, off), point(side, none, off), point(none, side, off), c), -1);
      EXPECT_EQ(
          orient3d(point(third, none, off), point(side, none, off), point(none, side, off), point(side, side, off)), 0);
      EXPECT_EQ(orient2d(Projection::yz, a, c, point(none, third, off)), 1) << size << ' ' << exponent;
      EXPECT_EQ(orient2d(Projection::yz, a, c, point(none, third, -off)), -1) << size << ' ' << exponent;
    }
}

TEST(orient3d, a_subnormal_coordinate_counts_beside_a_huge_one) {
  for (const double huge : {0x1p900, 0x1p959, 0x1p1000}) {
    const TestPoint a(Vec3{0x1p-1074, 1, 0}), b(Vec3{0, 0, 0}), c(Vec3{0, -1, 0}), d(Vec3{huge, 0, 1});
    EXPECT_EQ(sign_of(CGAL::orientation(a.oracle, b.oracle, c.oracle, d.oracle)), 1);
    EXPECT_EQ(orient3d(a.ours, b.ours, c.ours, d.ours), 1);
  }
}

// Where a part of a determinant is beyond the largest double and the whole is not, or has the other sign.
TEST(orient3d, determinants_of_fractions_at_the_end_of_the_range_are_decided) {
  Random random(4);
  const auto number = [&](double scale) { return Number{scale * real(random), 3}; };
  const auto point = [&](double scale) { return TestPoint(number(scale), number(scale), number(scale)); };
  for (const int exponent : {338, 339, 340, 341, 342, 343, 509, 510, 511, 512, 1000, 1022})
    for (int i = 0; i < 500; ++i) {
      const double scale = std::ldexp(1.0, exponent);
      const TestPoint a = point(scale), b = point(scale), c = point(scale), d = point(scale);
      ASSERT_EQ(orient3d(a.ours, b.ours, c.ours, d.ours),
                sign_of(CGAL::orientation(a.oracle, b.oracle, c.oracle, d.oracle)))
          << exponent;
      for (const auto plane : {Projection::yz, Projection::zx, Projection::xy})
        ASSERT_EQ(orient2d(plane, a.ours, b.ours, c.ours), oracle_orient2d(plane, a.oracle, b.oracle, c.oracle))
            << exponent;
    }
}

// ---- common parts

struct ContactOf {
  using result_type = Contact;
  Contact operator()(const Kernel::Point_3&) const { return Contact::point; }
  Contact operator()(const Kernel::Segment_3&) const { return Contact::segment; }
  Contact operator()(const Kernel::Triangle_3&) const { return Contact::area; }
  Contact operator()(const std::vector<Kernel::Point_3>&) const { return Contact::area; }
};

template <typename A, typename B>
Contact oracle_contact(const A& a, const B& b) {
  const auto common = CGAL::intersection(a, b);
  return common ? boost::apply_visitor(ContactOf(), *common) : Contact::none;
}

struct TestTriangle {
  TriangleRef ours;
  Kernel::Triangle_3 oracle;

  TestTriangle(const TestPoint& a, const TestPoint& b, const TestPoint& c)
      : ours{a.ours.ref(), b.ours.ref(), c.ours.ref()}, oracle(a.oracle, b.oracle, c.oracle) {}
  bool is_degenerate() const { return oracle.is_degenerate(); }
};

TriangleRef shuffled(TriangleRef triangle, Random& random) {
  std::shuffle(triangle.begin(), triangle.end(), random);
  return triangle;
}

TEST_P(EachFamily, triangles_meet_as_in_exact_arithmetic) {
  Random random(4);
  std::array<int, 4> seen{};
  for (int i = 0; i < sample_count(GetParam()); ++i) {
    const auto p = make_points(GetParam(), random, 6);
    const TestTriangle s(p[0], p[1], p[2]), t(p[3], p[4], p[5]);
    if (s.is_degenerate() || t.is_degenerate()) continue;
    const Contact expected = oracle_contact(s.oracle, t.oracle);
    ++seen[static_cast<std::size_t>(expected)];
    ASSERT_EQ(intersect_triangles(s.ours, t.ours), expected) << "sample " << i;
    ASSERT_EQ(intersect_triangles(shuffled(t.ours, random), shuffled(s.ours, random)), expected) << "sample " << i;
  }
  for (const int count : seen) EXPECT_GE(count, GetParam() == Family::grid ? 5 : 0);
}

TEST(coplanar, triangles_meet_as_in_exact_arithmetic) {
  Random random(5);
  std::array<int, 4> seen{};
  for (int i = 0; i < 4000; ++i) {
    std::vector<TestPoint> p;
    const int divisor = integer(random, 0, 3) == 0 ? 3 : 1;
    for (int k = 0; k < 6; ++k) {
      const int x = integer(random, 0, 3), y = integer(random, 0, 3);
      p.emplace_back(Number{double(x), divisor}, Number{double(y), divisor}, Number{double(2 * x - y), divisor});
    }
    const TestTriangle s(p[0], p[1], p[2]), t(p[3], p[4], p[5]);
    if (s.is_degenerate() || t.is_degenerate()) continue;
    const Contact expected = oracle_contact(s.oracle, t.oracle);
    ++seen[static_cast<std::size_t>(expected)];
    ASSERT_EQ(intersect_triangles(s.ours, t.ours), expected) << "sample " << i;
    ASSERT_EQ(intersect_triangles(shuffled(t.ours, random), shuffled(s.ours, random)), expected) << "sample " << i;
  }
  for (const int count : seen) EXPECT_GT(count, 50);
}

TEST_P(EachFamily, segments_meet_as_in_exact_arithmetic) {
  Random random(6);
  for (int i = 0; i < sample_count(GetParam()); ++i) {
    auto p = make_points(GetParam(), random, 4);
    if (p[0].oracle == p[1].oracle || p[2].oracle == p[3].oracle) continue;
    const Contact expected =
        oracle_contact(Kernel::Segment_3(p[0].oracle, p[1].oracle), Kernel::Segment_3(p[2].oracle, p[3].oracle));
    ASSERT_EQ(intersect_segments(p[0].ours, p[1].ours, p[2].ours, p[3].ours), expected) << "sample " << i;
    ASSERT_EQ(intersect_segments(p[3].ours, p[2].ours, p[0].ours, p[1].ours), expected) << "sample " << i;
  }
}

TEST_P(EachFamily, segment_and_triangle_meet_as_in_exact_arithmetic) {
  Random random(7);
  for (int i = 0; i < sample_count(GetParam()); ++i) {
    const auto p = make_points(GetParam(), random, 5);
    const TestTriangle t(p[2], p[3], p[4]);
    if (p[0].oracle == p[1].oracle || t.is_degenerate()) continue;
    const Contact expected = oracle_contact(Kernel::Segment_3(p[0].oracle, p[1].oracle), t.oracle);
    ASSERT_EQ(intersect_segment_triangle(p[0].ours, p[1].ours, t.ours), expected) << "sample " << i;
    ASSERT_EQ(intersect_segment_triangle(p[1].ours, p[0].ours, shuffled(t.ours, random)), expected) << "sample " << i;
  }
}

TEST_P(EachFamily, points_on_triangles_and_segments_are_those_of_exact_arithmetic) {
  Random random(17);
  for (int i = 0; i < rounds(500); ++i) {
    const auto p = make_points(GetParam(), random, 4);
    const TestTriangle t(p[1], p[2], p[3]);
    if (p[1].oracle != p[2].oracle) {
      ASSERT_EQ(is_on_segment(p[0].ours, p[1].ours, p[2].ours),
                Kernel::Segment_3(p[1].oracle, p[2].oracle).has_on(p[0].oracle));
    }
    if (t.is_degenerate()) continue;
    ASSERT_EQ(is_on_triangle(p[0].ours, shuffled(t.ours, random)), t.oracle.has_on(p[0].oracle)) << "sample " << i;
    for (const PointRef& corner : t.ours) ASSERT_TRUE(is_on_triangle(corner, t.ours));
  }
}

TEST_P(EachFamily, contacts_of_triangles_tell_the_sides_of_corners) {
  Random random(18);
  for (int i = 0; i < rounds(500); ++i) {
    const auto p = make_points(GetParam(), random, 6);
    const TestTriangle s(p[0], p[1], p[2]), t(p[3], p[4], p[5]);
    if (s.is_degenerate() || t.is_degenerate()) continue;
    const SidedContact contact = contact_of_triangles(s.ours, t.ours);
    ASSERT_EQ(contact.kind, oracle_contact(s.oracle, t.oracle));
    if (contact.kind == Contact::none) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_EQ(contact.s_sides[k], sign_of(CGAL::orientation(p[3].oracle, p[4].oracle, p[5].oracle, p[k].oracle)));
      ASSERT_EQ(contact.t_sides[k], sign_of(CGAL::orientation(p[0].oracle, p[1].oracle, p[2].oracle, p[k + 3].oracle)));
    }
  }
}

TEST_P(EachFamily, neighbours_meet_beyond_their_common_corner_as_in_exact_arithmetic) {
  Random random(8);
  std::array<int, 2> seen{};
  for (int i = 0; i < sample_count(GetParam()); ++i) {
    const auto p = make_points(GetParam(), random, 5);
    const TestTriangle s(p[0], p[1], p[2]), t(p[0], p[3], p[4]);
    if (s.is_degenerate() || t.is_degenerate()) continue;
    const bool expected = oracle_contact(s.oracle, t.oracle) != Contact::point;
    ++seen[expected ? 1 : 0];
    const auto meet = [&](int s1, int s2, int t1, int t2) {
      return meet_beyond_shared_vertex(p[0].ours, p[s1].ours, p[s2].ours, p[t1].ours, p[t2].ours);
    };
    ASSERT_EQ(meet(1, 2, 3, 4), expected) << "sample " << i;
    ASSERT_EQ(meet(2, 1, 3, 4), expected) << "sample " << i;
    ASSERT_EQ(meet(1, 2, 4, 3), expected) << "sample " << i;
    ASSERT_EQ(meet(4, 3, 2, 1), expected) << "sample " << i;
  }
  EXPECT_GT(std::min(seen[0], seen[1]), rounds(3));
}

TEST_P(EachFamily, neighbours_overlap_beyond_their_common_edge_as_in_exact_arithmetic) {
  Random random(9);
  for (int i = 0; i < rounds(500); ++i) {
    const auto p = make_points(GetParam(), random, 4);
    const TestTriangle s(p[0], p[1], p[2]), t(p[0], p[1], p[3]);
    if (s.is_degenerate() || t.is_degenerate()) continue;
    const bool expected = oracle_contact(s.oracle, t.oracle) == Contact::area;
    ASSERT_EQ(overlap_beyond_shared_edge(p[0].ours, p[1].ours, p[2].ours, p[3].ours), expected) << "sample " << i;
    ASSERT_EQ(overlap_beyond_shared_edge(p[1].ours, p[0].ours, p[3].ours, p[2].ours), expected) << "sample " << i;
  }
}

}  // namespace
}  // namespace algebra3d
