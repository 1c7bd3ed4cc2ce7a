// Mesh elements as rows: made one by one, owning their mesh, the same for each type of mesh.
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/kernel/exact/counters.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/values/types/mesh3d.h"
#include "unit/halfedge/polygon_lists.h"
#include "unit/operators/call_operator.h"

namespace algebra3d {
namespace {

using calls::call;

/// A table that is being read.
class OpenTable {
 public:
  OpenTable(const std::string& name, std::vector<Value> arguments) {
    static const Registry registry = make_registry();
    std::vector<TypeExpr> types;
    for (const Value& argument : arguments) types.emplace_back(argument.type().name());
    const auto resolved = registry.resolve(*registry.find_operator(name), types);
    auto rows = Registry::rows(*resolved, arguments, context_);
    source_ = *std::move(rows);
  }
  /// Up to `count` further rows as texts.
  std::vector<std::string> read(std::size_t count = ~std::size_t{0}) {
    std::vector<std::string> texts;
    while (texts.size() < count) {
      const auto row = source_->next(context_);
      EXPECT_TRUE(row.ok());
      if (!row.ok() || !*row) break;
      std::string text;
      for (const Value& cell : **row) text += cell.to_nested().print() + " ";
      texts.push_back(text);
    }
    return texts;
  }
  std::vector<std::string> diagnostics() const { return diagnostics_.summary(); }

