#include "algebra3d/kernel/halfedge/shells.h"

#include <atomic>
#include <random>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/audit.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/dual.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "polygon_lists.h"

namespace algebra3d {
namespace {

using namespace samples;

std::int64_t genus_of(const Triangles& triangles) {
  return genus_of_shells(mesh_of(triangles)).value();
}
/// The octahedron with two vertices moved to other numbers.
Triangles with_vertices(Triangles triangles, std::uint32_t a, std::uint32_t new_a, std::uint32_t b,
                        std::uint32_t new_b) {
  for (auto& triangle : triangles)
    for (std::uint32_t& corner : triangle) corner = corner == a ? new_a : corner == b ? new_b : corner;
  return triangles;
}

TEST(Shells, genus_of_closed_forms) {
  EXPECT_EQ(genus_of({}), 0);
  EXPECT_EQ(genus_of(samples::tetrahedron()), 0);
  EXPECT_EQ(genus_of(torus(4, 5)), 1);
  EXPECT_EQ(genus_of(double_torus()), 2);
  EXPECT_EQ(genus_of(joined(torus(4, 5), moved(double_torus(), 100))), 3);
  EXPECT_EQ(genus_of_shells(polygon_mesh(cube_faces())).value(), 0);
}

TEST(Shells, what_is_shared_counts_for_each) {
  // In a vertex, in an edge, and in a chain of two edges.
  EXPECT_EQ(genus_of(joined(torus(3, 3), with_vertices(moved(octahedron(), 100), 100, 0, 999, 999))), 1);
  EXPECT_EQ(genus_of(joined(torus(3, 3), with_vertices(moved(octahedron(), 100), 100, 0, 102, 1))), 1);
  Triangles chain = with_vertices(moved(octahedron(), 100), 100, 0, 102, 4);
  chain = with_vertices(chain, 101, 8, 999, 999);
  EXPECT_EQ(genus_of(joined(torus(3, 3), chain)), 1);
}

TEST(Shells, open_or_pinched_shells_have_no_genus) {
  EXPECT_FALSE(genus_of_shells(mesh_of(grid(2, 2, false, false))).is_defined());
  // An octahedron of which two vertices are one.
  EXPECT_FALSE(genus_of_shells(mesh_of(with_vertices(torus(6, 6), 0, 20, 999, 999))).is_defined());
  EXPECT_FALSE(genus_of_shells(mesh_of(moebius_strip())).is_defined());
}

/// V - E + F is twice the number of shells minus twice the number of handles, if shells share nothing. The parts and so
/// the handles are chosen, not counted.
TEST(Shells, euler_s_formula_holds_for_random_parts) {
  std::mt19937 random(17);
  const auto below = [&](std::uint32_t n) { return std::uniform_int_distribution<std::uint32_t>(0, n - 1)(random); };
  for (int round = 0; round < 200; ++round) {
    Triangles all;
    const std::int64_t parts = below(6);
    std::int64_t handles = 0;
    for (std::int64_t part = 0; part < parts; ++part) {
      const std::uint32_t kind = below(4);
      handles += kind == 0 ? 1 : kind == 1 ? 2 : 0;
      const Triangles one = kind == 0   ? torus(3 + below(4), 3 + below(4))
                            : kind == 1 ? double_torus()
                            : kind == 2 ? octahedron()
                                        : samples::tetrahedron();
      all = joined(all, moved(one, static_cast<std::uint32_t>(100 * part)));
    }
    std::ranges::shuffle(all, random);
    const TriangleMesh mesh = mesh_of(all);
    ASSERT_EQ(genus_of_shells(mesh).value(), handles);
    ASSERT_EQ(euler_characteristic(mesh), 2 * parts - 2 * handles);
    ASSERT_EQ(genus_of_shells(*dual_mesh(mesh)).value(), handles);
  }
}

TEST(Dual, of_a_cube_is_an_octahedron) {
  const PolygonMesh dual = dual_mesh(polygon_mesh(cube_faces(), cube_points(2))).value();
  EXPECT_EQ(dual.vertex_count(), 6U);
  EXPECT_EQ(dual.face_count(), 8U);
  EXPECT_EQ(edge_count(dual), 12U);
  EXPECT_TRUE(is_closed(dual) && is_manifold(dual));
  EXPECT_EQ(dual.point(VertexId(0)).approx, (Vec3{1, 1, 0}));
  // Outward: the plane of each face has the centre behind it.
  for (const FaceId f : faces(dual)) {
    const HalfedgeId h = dual.halfedge(f);
    EXPECT_LT(orient3d(dual.point(dual.origin(h)), dual.point(dual.target(h)), dual.point(dual.target(dual.next(h))),
                       Vec3{1, 1, 1}),
              0);
  }
}

TEST(Dual, of_manifold_meshes_has_faces_and_vertices_exchanged) {
  for (const PolygonList& polygons : all_polygon_lists()) {
    const PolygonMesh mesh = polygon_mesh(polygons);
    const PolygonMesh dual = dual_mesh(mesh).value();
    ASSERT_TRUE(audit(dual).empty());
    ASSERT_EQ(dual.vertex_count(), mesh.face_count());
    if (!is_closed(mesh) || !is_manifold(mesh)) continue;
    std::size_t inner = 0;
    bool is_simple = true;
    for (const VertexId v : vertices(mesh)) {
      const auto degree = static_cast<std::size_t>(std::ranges::distance(outgoing_halfedges(mesh, v)));
      inner += degree >= 3 ? 1 : 0;
      is_simple = is_simple && (degree == 0 || degree >= 3);
    }
    ASSERT_EQ(dual.face_count(), inner);
    if (is_simple) {
      ASSERT_EQ(euler_characteristic(dual), euler_characteristic(mesh));
    }
  }
}

TEST(Dual, leaves_out_boundary_vertices) {
  const PolygonMesh dual = dual_mesh(mesh_of(grid(3, 3, false, false))).value();
  EXPECT_EQ(dual.vertex_count(), 18U);
  EXPECT_EQ(dual.face_count(), 4U);
  for (const FaceId f : faces(dual)) EXPECT_EQ(dual.degree(f), 6U);
}

TEST(Dual, can_be_interrupted) {
  const std::atomic<bool> cancel = true;
  const auto dual = dual_mesh(mesh_of(grid(3, 3, false, false)), &cancel);
  ASSERT_FALSE(dual.ok());
  EXPECT_EQ(dual.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace algebra3d
