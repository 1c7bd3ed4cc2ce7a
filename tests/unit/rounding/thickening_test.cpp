#include "algebra3d/kernel/rounding/detail/thickening.h"

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/autorefinement/winding_selection.h"
#include "algebra3d/kernel/exact/affine_map.h"
#include "algebra3d/kernel/rounding/detail/solid_part.h"
#include "algebra3d/kernel/rounding/detail/solid_rounding.h"
#include "algebra3d/kernel/rounding/detail/thickened_faces.h"
#include "algebra3d/kernel/validity/validity.h"
#include "support/rounds.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/set_operations.h"
#include "unit/rounding/distances.h"
#include "unit/rounding/faults_by_cgal.h"

namespace algebra3d::solids {
namespace {

constexpr ThickeningSteps kNear = {4, 18, 2};

TriangleMesh cells_with_thick_faces(const TriangleMesh& closed, const Thickness& thickness) {
  return *solid_by_winding(thickened_faces(closed, thickness), [](int winding) { return winding > 0; });
}

/// A sphere without itself turned by so many degrees.
TriangleMesh thin_shells(double degrees) {
  const TriangleMesh sphere = geodesic_sphere(is_thorough() ? 2 : 1);
  const AffineMap turn = *AffineMap::rotation(RationalVec3(Vec3{0, 0, 0}), RationalVec3(Vec3{1, 2, 3}), degrees);
  return SetOperations().subtract(sphere,
                                  mapped(sphere, [&](const Vec3& p) { return turn.apply_rounded(ExactPoint(p)); }));
}

TEST(ThickenedFaces, of_a_box_are_plates_along_it) {
  // Half of each plate lies within the box.
  const TriangleMesh thick = cells_with_thick_faces(box({0, 0, 0}, {8, 8, 8}), {1, 0.75});
  EXPECT_EQ(exact_volume_of(thick), Rational(8 * 8 * 8 + 6 * 8 * 8 * 3 / 4));
  EXPECT_EQ(prove_volume(thick)->text(), "");
}

TEST(ThickenedFaces, are_prisms_where_two_faces_coincide) {
  // Nothing is left of the two triangles. The area of their shadow along the third axis, their nearest one, is 24.
  const TriangleMesh folded(PointArray({{0, 0, 0}, {8, 0, 1}, {0, 6, 5}}),
                            std::vector<IndexTriangle>{{0, 1, 2}, {0, 2, 1}});
  const TriangleMesh thick = cells_with_thick_faces(folded, {1, 2});
  EXPECT_EQ(exact_volume_of(thick), Rational(24 * 4));
  EXPECT_EQ(thick.face_count(), 8);
}

TEST(ThickenedFaces, of_neighbours_have_no_wall_between_them) {
  const TriangleMesh folded(PointArray({{0, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}}),
                            std::vector<IndexTriangle>{{0, 1, 2}, {0, 2, 3}, {0, 2, 1}, {0, 3, 2}});
  EXPECT_EQ(thickened_faces(folded, {1, 1}).face_count(), 12);  // a box, and nothing in it
}

TEST(ThickenedFaces, leave_out_triangles_without_area) {
  const TriangleMesh needle(PointArray({{0, 0, 0}, {8, 8, 8}, {4, 4, 4}}),
                            std::vector<IndexTriangle>{{0, 1, 2}, {0, 2, 1}});
  EXPECT_TRUE(thickened_faces(needle, {1, 1}).is_empty());
}

TEST(ThickenedFaces, cover_random_solids) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SetOperations engine;
    RandomSolids random(seed, engine);
    const double unit = 0x1p-6;
    const TriangleMesh solid = random.operand();
    const auto on_lattice = [&](const Vec3& p) {
      return Vec3{unit * std::round(p.x / unit), unit * std::round(p.y / unit), unit * std::round(p.z / unit)};
    };
    const TriangleMesh moved = mapped(solid, on_lattice);
    if (moved.is_empty() || !prove_volume(moved)->is_valid()) continue;
    const TriangleMesh thick = cells_with_thick_faces(moved, {unit, 0.75 * unit});
    EXPECT_EQ(prove_volume(thick)->text(), "");
    EXPECT_TRUE(engine.subtract(moved, thick).is_empty());
    EXPECT_LT(exact_volume_of(moved), exact_volume_of(thick));
  }
}

