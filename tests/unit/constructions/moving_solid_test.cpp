#include "algebra3d/values/constructions/moving_solid.h"

#include <gtest/gtest.h>

#include "algebra3d/kernel/exact/exact_sum.h"
#include "algebra3d/kernel/halfedge/mesh_triangles.h"
#include "algebra3d/kernel/planar/boundary_polygons.h"
#include "algebra3d/kernel/planar/polygon_measures.h"
#include "algebra3d/kernel/validity/validity.h"
#include "algebra3d/values/types/planar.h"
#include "support/plane_shapes.h"
#include "unit/operators/call_operator.h"

namespace algebra3d::moving_solid_tests {
namespace {

using plane_shapes::box;
using plane_shapes::Cycle;
using plane_shapes::Face;
using plane_shapes::on_grid;
using plane_shapes::reversed;
using plane_shapes::star;

MovingPolygons moving(const std::vector<Face>& start, const std::vector<Face>& end) {
  return {plane_shapes::polygons_of(start), plane_shapes::polygons_of(end)};
}

Rational volume_of(const TriangleMesh& mesh) {
  return *exact_volume(mesh.points(), triangles_of(mesh));
}

/// The region at that part of the way, without what has collapsed.
Region region_at(const MovingPolygons& polygons, const Rational& s) {
  return Region::trusted(*boundary_polygons(at(polygons, s)));
}

Region slice_at(const TriangleMesh& mesh, double z) {
  return calls::call("slice", Volume3d::trusted(mesh), z).get<Region>();
}

bool equal(const Region& a, const Region& b) {
  return compare(Value::of(a), Value::of(b)) == 0;
}

/// The solid between z = 0 and z = 1, which is valid.
TriangleMesh swept(const MovingPolygons& polygons) {
  const auto solid = swept_solid({&polygons, 0, 1});
  EXPECT_TRUE(solid.ok() && *solid) << (solid.ok() ? solid->reason() : solid.error().text());
  if (!solid.ok() || !*solid) return {};
  EXPECT_EQ(prove_volume(**solid)->text(), "");
  return **solid;
}

void expect_slices_are_instants(const MovingPolygons& polygons, const Rational& volume) {
  const TriangleMesh solid = swept(polygons);
  EXPECT_EQ(volume_of(solid), volume);
  for (const double z : {0.0, 0.125, 0.5, 0.8125, 1.0})
    EXPECT_TRUE(equal(slice_at(solid, z), region_at(polygons, Rational(z)))) << "at " << z;
}

TEST(SweptSolid, of_a_square_that_moves_is_an_oblique_prism) {
  expect_slices_are_instants(moving({{box(0, 0, 2, 2)}}, {{plane_shapes::shifted(box(0, 0, 2, 2), 3, -1)}}),
                             Rational(4));
}

TEST(SweptSolid, of_a_square_that_grows_from_a_point_is_a_pyramid) {
  expect_slices_are_instants(moving({{box(1, 1, 1, 1)}}, {{box(0, 0, 2, 2)}}), Rational(4) / Rational(3));
  expect_slices_are_instants(moving({{box(0, 0, 2, 2)}}, {{box(1, 1, 1, 1)}}), Rational(4) / Rational(3));
}

// At s the hole is 2s wide: 16 - 4 s^2.
TEST(SweptSolid, holes_open_from_a_point_and_close) {
  const Rational volume = Rational(16) - Rational(4) / Rational(3);
  expect_slices_are_instants(
      moving({{box(0, 0, 4, 4), reversed(box(2, 2, 2, 2))}}, {{box(0, 0, 4, 4), reversed(box(1, 1, 3, 3))}}), volume);
  expect_slices_are_instants(
      moving({{box(0, 0, 4, 4), reversed(box(1, 1, 3, 3))}}, {{box(0, 0, 4, 4), reversed(box(2, 2, 2, 2))}}), volume);
}

// A slit in the middle of the bottom, which is in no corner of what covers it.
TEST(SweptSolid, holes_open_from_a_segment) {
  const Cycle slit{{1, 2}, {1, 2}, {3, 2}, {3, 2}}, hole{{1, 1}, {1, 3}, {3, 3}, {3, 1}};
  expect_slices_are_instants(moving({{box(0, 0, 4, 4), slit}}, {{box(0, 0, 4, 4), hole}}), Rational(16) - Rational(2));
}

TEST(SweptSolid, faces_meet_in_a_segment_at_the_end) {
  const Cycle left = box(0, 0, 2, 2), right = plane_shapes::shifted(box(0, 0, 2, 2), 3, 0);
  expect_slices_are_instants(moving({{left}, {right}}, {{left}, {plane_shapes::shifted(right, -1, 0)}}), Rational(8));
}

TEST(SweptSolid, holes_reach_the_outer_cycle_at_the_end) {
  const Cycle hole = reversed(box(1, 1, 2, 2));
  expect_slices_are_instants(moving({{box(0, 0, 4, 4), hole}}, {{box(0, 0, 4, 4), plane_shapes::shifted(hole, -1, 0)}}),
                             Rational(15));
}

TEST(SweptSolid, faces_that_touch_in_a_moving_corner_are_one_solid) {
  expect_slices_are_instants(
      moving({{box(0, 0, 1, 1)}, {box(1, 1, 2, 2)}},
             {{plane_shapes::shifted(box(0, 0, 1, 1), 2, 1)}, {plane_shapes::shifted(box(1, 1, 2, 2), 2, 1)}}),
      Rational(2));
}

TEST(SweptSolid, sides_that_pass_through_one_another_are_refused) {
  // Two squares that change places.
  const Cycle left = box(0, 0, 1, 1), right = plane_shapes::shifted(box(0, 0, 1, 1), 3, 0);
  const MovingPolygons polygons = moving({{left}, {right}}, {{right}, {left}});
  const auto solid = swept_solid({&polygons, 0, 1});
  ASSERT_TRUE(solid.ok());
  ASSERT_FALSE(*solid);
  EXPECT_EQ(solid->reason(), "the sides of the solid pass through one another");
}

TEST(SweptSolid, of_stars_that_grow_has_their_instants_as_slices) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const Cycle outer = on_grid(star(5 + trial, 0.5, 4, random)), inner = on_grid(star(3 + trial, 0.25, 1, random));
    const auto image = [&](const Cycle& cycle) {
      return plane_shapes::shifted(plane_shapes::scaled(cycle, 0.5), 3, trial);
    };
    const MovingPolygons polygons = moving({{outer, reversed(inner)}}, {{image(outer), reversed(image(inner))}});
    // The area is that of the start times (1 - s/2)^2.
    expect_slices_are_instants(polygons, doubled_area(polygons.start) * Rational(7) / Rational(24));
  }
}

