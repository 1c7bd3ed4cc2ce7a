#include "algebra3d/kernel/rounding/detail/paired_faces.h"

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/topology.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/set_operations.h"

namespace algebra3d::solids {
namespace {

TEST(PairedFaces, leave_a_manifold_as_it_is) {
  const TriangleMesh sphere = geodesic_sphere(3);
  const TriangleMesh paired = with_paired_faces(sphere);
  EXPECT_EQ(paired.vertex_count(), sphere.vertex_count());
  EXPECT_EQ(triangles_of(paired), triangles_of(sphere));
}

TEST(PairedFaces, go_on_from_each_other_where_two_boundaries_cross) {
  // At each edge of the seam, the two faces outside are one boundary, and the two inside another one.
  const TriangleMesh cube = box({0, 0, 0}, {4, 4, 4}), bar = box({1, 1, -1}, {3, 3, 5});
  const TriangleMesh difference = SetOperations().difference_of_both(cube, bar);
  ASSERT_GT(difference.nonmanifold_edge_count(), 0);
  const TriangleMesh paired = with_paired_faces(difference);
  EXPECT_EQ(paired.nonmanifold_edge_count(), 0);
  EXPECT_TRUE(paired.nonmanifold_vertices().empty());
  ASSERT_EQ(paired.face_count(), difference.face_count());
  for (std::size_t f = 0; f < paired.face_count(); ++f)
    for (int i = 0; i < 3; ++i) EXPECT_EQ(paired.corners(FaceId(f))[i].approx, difference.corners(FaceId(f))[i].approx);
}

}  // namespace
}  // namespace algebra3d::solids