TEST(Thickening, rounds_thin_shells) {
  for (const double degrees : is_thorough() ? std::vector{1e-8, 1e-12} : std::vector{1e-12}) {
    SCOPED_TRACE(degrees);
    const TriangleMesh solid = thin_shells(degrees);
    const SolidPart whole(solid);
    SolidRounding job(solid, whole, CoordinateGrid::doubles(), nullptr);
    const auto is_found = thicken_faces(job, std::vector<bool>(solid.vertex_count(), true), kNear);
    ASSERT_TRUE(is_found.ok() && *is_found);
    const RoundedSolid rounded = job.result();
    EXPECT_EQ(rounded.method, RoundingMethod::faces_thickened);
    EXPECT_FALSE(rounded.mesh->is_empty());
    EXPECT_EQ(prove_volume(*rounded.mesh)->text(), "");
    const Faults faults = faults_of(*rounded.mesh);
    EXPECT_EQ(faults.degenerate + faults.improper_pairs + faults.unbalanced_edges, 0);
    EXPECT_LE(rounded.largest_movement, 0x1p20 * job.spacing());
    expect_near(*rounded.mesh, solid, rounded.largest_movement);
  }
}

TEST(Thickening, leaves_shells_alone_that_are_not_crowded) {
  const TriangleMesh shells = thin_shells(1e-12), cube = box({8, 8, 8}, {9, 9, 9});
  const TriangleMesh solid = SetOperations().unite(shells, cube);
  const SolidPart whole(solid);
  SolidRounding job(solid, whole, CoordinateGrid::doubles(), nullptr);
  std::vector<bool> crowded;
  for (const Vec3& p : solid.points().approx()) crowded.push_back(p.x < 4);
  const auto is_found = thicken_faces(job, crowded, kNear);
  ASSERT_TRUE(is_found.ok() && *is_found);
  const RoundedSolid rounded = job.result();
  EXPECT_TRUE(SetOperations().subtract(cube, *rounded.mesh).is_empty());
  std::size_t corners = 0;
  for (const Vec3& p : rounded.mesh->points().approx()) corners += p.x > 4 ? 1 : 0;
  EXPECT_EQ(corners, 8);
}

TEST(Thickening, leaves_solids_that_are_small_for_its_lattices) {
  const TriangleMesh solid = box({0, 0, 0}, {1000.25, 1000, 1000});
  const SolidPart whole(solid);
  SolidRounding job(solid, whole, CoordinateGrid::multiples(1), nullptr);
  EXPECT_FALSE(*thicken_faces(job, std::vector<bool>(solid.vertex_count(), true), kNear));
}

TEST(Thickening, needs_room_beside_the_solid) {
  const double size = std::numeric_limits<double>::max();
  const TriangleMesh solid = box({-size, -size, -size}, {size, size, size / 3});
  const SolidPart whole(solid);
  SolidRounding job(solid, whole, CoordinateGrid::doubles(), nullptr);
  EXPECT_FALSE(*thicken_faces(job, std::vector<bool>(solid.vertex_count(), true), kNear));
  EXPECT_FALSE(*thicken_faces(job, std::vector<bool>(solid.vertex_count(), false), kNear));
}

TEST(Thickening, can_be_interrupted) {
  const TriangleMesh solid = thin_shells(1e-8);
  const SolidPart whole(solid);
  const std::atomic<bool> cancel = true;
  SolidRounding job(solid, whole, CoordinateGrid::doubles(), &cancel);
  EXPECT_EQ(thicken_faces(job, std::vector<bool>(solid.vertex_count(), true), kNear).error().code,
            ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d::solids
