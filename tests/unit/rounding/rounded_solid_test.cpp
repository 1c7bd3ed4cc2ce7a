#include "algebra3d/kernel/rounding/rounded_solid.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/exact/affine_map.h"
#include "algebra3d/kernel/exact/vertical_line.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/rounding/detail/bodies_apart.h"
#include "algebra3d/kernel/validity/validity.h"
#include "support/rounds.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/set_operations.h"
#include "unit/rounding/distances.h"
#include "unit/rounding/mesh_area.h"

namespace algebra3d::solids {
namespace {

void expect_on_grid(const TriangleMesh& mesh, double step) {
  EXPECT_EQ(mesh.points().exact_count(), 0U);
  for (const Vec3& p : mesh.points().approx())
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_EQ(p[axis], std::round(p[axis] / step) * step);
}

// Where a solid lies must not decide how much of it rounding changes.
TEST(RoundedSolid, on_a_coarse_grid_does_not_depend_on_the_place) {
  SetOperations engine;
  const auto at = [](double scale, const Vec3& middle) {
    return mapped(geodesic_sphere(5), [&](const Vec3& p) {
      const auto short_number = [&](double x) { return std::round(0x1p20 * scale * x) * 0x1p-20; };
      return Vec3{short_number(p.x), short_number(p.y), short_number(p.z)} + middle;
    });
  };
  const auto rounded_at = [&](double x, const CoordinateGrid& grid) {
    const TriangleMesh solid = engine.intersect(at(3, {x, 0, 0}), at(2, {x + 0.5, 0, 0.5}));
    const RoundedSolid rounded = *rounded_solid(solid, grid);
    return mapped(*rounded.mesh, [&](const Vec3& p) { return p - Vec3{x, 0, 0}; });
  };
  const auto near = triangles_of(rounded_at(0, CoordinateGrid::multiples(0.25)));
  for (const double x : {48.0, 64.0, 4096.0})
    EXPECT_EQ(triangles_of(rounded_at(x, CoordinateGrid::multiples(0.25))), near) << x;
  // There floats are 0.25 apart along x only, so the result is finer.
  const TriangleMesh far = rounded_at(0x1p21, CoordinateGrid::floats());
  EXPECT_EQ(prove_volume(far)->text(), "");
  EXPECT_GT(exact_volume_of(far).nearest_double(),
            0.95 * exact_volume_of(rounded_at(0, CoordinateGrid::doubles())).nearest_double());
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

// Crossing spheres: the corners of the seam move, and nothing comes together.
TEST(RoundedSolid, keeps_its_faces_where_vertices_only_move) {
  const TriangleMesh ball = geodesic_sphere(8);
  const TriangleMesh other = mapped(ball, [](const Vec3& p) { return p + Vec3{0.7, 0.2, 0.1}; });
  SetOperations engine;
  const TriangleMesh solid = engine.unite(ball, other);
  ASSERT_GT(solid.points().exact_count(), 20U);
  const auto rounded = rounded_solid(solid, CoordinateGrid::doubles());
  ASSERT_TRUE(rounded.ok() && rounded->mesh) << rounded->reason;
  EXPECT_EQ(prove_volume(*rounded->mesh)->text(), "");
  EXPECT_EQ(triangles_of(*rounded->mesh), triangles_of(solid));
  EXPECT_EQ(rounded->mesh->points().approx(), solid.points().approx());
  EXPECT_EQ(rounded->mesh->points().exact_count(), 0U);
  EXPECT_EQ(rounded->moved_vertices, solid.points().exact_count());
  EXPECT_EQ(rounded->method, RoundingMethod::vertices_moved);
  EXPECT_EQ(rounded->contact_vertices, 0U);
  EXPECT_GT(rounded->largest_movement, 0);
  EXPECT_LT(rounded->largest_movement, 0x1p-52);
}

// A prism with two edges less than half a spacing apart: its corners come together, so faces go.
TEST(RoundedSolid, joins_vertices_that_come_to_one_place) {
  const TriangleMesh prism = mapped(box({0, 0, 0}, {4, 4, 1}), [](const Vec3& p) {
    return p.x == 4 && p.y == 4 ? Vec3{4, 0.25, p.z} : p;
  });
  const auto rounded = rounded_solid(prism, CoordinateGrid::multiples(1));
  ASSERT_TRUE(rounded.ok() && rounded->mesh) << rounded->reason;
  EXPECT_EQ(prove_volume(*rounded->mesh)->text(), "");
  EXPECT_EQ(rounded->mesh->vertex_count(), 6U);
  EXPECT_EQ(exact_volume_of(*rounded->mesh), Rational(8));
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
  for (std::uint64_t seed = 1; seed <= rounds(10U); ++seed) {
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
  for (std::uint64_t seed = 1; seed <= rounds(10U); ++seed) {
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

// Small bodies far apart: a lattice over both would have 10^12 cells along an axis.
TEST(RoundedSolid, bodies_far_apart_vanish_each_for_itself) {
  const auto pair = [](double size, double far) {
    return SetOperations().unite(box({0, 0, 0}, {0.125, 0.125, 0.125}),
                                 box({far, far, 0}, {far + size, far + size, size}));
  };
  const CoordinateGrid grid = CoordinateGrid::multiples(0.375);
  for (const double far : {10.0, 1e6, 0x1p40}) {
    SCOPED_TRACE(far);
    const Result<RoundedSolid> none = rounded_solid(pair(0.125, far), grid);
    ASSERT_TRUE(none);
    EXPECT_TRUE(none->mesh->is_empty());
    const Result<RoundedSolid> one = rounded_solid(pair(3, far), grid);
    ASSERT_TRUE(one);
    EXPECT_EQ(one->mesh->face_count(), 12U);
  }
}

TEST(BodiesApart, are_divided_by_planes_and_sorted_by_size) {
  SetOperations engine;
  const TriangleMesh with_cavity = engine.subtract(box({0, 0, 5}, {4, 4, 9}), box({1, 1, 6}, {2, 2, 7}));
  TriangleMesh all = box({0, 0, 0}, {1, 1, 1});
  for (const TriangleMesh& other : {box({2, 0, 0}, {3.5, 1, 1}), box({0, 2, 0}, {9, 3, 1}), with_cavity})
    all = engine.unite(all, other);
  std::vector<Rational> volumes;
  for (const std::vector<FaceId>& body : bodies_apart(all)) volumes.push_back(exact_volume_of(submesh(all, body)));
  EXPECT_EQ(volumes, (std::vector<Rational>{Rational(9), Rational(63), Rational(1.5), Rational(1)}));
  EXPECT_TRUE(bodies_apart(TriangleMesh()).empty());
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

// The cube does not move; the crumb moved by more than a tenth before it vanished.
TEST(RoundedSolid, the_distance_is_that_of_what_remains) {
  const CoordinateGrid grid = CoordinateGrid::multiples(1);
  const TriangleMesh crumb = box({20, 0, 0}, {20.125, 0.125, 0.125});
  const auto beside = [&](const TriangleMesh& body) { return rounded_solid(SetOperations().unite(body, crumb), grid); };
  const auto unmoved = beside(box({0, 0, 0}, {9, 9, 9}));
  EXPECT_EQ(unmoved->mesh->face_count(), 12U);
  EXPECT_EQ(unmoved->moved_vertices, 7U);
  EXPECT_EQ(unmoved->largest_movement, 0);
  const auto moved = beside(box({0.0625, 0, 0}, {9, 9, 9}));
  EXPECT_EQ(moved->mesh->face_count(), 12U);
  EXPECT_NEAR(moved->largest_movement, 0.0625, 1e-9);
  // A crumb that is flat, on a side of the cube, once its corners have moved.
  const auto flat = rounded_solid(
      SetOperations().unite(box({0, 0, 0}, {9, 9, 9}), box({9.125, 2.25, 2.25}, {9.25, 2.75, 2.75})), grid);
  EXPECT_EQ(exact_volume_of(*flat->mesh), Rational(729));
  EXPECT_NEAR(flat->largest_movement, 0, 1e-6);
}

// Features as thick as the grid are not noise, however large the solid is.
TEST(RoundedSolid, keeps_what_is_as_thick_as_the_grid) {
  SetOperations engine;
  for (const double thickness : {0.6, 0.9, 1.1, 1.3, 1.4}) {
    SCOPED_TRACE(thickness);
    const TriangleMesh plate = box({0, 0, 0}, {400, 300, thickness});
    const TriangleMesh with_hole = engine.subtract(plate, box({100, 100, -10}, {200, 200, 10}));
    const TriangleMesh tray =
        engine.subtract(box({0, 0, 0}, {400, 300, 100}), box({thickness, thickness, thickness}, {399, 299, 200}));
    const TriangleMesh with_pocket =
        engine.subtract(box({0, 0, 0}, {400, 300, 100}), box({100, 100, 50}, {300, 200, 50 + thickness}));
    const std::vector<std::pair<const TriangleMesh*, Rational>> solids = {
        {&plate, Rational(400 * 300)},
        {&with_hole, Rational(400 * 300 - 100 * 100)},
        {&tray, Rational(400 * 300 * 100 - 398 * 298 * 99)},
        {&with_pocket, Rational(400 * 300 * 100 - 200 * 100)}};
    for (const auto& [solid, volume] : solids) {
      const auto rounded = rounded_solid(*solid, CoordinateGrid::multiples(1));
      ASSERT_TRUE(rounded.ok() && rounded->mesh);
      const bool is_pocket = solid == &with_pocket;
      // A pocket narrower than the grid is closed.
      const bool is_closed = is_pocket && thickness < 1;
      EXPECT_EQ(exact_volume_of(*rounded->mesh), is_closed ? Rational(400 * 300 * 100) : volume);
      EXPECT_LE(rounded->largest_movement, 1.5);
    }
  }
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
    const TriangleMesh solid = sphere_without_itself_turned(is_thorough() ? 4 : 2, radians);
    const auto rounded = rounded_solid(solid, CoordinateGrid::doubles());
    ASSERT_TRUE(rounded.ok() && rounded->mesh) << rounded->reason;
    EXPECT_EQ(prove_volume(*rounded->mesh)->text(), "");
    EXPECT_EQ(rounded->mesh->points().exact_count(), 0U);
    EXPECT_LE(rounded->largest_movement, 64 * 0x1p-53);
    expect_near(*rounded->mesh, solid, rounded->largest_movement);
  }
}

// Two shells thinner than a spacing, a billionth of a degree apart: facets nearly coincide in fours.
TEST(RoundedSolid, of_nearly_coincident_thin_shells_is_found) {
  SetOperations engine;
  const AffineMap turn = *AffineMap::rotation(RationalVec3(Vec3{0.1, 0.2, 0.3}), RationalVec3(Vec3{1, 1, 2}), 1e-9);
  const TriangleMesh thin = *rounded_solid(sphere_without_itself_turned(3, 1e-16), CoordinateGrid::doubles())->mesh;
  const TriangleMesh turned = mapped(thin, [&](const Vec3& p) { return turn.apply_rounded(ExactPoint(p)); });
  const TriangleMesh solid = engine.difference_of_both(thin, turned);
  const auto rounded = rounded_solid(solid, CoordinateGrid::doubles());
  ASSERT_TRUE(rounded.ok() && rounded->mesh) << rounded->reason;
  EXPECT_EQ(prove_volume(*rounded->mesh)->text(), "");
  EXPECT_LE(rounded->largest_movement, 64 * 0x1p-53);
}

// A third of the vertices of such a solid are crowded: joining within wide reaches moves by 712,707 spacings.
TEST(RoundedSolid, of_a_shell_without_itself_turned_is_near) {
  SetOperations engine;
  const auto without_itself_turned = [&](const TriangleMesh& solid, const Vec3& axis, double degrees) {
    const AffineMap turn = *AffineMap::rotation(RationalVec3(Vec3{0, 0, 0}), RationalVec3(axis), degrees);
    return engine.subtract(solid, mapped(solid, [&](const Vec3& p) { return turn.apply_rounded(ExactPoint(p)); }));
  };
  const TriangleMesh shell = without_itself_turned(sphere(3, is_thorough() ? 6 : 3, 1), {1, 2, 3}, 6.7e-6);
  const TriangleMesh thin = *rounded_solid(shell, CoordinateGrid::doubles())->mesh;
  const TriangleMesh solid = without_itself_turned(thin, {-2, 1, 3}, 2.3e-8);
  const auto rounded = rounded_solid(solid, CoordinateGrid::doubles());
  ASSERT_TRUE(rounded.ok() && rounded->mesh) << rounded->reason;
  EXPECT_EQ(prove_volume(*rounded->mesh)->text(), "");
  EXPECT_LE(rounded->largest_movement, 64 * 0x1p-52);
}

TEST(RoundedSolid, methods_are_told_as_progress) {
  std::vector<std::string> told;
  const Monitor::Report report = [&](const std::string& how_far) { told.push_back(how_far); };
  const TriangleMesh solid = sphere_without_itself_turned(4, 1e-14);
  ASSERT_TRUE(rounded_solid(solid, CoordinateGrid::doubles(), {nullptr, &report}).ok());
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.front(), "rounding: moving vertices");
  EXPECT_NE(std::ranges::find(told, "rounding: joining features, turn 1"), told.end());
}

TEST(RoundedSolid, ends_when_it_is_cancelled) {
  const std::atomic<bool> cancel = true;
  EXPECT_EQ(rounded_solid(sphere_without_itself_turned(4, 1e-9), CoordinateGrid::doubles(), &cancel).error().code,
            ErrorCode::interrupted);
}

TEST(RoundedSolid, out_of_range_has_a_reason) {
  const auto reason = [](double size, const CoordinateGrid& grid) {
    const auto rounded = rounded_solid(cube(0, size), grid);
    EXPECT_TRUE(rounded.ok() && !rounded->mesh);
    return rounded->reason;
  };
  EXPECT_EQ(reason(1e300, CoordinateGrid::floats()),
            "a coordinate is out of range: 1e+300 is the largest one, and the numbers end at 3.4028234663852886e+38");
  EXPECT_EQ(reason(1.7e308, CoordinateGrid::multiples(1e308)),
            "a coordinate is out of range: 1.7e+308 is the largest one, and the numbers end at 1e+308");
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
  // The last half of a spacing beyond the largest float rounds to that.
  const double largest = std::numeric_limits<float>::max(), end = largest + 0x1p103;
  EXPECT_EQ(CoordinateGrid::floats().nearest(3.4028235e38), largest);
  EXPECT_EQ(CoordinateGrid::floats().nearest(-std::nextafter(end, 0)), -largest);
  EXPECT_EQ(CoordinateGrid::floats().nearest(end), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace algebra3d::solids
