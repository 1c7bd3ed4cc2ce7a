// The comparison of data structures for triangle meshes of [campagna1998]: bytes per triangle, and the time of one
// query in a traversal of a whole mesh of 999,698 triangles; structures without neighbours search, so they get few
// queries. All queries of a kind must find the same. Also its measurement of directed edges: triangles removed per
// second when a mesh is thinned to a tenth, at two resolutions.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <map>
#include <string>
#include <type_traits>

#include "indexed_faces.h"
#include "mesh_structures/directed_edges.h"
#include "mesh_structures/half_edges.h"
#include "mesh_structures/library.h"
#include "mesh_structures/thinning.h"
#include "mesh_structures/triangle_lists.h"
#include "mesh_structures/winged_edges.h"

namespace {

using namespace bench;
using namespace bench::structures;

enum class Query : std::uint8_t { ring, faces_round, edge_faces, neighbours };

TriangleMesh torus(std::uint32_t side) {
  const IndexedFaces faces = torus_of_triangles(side);
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::size_t h = 0; h < faces.corners.size(); h += 3)
    triangles.push_back({faces.corners[h], faces.corners[h + 1], faces.corners[h + 2]});
  return {PointArray(faces.points), triangles};
}

const TriangleMesh& mesh() {
  static const TriangleMesh made = torus(707);
  return made;
}

/// Result of a traversal, which all structures must have in common.
struct Found {
  std::size_t queries = 0, count = 0;
  std::uint64_t sum = 0;  // of the numbers of vertices or faces, where they have numbers

  void add(std::uint64_t number) { ++count, sum += number; }
  void add(const Vec3& /*point*/) { ++count; }
};

constexpr bool searches(const SingleTriangles*) {
  return true;
}
constexpr bool searches(const SharedVertices*) {
  return true;
}
constexpr bool searches(const void*) {
  return false;
}

/// A vertex as the structure knows it.
template <typename Structure>
auto vertex(Index v) {
  if constexpr (std::is_same_v<Structure, SingleTriangles>)
    return mesh().points().approx()[v];
  else
    return v;
}

template <typename Structure>
Found run(const Structure& structure, Query query, Index step) {
  Found found;
  const auto add = [&](const auto& element) { found.add(element); };
  const auto add_pair = [&](Index f, Index g) { ++found.queries, found.add(std::uint64_t{f} * g); };
  if (query == Query::edge_faces) {
    if constexpr (searches(static_cast<const Structure*>(nullptr)))
      for (Index f = 0; f < structure.face_count(); f += step) structure.visit_edge(f, 0, add_pair);
    else
      structure.visit_edges(add_pair);
    return found;
  }
  const std::size_t size = query == Query::neighbours ? structure.face_count() : structure.vertex_count();
  for (Index i = 0; i < size; i += step, ++found.queries) {
    if (query == Query::ring) structure.visit_ring(vertex<Structure>(i), add);
    if (query == Query::faces_round) structure.visit_faces_round(vertex<Structure>(i), add);
    if (query == Query::neighbours) structure.visit_neighbours(i, add);
  }
  return found;
}

/// By the mesh of the library; of a structure that searches, the faces of edge 0 of a few faces.
Found expected(Query query, Index step, bool searches_edges) {
  if (query != Query::edge_faces || !searches_edges) return run(LibraryMesh(mesh()), query, step);
  Found found;
  for (Index f = 0; f < mesh().face_count(); f += step, ++found.queries)
    found.add(std::uint64_t{f} * mesh().face(mesh().opposite(HalfedgeId(3 * f))).index());
  return found;
}

template <typename Structure>
void traverse(benchmark::State& state, Query query) {
  constexpr bool kSearches = searches(static_cast<const Structure*>(nullptr));
  const Structure structure(mesh());
  const Index step = kSearches ? 100'000 : 1;
  Found found;
  for (auto iteration : state) benchmark::DoNotOptimize(found = run(structure, query, step));
  const Found right = expected(query, step, kSearches);
  const bool has_numbers = !std::is_same_v<Structure, SingleTriangles> || query != Query::ring;
  if (found.count != right.count || found.queries != right.queries || (has_numbers && found.sum != right.sum))
    state.SkipWithError("another result");
  state.counters["bytes_per_triangle"] =
      static_cast<double>(structure.bytes()) / static_cast<double>(structure.face_count());
  state.counters["query"] = benchmark::Counter(
      static_cast<double>(found.queries), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <typename Structure>
void add(const std::string& name) {
  for (const auto& [query, query_name] : {std::pair(Query::ring, "one_ring"),
                                          {Query::faces_round, "faces_round_vertex"},
                                          {Query::edge_faces, "faces_of_edge"},
                                          {Query::neighbours, "faces_round_face"}})
    benchmark::RegisterBenchmark((std::string(query_name) + "/" + name).c_str(), [query =
                                                                                      query](benchmark::State& state) {
      traverse<Structure>(state, query);
    })->Unit(benchmark::kMillisecond);
}

/// The checksum of the torus of that side, thinned to a tenth.
std::size_t expected_checksum(std::uint32_t side) {
  static std::map<std::uint32_t, std::size_t> known;
  const auto found = known.find(side);
  if (found != known.end()) return found->second;
  const TriangleMesh input = torus(side);
  Thinning<SmallEdge> thinning{DirectedEdges<SmallEdge>(input)};
  thinning.thin(input.face_count() / 10);
  return known[side] = thinning.checksum();
}

template <typename Edge>
void thin(benchmark::State& state, std::uint32_t side) {
  const TriangleMesh input = torus(side);
  std::size_t removed = 0;
  for (auto iteration : state) {
    state.PauseTiming();
    Thinning<Edge> thinning{DirectedEdges<Edge>(input)};
    state.ResumeTiming();
    thinning.thin(input.face_count() / 10);
    state.PauseTiming();
    removed += input.face_count() - thinning.face_count();
    if (thinning.checksum() != expected_checksum(side)) state.SkipWithError("another result");
    state.ResumeTiming();
  }
  state.counters["removed"] = benchmark::Counter(static_cast<double>(removed), benchmark::Counter::kIsRate);
}

template <typename Edge>
void add_thinning(const std::string& name) {
  for (const std::uint32_t side : {224U, 707U})
    benchmark::RegisterBenchmark(("thinning/" + name + "/" + std::to_string(2 * side * side)).c_str(),
                                 [side](benchmark::State& state) { thin<Edge>(state, side); })
        ->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
  add<SingleTriangles>("single_triangles");
  add<SharedVertices>("shared_vertex");
  add<WingedEdges>("winged_edge");
  add<HalfEdges>("half_edge");
  add<DirectedEdges<FullEdge>>("directed_edge_full");
  add<DirectedEdges<MediumEdge>>("directed_edge_medium");
  add<DirectedEdges<SmallEdge>>("directed_edge_small");
  add<LibraryMesh>("library");
  add_thinning<FullEdge>("directed_edge_full");
  add_thinning<MediumEdge>("directed_edge_medium");
  add_thinning<SmallEdge>("directed_edge_small");
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
