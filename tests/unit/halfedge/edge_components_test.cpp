#include "algebra3d/kernel/halfedge/edge_components.h"

#include <gtest/gtest.h>

namespace algebra3d {
namespace {

// Two triangles with a common edge, one that touches them in a vertex, and three at a non-manifold edge.
TEST(edge_components, edges_connect_and_vertices_do_not) {
  const std::vector<TriangleMesh::Triangle> triangles{{4, 5, 0}, {0, 1, 2}, {6, 7, 8},
                                                      {2, 1, 3}, {6, 7, 9}, {7, 6, 10}};
  std::vector<Vec3> points;
  for (int i = 0; i < 11; ++i) points.push_back({double(i), double(i * i), double(i % 3)});
  const EdgeComponents components(TriangleMesh(PointArray(points), triangles));
  EXPECT_EQ(components.count(), 3U);
  const std::array<std::uint32_t, 6> expected{0, 1, 2, 1, 2, 2};
  for (std::size_t f = 0; f < 6; ++f) EXPECT_EQ(components.of(FaceId(f)), EdgeComponentId(expected[f]));
  for (const std::uint32_t first : {0U, 1U, 2U})
    EXPECT_EQ(components.first_face(EdgeComponentId(first)), FaceId(first));
}

TEST(edge_components, one_or_none) {
  const std::vector<TriangleMesh::Triangle> triangles{{0, 1, 2}};
  const EdgeComponents one(TriangleMesh(PointArray({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), triangles));
  EXPECT_EQ(one.count(), 1U);
  EXPECT_EQ(one.of(FaceId(0)), one.of(one.first_face(EdgeComponentId(0))));
  EXPECT_EQ(EdgeComponents(TriangleMesh()).count(), 0U);
}

}  // namespace
}  // namespace algebra3d
