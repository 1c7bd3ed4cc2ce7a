#include "algebra3d/mesh/mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "face_lists.h"

namespace algebra3d::mesh {
namespace {

using lists::Faces;

const std::vector<Vec3> kSquarePoints{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

template <typename T>
void expect_error(const Result<T>& result, ErrorCode code, const std::string& message) {
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, code);
  EXPECT_EQ(result.error().text(), message);
}

TEST(Mesh, an_empty_mesh_has_no_elements) {
  const TriangleMesh triangles;
  const PolygonMesh polygons;
  EXPECT_EQ(triangles.vertex_count() + triangles.edge_count() + triangles.face_count(), 0U);
  EXPECT_EQ(polygons.vertex_count() + polygons.edge_count() + polygons.face_count(), 0U);
  EXPECT_TRUE(polygons.is_empty() && polygons.is_manifold() && polygons.attributes().empty());
  EXPECT_TRUE(TriangleMesh::of_triangles({}, {})->is_empty());
  EXPECT_TRUE(PolygonMesh::of_faces({}, {}, 4)->is_empty());
}

TEST(Mesh, points_and_corners_are_shown_without_a_copy) {
  const std::vector<std::uint32_t> corners{0, 1, 2, 0, 2, 3};
  const TriangleMesh mesh = *TriangleMesh::of_corners(kSquarePoints, corners);
  const TriangleMesh copy = mesh;
  EXPECT_TRUE(std::ranges::equal(mesh.points(), kSquarePoints));
  EXPECT_TRUE(std::ranges::equal(mesh.corners(), corners));
  EXPECT_EQ(mesh.points().data(), copy.points().data());
  EXPECT_EQ(mesh.corners().data(), copy.corners().data());
  EXPECT_FALSE(mesh.has_fractions());
  EXPECT_EQ(mesh.triangle(FaceId(1)), (std::array<std::uint32_t, 3>{0, 2, 3}));
}

TEST(Mesh, points_that_are_handed_over_are_not_copied) {
  std::vector<Vec3> points = kSquarePoints;
  const Vec3* const data = points.data();
  const std::vector<std::uint32_t> corners{0, 1, 2, 3};
  const PolygonMesh mesh = *PolygonMesh::of_faces(std::move(points), corners, 4);
  EXPECT_EQ(mesh.points().data(), data);
  EXPECT_TRUE(std::ranges::equal(mesh.points(), kSquarePoints));
  expect_error(TriangleMesh::of_corners(std::vector<Vec3>(kSquarePoints), std::vector<std::uint32_t>{0, 1, 9}),
               ErrorCode::invalid_value, "corner 2: there is no point 9; there are 4, numbered from 0");
}

TEST(Mesh, arrays_live_as_long_as_the_last_copy) {
  TriangleMesh kept;
  {
    const TriangleMesh mesh = lists::triangles_of({{0, 1, 2}}, kSquarePoints);
    kept = mesh;
  }
  TriangleMesh moved = std::move(kept);
  EXPECT_EQ(kept.face_count(), 1U);  // NOLINT(bugprone-use-after-move): moving copies
  EXPECT_EQ(moved.point(VertexId(2)), kSquarePoints[2]);
}

TEST(Mesh, a_vertex_at_the_boundary_is_found_beside_a_nonmanifold_edge) {
  const TriangleMesh mesh = lists::triangles_of({{0, 1, 2}, {0, 1, 3}}, kSquarePoints);
  for (const VertexId v : vertices(mesh)) EXPECT_TRUE(mesh.is_boundary(v)) << v.index();
}

TEST(Mesh, triangles_as_polygons_keep_all_numbers) {
  lists::for_each_mesh([](const auto& mesh, const Faces& /*faces*/) {
    if constexpr (std::is_same_v<std::decay_t<decltype(mesh)>, TriangleMesh>) {
      const PolygonMesh polygons(mesh);
      ASSERT_EQ(polygons.edge_count(), mesh.edge_count());
      ASSERT_TRUE(std::ranges::equal(polygons.corners(), mesh.corners()));
      for (const HalfedgeId h : halfedges(mesh)) {
        ASSERT_EQ(polygons.opposite(h), mesh.opposite(h));
        ASSERT_EQ(polygons.edge(h), mesh.edge(h));
      }
      for (const VertexId v : vertices(mesh)) ASSERT_EQ(polygons.outgoing(v), mesh.outgoing(v));
    }
  });
}

TEST(Mesh, faulty_arrays_are_refused_with_the_place) {
  using Triangles = std::vector<std::array<std::uint32_t, 3>>;
  expect_error(TriangleMesh::of_triangles(kSquarePoints, Triangles{{0, 1, 2}, {0, 2, 4}}), ErrorCode::invalid_value,
               "triangle 1: there is no point 4; there are 4, numbered from 0");
  expect_error(
      TriangleMesh::of_triangles(std::vector<Vec3>{{0, 0, 0}, {0, std::numeric_limits<double>::infinity(), 0}}, {}),
      ErrorCode::invalid_value, "point 1: expected finite coordinates, found (0, inf, 0)");
  expect_error(TriangleMesh::of_corners(kSquarePoints, std::vector<std::uint32_t>{0, 1, 2, 3}),
               ErrorCode::invalid_value, "4 corners; expected three for each triangle");
  const std::vector<std::uint32_t> corners{0, 1, 2, 3};
  expect_error(PolygonMesh::of_faces(kSquarePoints, corners, std::vector<std::uint32_t>{2, 2}),
               ErrorCode::invalid_value, "face 0: expected three or more corners, found 2");
  expect_error(PolygonMesh::of_faces(kSquarePoints, corners, std::vector<std::uint32_t>{3}), ErrorCode::invalid_value,
               "4 corners; the faces have 3");
  expect_error(PolygonMesh::of_faces(kSquarePoints, corners, std::vector<std::uint32_t>{3, 3}),
               ErrorCode::invalid_value, "4 corners; the faces have 6");
  expect_error(PolygonMesh::of_faces(kSquarePoints, corners, 3), ErrorCode::invalid_value,
               "4 corners; expected a multiple of the degree 3, which is 3 or more");
  expect_error(PolygonMesh::of_faces(kSquarePoints, std::vector<std::uint32_t>{0, 1, 7}, 3), ErrorCode::invalid_value,
               "corner 2: there is no point 7; there are 4, numbered from 0");
}

TEST(MeshAttributesOfUsers, values_are_those_given_element_by_element) {
  const PolygonMesh cube = lists::polygons_of(lists::cube(), lists::cube_points());
  std::vector<double> lengths(cube.edge_count());
  for (const EdgeId e : edges(cube)) lengths[e.index()] = 0.5 * e.index();
  lengths[3] = std::numeric_limits<double>::quiet_NaN();
  std::vector<Vec2> textures(cube.halfedge_count());
  for (const HalfedgeId h : halfedges(cube)) textures[h.index()] = {1.0 * h.index(), 2.0};
  const std::vector<std::string> names{"a", "b", "a", "c", "a", "b"};
  const PolygonMesh named = *cube.with_attribute<FaceId>("Group", names);
  const PolygonMesh all = *named.with_attribute<EdgeId>("Length", lengths)
                               ->with_attribute<HalfedgeId>("TextureCoordinate", textures)
                               .value()
                               .with_attribute<VertexId>("Normal", std::vector<Vec3>(8, Vec3{1, 2, 3}));
  ASSERT_EQ(all.attributes().size(), 4U);
  EXPECT_EQ(all.points().data(), cube.points().data());  // the mesh is shared
  const auto length = *all.attribute<EdgeId, double>("Length");
  for (const EdgeId e : edges(all)) {
    EXPECT_EQ(length.is_defined(e), e.index() != 3);
    if (length.is_defined(e)) {
      EXPECT_EQ(length[e], 0.5 * e.index());
    }
  }
  EXPECT_EQ(length.numbers().size(), all.edge_count());
  const auto texture = *all.attribute<HalfedgeId, Vec2>("TextureCoordinate");
  EXPECT_EQ(texture[HalfedgeId(5)], (Vec2{5, 2}));
  const auto normal = *all.attribute<VertexId, Vec3>("Normal");
  EXPECT_EQ(normal[VertexId(7)], (Vec3{1, 2, 3}));
  const auto group = *all.attribute<FaceId, std::string>("Group");
  for (const FaceId f : faces(all)) EXPECT_EQ(group[f], names[f.index()]);
  EXPECT_EQ(all.without_attribute<EdgeId>("Length").attributes().size(), 3U);
}

TEST(MeshAttributesOfUsers, a_column_outlives_its_mesh) {
  const auto column_of_a_cube = [] {
    const PolygonMesh cube = lists::polygons_of(lists::cube(), lists::cube_points());
    return *cube.with_attribute<FaceId>("n", std::vector<double>{0, 1, 2, 3, 4, 5})->attribute<FaceId, double>("n");
  };
  EXPECT_EQ(column_of_a_cube()[FaceId(4)], 4);
}

TEST(MeshAttributesOfUsers, errors_name_the_attribute) {
  const PolygonMesh cube = lists::polygons_of(lists::cube(), lists::cube_points());
  expect_error(cube.with_attribute<FaceId>("n", std::vector<double>(5)), ErrorCode::invalid_value,
               "face attribute 'n': found 5 values, expected 6, one per face");
  expect_error(cube.with_attribute<FaceId>("", std::vector<double>(6)), ErrorCode::invalid_value,
               "the name of an attribute must not be empty");
  const PolygonMesh with = *cube.with_attribute<FaceId>("n", std::vector<double>(6));
  EXPECT_EQ((with.attribute<VertexId, double>("n").error().code), ErrorCode::unknown_name);
  EXPECT_EQ((with.attribute<VertexId, double>("n").error().message), "the mesh has no vertex attribute 'n'");
  EXPECT_EQ((with.attribute<FaceId, Vec3>("n").error().code), ErrorCode::type_error);
  EXPECT_EQ((with.attribute<FaceId, Vec3>("n").error().message),
            "the face attribute 'n' has values of the kind real, expected vector");
}

}  // namespace
}  // namespace algebra3d::mesh
