#include "algebra3d/kernel/rounding/detail/vertex_removal.h"

#include <array>
#include <atomic>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/soup/weld.h"
#include "algebra3d/kernel/validity/validity.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/set_operations.h"
#include "unit/rounding/distances.h"

namespace algebra3d::solids {
namespace {

std::vector<bool> all_of(const TriangleMesh& mesh) {
  return std::vector<bool>(mesh.vertex_count(), true);
}

TriangleMesh without_superfluous(const TriangleMesh& mesh, const std::vector<bool>& may_go, double tolerance) {
  TriangleStars stars(mesh);
  EXPECT_TRUE(remove_superfluous_vertices(stars, may_go, tolerance).ok());
  return stars.mesh();
}

TEST(VertexRemoval, leaves_a_convex_solid_as_it_is) {
  for (const TriangleMesh& solid : {box({0, 0, 0}, {1, 2, 3}), geodesic_sphere(3)})
    EXPECT_EQ(triangles_of(without_superfluous(solid, all_of(solid), 1e-9)), triangles_of(solid));
}

// Every edge is divided in its middle, so that each triangle becomes four.
TriangleMesh divided(const TriangleMesh& mesh) {
  std::vector<std::array<ExactPoint, 3>> triangles;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const TriangleRef t = mesh.corners(FaceId(f));
    const Vec3 a = t[0].approx, b = t[1].approx, c = t[2].approx;
    const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    for (const std::array<Vec3, 3>& part : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
      triangles.push_back({ExactPoint(part[0]), ExactPoint(part[1]), ExactPoint(part[2])});
  }
  WeldedTriangles welded = weld(triangles);
  return {std::move(welded.points), welded.triangles};
}

TEST(VertexRemoval, undoes_a_division_of_all_triangles) {
  const TriangleMesh cube = box({0, 0, 0}, {4, 4, 4});
  const TriangleMesh fine = divided(divided(cube));
  ASSERT_EQ(fine.face_count(), 12U * 16);
  const TriangleMesh coarse = without_superfluous(fine, all_of(fine), 1e-9);
  EXPECT_EQ(coarse.face_count(), 12U);
  EXPECT_EQ(exact_volume_of(coarse), Rational(64));
}

TEST(VertexRemoval, tolerates_what_rounding_moved_and_no_more) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    Chance chance(seed);
    const TriangleMesh rough = mapped(divided(divided(box({0, 0, 0}, {4, 4, 4}))), [&](const Vec3& p) {
      return p + 1e-6 * Vec3{chance.unit(), chance.unit(), chance.unit()};
    });
    const TriangleMesh smooth = without_superfluous(rough, all_of(rough), 4e-6);
    EXPECT_LT(smooth.face_count(), 24U);
    EXPECT_EQ(prove_volume(smooth)->text(), "");
    EXPECT_NEAR(exact_volume_of(smooth).nearest_double(), 64, 96 * 8e-6);
    EXPECT_EQ(without_superfluous(rough, all_of(rough), 1e-9).face_count(), rough.face_count());
  }
}

TEST(VertexRemoval, keeps_the_vertices_that_must_stay) {
  const TriangleMesh fine = divided(box({0, 0, 0}, {4, 4, 4}));
  EXPECT_EQ(without_superfluous(fine, std::vector<bool>(fine.vertex_count()), 1e-9).face_count(), 48U);
  std::vector<bool> may_go = all_of(fine);
  std::size_t kept = 0;
  for (std::size_t v = 0; v < fine.vertex_count(); ++v)
    if (fine.points()[v].approx == Vec3{2, 2, 0} || fine.points()[v].approx == Vec3{2, 0, 0}) {
      may_go[v] = false;
      ++kept;
    }
  ASSERT_EQ(kept, 2U);
  const TriangleMesh coarse = without_superfluous(fine, may_go, 1e-9);
  EXPECT_EQ(coarse.face_count(), 12U + 2 + 2);
}

TEST(VertexRemoval, does_not_close_a_tunnel) {
  SetOperations engine;
  const TriangleMesh frame = divided(engine.subtract(box({0, 0, 0}, {4, 4, 1e-3}), box({1, 1, -1}, {3, 3, 1})));
  const TriangleMesh coarse = without_superfluous(frame, all_of(frame), 1e-9);
  EXPECT_EQ(prove_volume(coarse)->text(), "");
  EXPECT_EQ(exact_volume_of(coarse), exact_volume_of(frame));
  EXPECT_EQ(coarse.face_count(), 32U);  // as many as a frame needs: 16 corners, genus 1
}

TEST(VertexRemoval, removes_vertices_of_folds_where_thin_triangles_are_allowed) {
  // A plate with a rough top is thinner than the tolerance.
  Chance chance(1);
  const TriangleMesh plate = mapped(divided(divided(box({0, 0, 0}, {4, 4, 4}))), [&](const Vec3& p) {
    return Vec3{p.x, p.y, 1e-7 * p.z * (1 + chance.unit() / 2)};
  });
  TriangleStars stars(plate);
  const auto has_changed = remove_superfluous_vertices(stars, all_of(plate), 1e-5, {}, ThinTriangles::allowed);
  ASSERT_TRUE(has_changed.ok() && *has_changed);
  const TriangleMesh coarse = stars.mesh();
  EXPECT_LE(coarse.face_count(), 16U);
  EXPECT_GE(coarse.face_count(), 4U);
  EXPECT_LT(coarse.face_count(), without_superfluous(plate, all_of(plate), 1e-5).face_count());
  EXPECT_EQ(Box3::around(coarse.points().approx()).max.x, 4);
  expect_near(coarse, plate, 2e-5);
  expect_near(plate, coarse, 2e-5);
}

TEST(VertexRemoval, can_be_interrupted) {
  const std::atomic<bool> cancel = true;
  const TriangleMesh sphere = geodesic_sphere(2);
  TriangleStars stars(sphere);
  const auto has_changed = remove_superfluous_vertices(stars, all_of(sphere), 1e-9, &cancel);
  ASSERT_FALSE(has_changed.ok());
  EXPECT_EQ(has_changed.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d::solids
