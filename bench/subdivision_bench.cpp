// One step of Loop and Catmull-Clark beside those of CGAL::Surface_mesh and OpenMesh, on closed meshes whose links are
// at hand; the copy that the peers change in place is not timed. Compare lines of the same argument: the number of
// thousands of triangles or quadrilaterals after the step.
#include <benchmark/benchmark.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>

#ifdef BENCH_WITH_OPENMESH
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/CatmullClarkT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#endif

#include <cmath>
#include <cstdint>
#include <vector>

#include "algebra3d/kernel/subdivision/subdivided.h"
#include "base/scheduler.h"
#include "indexed_faces.h"

namespace {

using namespace bench;
using algebra3d::PolygonLayout;
using algebra3d::PolygonMesh;
using algebra3d::SubdivisionScheme;

/// A sphere of about a quarter of so many thousands of triangles.
IndexedFaces triangles_for(std::int64_t thousands) {
  const Shape shape = sphere(static_cast<std::uint32_t>(std::sqrt(static_cast<double>(thousands) * 250 / 20)));
  IndexedFaces faces{shape.points, {}, 3};
  for (const auto& t : shape.triangles) faces.corners.insert(faces.corners.end(), t.begin(), t.end());
  return faces;
}

/// A torus of about a quarter of so many thousands of quadrilaterals.
IndexedFaces quadrilaterals_for(std::int64_t thousands) {
  return torus_of_quadrilaterals(static_cast<std::uint32_t>(std::sqrt(static_cast<double>(thousands) * 250)));
}

IndexedFaces faces_for(SubdivisionScheme scheme, std::int64_t thousands) {
  return scheme == SubdivisionScheme::loop ? triangles_for(thousands) : quadrilaterals_for(thousands);
}

void ours(benchmark::State& state, SubdivisionScheme scheme, int threads) {
  const IndexedFaces faces = faces_for(scheme, state.range(0));
  const PolygonMesh mesh(PointArray(faces.points), PolygonLayout::of_degree(faces.degree),
                         {faces.corners.begin(), faces.corners.end()});
  std::size_t count = 0;
  const auto work = [&] {
    for (auto step : state) {
      auto result = algebra3d::subdivided(mesh, scheme, 1);
      count = result->face_count();
      state.PauseTiming();
      result = PolygonMesh();
      state.ResumeTiming();
    }
  };
  if (threads == 0)
    work();
  else
    algebra3d::with_threads(threads, work);
  state.counters["faces"] = static_cast<double>(count);
}

using CgalMesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

void cgal(benchmark::State& state, SubdivisionScheme scheme) {
  const IndexedFaces faces = faces_for(scheme, state.range(0));
  CgalMesh mesh;
  for (const Vec3& p : faces.points) mesh.add_vertex({p.x, p.y, p.z});
  for (std::size_t h = 0; h < faces.corners.size(); h += faces.degree) {
    std::vector<CgalMesh::Vertex_index> corners;
    for (std::size_t i = 0; i < faces.degree; ++i) corners.emplace_back(faces.corners[h + i]);
    mesh.add_face(corners);
  }
  std::size_t count = 0;
  for (auto step : state) {
    state.PauseTiming();
    CgalMesh copy = mesh;
    state.ResumeTiming();
    const auto one = CGAL::parameters::number_of_iterations(1);
    if (scheme == SubdivisionScheme::loop)
      CGAL::Subdivision_method_3::Loop_subdivision(copy, one);
    else
      CGAL::Subdivision_method_3::CatmullClark_subdivision(copy, one);
    state.PauseTiming();
    count = copy.number_of_faces();
    copy.clear();
    state.ResumeTiming();
  }
  state.counters["faces"] = static_cast<double>(count);
}

#ifdef BENCH_WITH_OPENMESH
struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using Triangles = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using Polygons = OpenMesh::PolyMesh_ArrayKernelT<Traits>;

template <typename Mesh, typename Subdivider>
void openmesh(benchmark::State& state, SubdivisionScheme scheme) {
  const IndexedFaces faces = faces_for(scheme, state.range(0));
  Mesh mesh;
  for (const Vec3& p : faces.points) mesh.add_vertex({p.x, p.y, p.z});
  for (std::size_t h = 0; h < faces.corners.size(); h += faces.degree) {
    std::vector<typename Mesh::VertexHandle> corners;
    for (std::size_t i = 0; i < faces.degree; ++i) corners.emplace_back(static_cast<int>(faces.corners[h + i]));
    mesh.add_face(corners);
  }
  std::size_t count = 0;
  for (auto step : state) {
    state.PauseTiming();
    Mesh copy = mesh;
    state.ResumeTiming();
    {
      Subdivider subdivider;
      subdivider.attach(copy);
      subdivider(1);
      subdivider.detach();
    }
    state.PauseTiming();
    count = copy.n_faces();
    copy = Mesh();
    state.ResumeTiming();
  }
  state.counters["faces"] = static_cast<double>(count);
}
#endif

void add(const char* name, SubdivisionScheme scheme, void (*run)(benchmark::State&, SubdivisionScheme)) {
  auto* made = benchmark::RegisterBenchmark(name, [=](benchmark::State& state) { run(state, scheme); });
  made->Unit(benchmark::kMillisecond)->UseRealTime();
  const std::int64_t thousands = scheme == SubdivisionScheme::loop ? 1000 : 500;
  made->Arg(thousands)->Arg(4 * thousands);
}

}  // namespace

int main(int argc, char** argv) {
  const auto kLoop = SubdivisionScheme::loop, kCatmullClark = SubdivisionScheme::catmull_clark;
  const auto all_threads = [](benchmark::State& state, SubdivisionScheme scheme) { ours(state, scheme, 0); };
  const auto one_thread = [](benchmark::State& state, SubdivisionScheme scheme) { ours(state, scheme, 1); };
  add("loop/ours", kLoop, all_threads);
  add("loop/ours_one_thread", kLoop, one_thread);
  add("loop/cgal", kLoop, cgal);
  add("catmull_clark/ours", kCatmullClark, all_threads);
  add("catmull_clark/ours_one_thread", kCatmullClark, one_thread);
  add("catmull_clark/cgal", kCatmullClark, cgal);
#ifdef BENCH_WITH_OPENMESH
  using OpenMesh::Subdivider::Uniform::CatmullClarkT;
  using OpenMesh::Subdivider::Uniform::LoopT;
  add("loop/openmesh", kLoop, openmesh<Triangles, LoopT<Triangles>>);
  add("catmull_clark/openmesh", kCatmullClark, openmesh<Polygons, CatmullClarkT<Polygons>>);
#endif
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
