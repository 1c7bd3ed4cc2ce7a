#include "algebra3d/rounding/rounded_solid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "algebra3d/exact/affine_map.h"
#include "algebra3d/exact/vertical_line.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/set_operations.h"
#include "unit/rounding/mesh_area.h"

namespace algebra3d::solids {
namespace {

void expect_on_grid(const TriangleMesh& mesh, double step) {
  EXPECT_EQ(mesh.points().exact_count(), 0U);
  for (const Vec3& p : mesh.points().approx())
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_EQ(p[axis], std::round(p[axis] / step) * step);
}

using Wide = std::array<long double, 3>;

Wide wide(const Vec3& v) {
  return {v.x, v.y, v.z};
}
Wide operator-(const Wide& a, const Wide& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Wide operator*(long double s, const Wide& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
Wide operator+(const Wide& a, const Wide& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
long double dot(const Wide& a, const Wide& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Wide cross(const Wide& a, const Wide& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

long double distance_to_segment(const Wide& p, const Wide& a, const Wide& b) {
  const long double share = std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0L, 1.0L);
  const Wide difference = (p - a) - share * (b - a);
  return std::sqrt(dot(difference, difference));
}

long double distance_to_triangle(const Wide& p, const std::array<Wide, 3>& t) {
  const auto& [a, b, c] = t;
  const Wide normal = cross(b - a, c - a);
  const auto is_left = [&](const Wide& from, const Wide& to) { return dot(cross(to - from, p - from), normal) >= 0; };
  // The normal of a needle may be wrong, so the edges count in any case.
  const bool is_over = is_left(a, b) && is_left(b, c) && is_left(c, a);
  return std::min({is_over ? std::abs(dot(normal, p - a)) / std::sqrt(dot(normal, normal)) : Box3::kInfinity,
                   distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

std::array<Wide, 3> wide_corners(const TriangleMesh& mesh, std::size_t face) {
  const TriangleRef corners = mesh.corners(FaceId(face));
  return {wide(corners[0].approx), wide(corners[1].approx), wide(corners[2].approx)};
}

/// The distance of a point to the nearest plane of a triangle over which it is, `at_most` if none is nearer; exact but
/// for the last step.
double distance_to_inner_parts(const Vec3& point, const TriangleMesh& mesh, double at_most) {
  const RationalVec3 p(point);
  Rational nearest = Rational(at_most) * Rational(at_most);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const TriangleRef corners = mesh.corners(FaceId(f));
    Box3 box;
    for (const PointRef& corner : corners) box.extend(corner.approx);
    const auto is_far = [&](std::size_t axis) {
      return point[axis] < box.min[axis] - 2 * at_most || point[axis] > box.max[axis] + 2 * at_most;
    };
    if (is_far(0) || is_far(1) || is_far(2)) continue;
    const RationalVec3 a = corners[0].rational(), b = corners[1].rational(), c = corners[2].rational();
    const RationalVec3 normal = cross(b - a, c - a);
    const auto is_left = [&](const RationalVec3& from, const RationalVec3& to) {
      return dot(cross(to - from, p - from), normal).sign() >= 0;
    };
    if (!is_left(a, b) || !is_left(b, c) || !is_left(c, a)) continue;
    const Rational along = dot(normal, p - a);
    nearest = std::min(nearest, along * along / dot(normal, normal));
  }
  return std::sqrt(nearest.nearest_double());
}

/// Brute force, at corners and inner points of the rounded triangles, with eleven bits more than doubles have: slivers
/// need them, and needles, whose normals even these do not tell, need rationals. What is left is the rounding of the
/// given corners that are no doubles.
void expect_near(const TriangleMesh& rounded, const TriangleMesh& given, double distance) {
  for (std::size_t f = 0; f < rounded.face_count(); ++f) {
    const std::array<Wide, 3> t = wide_corners(rounded, f);
    for (const Wide& weights : {Wide{1, 0, 0}, Wide{0.5L, 0.5L, 0}, Wide{0.3L, 0.3L, 0.4L}, Wide{0.1L, 0.8L, 0.1L}}) {
      const Wide point = weights[0] * t[0] + weights[1] * t[1] + weights[2] * t[2];
      long double nearest = Box3::kInfinity;
      for (std::size_t g = 0; g < given.face_count(); ++g)
        nearest = std::min(nearest, distance_to_triangle(point, wide_corners(given, g)));
      const long double size = 1 + std::abs(point[0]) + std::abs(point[1]) + std::abs(point[2]);
      const Vec3 p{static_cast<double>(point[0]), static_cast<double>(point[1]), static_cast<double>(point[2])};
      if (nearest > distance + 1e-15L * size) nearest = distance_to_inner_parts(p, given, static_cast<double>(nearest));
      ASSERT_LE(nearest, distance + 1e-15L * size);
    }
  }
}

TEST(RoundedSolid, of_doubles_is_itself) {
  const TriangleMesh solid = geodesic_sphere(3);
  const auto rounded = rounded_solid(solid, CoordinateGrid::doubles());
  ASSERT_TRUE(rounded.ok() && rounded->mesh);
  EXPECT_EQ(triangles_of(*rounded->mesh), triangles_of(solid));
  EXPECT_EQ(rounded->moved_vertices, 0U);
  EXPECT_EQ(rounded->largest_movement, 0);
}

TEST(RoundedSolid, of_many_intersections_stays_a_solid_of_nearly_the_same_volume) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SetOperations engine;
    RandomSolids random(seed, engine);
    const TriangleMesh a = random.operand(), b = random.operand(), c = random.operand();
    const TriangleMesh solid = engine.subtract(engine.unite(a, b), c);
    const auto rounded = rounded_solid(solid, CoordinateGrid::doubles());
    ASSERT_TRUE(rounded.ok() && rounded->mesh) << rounded->reason;
    EXPECT_EQ(prove_volume(*rounded->mesh)->text(), "");
    EXPECT_EQ(rounded->mesh->points().exact_count(), 0U);
    // The boundary sweeps over no more than its area times the movement, to first order.
    EXPECT_LE((exact_volume_of(*rounded->mesh) - exact_volume_of(solid)).abs().nearest_double(),
              2 * area_of(solid) * rounded->largest_movement);
  }
}

/// Boxes on a small grid, turned: what was common is a hair apart, or overlaps by one.
TriangleMesh boxes_that_nearly_touch(std::uint64_t seed) {
  Chance chance(seed);
  const RationalVec3 centre(chance.direction()), axis(chance.direction());
  const AffineMap turn = *AffineMap::rotation(centre, axis, 10.0 * chance.below(36) + 0.7);
  SetOperations engine;
  TriangleMesh solid;
  for (int i = chance.between(2, 5); i > 0; --i) {
    const Vec3 corner = chance.grid_point(4), size = chance.grid_point(3) + Vec3{1, 1, 1};
    const auto turned = [&](const Vec3& p) { return turn.apply_rounded(ExactPoint(p)); };
    solid = engine.unite(solid, mapped(box(corner, corner + size), turned));
  }
  return solid;
}

TEST(RoundedSolid, of_boxes_that_nearly_touch_is_found) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const TriangleMesh solid = boxes_that_nearly_touch(seed);
    for (const CoordinateGrid& grid : {CoordinateGrid::doubles(), CoordinateGrid::floats()}) {
      const auto rounded = rounded_solid(solid, grid);
      ASSERT_TRUE(rounded.ok() && rounded->mesh) << rounded->reason;
      EXPECT_EQ(prove_volume(*rounded->mesh)->text(), "");
      EXPECT_LE(rounded->largest_movement, 100 * grid.spacing_up_to(10));
      expect_near(*rounded->mesh, solid, rounded->largest_movement);
    }
  }
}

// On a grid that is coarse for the solid nearly everything collides.
TEST(RoundedSolid, to_a_coarse_grid_is_valid_and_near) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chance chance(seed);
    const TriangleMesh solid = mapped(geodesic_sphere(6), [&](const Vec3& p) { return (1 + 0.4 * chance.unit()) * p; });
    if (!prove_volume(solid)->is_valid()) continue;
    const double step = 0.05 + 0.05 * static_cast<double>(seed % 9);
    const auto rounded = rounded_solid(solid, CoordinateGrid::multiples(step));
    ASSERT_TRUE(rounded.ok() && rounded->mesh) << rounded->reason;
    EXPECT_EQ(prove_volume(*rounded->mesh)->text(), "");
    expect_on_grid(*rounded->mesh, step);
    EXPECT_LE(rounded->largest_movement, (rounded->reach == 0 ? 5 : 20) * step);
    expect_near(*rounded->mesh, solid, rounded->largest_movement);
    // Rounded again, nothing moves.
    const auto again = rounded_solid(*rounded->mesh, CoordinateGrid::multiples(step));
    EXPECT_EQ(again->moved_vertices, 0U);
  }
}

TEST(RoundedSolid, thinner_than_the_grid_vanishes) {
  const auto rounded = rounded_solid(box({0.1, 0.1, 0.1}, {0.4, 8, 9}), CoordinateGrid::multiples(1));
  ASSERT_TRUE(rounded->mesh);
  EXPECT_TRUE(rounded->mesh->is_empty());
  // Two plates with a gap that closes, and a third one that stays apart.
  const TriangleMesh plates = SetOperations().unite(box({0, 0, 0}, {1, 9, 9}), box({1.25, 0, 0}, {2, 9, 9}));
  const auto joined = rounded_solid(plates, CoordinateGrid::multiples(1));
  EXPECT_EQ(exact_volume_of(*joined->mesh), Rational(2 * 81));
  EXPECT_EQ(joined->mesh->face_count(), 12U);
}

/// A sphere without itself, turned by some radians: shells as thin as that, whose sides cross in needles.
TriangleMesh sphere_without_itself_turned(int corners, double radians) {
  const TriangleMesh sphere = geodesic_sphere(corners);
  const AffineMap turn =
      *AffineMap::rotation(RationalVec3(Vec3{0, 0, 0}), RationalVec3(Vec3{1, 2, 3}), radians * 180 / 3.14159265358979);
  SetOperations engine;
  return engine.subtract(sphere, mapped(sphere, [&](const Vec3& p) { return turn.apply_rounded(ExactPoint(p)); }));
}

TEST(RoundedSolid, of_nearly_coincident_spheres_is_found) {
  for (const double radians : {1e-6, 1e-9, 1e-12, 1e-14}) {
    SCOPED_TRACE(radians);
    const TriangleMesh solid = sphere_without_itself_turned(4, radians);
    const auto rounded = rounded_solid(solid, CoordinateGrid::doubles());
    ASSERT_TRUE(rounded.ok() && rounded->mesh) << rounded->reason;
    EXPECT_EQ(prove_volume(*rounded->mesh)->text(), "");
    EXPECT_EQ(rounded->mesh->points().exact_count(), 0U);
    EXPECT_LE(rounded->largest_movement, 64 * 0x1p-53);
    expect_near(*rounded->mesh, solid, rounded->largest_movement);
  }
}

TEST(RoundedSolid, out_of_range_has_a_reason) {
  const auto rounded = rounded_solid(cube(0, 1e300), CoordinateGrid::floats());
  ASSERT_TRUE(rounded.ok());
  EXPECT_FALSE(rounded->mesh);
  EXPECT_STREQ(rounded->reason, "a coordinate is out of range");
}

TEST(CoordinateGrid, keeps_its_own_numbers) {
  for (const double step : {0.1, 1.0 / 3, 1e-300, 7e20, 1e308}) {
    const CoordinateGrid grid = CoordinateGrid::multiples(step);
    for (const double x : {0.0, 1.0, -2.7, 12345.678, 1e-9, 3e19, 5e-324, -1e300}) {
      const double once = grid.nearest(x);
      EXPECT_EQ(grid.nearest(once), once) << x << " to " << step;
      EXPECT_LE(std::abs(once - x), 0.5 * step + std::abs(x) * 1e-15) << x << " to " << step;
    }
  }
  EXPECT_EQ(CoordinateGrid::floats().nearest(0.1), static_cast<double>(0.1F));
  EXPECT_EQ(CoordinateGrid::floats().nearest(-1e39), -std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace algebra3d::solids
