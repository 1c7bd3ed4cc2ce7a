// Ten tasks with the library algebra3d::mesh, for the comparison in docs/mesh_library.md: each is a function, whose
// lines and time are counted. A torus of 320,000 triangles, coordinates as doubles.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <ranges>
#include <span>
#include <string>
#include <vector>

#include "algebra3d/mesh/builder.h"
#include "algebra3d/mesh/editor.h"
#include "algebra3d/mesh/files.h"
#include "algebra3d/mesh/mesh.h"
#include "algebra3d/mesh/normals.h"
#include "algebra3d/mesh/operations.h"
#include "algebra3d/mesh/topology.h"

namespace {

using namespace algebra3d;        // NOLINT(google-build-using-namespace): as a user's program
using namespace algebra3d::mesh;  // NOLINT(google-build-using-namespace)
using Mesh3 = algebra3d::mesh::TriangleMesh;
using Polygons = algebra3d::mesh::PolygonMesh;

std::string torus_file() {
  return (std::filesystem::temp_directory_path() / "mesh_library_bench.off").string();
}

const Mesh3& torus() {
  static const Mesh3 mesh = [] {
    constexpr std::uint32_t kSide = 400;
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t y = 0; y < kSide; ++y)
      for (std::uint32_t x = 0; x < kSide; ++x) {
        const double a = 2 * std::numbers::pi * x / kSide, b = 2 * std::numbers::pi * y / kSide;
        points.push_back({(3 + std::cos(b)) * std::cos(a), (3 + std::cos(b)) * std::sin(a), std::sin(b)});
        const auto v = [&](std::uint32_t dx, std::uint32_t dy) { return (y + dy) % kSide * kSide + (x + dx) % kSide; };
        triangles.push_back({v(0, 0), v(1, 0), v(1, 1)});
        triangles.push_back({v(0, 0), v(1, 1), v(0, 1)});
      }
    return *Mesh3::of_triangles(points, triangles);
  }();
  return mesh;
}

// The tasks. Each returns a number by which the results of libraries are compared.

double read_file(const Mesh3& /*mesh*/) {
  return static_cast<double>(read_mesh(torus_file())->mesh.face_count());
}

double one_rings(const Mesh3& mesh) {
  double sum = 0;
  for (const VertexId v : vertices(mesh)) {
    Vec3 centre;
    double count = 0;
    for (const VertexId n : adjacent_vertices(mesh, v)) centre = centre + mesh.point(n), ++count;
    sum += length(1 / count * centre - mesh.point(v));
  }
  return sum;
}

double longest_edge(const Mesh3& mesh) {
  return std::ranges::max(edges(mesh) | std::views::transform([&](EdgeId e) {
                            const auto [a, b] = mesh.ends(e);
                            return length(mesh.point(a) - mesh.point(b));
                          }));
}

double neighbours_of_faces(const Mesh3& mesh) {
  double sum = 0;
  for (const FaceId f : faces(mesh))
    for (const FaceId g : adjacent_faces(mesh, f)) sum += g.index();
  return sum;
}

double normals_of_vertices(const Mesh3& mesh) {
  return vertex_normals(mesh)[7].x;
}

double attribute_of_faces(const Mesh3& mesh) {
  std::vector<double> heights;
  for (const FaceId f : faces(mesh))
    heights.push_back(
        std::ranges::max(vertices_of(mesh, f) | std::views::transform([&](VertexId v) { return mesh.point(v).z; })));
  const Mesh3 with = *mesh.with_attribute<FaceId>("height", heights);
  const auto height = *with.attribute<FaceId, double>("height");
  double sum = 0;
  for (const FaceId f : faces(with)) sum += height[f];
  return sum;
}

double holes(const Mesh3& mesh) {
  MeshBuilder builder{Polygons(mesh)};
  for (std::uint32_t f = 0; f < mesh.face_count(); f += 1000)
    if (!builder.remove_face(FaceId(f))) return 0;
  return static_cast<double>(boundary_loops(*builder.mesh()).size());
}

double split_edges(const Mesh3& mesh) {
  MeshEditor editor = *MeshEditor::of(mesh);
  for (std::uint32_t h = 0; h < mesh.halfedge_count(); h += 100) {
    const HalfedgeId edge(h);
    if (!editor.split_edge(edge, 0.5 * editor.point(editor.origin(edge)) + 0.5 * editor.point(editor.target(edge))))
      return 0;
  }
  return static_cast<double>(editor.triangle_mesh()->face_count());
}

double subdivide(const Mesh3& mesh) {
  return static_cast<double>(subdivided(mesh, "loop", 1)->face_count());
}

double simplify(const Mesh3& mesh) {
  return static_cast<double>(simplified(mesh, {.triangles = mesh.face_count() / 10})->face_count());
}

// The end of the tasks.

void measure(const char* name, double (*task)(const Mesh3&)) {
  benchmark::RegisterBenchmark(name,
                               [task](benchmark::State& state) {
                                 double result = 0;
                                 for (auto _ : state) result = task(torus());
                                 state.counters["result"] = result;
                               })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

}  // namespace

int main(int argc, char** argv) {
  if (!write_mesh(torus(), torus_file(), "off")) return EXIT_FAILURE;
  measure("read a file", read_file);
  measure("one-rings of all vertices", one_rings);
  measure("longest edge", longest_edge);
  measure("neighbours of all faces", neighbours_of_faces);
  measure("normals of all vertices", normals_of_vertices);
  measure("attribute of faces", attribute_of_faces);
  measure("remove faces and count holes", holes);
  measure("split edges", split_edges);
  measure("subdivide (Loop)", subdivide);
  measure("simplify to a tenth", simplify);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return EXIT_SUCCESS;
}
