#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/exact/axis_line.h"
#include "algebra3d/kernel/exact/vertical_line.h"

namespace algebra3d {
namespace {

struct Point {
  int x, y, z;
  friend bool operator==(const Point&, const Point&) = default;
};
using Triangle = std::array<Point, 3>;
using Mesh = std::vector<Triangle>;

int volume(const Point& a, const Point& b, const Point& c, const Point& d) {
  const int ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
  const int vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  const int wx = d.x - a.x, wy = d.y - a.y, wz = d.z - a.z;
  return ux * (vy * wz - vz * wy) - uy * (vx * wz - vz * wx) + uz * (vx * wy - vy * wx);
}

// Faces of the tetrahedron, outward if its volume is positive (d above abc means that abc looks inward).
Mesh tetrahedron(const Point& a, const Point& b, const Point& c, const Point& d) {
  return {{a, c, b}, {a, b, d}, {b, c, d}, {c, a, d}};
}

enum class Place { inside, outside, on_boundary };

Place place_in_tetrahedron(const Point& a, const Point& b, const Point& c, const Point& d, const Point& p) {
  const int whole = volume(a, b, c, d) > 0 ? 1 : -1;
  const std::array parts{whole * volume(p, b, c, d), whole * volume(a, p, c, d), whole * volume(a, b, p, d),
                         whole * volume(a, b, c, p)};
  const int smallest = *std::min_element(parts.begin(), parts.end());
  return smallest > 0 ? Place::inside : smallest < 0 ? Place::outside : Place::on_boundary;
}

// All coordinates are divided by `divisor`, which makes rationals of them if it is 3.
ExactPoint exact(const Point& p, int divisor) {
  return ExactPoint(RationalVec3(Rational(p.x, divisor), Rational(p.y, divisor), Rational(p.z, divisor)));
}

struct Sums {
  int all = 0, above = 0, below = 0, on = 0;
};

Sums sum_crossings(const Mesh& mesh, const Point& p, int divisor) {
  Sums sums;
  const ExactPoint from = exact(p, divisor);
  for (const auto& [a, b, c] : mesh) {
    const ExactPoint pa = exact(a, divisor), pb = exact(b, divisor), pc = exact(c, divisor);
    const LineCrossing crossing = cross_vertical_line(from, {pa.ref(), pb.ref(), pc.ref()});
    sums.all += crossing.sign;
    (crossing.side < 0 ? sums.above : crossing.side > 0 ? sums.below : sums.on) += crossing.sign;
  }
  return sums;
}

Point random_point(std::mt19937_64& random, int size) {
  std::uniform_int_distribution<int> coordinate(0, size);
  return {coordinate(random), coordinate(random), coordinate(random)};
}

TEST(vertical_line, crossings_of_a_tetrahedron_sum_to_its_winding_number) {
  std::mt19937_64 random(1);
  std::array<int, 3> seen{};
  for (int i = 0; i < 20000; ++i) {
    const int divisor = i % 4 == 0 ? 3 : 1;
    const auto point = [&] { return random_point(random, 4); };
    const Point a = point(), b = point(), c = point(), d = point(), p = point();
    if (volume(a, b, c, d) == 0) continue;
    const Sums sums = sum_crossings(tetrahedron(a, b, c, d), p, divisor);
    ASSERT_EQ(sums.all, 0) << "the line leaves a closed mesh as often as it enters, sample " << i;
    const Place place = place_in_tetrahedron(a, b, c, d, p);
    ++seen[static_cast<std::size_t>(place)];
    if (place == Place::on_boundary) continue;
    const int winding = place == Place::outside ? 0 : volume(a, b, c, d) > 0 ? 1 : -1;
    ASSERT_EQ(sums.above, winding) << "sample " << i;
    ASSERT_EQ(sums.below, -winding) << "sample " << i;
    ASSERT_EQ(sums.on, 0) << "sample " << i;
  }
  for (const int count : seen) EXPECT_GT(count, 10);
}

// Outward faces of a box, each a pair of triangles with a diagonal by chance.
Mesh box(const Point& low, const Point& high, std::mt19937_64& random) {
  const auto corner = [&](int bits) {
    return Point{(bits & 1) != 0 ? high.x : low.x, (bits & 2) != 0 ? high.y : low.y, (bits & 4) != 0 ? high.z : low.z};
  };
  constexpr std::array<std::array<int, 4>, 6> kFaces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  Mesh mesh;
  for (const auto& face : kFaces) {
    const std::size_t turn = random() % 2;
    const auto at = [&](std::size_t k) { return corner(face[(k + turn) % 4]); };
    mesh.push_back({at(0), at(1), at(2)});
    mesh.push_back({at(0), at(2), at(3)});
  }
  return mesh;
}

TEST(vertical_line, crossings_of_overlapping_boxes_sum_to_the_number_of_boxes_around_the_point) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 3000; ++i) {
    Mesh mesh;
    const Point p = random_point(random, 5);
    int around = 0;
    bool on_boundary = false;
    for (int k = 0; k < 3; ++k) {
      const Point low = random_point(random, 4);
      const Point size = random_point(random, 2);
      const Point high{low.x + size.x + 1, low.y + size.y + 1, low.z + size.z + 1};
      const Mesh faces = box(low, high, random);
      mesh.insert(mesh.end(), faces.begin(), faces.end());
      const bool in_closed =
          low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y && low.z <= p.z && p.z <= high.z;
      const bool in_open = low.x < p.x && p.x < high.x && low.y < p.y && p.y < high.y && low.z < p.z && p.z < high.z;
      around += in_open ? 1 : 0;
      on_boundary = on_boundary || (in_closed && !in_open);
    }
    const Sums sums = sum_crossings(mesh, p, 1);
    ASSERT_EQ(sums.all, 0);
    if (on_boundary) continue;
    ASSERT_EQ(sums.above, around) << i;
    ASSERT_EQ(sums.below, -around) << i;
  }
}

