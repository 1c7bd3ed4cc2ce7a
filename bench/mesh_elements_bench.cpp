// Rows of the table operators on meshes, and what vertices of high valence cost: a fan of triangles about one vertex
// beside a strip, which has as many triangles, vertices and boundary edges, and two fans that close each other beside a
// sphere of as many triangles and vertices. Ratios of such lines show whether anything is more than linear in the
// valence. The argument is a frequency f, for 20 f^2 triangles.
#include <benchmark/benchmark.h>

#include <optional>
#include <string>
#include <vector>

#include "algebra3d/kernel/halfedge/audit.h"
#include "algebra3d/kernel/halfedge/normals.h"
#include "algebra3d/operators/descriptions/all.h"
#include "algebra3d/values/types/scalars.h"
#include "algebra3d/values/types/spatial.h"
#include "shapes.h"

namespace {

using namespace bench;
using namespace algebra3d;

enum class Kind : std::uint8_t { fan, strip, double_fan, sphere };

/// Vertex 0 and a circle about it; the last vertex, above, is for the other hub of a double fan.
Shape fan(std::uint32_t count, bool is_double) {
  Shape shape;
  shape.points.push_back({0, 0, 0});
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    shape.points.push_back({std::cos(angle), std::sin(angle), 0});
    const std::uint32_t here = 1 + i, next = 1 + (i + 1) % count;
    shape.triangles.push_back({0, here, next});
    if (is_double) shape.triangles.push_back({count + 1, next, here});
  }
  if (is_double) shape.points.push_back({0, 0, -1});
  return shape;
}

Shape strip(std::uint32_t count) {
  Shape shape;
  for (std::uint32_t i = 0; i < count + 2; ++i) shape.points.push_back({0.5 * i, i % 2 == 0 ? 0.0 : 1.0, 0});
  for (std::uint32_t i = 0; i < count; ++i)
    shape.triangles.push_back(i % 2 == 0 ? TriangleMesh::Triangle{i, i + 2, i + 1}
                                         : TriangleMesh::Triangle{i, i + 1, i + 2});
  return shape;
}

Shape shape_of(Kind kind, const benchmark::State& state) {
  const auto f = static_cast<std::uint32_t>(state.range(0));
  if (kind == Kind::fan) return fan(20 * f * f, false);
  if (kind == Kind::strip) return strip(20 * f * f);
  return kind == Kind::double_fan ? fan(10 * f * f, true) : sphere(f);
}

void build(benchmark::State& state, Kind kind) {
  const Shape shape = shape_of(kind, state);
  const PointArray points{std::vector<Vec3>(shape.points)};
  for (auto step : state) {
    const TriangleMesh mesh(points, shape.triangles);
    benchmark::DoNotOptimize(mesh.face_count());
  }
}

void audit_mesh(benchmark::State& state, Kind kind) {
  const TriangleMesh mesh = mesh_of(shape_of(kind, state));
  for (auto step : state) benchmark::DoNotOptimize(audit(mesh).size());
}

/// Reads all rows, or the first `limit`.
std::size_t read(const Registry& registry, const std::string& name, std::vector<Value> arguments,
                 std::size_t limit = ~std::size_t{0}) {
  std::vector<TypeExpr> types;
  for (const Value& argument : arguments) types.emplace_back(argument.type().name());
  const auto call = registry.resolve(*registry.find_operator(name), types);
  Diagnostics diagnostics;
  Context context{.diagnostics = diagnostics, .cancel = nullptr, .folder = {}};
  const auto rows = Registry::rows(*call, arguments, context);
  std::size_t count = 0;
  while (count < limit) {
    const auto row = (*rows)->next(context);
    if (!row.ok() || !*row) break;
    ++count;
  }
  return count;
}

void stream(benchmark::State& state, Kind kind, const std::string& name) {
  const Registry registry = make_registry();
  const Value value = Value::of(Surface3d::trusted(mesh_of(shape_of(kind, state))));
  for (auto step : state) state.counters["rows"] = static_cast<double>(read(registry, name, {value}));
}

void stream_neighbours(benchmark::State& state, const std::string& name) {
  const Registry registry = make_registry();
  const Value value = Value::of(Surface3d::trusted(mesh_of(shape_of(Kind::fan, state))));
  for (auto step : state) state.counters["rows"] = static_cast<double>(read(registry, name, {value, Value::of(0)}));
}

void first_ten(benchmark::State& state, const std::string& name) {
  const Registry registry = make_registry();
  const Value value = Value::of(Surface3d::trusted(mesh_of(shape_of(Kind::sphere, state))));
  for (auto step : state) state.counters["rows"] = static_cast<double>(read(registry, name, {value}, 10));
}

void normals(benchmark::State& state, bool of_vertices) {
  const TriangleMesh mesh = mesh_of(shape_of(Kind::sphere, state));
  const std::vector<Vec3> of_faces = face_normals(mesh);
  for (auto step : state) benchmark::DoNotOptimize((of_vertices ? vertex_normals(mesh) : face_normals(mesh)).data());
}

constexpr int kLarge = 224;  // 1,003,520 triangles
constexpr int kFan = 71;     // 100,820 triangles

BENCHMARK_CAPTURE(build, fan, Kind::fan)->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build, strip, Kind::strip)->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build, double_fan, Kind::double_fan)->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build, sphere, Kind::sphere)->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(audit_mesh, fan, Kind::fan)->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(audit_mesh, strip, Kind::strip)->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(audit_mesh, double_fan, Kind::double_fan)->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(audit_mesh, sphere, Kind::sphere)->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream, fan_vertices, Kind::fan, "vertices")->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream, strip_vertices, Kind::strip, "vertices")->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream, fan_edges, Kind::fan, "edges")->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream, strip_edges, Kind::strip, "edges")->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream, fan_faces, Kind::fan, "faces")->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream, strip_faces, Kind::strip, "faces")->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream_neighbours, fan_one_ring, "oneRing")->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream_neighbours, fan_edges, "vertexEdges")->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream_neighbours, fan_faces, "vertexFaces")->Arg(kFan)->Unit(benchmark::kMillisecond);

BENCHMARK_CAPTURE(stream, faces, Kind::sphere, "faces")->Arg(kLarge)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream, vertices, Kind::sphere, "vertices")->Arg(kLarge)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream, edges, Kind::sphere, "edges")->Arg(kLarge)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream, halfedges, Kind::sphere, "halfedges")->Arg(kLarge)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(first_ten, faces, "faces")->Arg(kLarge)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(first_ten, edges, "edges")->Arg(kLarge)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(normals, faces, false)->Arg(kLarge)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(normals, vertices, true)->Arg(kLarge)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
