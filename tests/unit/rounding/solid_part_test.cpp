#include "algebra3d/kernel/rounding/detail/solid_part.h"

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/validity/validity.h"
#include "base/indices.h"
#include "unit/arrangement/random_solids.h"

namespace algebra3d::solids {
namespace {

/// The mesh with one vertex at another place.
TriangleMesh with_vertex_at(const TriangleMesh& mesh, VertexId vertex, const Vec3& place) {
  std::vector<Vec3> points = mesh.points().approx();
  points[vertex.index()] = place;
  return {mesh, PointArray(std::move(points))};
}

/// All faces, those at the vertex as not kept.
std::vector<std::uint32_t> kept_without(const TriangleMesh& mesh, VertexId vertex) {
  std::vector<std::uint32_t> kept(mesh.face_count());
  std::iota(kept.begin(), kept.end(), 0U);
  for (const FaceId face : faces_around(mesh, vertex)) kept[face.index()] = kNone;
  return kept;
}

constexpr VertexId kSome(7);

TEST(SolidPart, changes_only_faces_that_are_not_kept) {
  const TriangleMesh sphere = geodesic_sphere(6);
  const Vec3 place = 1.25 * sphere.points().approx()[kSome.index()];
  const TriangleMesh moved = with_vertex_at(sphere, kSome, place);
  const auto change = SolidPart(sphere).change_to(moved, kept_without(sphere, kSome));
  ASSERT_TRUE(change);
  EXPECT_EQ(change->part.mesh().face_count(), change->added.face_count());
  EXPECT_LE(change->added.face_count(), 6);
  EXPECT_TRUE(change->part.keeps_shells_with(change->added));
  EXPECT_TRUE(change->part.prove_with(change->added, 1, {}, nullptr)->is_valid);
  const TriangleMesh solid = change->part.solid_with(change->added);
  EXPECT_EQ(solid.face_count(), sphere.face_count());
  EXPECT_EQ(prove_volume(solid)->text(), "");
}

TEST(SolidPart, finds_a_changed_face_that_crosses_one_that_is_kept) {
  const TriangleMesh sphere = geodesic_sphere(6);
  const Vec3 beyond = -1.25 * sphere.points().approx()[kSome.index()];  // through the other side
  const TriangleMesh moved = with_vertex_at(sphere, kSome, beyond);
  ASSERT_FALSE(prove_volume(moved)->is_valid());
  const auto change = SolidPart(sphere).change_to(moved, kept_without(sphere, kSome));
  ASSERT_TRUE(change);
  EXPECT_FALSE(change->part.prove_with(change->added, 3, {}, nullptr)->is_valid);
}

TEST(SolidPart, is_the_whole_where_too_much_changes_or_nothing_is_known) {
  const TriangleMesh box = geodesic_sphere(1);
  EXPECT_FALSE(SolidPart(box).change_to(box, {}));
  EXPECT_FALSE(SolidPart(box).change_to(box, std::vector<std::uint32_t>(box.face_count(), kNone)));
}

// Two tetrahedra back to back along an edge, and a sphere far away, so that little changes. What moves has two faces at
// that edge; the other two stay, but cannot be told apart there.
TEST(SolidPart, changes_all_faces_at_an_edge_of_four) {
  const TriangleMesh far = geodesic_sphere(3);
  std::vector<Vec3> points{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  std::vector<TriangleMesh::Triangle> triangles{{0, 3, 2}, {0, 2, 1}, {2, 3, 1}, {0, 1, 3},
                                                {0, 5, 4}, {0, 4, 1}, {4, 5, 1}, {0, 1, 5}};
  for (const Vec3& point : far.points().approx()) points.push_back(point + Vec3{100, 0, 0});
  for (std::uint32_t f = 0; f < far.face_count(); ++f) {
    const auto [a, b, c] = far.triangle(FaceId(f));
    triangles.push_back({a + 6, b + 6, c + 6});
  }
  const TriangleMesh solid(PointArray(std::move(points)), triangles);
  ASSERT_EQ(prove_volume(solid)->text(), "");
  const VertexId apex(3);
  const TriangleMesh moved = with_vertex_at(solid, apex, {1, 1.5, 0});
  const auto change = SolidPart(solid).change_to(moved, kept_without(solid, apex));
  ASSERT_TRUE(change);
  EXPECT_EQ(change->added.face_count(), 6);  // three at the apex, and the other three at the edge
  EXPECT_TRUE(change->part.prove_with(change->added, 1, {}, nullptr)->is_valid);
  EXPECT_EQ(prove_volume(change->part.solid_with(change->added))->text(), "");
}

}  // namespace
}  // namespace algebra3d::solids