TEST(vertical_line, sign_and_side_are_as_documented) {
  const TriangleRef upward{Vec3{0, 0, 1}, Vec3{4, 0, 1}, Vec3{0, 4, 1}};
  const TriangleRef downward{upward[0], upward[2], upward[1]};
  const LineCrossing below = cross_vertical_line(Vec3{1, 1, 0}, upward);
  EXPECT_EQ(below.sign, 1);
  EXPECT_EQ(below.side, -1);
  const LineCrossing above = cross_vertical_line(Vec3{1, 1, 2}, downward);
  EXPECT_EQ(above.sign, -1);
  EXPECT_EQ(above.side, 1);
  EXPECT_EQ(cross_vertical_line(Vec3{1, 1, 1}, downward).side, 0);
  EXPECT_EQ(cross_vertical_line(Vec3{1, 1, 1}, downward).sign, -1);
  EXPECT_EQ(cross_vertical_line(Vec3{3, 3, 0}, upward).sign, 0);
}

TEST(vertical_line, passes_a_little_towards_positive_x_and_less_towards_positive_y) {
  const TriangleRef triangle{Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{0, 4, 0}};
  EXPECT_EQ(cross_vertical_line(Vec3{1, 0, 5}, triangle).sign, 1) << "moved off the edge on the x axis, inwards";
  EXPECT_EQ(cross_vertical_line(Vec3{0, 1, 5}, triangle).sign, 1) << "moved off the edge on the y axis, inwards";
  EXPECT_EQ(cross_vertical_line(Vec3{2, 2, 5}, triangle).sign, 0) << "moved off the third edge, outwards";
  const TriangleRef steep{Vec3{0, 0, 0}, Vec3{4, 4, 0}, Vec3{0, 4, 0}};
  EXPECT_EQ(cross_vertical_line(Vec3{2, 2, 5}, steep).sign, 0) << "x counts before y";
  EXPECT_EQ(cross_vertical_line(Vec3{0, 0, 5}, triangle).sign, 1);
  EXPECT_EQ(cross_vertical_line(Vec3{4, 0, 5}, triangle).sign, 0);
}

TEST(vertical_line, triangles_without_projected_area_are_never_crossed) {
  const TriangleRef upright{Vec3{0, 0, 0}, Vec3{1, 1, 0}, Vec3{2, 2, 5}};
  const TriangleRef needle{Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{1, 0, 0}};
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y) {
      EXPECT_EQ(cross_vertical_line(Vec3{double(x), double(y), 0}, upright).sign, 0);
      EXPECT_EQ(cross_vertical_line(Vec3{double(x), double(y), 0}, needle).sign, 0);
    }
}

/// The point with its axes exchanged cyclically, so that `axis` becomes the last.
Point with_last(std::size_t axis, const Point& p) {
  return axis == 0 ? Point{p.y, p.z, p.x} : axis == 1 ? Point{p.z, p.x, p.y} : p;
}

TEST(axis_line, crosses_as_the_vertical_line_does_with_exchanged_axes) {
  std::mt19937_64 random(7);
  int crossed = 0;
  for (int i = 0; i < 20000; ++i) {
    const int divisor = i % 4 == 0 ? 3 : 1;
    const std::size_t axis = static_cast<std::size_t>(i) % 3;
    const auto point = [&] { return random_point(random, 4); };
    const Point a = point(), b = point(), c = point(), p = point();
    const ExactPoint ea = exact(a, divisor), eb = exact(b, divisor), ec = exact(c, divisor), ep = exact(p, divisor);
    const LineCrossing found = cross_axis_line(axis, ep, {ea.ref(), eb.ref(), ec.ref()});
    const ExactPoint ta = exact(with_last(axis, a), divisor), tb = exact(with_last(axis, b), divisor),
                     tc = exact(with_last(axis, c), divisor), tp = exact(with_last(axis, p), divisor);
    const LineCrossing expected = cross_vertical_line(tp, {ta.ref(), tb.ref(), tc.ref()});
    EXPECT_EQ(found.sign, expected.sign);
    EXPECT_EQ(found.side, expected.side);
    crossed += expected.sign != 0;
  }
  EXPECT_GT(crossed, 1000);
}

}  // namespace
}  // namespace algebra3d
