// Rows of the table operators on meshes, and what a fan of many triangles about one vertex costs beside a sphere of as
// many: the ratio of lines with the same number of triangles shows whether anything is more than linear in the valence.
// In the names, fan and sphere are the shapes; the argument is a frequency f, for 20 f^2 triangles.
#include <benchmark/benchmark.h>

#include <optional>
#include <string>
#include <vector>

#include "algebra3d/halfedge/audit.h"
#include "algebra3d/halfedge/normals.h"
#include "algebra3d/operators/all.h"
#include "algebra3d/types/scalars.h"
#include "algebra3d/types/spatial.h"
#include "shapes.h"

namespace {

using namespace bench;
using namespace algebra3d;

/// A closed fan about vertex 0, in the plane.
Shape fan(std::uint32_t count) {
  Shape shape;
  shape.points.push_back({0, 0, 0});
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    shape.points.push_back({std::cos(angle), std::sin(angle), 0});
    shape.triangles.push_back({0, 1 + i, 1 + (i + 1) % count});
  }
  return shape;
}

Shape shape_of(bool is_fan, const benchmark::State& state) {
  const auto f = static_cast<std::uint32_t>(state.range(0));
  return is_fan ? fan(20 * f * f) : sphere(f);
}

void build(benchmark::State& state, bool is_fan) {
  const Shape shape = shape_of(is_fan, state);
  const PointArray points{std::vector<Vec3>(shape.points)};
  for (auto step : state) {
    const TriangleMesh mesh(points, shape.triangles);
    benchmark::DoNotOptimize(mesh.face_count());
  }
}

void audit_mesh(benchmark::State& state, bool is_fan) {
  const TriangleMesh mesh = mesh_of(shape_of(is_fan, state));
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

void stream(benchmark::State& state, bool is_fan, const std::string& name) {
  const Registry registry = make_registry();
  const Value value = Value::of(Surface3d::trusted(mesh_of(shape_of(is_fan, state))));
  for (auto step : state) state.counters["rows"] = static_cast<double>(read(registry, name, {value}));
}

void stream_neighbours(benchmark::State& state, const std::string& name) {
  const Registry registry = make_registry();
  const Value value = Value::of(Surface3d::trusted(mesh_of(shape_of(true, state))));
  for (auto step : state) state.counters["rows"] = static_cast<double>(read(registry, name, {value, Value::of(0)}));
}

void first_ten(benchmark::State& state, const std::string& name) {
  const Registry registry = make_registry();
  const Value value = Value::of(Surface3d::trusted(mesh_of(shape_of(false, state))));
  for (auto step : state) state.counters["rows"] = static_cast<double>(read(registry, name, {value}, 10));
}

void normals(benchmark::State& state, bool of_vertices) {
  const TriangleMesh mesh = mesh_of(shape_of(false, state));
  const std::vector<Vec3> of_faces = face_normals(mesh);
  for (auto step : state)
    benchmark::DoNotOptimize((of_vertices ? vertex_normals(mesh, of_faces) : face_normals(mesh)).data());
}

constexpr int kLarge = 224;  // 1,003,520 triangles
constexpr int kFan = 71;     // 100,820 triangles

BENCHMARK_CAPTURE(build, fan, true)->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build, sphere, false)->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(audit_mesh, fan, true)->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(audit_mesh, sphere, false)->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream, fan_vertices, true, "vertices")->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream, sphere_vertices, false, "vertices")->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream, fan_edges, true, "edges")->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream, sphere_edges, false, "edges")->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream, fan_faces, true, "faces")->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream, sphere_faces, false, "faces")->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream_neighbours, fan_one_ring, "oneRing")->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream_neighbours, fan_edges, "vertexEdges")->Arg(kFan)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream_neighbours, fan_faces, "vertexFaces")->Arg(kFan)->Unit(benchmark::kMillisecond);

BENCHMARK_CAPTURE(stream, faces, false, "faces")->Arg(kLarge)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream, vertices, false, "vertices")->Arg(kLarge)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream, edges, false, "edges")->Arg(kLarge)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(stream, halfedges, false, "halfedges")->Arg(kLarge)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(first_ten, faces, "faces")->Arg(kLarge)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(first_ten, edges, "edges")->Arg(kLarge)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(normals, faces, false)->Arg(kLarge)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(normals, vertices, true)->Arg(kLarge)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
