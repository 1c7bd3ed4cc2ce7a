#include "algebra3d/mesh/operations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "algebra3d/mesh/files.h"
#include "algebra3d/mesh/normals.h"
#include "algebra3d/mesh/shapes.h"
#include "algebra3d/mesh/topology.h"
#include "face_lists.h"

namespace algebra3d::mesh {
namespace {

PolygonMesh unit_cube() {
  return lists::polygons_of(lists::cube(), lists::cube_points());
}

double distance_between(const Vec3& a, const Vec3& b) {
  return length(a - b);
}

TEST(MeshTopology, facts_of_a_torus_a_grid_and_a_cube) {
  const PolygonMesh torus = lists::polygons_of(lists::torus(6, 5, false), lists::torus_points(6, 5));
  EXPECT_TRUE(is_closed(torus) && is_manifold(torus) && is_consistently_oriented(torus));
  EXPECT_EQ(euler_characteristic(torus), 0);
  EXPECT_EQ(*genus(torus), 1);
  const TriangleMesh grid = lists::triangles_of(lists::grid(3, 2, true), lists::grid_points(3, 2));
  EXPECT_FALSE(is_closed(grid));
  EXPECT_EQ(boundary_loops(grid).size(), 1U);
  EXPECT_EQ(boundary_loops(grid)[0].halfedges.size(), 10U);
  EXPECT_EQ(euler_characteristic(grid), 1);
  EXPECT_EQ(genus(grid).error().code, ErrorCode::invalid_value);
  lists::Faces two = lists::cube();
  for (const auto& face : lists::cube()) {
    two.push_back(face);
    for (std::uint32_t& v : two.back()) v += 8;
  }
  const FaceComponents parts = connected_components(lists::polygons_of(two, lists::some_points(16)));
  EXPECT_EQ(parts.count, 2U);
  EXPECT_EQ(parts.faces()[1].front(), FaceId(6));
}

TEST(MeshNormals, those_of_a_cube_point_outward_by_every_weight) {
  const PolygonMesh cube = unit_cube();
  const std::vector<Vec3> of_faces = face_normals(cube);
  EXPECT_EQ(of_faces[0], (Vec3{0, 0, -1}));
  EXPECT_EQ(of_faces[5], (Vec3{1, 0, 0}));
  for (const NormalWeight weight : {NormalWeight::angle, NormalWeight::area, NormalWeight::uniform}) {
    const std::vector<Vec3> normals = vertex_normals(cube, weight);
    for (const VertexId v : vertices(cube)) {
      const Vec3& p = cube.point(v);
      const Vec3 expected = 1 / std::sqrt(3.0) * Vec3{2 * p.x - 1, 2 * p.y - 1, 2 * p.z - 1};
      EXPECT_LT(distance_between(normals[v.index()], expected), 1e-15);
    }
  }
  for (const EdgeId e : edges(cube)) EXPECT_EQ(*dihedral_angle_degrees(cube, e), 90);
}

TEST(MeshNormals, weights_are_angles_areas_and_ones) {
  // At vertex 0: in the plane z = 0 two triangles with 45 degrees and the area 1/2 each, in x = 0 one with 90 degrees
  // and the area 2.
  const TriangleMesh mesh =
      lists::triangles_of({{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 4}});
  const auto expect_direction = [&](NormalWeight weight, const Vec3& sum) {
    EXPECT_LT(distance_between(vertex_normals(mesh, weight)[0], 1 / length(sum) * sum), 1e-15);
  };
  expect_direction(NormalWeight::angle, {1, 0, 1});
  expect_direction(NormalWeight::area, {2, 0, 1});
  expect_direction(NormalWeight::uniform, {1, 0, 2});
}

TEST(MeshNormals, faces_of_any_size_have_weight) {
  for (const double size : {1e-160, 1e-300, 5e-324, 1e-100, 1.0, 1e160, 1e300}) {
    const TriangleMesh mesh = lists::triangles_of({{0, 1, 2}}, {{0, 0, 0}, {size, 0, 0}, {0, size, 0}});
    for (const NormalWeight weight : {NormalWeight::angle, NormalWeight::area, NormalWeight::uniform})
      for (const Vec3& normal : vertex_normals(mesh, weight)) EXPECT_LT(length(normal - Vec3{0, 0, 1}), 1e-15) << size;
  }
  const TriangleMesh isolated = *TriangleMesh::of_corners(std::vector<Vec3>{{1, 2, 3}}, {});
  EXPECT_EQ(vertex_normals(isolated, NormalWeight::area)[0], Vec3{});
}

TEST(MeshRenderBuffers, meshes_beyond_the_range_of_floats_are_refused) {
  const TriangleMesh mesh = lists::triangles_of({{0, 1, 2}}, {{0, 0, 0}, {1e39, 0, 0}, {0, 1, 0}});
  EXPECT_EQ(render_buffers(mesh).error().code, ErrorCode::limit_exceeded);
}

TEST(MeshRenderBuffers, vertices_are_divided_at_creases) {
  const PolygonMesh cube = unit_cube();
  const RenderBuffers sharp = *render_buffers(cube, 30);
  EXPECT_EQ(sharp.vertices.size(), 24U);
  EXPECT_EQ(sharp.triangles.size(), 36U);
  EXPECT_EQ(sharp.faces.size(), 12U);
  const RenderBuffers smooth = *render_buffers(cube, 180);
  EXPECT_EQ(smooth.vertices.size(), 8U);
  for (const RenderBuffers& buffers : {sharp, smooth}) {
    ASSERT_EQ(buffers.positions.size(), 3 * buffers.vertices.size());
    ASSERT_EQ(buffers.normals.size(), buffers.positions.size());
    for (std::size_t t = 0; t < buffers.faces.size(); ++t) {
      std::set<std::uint32_t> corners;
      for (std::size_t i = 0; i < 3; ++i) corners.insert(buffers.vertices[buffers.triangles[3 * t + i]].index());
      ASSERT_EQ(corners.size(), 3U);
      for (const std::uint32_t v : corners) ASSERT_EQ(std::ranges::count(cube.corners(buffers.faces[t]), v), 1);
    }
    for (std::size_t i = 0; i < buffers.vertices.size(); ++i)
      EXPECT_EQ(buffers.positions[3 * i], cube.point(buffers.vertices[i]).x - 0.5);
  }
  EXPECT_EQ(render_buffers(cube, -1).error().code, ErrorCode::invalid_value);
}

TEST(MeshSubdivision, a_cube_becomes_quadrilaterals_and_keeps_its_attributes) {
  const PolygonMesh cube =
      *unit_cube().with_attribute<FaceId>("Group", std::vector<std::string>{"a", "b", "c", "d", "e", "f"});
  const PolygonMesh fine = *subdivided(cube, "catmull-clark", 2);
  EXPECT_EQ(fine.face_count(), 6U * 16);
  EXPECT_EQ(*genus(fine), 0);
  const auto group = *fine.attribute<FaceId, std::string>("Group");
  for (const FaceId f : faces(fine)) EXPECT_EQ(group[f], std::string(1, static_cast<char>('a' + f.index() / 16)));
  EXPECT_EQ(subdivided(cube, "catmull", 1).error().code, ErrorCode::unknown_name);
  EXPECT_EQ(subdivided(cube, "loop", 1).error().code, ErrorCode::invalid_value);
  const TriangleMesh triangles = *triangulated(cube);
  EXPECT_EQ(subdivided(triangles, "loop", 1)->face_count(), 4 * triangles.face_count());
}

TEST(MeshSubdivision, variants_and_limits_have_the_names_of_the_scheme) {
  const PolygonMesh cube = unit_cube();
  const PolygonMesh triangles(*triangulated(cube));
  EXPECT_NE(subdivided(triangles, "doo-sabin", 1, "doo")->points()[0],
            subdivided(triangles, "doo-sabin", 1, "mean")->points()[0]);
  EXPECT_EQ(subdivided(triangles, "doo-sabin", 1)->points()[0],
            subdivided(triangles, "doo-sabin", 1, "mean")->points()[0]);
  EXPECT_EQ(subdivided(cube, "doo-sabin", 1, "loop").error().code, ErrorCode::unknown_name);
  EXPECT_EQ(subdivided(cube, "catmull-clark", 1, "doo").error().code, ErrorCode::unknown_name);

  const PolygonMesh limit = *limit_mesh(cube, "catmull-clark");
  const PolygonMesh fine = *subdivided(cube, "catmull-clark", 6);
  for (const VertexId v : vertices(cube)) EXPECT_LT(length(fine.point(v) - limit.point(v)), 1e-3);
  EXPECT_EQ(limit_mesh(cube, "butterfly").error().code, ErrorCode::invalid_value);
  const PolygonMesh open = lists::polygons_of(lists::grid(2, 2, false), lists::grid_points(2, 2));
  EXPECT_EQ(limit_mesh(open, "doo-sabin", "open").error().code, ErrorCode::invalid_value);
}

TEST(MeshSimplification, a_grid_becomes_two_triangles_and_keeps_its_groups) {
  const TriangleMesh grid = lists::triangles_of(lists::grid(8, 8, true), lists::grid_points(8, 8));
  const TriangleMesh grouped =
      *grid.with_attribute<FaceId>("Group", std::vector<std::string>(grid.face_count(), "ground"));
  const TriangleMesh simple = *simplified(grouped, {.triangles = 2});
  EXPECT_EQ(simple.face_count(), 2U);
  EXPECT_EQ((*simple.attribute<FaceId, std::string>("Group"))[FaceId(0)], "ground");
  EXPECT_EQ(simplified(grid, {.deviation = -1}).error().code, ErrorCode::invalid_value);
}

TEST(MeshOperations, cancelled_work_ends_with_an_error) {
  const std::atomic<bool> cancel = true;
  const PolygonMesh torus = lists::polygons_of(lists::torus(40, 40, false), lists::torus_points(40, 40));
  EXPECT_EQ(subdivided(torus, "catmull-clark", 2, {}, &cancel).error().code, ErrorCode::interrupted);
  EXPECT_EQ(dual(torus, &cancel).error().code, ErrorCode::interrupted);
  EXPECT_EQ(simplified(*triangulated(torus), {.triangles = 10}, &cancel).error().code, ErrorCode::interrupted);
  EXPECT_EQ(solid_of(torus, &cancel).error().code, ErrorCode::interrupted);
}

TEST(MeshDual, that_of_a_cube_is_an_octahedron) {
  const PolygonMesh octahedron = *dual(unit_cube());
  EXPECT_EQ(octahedron.vertex_count(), 6U);
  EXPECT_EQ(octahedron.face_count(), 8U);
  EXPECT_EQ(octahedron.common_degree(), 3U);
  EXPECT_EQ(octahedron.point(VertexId(0)), (Vec3{0.5, 0.5, 0}));
}

TEST(MeshFiles, meshes_are_read_as_they_were_written) {
  const PolygonMesh cube = *unit_cube().with_attribute<FaceId>("Material", std::vector<std::string>(6, "steel"));
  const std::filesystem::path folder = testing::TempDir();
  for (const char* const name : {"cube.obj", "cube.off"}) {
    ASSERT_TRUE(write_mesh(cube, folder / name).ok());
    const ReadMesh read = *read_mesh(folder / name);
    EXPECT_TRUE(std::ranges::equal(read.mesh.points(), cube.points()));
    EXPECT_TRUE(std::ranges::equal(read.mesh.corners(), cube.corners()));
    const auto material = read.mesh.attribute<FaceId, std::string>("Material");
    ASSERT_EQ(material.ok(), std::string(name) == "cube.obj");
    if (material.ok()) {
      for (const FaceId f : faces(cube)) EXPECT_EQ((*material)[f], "steel");
    }
  }
  EXPECT_EQ(write_mesh(cube, folder / "cube.off")->size(), 1U);  // the material was left out
  for (const char* const form : {"stl", "stl-ascii"}) {
    ASSERT_TRUE(write_mesh(*triangulated(cube), folder / "cube.stl", form).ok());
    const ReadMesh read = *read_mesh(folder / "cube.stl");
    EXPECT_EQ(read.mesh.face_count(), 12U);
    EXPECT_EQ(read.mesh.vertex_count(), 8U);
    EXPECT_TRUE(is_closed(read.mesh));
  }
  EXPECT_EQ(write_mesh(cube, folder / "cube.ply").error().code, ErrorCode::wrong_usage);
  EXPECT_EQ(write_mesh(cube, folder / "cube.obj", "stl").error().code, ErrorCode::wrong_usage);
  EXPECT_EQ(read_mesh(folder / "nothing.obj").error().code, ErrorCode::file_missing);
}

TEST(MeshShapes, solids_and_surfaces_become_meshes_and_back) {
  const Solid box = *Solid::box({0, 0, 0}, {2, 1, 1});
  const TriangleMesh mesh = mesh_of(box);
  EXPECT_EQ(mesh.face_count(), 12U);
  EXPECT_TRUE(is_closed(mesh) && is_manifold(mesh));
  EXPECT_EQ(*solid_of(mesh), box);
  EXPECT_EQ(*solid_of(unit_cube()), *Solid::box({0, 0, 0}, {1, 1, 1}));
  EXPECT_EQ(*surface_of(mesh), boundary(box));
  EXPECT_EQ(mesh_of(boundary(box)).face_count(), 12U);
  const TriangleMesh open = lists::triangles_of(lists::grid(1, 1, true), lists::grid_points(1, 1));
  EXPECT_EQ(solid_of(open).error().code, ErrorCode::invalid_value);
  EXPECT_TRUE(surface_of(open).ok());
}

TEST(MeshShapes, fractions_stay_exact_through_meshes_and_edits) {
  const Solid ball = *Solid::sphere({0, 0, 0}, 1, 7);
  const Solid cut = *intersect(ball, *ball.translated({0.3, 0.1, 0.2}));
  const TriangleMesh mesh = mesh_of(cut);
  ASSERT_TRUE(mesh.has_fractions());
  EXPECT_EQ(*solid_of(mesh), cut);
  EXPECT_EQ(*solid_of(PolygonMesh(mesh)), cut);
}

}  // namespace
}  // namespace algebra3d::mesh
