#include "algebra3d/kernel/halfedge/polygon_mesh.h"

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/audit.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/nonmanifold_text.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "mesh_tester.h"
#include "polygon_samples.h"
#include "same_mesh.h"

namespace algebra3d {
namespace {

using samples::all_polygon_kinds;
using samples::polygon_mesh_of;
using samples::PolygonBruteForce;
using samples::PolygonList;
using Lines = std::vector<std::string>;

std::vector<std::uint32_t> numbers_of(std::span<const HalfedgeId> halfedges) {
  std::vector<std::uint32_t> result;
  for (const HalfedgeId h : halfedges) result.push_back(h.index());
  return result;
}

/// Beside divisions, up to the largest number of half-edges.
TEST(PolygonLayout, computes_the_faces_of_any_degree) {
  constexpr std::uint32_t kMost = static_cast<std::uint32_t>(PolygonMesh::kMaxHalfedges);
  for (const std::uint32_t degree :
       {1U, 2U, 3U, 4U, 5U, 6U, 7U, 11U, 64U, 1000U, 65537U, kMost / 2, kMost - 1, kMost}) {
    const PolygonLayout layout = PolygonLayout::of_degree(degree);
    const std::uint32_t last = kMost / degree - 1;
    for (const std::uint32_t face : {0U, 1U, 2U, last / 3, last / 2, last}) {
      if (face > last) continue;
      const std::uint32_t first = face * degree, end = first + degree;
      for (const std::uint32_t h : {first, first + degree / 2, end - 1}) {
        ASSERT_EQ(layout.face(HalfedgeId(h)), FaceId(face)) << degree;
        ASSERT_EQ(layout.next(HalfedgeId(h)).index(), h + 1 == end ? first : h + 1) << degree;
        ASSERT_EQ(layout.prev(HalfedgeId(h)).index(), h == first ? end - 1 : h - 1) << degree;
      }
    }
  }
}

TEST(PolygonMesh, default_mesh_is_empty) {
  const PolygonMesh mesh;
  EXPECT_TRUE(mesh.is_empty());
  EXPECT_EQ(mesh.face_count(), 0U);
  EXPECT_EQ(mesh.heap_bytes(), 0U);
  EXPECT_TRUE(audit(mesh).empty());
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_TRUE(polygon_mesh_of(PolygonList{}).is_empty());
}

TEST(PolygonMesh, faces_are_kept_in_order) {
  for (const PolygonList& polygons : all_polygon_kinds()) {
    const PolygonMesh mesh = polygon_mesh_of(polygons);
    ASSERT_EQ(mesh.face_count(), polygons.size());
    for (std::size_t f = 0; f < polygons.size(); ++f) {
      ASSERT_EQ(mesh.degree(FaceId(f)), polygons[f].size());
      std::vector<std::uint32_t> corners;
      for (const VertexId v : vertices_of(mesh, FaceId(f))) corners.push_back(v.index());
      ASSERT_EQ(corners, polygons[f]);
    }
  }
}

TEST(PolygonMesh, links_are_those_of_brute_force) {
  for (const PolygonList& polygons : all_polygon_kinds()) {
    const PolygonMesh mesh = polygon_mesh_of(polygons);
    const PolygonBruteForce expected(polygons);
    ASSERT_EQ(mesh.halfedge_count(), expected.halfedge_count());
    std::size_t nonmanifold_count = 0;
    for (const auto& [edge, along] : expected.edges())
      nonmanifold_count += !expected.is_boundary(along[0]) && !expected.is_manifold(along[0]) ? 1 : 0;
    ASSERT_EQ(mesh.nonmanifold_edge_count(), nonmanifold_count);
    ASSERT_EQ(edge_count(mesh), expected.edges().size());
    for (std::uint32_t i = 0; i < expected.halfedge_count(); ++i) {
      const HalfedgeId h(i);
      ASSERT_EQ(mesh.origin(h).index(), expected.origin(i));
      ASSERT_EQ(mesh.target(h).index(), expected.target(i));
      ASSERT_EQ(mesh.face(h).index(), expected.face(i));
      ASSERT_EQ(mesh.next(h).index(), expected.next(i));
      ASSERT_EQ(mesh.prev(h).index(), expected.prev(i));
      ASSERT_EQ(mesh.is_boundary(h), expected.is_boundary(i));
      ASSERT_EQ(mesh.is_nonmanifold(h), !expected.is_boundary(i) && !expected.is_manifold(i));
      ASSERT_EQ(mesh.opposite(h), expected.is_manifold(i) ? HalfedgeId(expected.opposite(i)) : HalfedgeId());
      if (mesh.is_nonmanifold(h)) {
        ASSERT_EQ(numbers_of(mesh.edge_halfedges(h)), expected.along(i));
      }
    }
  }
}

TEST(PolygonMesh, fans_are_those_of_brute_force) {
  for (const PolygonList& polygons : all_polygon_kinds()) {
    const PolygonMesh mesh = polygon_mesh_of(polygons);
    const PolygonBruteForce expected(polygons);
    std::vector<VertexId> nonmanifold;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
      const auto fans = expected.fans(v);
      const auto listed = numbers_of(mesh.fans(VertexId(v)));
      ASSERT_EQ(listed.size(), fans.size());
      ASSERT_EQ(mesh.is_isolated(VertexId(v)), fans.empty());
      ASSERT_EQ(mesh.outgoing(VertexId(v)), fans.empty() ? HalfedgeId() : HalfedgeId(listed[0]));
      if (fans.size() > 1) nonmanifold.emplace_back(v);
      for (const auto& fan : fans) {
        const auto start = std::ranges::find_if(listed, [&](std::uint32_t h) { return fan.contains(h); });
        ASSERT_NE(start, listed.end());
        const auto open = std::ranges::find_if(fan, [&](std::uint32_t h) { return !expected.is_manifold(h); });
        ASSERT_EQ(*start, open != fan.end() ? *open : *fan.begin());
      }
    }
    ASSERT_EQ(mesh.nonmanifold_vertices(), nonmanifold);
  }
}

TEST(PolygonMesh, each_boundary_halfedge_is_in_one_loop) {
  for (const PolygonList& polygons : all_polygon_kinds()) {
    const PolygonMesh mesh = polygon_mesh_of(polygons);
    const PolygonBruteForce expected(polygons);
    std::vector<std::uint32_t> in_loops, on_boundary;
    for (const BoundaryLoop& loop : boundary_loops(mesh))
      for (const HalfedgeId h : loop.halfedges) in_loops.push_back(h.index());
    for (std::uint32_t h = 0; h < expected.halfedge_count(); ++h)
      if (expected.is_boundary(h)) on_boundary.push_back(h);
    std::ranges::sort(in_loops);
    ASSERT_EQ(in_loops, on_boundary);
    ASSERT_EQ(is_closed(mesh), on_boundary.empty());
  }
}

TEST(PolygonMesh, every_mesh_as_built_is_sound) {
  for (const PolygonList& polygons : all_polygon_kinds()) {
    const Lines violations = audit(polygon_mesh_of(polygons));
    ASSERT_TRUE(violations.empty()) << violations.front();
  }
}

TEST(PolygonMesh, of_triangles_is_linked_as_the_triangle_mesh) {
  for (const samples::Triangles& triangles : samples::all_kinds()) {
    const TriangleMesh expected = samples::mesh_of(triangles);
    const PolygonMesh mesh = polygon_mesh_of(samples::as_polygons(triangles));
    ASSERT_EQ(mesh.common_degree(), triangles.empty() ? 0U : 3U);
    for (std::size_t i = 0; i < expected.halfedge_count(); ++i) {
      const HalfedgeId h(i);
      ASSERT_EQ(mesh.opposite(h), expected.opposite(h));
      ASSERT_EQ(mesh.is_boundary(h), expected.is_boundary(h));
    }
    for (std::size_t v = 0; v < expected.vertex_count(); ++v)
      ASSERT_EQ(samples::listed(mesh.fans(VertexId(v))), samples::listed(expected.fans(VertexId(v))));
  }
}

TEST(PolygonMesh, euler_characteristic_and_genus_are_the_known_ones) {
  EXPECT_EQ(euler_characteristic(polygon_mesh_of(samples::cube())), 2);
  EXPECT_EQ(*genus(polygon_mesh_of(samples::prism(7))), 0);
  EXPECT_EQ(*genus(polygon_mesh_of(samples::quad_grid(4, 5, true, true))), 1);
  EXPECT_EQ(euler_characteristic(polygon_mesh_of(samples::quad_grid(4, 5, false, false))), 1);
}

TEST(PolygonMesh, triangles_take_as_much_memory_as_in_a_triangle_mesh) {
  for (const std::uint32_t size : {3U, 10U, 100U, 300U}) {
    const auto triangles = samples::torus(size, size);
    const TriangleMesh expected(samples::torus_points(size, size), triangles);
    const PolygonMesh mesh = polygon_mesh_of(samples::as_polygons(triangles), samples::torus_points(size, size));
    EXPECT_EQ(mesh.heap_bytes(), expected.heap_bytes());
    EXPECT_LE(mesh.heap_bytes() + sizeof(PolygonMesh), 24 * triangles.size() + 28 * std::size_t{size} * size + 512);
  }
}

TEST(PolygonMesh, memory_of_polygons_is_as_documented) {
  const std::size_t quads = polygon_mesh_of(samples::quad_grid(50, 60, true, true)).heap_bytes();
  EXPECT_LE(quads, 28U * 3000 + 8U * 12000 + 256);
  PolygonList mixed = samples::quad_grid(50, 60, true, true);
  mixed.push_back({3000, 3001, 3002});
  EXPECT_LE(polygon_mesh_of(mixed).heap_bytes(), 28U * 3003 + 12U * 12003 + 4U * 3001 + 256);
}

TEST(PolygonMesh, hub_of_a_large_fan_of_quads_is_linked) {
  PolygonList quads;
  const std::uint32_t count = 20000;
  for (std::uint32_t i = 0; i < count; ++i) quads.push_back({0, 2 * i + 1, 2 * i + 2, (2 * i + 2) % (2 * count) + 1});
  const PolygonMesh mesh = polygon_mesh_of(quads);
  EXPECT_EQ(mesh.fans(VertexId(0)).size(), 1U);
  EXPECT_EQ(boundary_loops(mesh).size(), 1U);
  EXPECT_TRUE(audit(mesh).empty());
}

TEST(PolygonMesh, damage_is_found) {
  PolygonMesh quads = polygon_mesh_of(samples::cube());
  MeshTester::origins(quads).push_back(0);
  EXPECT_EQ(audit(quads),
            (Lines{"25 half-edges, expected a multiple of 4", "24 opposites, expected one per half-edge (25)"}));
  PolygonMesh mixed = polygon_mesh_of(samples::prism(5));
  MeshTester::origins(mixed).push_back(0);
  EXPECT_EQ(audit(mixed), (Lines{"the starts of the faces do not divide 31 half-edges",
                                 "30 opposites, expected one per half-edge (31)"}));
  PolygonMesh open = polygon_mesh_of(samples::prism(5));
  MeshTester::opposites(open)[0] = 0xFFFFFFFF;
  ASSERT_EQ(audit(open).size(), 2U);
  EXPECT_TRUE(audit(open)[0].starts_with("half-edge 0: boundary, its edge demands opposite ")) << audit(open)[0];
}

TEST(PolygonMesh, nonmanifold_places_are_counted) {
  const auto mesh_of = [](LargeVector<std::uint32_t> starts, LargeVector<std::uint32_t> corners) {
    return PolygonMesh(PointArray(std::vector<Vec3>(9)), PolygonLayout(std::move(starts)), std::move(corners));
  };
  EXPECT_EQ(nonmanifold_text(PolygonMesh()), "");
  EXPECT_EQ(nonmanifold_text(mesh_of({0, 4, 7}, {0, 1, 2, 3, 1, 0, 4})), "");
  EXPECT_EQ(nonmanifold_text(mesh_of({0, 4, 7}, {0, 1, 2, 3, 0, 4, 5})), "1 non-manifold vertex (first 0)");
  EXPECT_EQ(nonmanifold_text(mesh_of({0, 4, 7, 10}, {0, 1, 2, 3, 2, 1, 4, 1, 2, 5})),
            "1 non-manifold edge (first between vertices 1 and 2) and 2 non-manifold vertices (first 1)");
}

TEST(PolygonMesh, copy_and_move_keep_everything) {
  PolygonMesh mesh = polygon_mesh_of({{0, 1, 2}, {0, 3, 4, 5}});
  const PolygonMesh copy = mesh;
  const PolygonMesh moved = std::move(mesh);
  for (const PolygonMesh* each : {&copy, &moved}) {
    EXPECT_TRUE(audit(*each).empty());
    EXPECT_EQ(each->fans(VertexId(0)).size(), 2U);
    EXPECT_EQ(each->degree(FaceId(1)), 4U);
  }
}

}  // namespace
}  // namespace algebra3d
