// Meshes that are divided where faces touch, on solids of random unit cells: there the two faces of a cell are known at
// every edge.
#include "algebra3d/kernel/subdivision/divided_contacts.h"

#include <algorithm>
#include <array>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "algebra3d/kernel/halfedge/audit.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "subdivision_samples.h"
#include "support/rounds.h"

namespace algebra3d {
namespace {

using samples::polygon_mesh;
using Scheme = SubdivisionScheme;
using Cell = std::array<int, 3>;

/// The boundary of some unit cells, and the cell of each triangle.
struct CellSolid {
  PolygonMesh mesh;
  std::vector<Cell> cell_of_face;
};

CellSolid boundary_of(const std::vector<Cell>& cells) {
  samples::Faces faces;
  CellSolid solid;
  std::map<Cell, std::uint32_t> numbers;
  std::vector<Vec3> points;
  const auto number = [&](const Cell& p) {
    const auto [found, is_new] = numbers.try_emplace(p, static_cast<std::uint32_t>(points.size()));
    if (is_new) points.push_back({1.0 * p[0], 1.0 * p[1], 1.0 * p[2]});
    return found->second;
  };
  for (const Cell& cell : cells)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        Cell beyond = cell;
        beyond[axis] += side == 1 ? 1 : -1;
        if (std::ranges::find(cells, beyond) != cells.end()) continue;
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::array<Cell, 4> corners;
        corners.fill(cell);
        for (Cell& corner : corners) corner[axis] += side;
        // Counter-clockwise about the axis, which points outward for side 1.
        ++corners[1][u], ++corners[2][u], ++corners[2][v], ++corners[3][v];
        if (side == 0) std::swap(corners[1], corners[3]);
        faces.push_back({number(corners[0]), number(corners[1]), number(corners[2])});
        faces.push_back({number(corners[0]), number(corners[2]), number(corners[3])});
        solid.cell_of_face.insert(solid.cell_of_face.end(), 2, cell);
      }
  solid.mesh = polygon_mesh(faces, std::move(points));
  return solid;
}

/// What holds for every divided solid: the same triangles, linked all round, and at edges that were divided the faces
/// of one cell belong together.
void expect_divided(const CellSolid& solid) {
  const DividedContacts divided = *divided_contacts(solid.mesh, ContactsOf::solids);
  const PolygonMesh& mesh = divided.mesh;
  ASSERT_EQ(mesh.face_count(), solid.mesh.face_count());
  for (const HalfedgeId h : halfedges(mesh)) {
    ASSERT_EQ(mesh.point(mesh.origin(h)).approx, solid.mesh.point(solid.mesh.origin(h)).approx);
    const HalfedgeId o = mesh.opposite(h);
    ASSERT_TRUE(o.is_valid());
    ASSERT_EQ(mesh.opposite(o), h);
    ASSERT_EQ(mesh.origin(o), mesh.target(h));
    ASSERT_EQ(mesh.target(o), mesh.origin(h));
    if (!solid.mesh.is_nonmanifold(h)) continue;
    ASSERT_EQ(solid.cell_of_face[mesh.face(h).index()], solid.cell_of_face[mesh.face(o).index()]);
  }
  ASSERT_EQ(divided.edge_count, solid.mesh.nonmanifold_edge_count());
  // After a step nothing touches any more, whatever the scheme.
  for (const Scheme& scheme : subdivision_schemes()) {
    const auto result = subdivided(mesh, scheme, 1);
    ASSERT_TRUE(result.ok()) << result.error().message;
    ASSERT_EQ(audit(*result), std::vector<std::string>());
    const PolygonMesh anew(result->points(), result->layout(), result->origins());
    ASSERT_TRUE(is_manifold(anew)) << name_of(scheme);
    ASSERT_TRUE(is_closed(anew));
  }
}

TEST(DividedContacts, cells_that_touch_in_an_edge_or_a_vertex) {
  const CellSolid at_edge = boundary_of({{0, 0, 0}, {1, 1, 0}}), at_vertex = boundary_of({{0, 0, 0}, {1, 1, 1}});
  expect_divided(at_edge);
  expect_divided(at_vertex);
  const DividedContacts by_edge = *divided_contacts(at_edge.mesh, ContactsOf::solids);
  EXPECT_EQ(by_edge.edge_count, 1U);
  EXPECT_EQ(by_edge.vertex_count, 2U);
  EXPECT_EQ(by_edge.mesh.vertex_count(), 16U);
  EXPECT_EQ(connected_components(by_edge.mesh).count, 2U);
  const DividedContacts by_vertex = *divided_contacts(at_vertex.mesh, ContactsOf::solids);
  EXPECT_EQ(by_vertex.edge_count, 0U);
  EXPECT_EQ(by_vertex.vertex_count, 1U);
  // New vertices come last, at the place of the old one.
  EXPECT_EQ(by_vertex.mesh.vertex_count(), 16U);
  EXPECT_EQ(by_vertex.mesh.point(VertexId(15)).approx, (Vec3{1, 1, 1}));
}

/// Each body is what it is alone.
TEST(DividedContacts, bodies_are_subdivided_alone) {
  const CellSolid both = boundary_of({{0, 0, 0}, {1, 1, 0}});
  const PolygonMesh result = *subdivided(divided_contacts(both.mesh, ContactsOf::solids)->mesh, Scheme::loop, 2);
  std::vector<Vec3> expected;
  for (const Cell& cell : {Cell{0, 0, 0}, Cell{1, 1, 0}}) {
    const PolygonMesh alone = *subdivided(boundary_of({cell}).mesh, Scheme::loop, 2);
    for (const Vec3& p : alone.points().approx()) expected.push_back(p);
  }
  const std::vector<Vec3>& points = result.points().approx();
  ASSERT_EQ(points.size(), expected.size());
  const auto has = [](const std::vector<Vec3>& list, const Vec3& p) {
    return std::ranges::any_of(list, [&](const Vec3& q) { return length(p - q) <= 1e-14; });
  };
  for (const Vec3& p : points) EXPECT_TRUE(has(expected, p));
  for (const Vec3& p : expected) EXPECT_TRUE(has(points, p));
}

/// Two columns between two plates touch in an edge whose ends have one fan each: both edges join the same vertices.
TEST(DividedContacts, edge_between_vertices_that_are_not_divided) {
  std::vector<Cell> cells = {{0, 0, 1}, {1, 1, 1}};
  for (const int z : {0, 2})
    for (const int x : {0, 1})
      for (const int y : {0, 1}) cells.push_back({x, y, z});
  const CellSolid solid = boundary_of(cells);
  expect_divided(solid);
  const DividedContacts divided = *divided_contacts(solid.mesh, ContactsOf::solids);
  EXPECT_EQ(divided.edge_count, 1U);
  EXPECT_EQ(divided.vertex_count, 0U);
}

TEST(DividedContacts, random_cells) {
  std::mt19937 random(5);
  std::size_t edge_count = 0, vertex_count = 0;
  for (int round = 0; round < rounds(25); ++round) {
    std::vector<Cell> cells;
    const auto size = static_cast<int>(2 + random() % 3);
    for (int x = 0; x < size; ++x)
      for (int y = 0; y < size; ++y)
        for (int z = 0; z < size; ++z)
          if (random() % 2 == 0) cells.push_back({x, y, z});
    const CellSolid solid = boundary_of(cells);
    ASSERT_NO_FATAL_FAILURE(expect_divided(solid));
    const DividedContacts divided = *divided_contacts(solid.mesh, ContactsOf::solids);
    edge_count += divided.edge_count;
    vertex_count += divided.vertex_count;
  }
  EXPECT_GT(edge_count, 25U);
  EXPECT_GT(vertex_count, 25U);
}

/// Random triangles: edges of more than two are cut, and each fan gets its vertex.
TEST(DividedContacts, surfaces) {
  std::size_t seen = 0;
  for (const auto& triangles : samples::all_kinds()) {
    const bool has_loop =
        std::ranges::any_of(triangles, [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    if (has_loop) continue;
    const PolygonMesh mesh = polygon_mesh(samples::faces_of(triangles));
    const auto result_of_division = divided_contacts(mesh, ContactsOf::surfaces);
    bool has_turned_faces = false;
    for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n)
      has_turned_faces = has_turned_faces || mesh.nonmanifold_edge(n).size() == 2;
    ASSERT_EQ(result_of_division.ok(), !has_turned_faces);
    if (has_turned_faces) continue;
    const DividedContacts& divided = *result_of_division;
    ++seen;
    ASSERT_EQ(divided.mesh.face_count(), mesh.face_count());
    for (const HalfedgeId h : halfedges(mesh)) {
      ASSERT_EQ(divided.mesh.opposite(h), mesh.opposite(h));
      ASSERT_EQ(divided.mesh.point(divided.mesh.origin(h)).approx, mesh.point(mesh.origin(h)).approx);
    }
    const auto result = subdivided(divided.mesh, Scheme::catmull_clark, 1);
    if (!result.ok()) continue;
    ASSERT_EQ(audit(*result), std::vector<std::string>());
    ASSERT_TRUE(is_manifold(PolygonMesh(result->points(), result->layout(), result->origins())));
  }
  EXPECT_GT(seen, 100U);
  const DividedContacts three =
      *divided_contacts(polygon_mesh({{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}), ContactsOf::surfaces);
  EXPECT_EQ(three.mesh.vertex_count(), 9U);
  EXPECT_EQ(three.edge_count, 1U);
  EXPECT_EQ(three.vertex_count, 2U);
  EXPECT_EQ(divided_contacts(polygon_mesh({{0, 1, 2}, {0, 1, 3}}), ContactsOf::surfaces).error().message,
            "both faces at the edge between vertices 0 and 1 run along it in the same direction");
}

}  // namespace
}  // namespace algebra3d
