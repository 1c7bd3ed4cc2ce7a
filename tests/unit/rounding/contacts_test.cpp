#include "algebra3d/kernel/validity/contacts.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "algebra3d/kernel/rounding/divided_contacts.h"
#include "algebra3d/kernel/validity/edge_contacts.h"
#include "algebra3d/kernel/validity/validity.h"
#include "support/rounds.h"
#include "unit/arrangement/random_solids.h"
#include "unit/arrangement/set_operations.h"
#include "unit/rounding/faults_by_cgal.h"
#include "unit/rounding/mesh_area.h"

namespace algebra3d::solids {
namespace {

/// A tetrahedron that stands on its tip.
TriangleMesh standing_on(const Vec3& tip) {
  const PointArray points(
      std::vector<Vec3>{tip, tip + Vec3{-0.25, -0.25, 1}, tip + Vec3{0.5, 0, 1}, tip + Vec3{0, 0.5, 1}});
  return {points, std::vector<TriangleMesh::Triangle>{{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}}};
}

/// Several meshes as one.
TriangleMesh together(const std::vector<TriangleMesh>& meshes) {
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;
  for (const TriangleMesh& mesh : meshes) {
    const auto first = static_cast<std::uint32_t>(points.size());
    points.insert(points.end(), mesh.points().approx().begin(), mesh.points().approx().end());
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      const TriangleMesh::Triangle t = mesh.triangle(FaceId(f));
      triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
  }
  return {PointArray(points), triangles};
}

std::vector<VertexContact> contacts_of(const TriangleMesh& mesh) {
  return vertex_contacts(mesh, *touching_faces(mesh, nullptr));
}

std::vector<EdgeContact> edge_contacts_of(const TriangleMesh& mesh) {
  return edge_contacts(mesh, *touching_faces(mesh, nullptr));
}

TEST(VertexContacts, in_a_face_in_edges_and_at_a_corner) {
  const TriangleMesh cube = box({0, 0, 0}, {4, 4, 4});
  EXPECT_TRUE(contacts_of(cube).empty());
  // In the middle of the upper side both of its triangles have the point in their edge; at (4, 2, 4) two faces of the
  // cube meet; at (1.5, 1, 4) it is inside one triangle.
  for (const auto& [tip, expected] : std::map<Vec3, std::size_t>{
           {{2, 2, 4}, 2}, {{4, 2, 4}, 2}, {{1.5, 1, 4}, 1}, {{5, 5, 4}, 0}, {{1.5, 1, 0x1.0000000000001p2}, 0}}) {
    const TriangleMesh both = together({cube, standing_on(tip)});
    EXPECT_EQ(contacts_of(both).size(), expected) << tip;
    EXPECT_EQ(vertex_count_of(contacts_of(both)), expected > 0 ? 1U : 0U);
    EXPECT_EQ(prove_volume(both)->contact_vertices, expected > 0 ? 1U : 0U);
    // The cube is known, or the tetrahedron is.
    for (const bool is_cube_known : {false, true}) {
      std::vector<bool> is_known(both.face_count(), is_cube_known);
      std::fill(is_known.begin() + 12, is_known.end(), !is_cube_known);
      EXPECT_EQ(prove_volume(both, {.known = FaceSet(is_known)})->contact_vertices, expected > 0 ? 1U : 0U);
    }
    const FaceSet all(std::vector<bool>(both.face_count(), true));
    EXPECT_EQ(prove_volume(both, {.known = all})->contact_vertices, 0U);
  }
}

TEST(VertexContacts, are_corners_after_division) {
  const TriangleMesh touched = together({box({0, 0, 0}, {4, 4, 4}), standing_on({1.5, 1, 4}), standing_on({3, 1, 4}),
                                         standing_on({2, 2, 4}), standing_on({3, 3, 4}), standing_on({4, 2, 4})});
  ASSERT_EQ(prove_volume(touched)->text(), "");
  const std::vector<VertexContact> contacts = contacts_of(touched);
  EXPECT_EQ(vertex_count_of(contacts), 5U);
  const TriangleMesh divided = divided_at_contacts(touched, contacts);
  EXPECT_EQ(prove_volume(divided)->text(), "");
  EXPECT_TRUE(contacts_of(divided).empty());
  EXPECT_EQ(faults_of(divided).points_inside, 0);
  EXPECT_EQ(exact_volume_of(divided), exact_volume_of(touched));
  // Each vertex inside a triangle adds two, one inside an edge adds two as well: one to each side.
  EXPECT_EQ(divided.face_count(), touched.face_count() + 10);
  EXPECT_EQ(divided.points(), touched.points());
}

TEST(EdgeContacts, are_corners_after_division) {
  const std::vector<TriangleMesh::Triangle> faces{{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
  // Edges along y and along x cross in the origin.
  const TriangleMesh below(PointArray(std::vector<Vec3>{{0, -1, 0}, {0, 1, 0}, {1, 0, -1}, {-1, 0, -1}}), faces);
  const TriangleMesh above(PointArray(std::vector<Vec3>{{1, 0, 0}, {-1, 0, 0}, {0, -1, 1}, {0, 1, 1}}), faces);
  const TriangleMesh touched = together({below, above});
  ASSERT_EQ(prove_volume(touched)->text(), "");
  const std::vector<EdgeContact> contacts = edge_contacts_of(touched);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].point, ExactPoint(Vec3{0, 0, 0}));
  const TriangleMesh divided = divided_at_edge_contacts(touched, contacts, CoordinateGrid::floats());
  EXPECT_EQ(prove_volume(divided)->text(), "");
  EXPECT_TRUE(edge_contacts_of(divided).empty());
  EXPECT_EQ(divided.face_count(), touched.face_count() + 4);
  EXPECT_EQ(divided.vertex_count(), touched.vertex_count() + 1);
  const TriangleMesh same = divided_at_edge_contacts(
      touched, {{contacts[0].first, contacts[0].second, ExactPoint(Vec3{0.3, 0, 0})}}, CoordinateGrid::floats());
  EXPECT_EQ(same.face_count(), touched.face_count());
}

/// The contacts by CGAL: the vertices of pairs of triangles that share one point, a corner of one of them only; and the
/// number of points where two edges cross.
std::pair<std::set<Vec3>, int> contacts_by_cgal(const TriangleMesh& mesh) {
  std::pair<std::set<Vec3>, int> found;
  const std::vector<FaultKernel::Triangle_3> triangles = triangles_of_cgal(mesh);
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (std::size_t g = 0; g < f; ++g) {
      if (!CGAL::do_overlap(triangles[f].bbox(), triangles[g].bbox())) continue;
      const auto common = CGAL::intersection(triangles[f], triangles[g]);
      const auto* point = common ? boost::get<FaultKernel::Point_3>(&*common) : nullptr;
      if (point == nullptr) continue;
      const bool of_f = is_corner_of(*point, triangles[f]), of_g = is_corner_of(*point, triangles[g]);
      if (of_f != of_g)
        found.first.insert({CGAL::to_double(point->x()), CGAL::to_double(point->y()), CGAL::to_double(point->z())});
      else if (!of_f)
        ++found.second;
    }
  return found;
}

/// A tetrahedron between points of a small grid, not necessarily a valid one.
TriangleMesh random_tetrahedron(Chance& chance) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 4; ++i) corners.push_back(chance.grid_point(4));
  if (orient3d(corners[0], corners[1], corners[2], corners[3]) > 0) std::swap(corners[0], corners[1]);
  return {PointArray(corners), std::vector<TriangleMesh::Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
}

TEST(VertexContacts, of_tetrahedra_that_touch_are_those_of_all_pairs) {
  std::size_t contact_count = 0, crossing_count = 0;
  Chance chance(1);
  for (int i = 0; i < rounds(1000); ++i) {
    const TriangleMesh both = together({random_tetrahedron(chance), random_tetrahedron(chance)});
    if (!prove_volume(both)->is_valid()) continue;
    const auto [expected, crossings] = contacts_by_cgal(both);
    std::set<Vec3> found;
    const std::vector<VertexContact> contacts = contacts_of(both);
    for (const VertexContact& contact : contacts) found.insert(both.point(contact.vertex).approx);
    EXPECT_EQ(found, expected);
    const TriangleMesh divided = divided_at_contacts(both, contacts);
    EXPECT_EQ(prove_volume(divided)->text(), "");
    EXPECT_EQ(contacts_by_cgal(divided), std::pair(std::set<Vec3>(), crossings));
    const std::vector<EdgeContact> edges = edge_contacts_of(divided);
    EXPECT_EQ(edges.empty(), crossings == 0);
    const TriangleMesh touching = divided_at_edge_contacts(divided, edges, CoordinateGrid::doubles());
    EXPECT_EQ(prove_volume(touching)->text(), "");
    EXPECT_EQ(exact_volume_of(touching), exact_volume_of(both));
    const bool are_on_grid = std::ranges::all_of(
        edges, [](const EdgeContact& contact) { return is_on_grid(contact.point, CoordinateGrid::doubles()); });
    EXPECT_EQ(contacts_by_cgal(touching).second == 0, are_on_grid);
    contact_count += found.size();
    crossing_count += static_cast<std::size_t>(crossings);
  }
  EXPECT_GT(contact_count, rounds(5U));
  EXPECT_GT(crossing_count, 0U);
}

}  // namespace
}  // namespace algebra3d::solids
