#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "algebra3d/mesh/builder.h"
#include "algebra3d/mesh/editor.h"
#include "algebra3d/mesh/topology.h"
#include "face_lists.h"

namespace algebra3d::mesh {
namespace {

template <typename T>
void expect_refusal(const Result<T>& result, const std::string& message) {
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::invalid_value);
  EXPECT_EQ(result.error().text(), message);
}

std::vector<VertexId> corners_of(const PolygonMesh& mesh, FaceId f) {
  const auto range = vertices_of(mesh, f);
  return {range.begin(), range.end()};
}

TEST(MeshBuilder, vertices_and_faces_become_a_mesh_in_their_order) {
  MeshBuilder builder;
  for (const Vec3& p : lists::cube_points()) ASSERT_TRUE(builder.add_vertex(p).ok());
  for (const auto& face : lists::cube()) {
    std::vector<VertexId> corners;
    for (const std::uint32_t v : face) corners.emplace_back(v);
    ASSERT_TRUE(builder.add_face(corners).ok());
  }
  const PolygonMesh mesh = *builder.mesh();
  EXPECT_TRUE(std::ranges::equal(mesh.points(), lists::cube_points()));
  for (const FaceId f : faces(mesh)) EXPECT_TRUE(std::ranges::equal(mesh.corners(f), lists::cube()[f.index()]));
  EXPECT_TRUE(is_closed(mesh) && is_manifold(mesh));
  EXPECT_EQ(*genus(mesh), 0);
}

TEST(MeshBuilder, a_face_that_cannot_be_is_refused_and_nothing_is_added) {
  MeshBuilder builder;
  for (const Vec3& p : lists::cube_points()) ASSERT_TRUE(builder.add_vertex(p).ok());
  const auto v = [](std::uint32_t i) { return VertexId(i); };
  ASSERT_TRUE(builder.add_face({v(0), v(1), v(2)}).ok());
  expect_refusal(builder.add_face({v(0), v(1)}), "add_face: expected three or more corners, found 2");
  expect_refusal(builder.add_face({v(0), v(1), v(8)}), "add_face: there is no vertex 8; there are 8, numbered from 0");
  expect_refusal(builder.add_face({v(2), v(3), v(2)}), "add_face: vertex 2 is two corners of the face");
  expect_refusal(builder.add_face({v(4), v(0), v(1)}),
                 "add_face: the edge from vertex 0 to vertex 1 has a face already");
  expect_refusal(builder.add_vertex({0, std::numeric_limits<double>::quiet_NaN(), 0}),
                 "add_vertex: expected finite coordinates, found (0, nan, 0)");
  EXPECT_EQ(builder.face_count(), 1U);
  EXPECT_TRUE(builder.add_face({v(1), v(0), v(4)}).ok());
  MeshBuilder free(FaceRule::any);
  for (const Vec3& p : lists::cube_points()) ASSERT_TRUE(free.add_vertex(p).ok());
  ASSERT_TRUE(free.add_face({v(0), v(1), v(2)}).ok());
  ASSERT_TRUE(free.add_face({v(0), v(1), v(3)}).ok());
  EXPECT_EQ(free.mesh()->nonmanifold_edge_count(), 1U);
}

TEST(MeshBuilder, removed_faces_make_room_and_attributes_stay_with_their_faces) {
  const PolygonMesh cube =
      *lists::polygons_of(lists::cube(), lists::cube_points())
           .with_attribute<FaceId>("Group", std::vector<std::string>{"a", "b", "c", "d", "e", "f"});
  MeshBuilder builder(cube);
  ASSERT_TRUE(builder.remove_face(FaceId(2)).ok());
  expect_refusal(builder.remove_face(FaceId(2)), "remove_face: there is no face 2");
  expect_refusal(builder.remove_face(FaceId(6)), "remove_face: there is no face 6");
  EXPECT_EQ(builder.face_count(), 5U);
  const std::vector<VertexId> corners = corners_of(cube, FaceId(2));
  ASSERT_TRUE(builder.add_face({corners[0], corners[1], corners[2]}).ok());
  ASSERT_TRUE(builder.add_face({corners[0], corners[2], corners[3]}).ok());
  const PolygonMesh changed = *builder.mesh();
  EXPECT_TRUE(is_closed(changed));
  const auto group = *changed.attribute<FaceId, std::string>("Group");
  std::string all;
  for (const FaceId f : faces(changed)) all += group.is_defined(f) ? std::string(group[f]) : "-";
  EXPECT_EQ(all, "abdef--");
  expect_refusal(builder.triangle_mesh(), "face 0 has 4 corners, expected triangles; triangulated makes them");
}

TEST(MeshBuilder, a_mesh_of_the_builder_is_the_mesh_it_began_with) {
  lists::for_each_mesh([](const auto& mesh, const lists::Faces& /*faces*/) {
    const PolygonMesh polygons(mesh);
    const PolygonMesh again = *MeshBuilder(polygons, FaceRule::any).mesh();
    ASSERT_TRUE(std::ranges::equal(again.corners(), polygons.corners()));
    ASSERT_TRUE(std::ranges::equal(again.points(), polygons.points()));
    ASSERT_EQ(again.edge_count(), polygons.edge_count());
  });
}

TEST(MeshEditorOfUsers, an_edge_that_is_split_and_collapsed_leaves_the_mesh) {
  const TriangleMesh torus = lists::triangles_of(lists::torus(5, 4, true), lists::torus_points(5, 4));
  MeshEditor editor = *MeshEditor::of(torus);
  const HalfedgeId h(7);
  const VertexId end = torus.target(h);
  const VertexId middle = *editor.split_edge(h, {9, 9, 9});
  EXPECT_EQ(editor.vertex_count(), torus.vertex_count() + 1);
  EXPECT_EQ(editor.edge_count(), torus.edge_count() + 3);
  EXPECT_EQ(editor.face_count(), torus.face_count() + 2);
  EXPECT_EQ(editor.point(middle), (Vec3{9, 9, 9}));
  EXPECT_EQ(editor.target(h), middle);
  const TriangleMesh split = *editor.triangle_mesh();
  EXPECT_TRUE(is_closed(split) && is_manifold(split));
  EXPECT_EQ(euler_characteristic(split), 0);
  ASSERT_EQ(*editor.collapse_edge(editor.find_halfedge(end, middle)), end);
  const TriangleMesh again = *editor.triangle_mesh();
  EXPECT_TRUE(std::ranges::equal(again.points(), torus.points()));
  const auto triangles_in = [](const TriangleMesh& mesh) {
    std::vector<std::array<std::uint32_t, 3>> all;
    for (const FaceId f : faces(mesh)) {
      std::array<std::uint32_t, 3> t = mesh.triangle(f);
      std::ranges::rotate(t, std::ranges::min_element(t));
      all.push_back(t);
    }
    std::ranges::sort(all);
    return all;
  };
  EXPECT_EQ(triangles_in(again), triangles_in(torus));
}

TEST(MeshEditorOfUsers, an_edge_that_is_flipped_twice_is_the_opposite_one) {
  const TriangleMesh grid = lists::triangles_of(lists::grid(1, 1, true), lists::grid_points(1, 1));
  MeshEditor editor = *MeshEditor::of(grid);
  const HalfedgeId diagonal = editor.find_halfedge(VertexId(0), VertexId(3));
  ASSERT_TRUE(diagonal.is_valid());
  const HalfedgeId flipped = *editor.flip_edge(diagonal);
  EXPECT_FALSE(editor.find_halfedge(VertexId(0), VertexId(3)).is_valid());
  EXPECT_TRUE(editor.find_halfedge(VertexId(1), VertexId(2)).is_valid());
  ASSERT_TRUE(editor.flip_edge(flipped).ok());
  EXPECT_TRUE(editor.find_halfedge(VertexId(0), VertexId(3)).is_valid());
}

TEST(MeshEditorOfUsers, faces_and_vertices_are_split_and_moved) {
  MeshEditor editor = *MeshEditor::of(lists::polygons_of(lists::cube(), lists::cube_points()));
  const FaceId part = *editor.split_face(FaceId(0), VertexId(0), VertexId(3));
  EXPECT_TRUE(editor.is_used(part));
  EXPECT_EQ(editor.face_count(), 7U);
  const VertexId top = *editor.split_face(FaceId(1), {0.5, 0.5, 2});
  EXPECT_EQ(editor.face_count(), 10U);
  ASSERT_TRUE(editor.move_vertex(top, {0.5, 0.5, 3}).ok());
  const HalfedgeId first = editor.find_halfedge(top, VertexId(4)), last = editor.find_halfedge(top, VertexId(7));
  const VertexId second = *editor.split_vertex(top, first, last, {0.5, 0.5, 4});
  EXPECT_TRUE(editor.find_halfedge(top, second).is_valid());
  const PolygonMesh mesh = *editor.mesh();
  EXPECT_TRUE(is_closed(mesh) && is_manifold(mesh));
  EXPECT_EQ(*genus(mesh), 0);
  EXPECT_EQ(mesh.point(top), (Vec3{0.5, 0.5, 3}));
}

TEST(MeshEditorOfUsers, refused_edits_give_the_reason_and_change_nothing) {
  const PolygonMesh tetrahedron =
      lists::polygons_of({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  MeshEditor editor = *MeshEditor::of(tetrahedron);
  EXPECT_EQ(editor.collapse_edge(HalfedgeId(0)).error().code, ErrorCode::invalid_value);
  EXPECT_EQ(editor.flip_edge(HalfedgeId(0)).error().code, ErrorCode::invalid_value);
  EXPECT_EQ(editor.split_face(FaceId(0), VertexId(0), VertexId(3)).error().code, ErrorCode::invalid_value);
  expect_refusal(editor.flip_edge(HalfedgeId(12)), "flip_edge: there is no half-edge 12");
  expect_refusal(editor.flip_edge(HalfedgeId()), "flip_edge: the half-edge is invalid");
  expect_refusal(editor.move_vertex(VertexId(4), {}), "move_vertex: there is no vertex 4");
  expect_refusal(editor.split_face(FaceId(4), {0, 0, 0}), "split_face: there is no face 4");
  expect_refusal(editor.split_edge(HalfedgeId(0), {0, 0, std::numeric_limits<double>::infinity()}),
                 "split_edge: expected finite coordinates, found (0, 0, inf)");
  const PolygonMesh same = *editor.mesh();
  EXPECT_TRUE(std::ranges::equal(same.corners(), tetrahedron.corners()));
  EXPECT_TRUE(std::ranges::equal(same.points(), tetrahedron.points()));
  const PolygonMesh three_at_an_edge = lists::polygons_of({{0, 1, 2}, {0, 1, 3}, {1, 0, 4}}, lists::some_points(5));
  expect_refusal(MeshEditor::of(three_at_an_edge),
                 "MeshEditor: the mesh is not a manifold: 3 faces meet at the edge between vertices 0 and 1");
}

TEST(MeshEditorOfUsers, attributes_of_elements_that_stay_are_kept) {
  const PolygonMesh cube = *lists::polygons_of(lists::cube(), lists::cube_points())
                                .with_attribute<VertexId>("x", std::vector<double>{0, 1, 0, 1, 0, 1, 0, 1});
  MeshEditor editor = *MeshEditor::of(cube);
  const HalfedgeId h = editor.find_halfedge(VertexId(0), VertexId(1));
  const VertexId quarter = *editor.split_edge(h, {0.25, 0, 0});
  const PolygonMesh mesh = *editor.mesh();
  const auto x = *mesh.attribute<VertexId, double>("x");
  for (const VertexId v : vertices(mesh)) EXPECT_EQ(x[v], mesh.point(v).x);
  EXPECT_EQ(x[quarter], 0.25);
}

}  // namespace
}  // namespace algebra3d::mesh
