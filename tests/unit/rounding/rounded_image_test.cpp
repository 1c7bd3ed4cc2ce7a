#include "algebra3d/kernel/rounding/rounded_image.h"

#include <atomic>
#include <limits>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/mesh_image.h"
#include "algebra3d/kernel/rounding/rounded_solid.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/set_operations.h"
#include "unit/rounding/distances.h"
#include "unit/rounding/faults_by_cgal.h"

namespace algebra3d::solids {
namespace {

AffineMap turn(double degrees) {
  return *AffineMap::rotation(RationalVec3(Vec3{0.1, 0.2, 0.3}), RationalVec3(Vec3{1, 2, 3}), degrees);
}

/// A sphere united with the same one moved: its seam has fractions.
TriangleMesh two_spheres() {
  const TriangleMesh sphere = geodesic_sphere(3);
  return SetOperations().unite(sphere, mapped(sphere, [](const Vec3& p) { return p + Vec3{0.3, 0.1, 0.2}; }));
}

TEST(RoundedImage, is_the_exact_image_rounded) {
  const TriangleMesh solid = two_spheres();
  ASSERT_GT(solid.points().exact_count(), 0U);
  for (const double degrees : {10.0, 1e-7}) {
    SCOPED_TRACE(degrees);
    const auto direct = rounded_image(turn(degrees), solid);
    ASSERT_TRUE(direct.ok() && *direct);
    const RoundedSolid& found = **direct;
    const TriangleMesh exact = **exact_image(turn(degrees), solid);
    const auto by_steps = rounded_solid(exact, CoordinateGrid::doubles());
    EXPECT_TRUE(SetOperations().same(*found.mesh, *by_steps->mesh));
    EXPECT_EQ(found.moved_vertices, by_steps->moved_vertices);
    EXPECT_EQ(found.method, by_steps->method);
    EXPECT_GE(found.largest_movement, by_steps->largest_movement);
    EXPECT_LE(found.largest_movement, 6 * 0x1p-52);
    const Faults faults = faults_of(*found.mesh);
    EXPECT_EQ(faults.degenerate + faults.improper_pairs + faults.unbalanced_edges + faults.points_inside, 0);
    expect_near(*found.mesh, exact, found.largest_movement);
  }
}

TEST(RoundedImage, that_would_not_be_valid_is_nothing) {
  // Corners come to one place, where doubles are farther apart.
  const AffineMap about_one = *AffineMap::rotation(RationalVec3(Vec3{1, 1, 1}), RationalVec3(Vec3{1, 2, 3}), 45);
  EXPECT_FALSE(*rounded_image(about_one, box({0, 0, 0}, {1, 0x1p-62, 1})));
  const double huge = std::numeric_limits<double>::max();
  EXPECT_FALSE(*rounded_image(turn(45), box({0, 0, 0}, {huge, huge, huge})));
  EXPECT_FALSE(*rounded_image(turn(45), TriangleMesh()));
}

TEST(RoundedImage, can_be_interrupted) {
  const std::atomic<bool> cancel = true;
  EXPECT_EQ(rounded_image(turn(10), two_spheres(), &cancel).error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d::solids
