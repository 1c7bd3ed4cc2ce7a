#include "algebra3d/kernel/halfedge/audit.h"

#include <gtest/gtest.h>

#include "mesh_samples.h"
#include "mesh_tester.h"

namespace algebra3d {
namespace {

using Tester = MeshTester;
using Lines = std::vector<std::string>;

TriangleMesh tetrahedron() {
  return samples::mesh_of(samples::tetrahedron());
}
/// Three triangles along the edge from 0 to 1.
TriangleMesh book() {
  return samples::mesh_of({{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
}
/// Two triangles that touch in vertex 0.
TriangleMesh bow_tie() {
  return samples::mesh_of({{0, 1, 2}, {0, 3, 4}});
}

TEST(Audit, every_mesh_as_built_is_sound) {
  for (const auto& triangles : samples::all_kinds()) {
    const Lines violations = audit(samples::mesh_of(triangles));
    ASSERT_TRUE(violations.empty()) << violations.front();
  }
  EXPECT_TRUE(audit(TriangleMesh()).empty());
}

TEST(Audit, wrong_sizes_are_found) {
  TriangleMesh mesh = tetrahedron();
  Tester::origins(mesh).push_back(0);
  Tester::outgoing(mesh).pop_back();
  EXPECT_EQ(audit(mesh),
            (Lines{"13 half-edges, expected a multiple of 3", "12 opposites, expected one per half-edge (13)",
                   "3 outgoing half-edges, expected one per vertex (4)"}));
}

TEST(Audit, origin_that_is_no_vertex_is_found) {
  TriangleMesh mesh = tetrahedron();
  Tester::origins(mesh)[5] = 4;
  EXPECT_EQ(audit(mesh), Lines{"half-edge 5: origin 4 is not a vertex"});
}

TEST(Audit, forgotten_opposite_is_found) {
  TriangleMesh mesh = tetrahedron();
  Tester::opposites(mesh)[0] = 0xFFFFFFFF;
  EXPECT_EQ(audit(mesh),
            (Lines{"half-edge 0: boundary, its edge demands opposite 9", "half-edge 9: its opposite 0 has boundary"}));
}

TEST(Audit, opposite_that_does_not_run_in_reverse_is_found) {
  TriangleMesh mesh = tetrahedron();
  Tester::opposites(mesh)[0] = 1;
  EXPECT_EQ(audit(mesh),
            (Lines{"half-edge 0: opposite 1, its edge demands opposite 9", "half-edge 0: its opposite 1 has opposite 6",
                   "half-edge 0 from 0 to 2: its opposite 1 runs from 2 to 1",
                   "half-edge 9: its opposite 0 has opposite 1"}));
}

TEST(Audit, opposite_that_is_no_halfedge_is_found) {
  TriangleMesh mesh = tetrahedron();
  Tester::opposites(mesh)[9] = 12;
  EXPECT_EQ(audit(mesh), (Lines{"half-edge 0: its opposite 9 has opposite 12",
                                "half-edge 9: opposite 12, its edge demands opposite 0",
                                "half-edge 9: opposite 12 is not a half-edge"}));
}

TEST(Audit, boundary_taken_for_nonmanifold_is_found) {
  TriangleMesh mesh = bow_tie();
  Tester::opposites(mesh)[1] = 0x80000000;
  EXPECT_EQ(audit(mesh), Lines{"half-edge 1: non-manifold edge 0, its edge demands boundary"});
}

TEST(Audit, wrong_number_of_a_nonmanifold_edge_is_found) {
  TriangleMesh mesh = book();
  Tester::opposites(mesh)[3] = 0x80000001;
  EXPECT_EQ(audit(mesh), Lines{"half-edge 3: non-manifold edge 1, its edge demands non-manifold edge 0"});
}

TEST(Audit, missing_outgoing_halfedge_is_found) {
  TriangleMesh mesh = tetrahedron();
  Tester::outgoing(mesh)[2] = HalfedgeId();
  EXPECT_EQ(audit(mesh), Lines{"vertex 2: no outgoing half-edge, but faces"});
}

TEST(Audit, outgoing_that_is_no_halfedge_is_found) {
  TriangleMesh mesh = tetrahedron();
  Tester::outgoing(mesh)[2] = HalfedgeId(99);
  EXPECT_EQ(audit(mesh), Lines{"vertex 2: outgoing half-edge 99 is not a half-edge"});
}

TEST(Audit, outgoing_halfedge_of_another_vertex_is_found) {
  TriangleMesh mesh = tetrahedron();
  Tester::outgoing(mesh)[2] = HalfedgeId(0);
  EXPECT_EQ(audit(mesh), Lines{"vertex 2: outgoing half-edge 0 leaves vertex 0"});
}

TEST(Audit, outgoing_halfedge_of_an_isolated_vertex_is_found) {
  TriangleMesh mesh = samples::mesh_of({{0, 1, 2}}, 4);
  Tester::outgoing(mesh)[3] = HalfedgeId(1);
  EXPECT_EQ(audit(mesh), Lines{"vertex 3: outgoing half-edge 1 leaves vertex 1"});
}

TEST(Audit, outgoing_halfedge_inside_a_fan_is_found) {
  TriangleMesh mesh = samples::mesh_of({{0, 1, 2}, {0, 2, 3}});
  Tester::outgoing(mesh)[0] = HalfedgeId(3);
  EXPECT_EQ(audit(mesh), Lines{"vertex 0: outgoing half-edge 3 is not the start of its first fan, 0"});
}

TEST(Audit, missing_side_tables_are_found) {
  TriangleMesh mesh = bow_tie();
  Tester::drop_tables(mesh);
  EXPECT_EQ(audit(mesh), Lines{"no side tables, but non-manifold edges or vertices"});
}

TEST(Audit, needless_side_tables_are_found) {
  TriangleMesh mesh = tetrahedron();
  Tester::change_tables(mesh, [](auto&) {});
  EXPECT_EQ(audit(mesh), Lines{"side tables, but nothing is non-manifold"});
}

TEST(Audit, edge_table_that_is_not_divided_is_found) {
  TriangleMesh mesh = book();
  Tester::change_tables(mesh, [](auto& tables) { tables.edge_starts.back() = 2; });
  EXPECT_EQ(audit(mesh), Lines{"table of non-manifold edges: its 2 starts do not divide 3 half-edges"});
}

TEST(Audit, missing_nonmanifold_edge_is_found) {
  TriangleMesh mesh = book();
  Tester::change_tables(mesh, [](auto& tables) {
    tables.edge_starts = {0};
    tables.edge_halfedges.clear();
  });
  EXPECT_EQ(audit(mesh), Lines{"table of non-manifold edges: 0 listed, 1 counted"});
}

TEST(Audit, nonmanifold_edge_out_of_order_is_found) {
  TriangleMesh mesh = book();
  Tester::change_tables(mesh, [](auto& tables) { std::swap(tables.edge_halfedges[0], tables.edge_halfedges[1]); });
  EXPECT_EQ(audit(mesh), Lines{"non-manifold edge 0: half-edges (3 0 6) listed, (0 3 6) counted"});
}

TEST(Audit, vertex_table_that_is_not_divided_is_found) {
  TriangleMesh mesh = bow_tie();
  Tester::change_tables(mesh, [](auto& tables) { tables.fan_starts.push_back(3); });
  EXPECT_EQ(audit(mesh), Lines{"table of non-manifold vertices: its 3 starts do not divide 2 fans among 1 vertices"});
}

TEST(Audit, missing_nonmanifold_vertex_is_found) {
  TriangleMesh mesh = bow_tie();
  Tester::change_tables(mesh, [](auto& tables) { tables = {}; });
  EXPECT_EQ(audit(mesh), Lines{"vertex 0: 2 fans, but not in the table of non-manifold vertices"});
}

TEST(Audit, missing_fan_is_found) {
  TriangleMesh mesh = bow_tie();
  Tester::change_tables(mesh, [](auto& tables) {
    tables.fans.pop_back();
    tables.fan_starts.back() = 1;
  });
  EXPECT_EQ(audit(mesh), Lines{"vertex 0: fans (0) listed, (0 3) counted"});
}

TEST(Audit, manifold_vertex_in_the_table_is_found) {
  TriangleMesh mesh = bow_tie();
  Tester::change_tables(mesh, [](auto& tables) {
    tables.vertices.push_back(1);
    tables.fans.emplace_back(1);
    tables.fan_starts.push_back(3);
  });
  EXPECT_EQ(audit(mesh), Lines{"vertex 1: listed as non-manifold, but has 1 fans"});
}

TEST(Audit, unknown_vertex_in_the_table_is_found) {
  TriangleMesh mesh = bow_tie();
  Tester::change_tables(mesh, [](auto& tables) {
    tables.vertices.push_back(7);
    tables.fans.emplace_back(1);
    tables.fan_starts.push_back(3);
  });
  EXPECT_EQ(audit(mesh), Lines{"table of non-manifold vertices: 7 is not a vertex"});
}

TEST(Audit, vertex_table_out_of_order_is_found) {
  TriangleMesh mesh = book();
  Tester::change_tables(mesh, [](auto& tables) {
    std::swap(tables.vertices[0], tables.vertices[1]);
    std::rotate(tables.fans.begin(), tables.fans.begin() + 3, tables.fans.end());
  });
  EXPECT_EQ(audit(mesh), Lines{"table of non-manifold vertices: not ascending"});
}

}  // namespace
}  // namespace algebra3d