 private:
  Diagnostics diagnostics_;
  Context context_{.diagnostics = diagnostics_, .cancel = nullptr, .folder = {}};
  RowSourcePtr source_;
};

PointArray thirds(const PointArray& points) {
  PointArray result;
  for (std::size_t i = 0; i < points.size(); ++i) result.push_back(ExactPoint(Rational(1, 3) * points[i].rational()));
  return result;
}

std::uint64_t rationals_made(OpenTable& table, std::size_t rows) {
  reset_exact_counters();
  EXPECT_EQ(table.read(rows).size(), rows);
  return exact_counters().heap_rationals;
}

/// Measures of coordinates that are not doubles take rationals, which are counted.
TEST(MeshRows, that_are_not_read_are_not_made) {
  const samples::Triangles torus = samples::torus(30, 40);
  const Mesh3d mesh(samples::polygon_mesh(samples::polygons_of(torus), thirds(samples::torus_points(30, 40))));
  const std::vector<std::pair<std::string, std::size_t>> tables = {
      {"vertices", 1200}, {"edges", 3600}, {"faces", 2400}};
  for (const auto& [name, count] : tables) {
    OpenTable table(name, {Value::of(mesh)});
    const std::uint64_t of_ten = rationals_made(table, 10), of_rest = rationals_made(table, count - 10);
    EXPECT_GT(of_ten, 0U) << name;
    EXPECT_LT(of_ten * (count - 10), of_rest * 20) << name;
    EXPECT_TRUE(table.read().empty()) << name;
  }
}

/// A fan of triangles about vertex 0: the rows of all neighbourhoods of edges cost as much as the rows, not as the hub
/// each time.
TEST(MeshRows, of_edges_at_a_hub_look_at_it_once) {
  const auto rationals_of_fan = [](std::uint32_t count) {
    std::vector<Vec3> points{{0, 0, 1}};
    samples::PolygonList fan;
    for (std::uint32_t i = 0; i < count; ++i) {
      const double angle = 6 * i / static_cast<double>(count);
      points.push_back({std::cos(angle), std::sin(angle), 0});
      if (i > 0) fan.push_back({0, i, i + 1});
    }
    const Mesh3d mesh(samples::polygon_mesh(fan, thirds(PointArray(std::move(points)))));
    reset_exact_counters();
    for (std::int64_t edge = 0; edge < 2 * std::int64_t{count} - 3; ++edge)
      EXPECT_EQ(OpenTable("edgeVertices", {Value::of(mesh), Value::of(edge)}).read().size(), 2U);
    return exact_counters().heap_rationals;
  };
  const std::uint64_t small = rationals_of_fan(50), large = rationals_of_fan(200);
  EXPECT_GT(small, 0U);
  EXPECT_LT(large, 6 * small);
}

TEST(MeshRows, own_their_mesh) {
  auto value =
      std::make_unique<Value>(Value::of(Mesh3d(samples::polygon_mesh(samples::cube_faces(), samples::cube_points()))));
  OpenTable faces("faces", {*value}), ring("oneRing", {*value, Value::of(0)}), loops("boundaryLoops", {*value});
  value.reset();
  EXPECT_EQ(faces.read().size(), 6U);
  EXPECT_EQ(ring.read().size(), 3U);
  EXPECT_TRUE(loops.read().empty());
}

TEST(MeshRows, are_the_same_for_every_type) {
  const Volume3d solid = calls::cube(calls::point(0, 0, 0), calls::point(2, 3, 4));
  const Surface3d surface = Surface3d::trusted(solid.mesh());
  samples::PolygonList polygons;
  for (const FaceId f : faces(solid.mesh())) {
    const auto t = solid.mesh().triangle(f);
    polygons.push_back({t[0], t[1], t[2]});
  }
  const Mesh3d mesh(samples::polygon_mesh(polygons, solid.mesh().points()));
  for (const char* name : {"vertices", "edges", "halfedges", "faces"}) {
    const auto rows = OpenTable(name, {Value::of(solid)}).read();
    EXPECT_FALSE(rows.empty());
    EXPECT_EQ(OpenTable(name, {Value::of(surface)}).read(), rows);
    EXPECT_EQ(OpenTable(name, {Value::of(mesh)}).read(), rows);
  }
  for (const char* name :
       {"oneRing", "vertexEdges", "vertexFaces", "edgeVertices", "edgeEdges", "edgeFaces", "faceVertices", "faceEdges",
        "faceFaces", "outgoingHalfedges", "incomingHalfedges", "faceHalfedges", "halfedge"}) {
    for (int i = 0; i < 8; ++i) {
      const auto rows = OpenTable(name, {Value::of(solid), Value::of(i)}).read();
      EXPECT_FALSE(rows.empty());
      EXPECT_EQ(OpenTable(name, {Value::of(surface), Value::of(i)}).read(), rows);
      EXPECT_EQ(OpenTable(name, {Value::of(mesh), Value::of(i)}).read(), rows);
    }
  }
}

/// The rows of neighbours are those of the whole table with the same Id.
TEST(MeshRows, of_neighbours_are_those_of_the_table) {
  for (const auto& polygons : samples::all_polygon_lists()) {
    if (polygons.empty()) continue;
    const Mesh3d mesh(samples::polygon_mesh(polygons));
    const auto all = OpenTable("edges", {Value::of(mesh)}).read();
    const auto ids = call("edges", mesh).elements();
    ASSERT_EQ(ids.size(), edge_count(mesh.mesh()));
    for (std::size_t i = 0; i < ids.size(); ++i) ASSERT_EQ(ids[i].get<std::int64_t>(), static_cast<std::int64_t>(i));
    const auto of_face = OpenTable("faceEdges", {Value::of(mesh), Value::of(0)}).read();
    for (const std::string& row : of_face) ASSERT_NE(std::ranges::find(all, row), all.end()) << row;
  }
}

/// Half-edges at a vertex and of a face are those of the table, each once, on all kinds of meshes.
TEST(MeshRows, of_halfedges_are_those_of_the_table) {
  for (const auto& polygons : samples::all_polygon_lists()) {
    if (polygons.empty()) continue;
    const Mesh3d value(samples::polygon_mesh(polygons));
    const auto& mesh = value.mesh();
    const auto all = OpenTable("halfedges", {Value::of(value)}).read();
    const auto expect_rows = [&](const char* name, std::size_t element, const auto& belongs) {
      std::vector<std::string> expected;
      for (const HalfedgeId h : halfedges(mesh))
        if (belongs(h)) expected.push_back(all[h.index()]);
      auto rows = OpenTable(name, {Value::of(value), Value::of(static_cast<std::int64_t>(element))}).read();
      std::ranges::sort(rows);
      std::ranges::sort(expected);
      ASSERT_EQ(rows, expected) << name << " " << element;
    };
    for (const VertexId v : vertices(mesh)) {
      expect_rows("outgoingHalfedges", v.index(), [&](HalfedgeId h) { return mesh.origin(h) == v; });
      expect_rows("incomingHalfedges", v.index(), [&](HalfedgeId h) { return mesh.target(h) == v; });
    }
    for (const FaceId f : faces(mesh))
      expect_rows("faceHalfedges", f.index(), [&](HalfedgeId h) { return mesh.face(h) == f; });
    expect_rows("halfedge", 1, [&](HalfedgeId h) { return h.index() == 1; });
  }
}

TEST(MeshRows, of_no_element_are_none_with_the_reason) {
  const Mesh3d mesh(samples::polygon_mesh(samples::cube_faces(), samples::cube_points()));
  OpenTable ring("oneRing", {Value::of(mesh), Value::of(8)});
  EXPECT_TRUE(ring.read().empty());
  ASSERT_EQ(ring.diagnostics().size(), 1U);
  EXPECT_NE(ring.diagnostics()[0].find("there is no vertex 8: expected a number from 0 to 7"), std::string::npos)
      << ring.diagnostics()[0];
  OpenTable edges("edgeFaces", {Value::of(Mesh3d()), Value::of(0)});
  EXPECT_TRUE(edges.read().empty());
  ASSERT_EQ(edges.diagnostics().size(), 1U);
  EXPECT_NE(edges.diagnostics()[0].find("there is no edge 0: the mesh is empty"), std::string::npos);
}

TEST(MeshRows, end_when_cancelled) {
  const Mesh3d mesh(samples::polygon_mesh(samples::polygons_of(samples::torus(40, 40)), samples::torus_points(40, 40)));
  static const Registry registry = make_registry();
  std::vector<Value> arguments{Value::of(mesh)};
  const std::vector<TypeExpr> types{TypeExpr("mesh3d")};
  Diagnostics diagnostics;
  std::atomic<bool> cancel{false};
  Context context{.diagnostics = diagnostics, .cancel = &cancel, .folder = {}};
  const auto resolved = registry.resolve(*registry.find_operator("faces"), types);
  auto rows = Registry::rows(*resolved, arguments, context);
  ASSERT_TRUE((*rows)->next(context).ok());
  cancel = true;
  std::size_t count = 1;
  auto row = (*rows)->next(context);
  for (; row.ok() && *row; row = (*rows)->next(context)) ++count;
  ASSERT_FALSE(row.ok());
  EXPECT_EQ(row.error().code, ErrorCode::interrupted);
  EXPECT_LT(count, 2000U);
}

/// V - E + F of a mesh by its tables, and by its operator.
TEST(Topology, euler_characteristic_counts_rows) {
  for (const auto& polygons : samples::all_polygon_lists()) {
    const Mesh3d mesh(samples::polygon_mesh(polygons));
    std::int64_t used = 0;
    for (const VertexId v : vertices(mesh.mesh())) used += mesh.mesh().is_isolated(v) ? 0 : 1;
    const auto count = [&](const char* name) { return static_cast<std::int64_t>(call(name, mesh).elements().size()); };
    ASSERT_EQ(call("eulerCharacteristic", mesh).get<std::int64_t>(), used - count("edges") + count("faces"));
    ASSERT_EQ(count("vertices"), static_cast<std::int64_t>(mesh.mesh().vertex_count()));
  }
}

TEST(Topology, isolated_vertices_have_rows_without_normal) {
  const Mesh3d mesh(samples::polygon_mesh({}, PointArray(std::vector<Vec3>{{1, 2, 3}})));
  EXPECT_EQ(OpenTable("vertices", {Value::of(mesh)}).read(),
            (std::vector<std::string>{"0 (1.0 2.0 3.0) 0 undefined FALSE TRUE undefined "}));
  EXPECT_EQ(call("eulerCharacteristic", mesh).get<std::int64_t>(), 0);
}

}  // namespace
}  // namespace algebra3d
