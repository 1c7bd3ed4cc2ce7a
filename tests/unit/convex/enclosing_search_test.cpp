// Minimal boxes and bounding cylinders: exact containment, the proved ratio against the volumes for many random
// orientations, solids whose minimum is known by hand, and shapes from needles to plates.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "algebra3d/kernel/convex/bounding_cylinder.h"
#include "algebra3d/kernel/convex/convex_hull.h"
#include "algebra3d/kernel/convex/detail/hull_outline.h"
#include "algebra3d/kernel/convex/minimal_box.h"
#include "algebra3d/kernel/exact/affine_map.h"
#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/exact/predicates.h"
#include "unit/convex/clouds.h"

namespace algebra3d {
namespace {

using clouds::array_of;

TriangleMesh hull_of(const std::vector<ExactPoint>& points) {
  auto hull = convex_hull(array_of(points)).value();
  return hull ? *hull : TriangleMesh();
}

std::vector<ExactPoint> cuboid(const Vec3& size) {
  std::vector<ExactPoint> points;
  for (unsigned i = 0; i < 8; ++i)
    points.emplace_back(Vec3{(i & 1U) * size.x, (i >> 1U & 1U) * size.y, (i >> 2U & 1U) * size.z});
  return points;
}

std::vector<ExactPoint> turned(const std::vector<ExactPoint>& points) {
  const AffineMap map = *AffineMap::rotation(RationalVec3(), RationalVec3(Vec3{1, 2, 3}), 40);
  std::vector<ExactPoint> result;
  for (const ExactPoint& p : points) result.emplace_back(map.apply_rounded(p));
  return result;
}

std::vector<ExactPoint> ball(int count) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  std::vector<ExactPoint> points;
  for (int i = 0; i < count; ++i) {
    const Vec3 v{normal(random), normal(random), normal(random)};
    points.emplace_back(1 / length(v) * v);
  }
  return points;
}

void expect_inside(const TriangleMesh& box, const TriangleMesh& hull) {
  for (std::size_t f = 0; f < box.face_count(); ++f) {
    const TriangleRef c = box.corners(FaceId(f));
    for (std::size_t v = 0; v < hull.vertex_count(); ++v)
      EXPECT_LE(orient3d(c[0], c[1], c[2], hull.point(VertexId(v))), 0);
  }
}

double volume_of(const OrientedBox& box) {
  return (box.sizes[0] * box.sizes[1] * box.sizes[2]).nearest_double();
}

// By hand: a box is its own smallest box.
TEST(minimal_box, of_a_cuboid_is_the_cuboid) {
  for (const Vec3& size : {Vec3{1, 2, 3}, Vec3{1, 1, 1}, Vec3{1000, 1, 1}, Vec3{1000, 1000, 1}, Vec3{1000, 100, 1}}) {
    SCOPED_TRACE(size.x + size.y);
    const auto box = minimal_box(hull_of(cuboid(size))).value();
    EXPECT_EQ(volume_of(*box), size.x * size.y * size.z);
    EXPECT_LE(box->ratio, 1.05);
    const TriangleMesh hull = hull_of(turned(cuboid(size)));
    const auto other = minimal_box(hull).value();
    EXPECT_NEAR(volume_of(*other) / (size.x * size.y * size.z), 1, 1e-9);
    EXPECT_LE(other->ratio, 1.05);
    expect_inside(other->mesh, hull);
  }
}

// [orourke1985]: the smallest box of a regular tetrahedron is the cube on whose diagonals its edges are.
TEST(minimal_box, of_needles_and_sheets_of_all_widths) {
  for (const Vec3 size : {Vec3{1, 1e-300, 2e-300}, Vec3{1, 1e-300, 1e-290}, Vec3{1, 1, 1e-320}, Vec3{1, 1e-8, 1e300}}) {
    const auto points = cuboid(size);
    const auto box = minimal_box(hull_of(points)).value();
    ASSERT_TRUE(box);
    EXPECT_GE(box->ratio, 1);
  }
}

TEST(minimal_box, of_a_regular_tetrahedron_is_a_cube) {
  const auto box = minimal_box(hull_of({Vec3{0, 0, 0}, Vec3{1, 1, 0}, Vec3{1, 0, 1}, Vec3{0, 1, 1}})).value();
  EXPECT_LE(volume_of(*box), 1.0001);
  EXPECT_LE(box->ratio, 1.05);
}

TEST(minimal_box, contains_random_sets_and_is_as_small_as_it_says) {
  std::mt19937 random(4);
  for (int seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const TriangleMesh hull = hull_of(clouds::Cloud(static_cast<std::uint64_t>(seed)).draw());
    if (hull.is_empty()) continue;
    const auto box = minimal_box(hull).value();
    if (!box) continue;
    expect_inside(box->mesh, hull);
    const detail::HullOutline outline(hull);
    const double unit = outline.unit();
    const Rational cube = Rational(unit) * Rational(unit) * Rational(unit);
    const double volume = (box->sizes[0] * box->sizes[1] * box->sizes[2] / cube).nearest_double();
    std::normal_distribution<double> normal;
    for (int i = 0; i < 300; ++i) {
      const Vec3 v{normal(random), normal(random), normal(random)};
      const auto view = outline.seen_along(1 / length(v) * v);
      EXPECT_LE(volume, box->ratio * view.height * smallest_rectangle(view.outline).area * (1 + 1e-12));
    }
    if (testing::Test::HasFailure()) return;
  }
}

TEST(minimal_box, of_a_ball_has_a_ratio_too) {
  const auto box = minimal_box(hull_of(ball(3000))).value();
  EXPECT_LE(box->ratio, 1.1);
  EXPECT_LE(volume_of(*box), 8);
}

void expect_contains(const Cylinder& cylinder, const TriangleMesh& hull) {
  const RationalVec3 base(cylinder.base), axis(cylinder.axis);
  const Rational square = dot(axis, axis);
  for (std::size_t v = 0; v < hull.vertex_count(); ++v) {
    const RationalVec3 p = hull.point(VertexId(v)).rational() - base;
    const Rational height = dot(p, axis);
    EXPECT_GE(height, Rational(0));
    EXPECT_LE(height, Rational(cylinder.height));
    const RationalVec3 off = cross(p, axis);
    EXPECT_LE(dot(off, off), Rational(cylinder.radius) * Rational(cylinder.radius) * square);
  }
}

TEST(bounding_cylinder, contains_random_sets) {
  for (int seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const TriangleMesh hull = hull_of(clouds::Cloud(static_cast<std::uint64_t>(seed)).draw());
    if (hull.is_empty()) continue;
    const auto cylinder = bounding_cylinder(hull).value();
    if (!cylinder) continue;
    expect_contains(*cylinder, hull);
    if (testing::Test::HasFailure()) return;
  }
}

// Radius and height are enlarged by some units of the smallest doubles, so that the ratio is large.
TEST(bounding_cylinder, of_the_smallest_cube) {
  const TriangleMesh hull = hull_of(cuboid({5e-324, 5e-324, 5e-324}));
  const auto cylinder = bounding_cylinder(hull).value();
  ASSERT_TRUE(cylinder.has_value());
  expect_contains(*cylinder, hull);
  EXPECT_GT(cylinder->ratio, 100);
}

// All nearest doubles are the same.
TEST(bounding_cylinder, of_the_smallest_cube_far_away) {
  std::vector<ExactPoint> points;
  for (const ExactPoint& p : cuboid({5e-324, 5e-324, 5e-324}))
    points.emplace_back(p.rational() + RationalVec3(Vec3{1, 2, 3}));
  const TriangleMesh hull = hull_of(points);
  const auto cylinder = bounding_cylinder(hull).value();
  ASSERT_TRUE(cylinder.has_value());
  expect_contains(*cylinder, hull);
  const auto box = minimal_box(hull).value();
  ASSERT_TRUE(box);
  for (const Rational& size : box->sizes) EXPECT_GE(size, Rational(5e-324) * Rational(1, 2));
}

// By hand: of a prism over a regular polygon with many corners that is long or flat, the cylinder around it.
TEST(bounding_cylinder, of_prisms) {
  for (const double height : {0.01, 20.0}) {
    SCOPED_TRACE(height);
    std::vector<ExactPoint> points;
    for (int i = 0; i < 48; ++i) {
      const double angle = std::numbers::pi * i / 24;
      for (const double z : {0.0, height}) points.emplace_back(Vec3{std::cos(angle), std::sin(angle), z});
    }
    for (const bool is_turned : {false, true}) {
      const TriangleMesh hull = hull_of(is_turned ? turned(points) : points);
      const auto cylinder = bounding_cylinder(hull).value();
      EXPECT_NEAR(cylinder->radius, 1, 1e-5);
      EXPECT_NEAR(cylinder->height / height, 1, 1e-3);
      EXPECT_LE(cylinder->ratio, 1.05);
      expect_contains(*cylinder, hull);
    }
  }
}

}  // namespace
}  // namespace algebra3d
