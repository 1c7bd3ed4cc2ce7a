// The predicates against CGAL's over GMP rationals. The one test program of this layer's predicates that includes CGAL,
// which compiles slowly.

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/intersections.h>
#include <gtest/gtest.h>

#include "algebra3d/exact/predicates.h"

namespace algebra3d {
namespace {

using Kernel = CGAL::Simple_cartesian<CGAL::Gmpq>;
using Oracle = Kernel::Point_3;

// A number in both worlds: `multiple` over `divisor`; the divisor is 1 for doubles.
struct Number {
  double multiple = 0;
  std::int64_t divisor = 1;

  CGAL::Gmpq oracle() const {
    CGAL::Gmpq value;
    mpq_set_d(value.mpq(), multiple);
    return value / CGAL::Gmpq(static_cast<int>(divisor));
  }
  Rational ours() const { return Rational(multiple) / Rational(divisor); }
};

struct TestPoint {
  ExactPoint ours;
  Oracle oracle;

  TestPoint(const Number& x, const Number& y, const Number& z)
      : ours(RationalVec3(x.ours(), y.ours(), z.ours())), oracle(x.oracle(), y.oracle(), z.oracle()) {}
  explicit TestPoint(const Vec3& v) : TestPoint(Number{v.x}, Number{v.y}, Number{v.z}) {}
};

using Random = std::mt19937_64;

int integer(Random& random, int from, int to) {
  return std::uniform_int_distribution<int>(from, to)(random);
}
double real(Random& random) {
  return std::uniform_real_distribution<double>(-1, 1)(random);
}

// Families of points; in each, four points are coplanar and three collinear often enough to matter.
enum class Family { uniform, grid, scaled_grid, near_plane, wide_plane, extreme, thirds, far_thirds, mixed_thirds };
constexpr std::array kFamilies{Family::uniform,    Family::grid,       Family::scaled_grid,
                               Family::near_plane, Family::wide_plane, Family::extreme,
                               Family::thirds,     Family::far_thirds, Family::mixed_thirds};

double moved_by_ulps(double value, int ulps) {
  for (; ulps > 0; --ulps) value = std::nextafter(value, 9);
  for (; ulps < 0; ++ulps) value = std::nextafter(value, -9);
  return value;
}

Vec3 grid_point(Random& random) {
  const auto coordinate = [&] { return static_cast<double>(integer(random, 0, 3)); };
  return {coordinate(), coordinate(), coordinate()};
}

std::vector<TestPoint> near_plane(Random& random, std::size_t count) {
  const Vec3 a{real(random), real(random), real(random)};
  const Vec3 u{real(random), real(random), real(random)};
  const Vec3 v{real(random), real(random), real(random)};
  const bool on_line = integer(random, 0, 3) == 0;
  std::vector<TestPoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 p = a + real(random) * u;
    if (!on_line) p = p + real(random) * v;
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = moved_by_ulps(p[axis], integer(random, -2, 2));
    points.emplace_back(p);
  }
  return points;
}

// On z = x - y, each at its own scale: exactly coplanar, but the bits of the coordinates lie far apart. Some are moved
// off by their last bit.
Vec3 wide_plane_point(Random& random, int exponent) {
  const Vec3 g = grid_point(random);
  const double scale = std::ldexp(1, exponent + integer(random, -90, 90));
  return {scale * g.x, scale * g.y, scale * moved_by_ulps(g.x - g.y, integer(random, 0, 3) == 0 ? 1 : 0)};
}

// Any exponent that a double can have, subnormal ones included; zero now and then.
double extreme(Random& random) {
  if (integer(random, 0, 7) == 0) return integer(random, 0, 1) != 0 ? 0.0 : -0.0;
  return std::ldexp(real(random), integer(random, 0, 1) != 0 ? integer(random, -1074, 1023) : integer(random, 0, 3));
}

std::vector<TestPoint> make_points(Family family, Random& random, std::size_t count) {
  if (family == Family::near_plane) return near_plane(random, count);
  constexpr std::array kScales{-1074, -1073, -1022, -520, -330, -201, -30, 0, 40, 299, 310, 520, 1021};
  const auto scale = [&] { return kScales[static_cast<std::size_t>(integer(random, 0, kScales.size() - 1))]; };
  const std::array exponents{scale(), scale(), scale()};
  constexpr std::array kMiddles{0, 0, -960, -330, -240, 240, 330, 900};
  const int middle = kMiddles[static_cast<std::size_t>(integer(random, 0, kMiddles.size() - 1))];
  const double far = std::ldexp(1, integer(random, 0, 50));
  std::vector<TestPoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 g = grid_point(random);
    const auto scaled = [&](std::size_t axis) { return std::ldexp(g[axis] - 1.5, exponents[axis]); };
    switch (family) {
      case Family::uniform:
        points.emplace_back(Vec3{real(random), real(random), real(random)});
        break;
      case Family::wide_plane:
        points.emplace_back(wide_plane_point(random, middle));
        break;
      case Family::grid:
        points.emplace_back(g);
        break;
      case Family::scaled_grid:
        points.emplace_back(Vec3{scaled(0), scaled(1), scaled(2)});
        break;
      case Family::extreme:
        points.emplace_back(Vec3{extreme(random), extreme(random), extreme(random)});
        break;
      case Family::thirds:
        points.emplace_back(Number{g.x, 3}, Number{g.y, 7}, Number{g.z, 3});
        break;
      case Family::far_thirds:
        points.emplace_back(Number{far + g.x, 3}, Number{g.y, 3}, Number{far - g.z, 5});
        break;
      default:
        points.emplace_back(Number{g.x, integer(random, 0, 1) != 0 ? 1 : 3}, Number{g.y}, Number{g.z, 2});
        break;
    }
  }
  return points;
}

// The oracle's numbers are long where exponents are extreme.
int sample_count(Family family) {
  return family == Family::extreme ? 300 : 4000;
}

int sign_of(CGAL::Sign sign) {
  return static_cast<int>(sign);
}

int oracle_orient2d(Projection plane, const Oracle& a, const Oracle& b, const Oracle& c) {
  const int i = static_cast<int>(first_axis(plane));
  const int j = static_cast<int>(second_axis(plane));
  using Point2 = Kernel::Point_2;
  return sign_of(CGAL::orientation(Point2(a[i], a[j]), Point2(b[i], b[j]), Point2(c[i], c[j])));
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

TEST(orient3d, a_subnormal_coordinate_counts_beside_a_huge_one) {
  for (const double huge : {0x1p900, 0x1p959, 0x1p1000}) {
    const TestPoint a(Vec3{0x1p-1074, 1, 0}), b(Vec3{0, 0, 0}), c(Vec3{0, -1, 0}), d(Vec3{huge, 0, 1});
    EXPECT_EQ(sign_of(CGAL::orientation(a.oracle, b.oracle, c.oracle, d.oracle)), 1);
    EXPECT_EQ(orient3d(a.ours, b.ours, c.ours, d.ours), 1);
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
  EXPECT_GT(std::min(seen[0], seen[1]), 10);
}

TEST_P(EachFamily, neighbours_overlap_beyond_their_common_edge_as_in_exact_arithmetic) {
  Random random(9);
  for (int i = 0; i < 2000; ++i) {
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