/// How far sides of a unit may be from the moving segments at s, times the length along which they may be.
double bound_of_difference(const MovingPolygons& polygons, double s) {
  double bound = 0;
  const auto& start = polygons.start.corners.approx();
  const auto& end = polygons.end.corners.approx();
  for (const auto& [a, b] : segments_of(polygons.start)) {
    const Vec3 before = start[b] - start[a], after = end[b] - end[a];
    bound += s * (1 - s) * length(after - before) * (length(before) + length(after));
  }
  return bound;
}

TEST(SweptSolid, of_stars_that_change_is_near_their_instants) {
  std::mt19937_64 random(6);
  for (int trial = 0; trial < 20; ++trial) {
    const int corners = 8 + trial;
    const MovingPolygons polygons =
        moving({{on_grid(star(corners, 0.666667, 3, random)), reversed(on_grid(star(corners, 0.5, 1, random)))}},
               {{on_grid(star(corners, 0.666667, 3, random)), reversed(on_grid(star(corners, 0.5, 1, random)))}});
    const TriangleMesh solid = swept(polygons);
    for (const double z : {0.0, 0.25, 0.5, 1.0}) {
      const Region cut = slice_at(solid, z), instant = region_at(polygons, Rational(z));
      const double difference =
          calls::call("area", calls::call("symmetricDifference", cut, instant).get<Region>()).get<double>();
      EXPECT_LE(difference, bound_of_difference(polygons, z));
      if (z == 0 || z == 1) {
        EXPECT_TRUE(equal(cut, instant));
      }
    }
  }
}

}  // namespace
}  // namespace algebra3d::moving_solid_tests
