#include "algebra3d/kernel/halfedge/render_buffers.h"

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "polygon_lists.h"

namespace algebra3d {
namespace {

using namespace samples;

/// Fans of the faces' corners.
std::vector<std::array<HalfedgeId, 3>> fans_of_faces(const PolygonMesh& mesh) {
  std::vector<std::array<HalfedgeId, 3>> triangles;
  for (const FaceId f : faces(mesh))
    for (std::uint32_t i = 1; i + 1 < mesh.degree(f); ++i)
      triangles.push_back({mesh.halfedge(f, 0), mesh.halfedge(f, i), mesh.halfedge(f, i + 1)});
  return triangles;
}

TEST(RenderBuffers, of_a_cube_have_four_vertices_for_each_face) {
  const PolygonMesh cube = polygon_mesh(cube_faces(), cube_points(2));
  const auto triangles = fans_of_faces(cube);
  const RenderBuffers buffers =
      render_buffers<PolygonLayout>(cube, triangles, corner_normals(cube, face_normals(cube), 30));
  EXPECT_EQ(buffers.origin, (Vec3{1, 1, 1}));
  EXPECT_EQ(buffers.positions.size(), 24U);
  ASSERT_EQ(buffers.triangles.size(), 12U);
  const std::vector<Vec3> normals = face_normals(cube);
  for (std::size_t t = 0; t < 12; ++t) {
    EXPECT_EQ(buffers.faces[t], t / 2);
    for (const std::uint32_t vertex : buffers.triangles[t]) {
      const Vec3 normal = normals[t / 2];
      EXPECT_EQ(buffers.normals[vertex],
                (std::array{static_cast<float>(normal.x), static_cast<float>(normal.y), static_cast<float>(normal.z)}));
      for (const float coordinate : buffers.positions[vertex]) EXPECT_EQ(std::abs(coordinate), 1);
    }
  }
}

TEST(RenderBuffers, of_smooth_meshes_have_each_vertex_once_and_no_isolated_ones) {
  std::vector<Vec3> points = torus_points(8, 9).approx();
  points.push_back({0, 0, 0});
  const TriangleMesh mesh(PointArray(std::move(points)), torus(8, 9));
  const RenderBuffers buffers = render_buffers(mesh, corner_normals(mesh, face_normals(mesh), 180));
  EXPECT_EQ(buffers.positions.size(), 72U);
  ASSERT_EQ(buffers.triangles.size(), mesh.face_count());
  for (const FaceId f : faces(mesh))
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(buffers.mesh_vertices[buffers.triangles[f.index()][i]], mesh.triangle(f)[i]);
}

/// A millimetre at the other end of the world is not lost, as it would be in floats.
TEST(RenderBuffers, are_relative_to_an_origin) {
  const PointArray points(std::vector<Vec3>{{6e9, 0, 0}, {6e9 + 0.5, 0, 0}, {6e9, 0.25, 0}});
  const TriangleMesh mesh(points, Triangles{{0, 1, 2}});
  const RenderBuffers buffers = render_buffers(mesh, corner_normals(mesh, face_normals(mesh), 30));
  EXPECT_EQ(buffers.origin, (Vec3{6e9 + 0.25, 0.125, 0}));
  EXPECT_EQ(buffers.positions[1], (std::array{0.25F, -0.125F, 0.0F}));
}

TEST(RenderBuffers, of_nothing_are_empty) {
  const TriangleMesh empty;
  const RenderBuffers buffers = render_buffers(empty, corner_normals(empty, face_normals(empty), 30));
  EXPECT_TRUE(buffers.positions.empty() && buffers.triangles.empty());
}

}  // namespace
}  // namespace algebra3d
