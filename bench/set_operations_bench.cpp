// Set operations beside CGAL's corefinement (with inexact and with exact constructions) and its Nef polyhedra, on the
// same solids in the same run. The operation alone is timed: our meshes come with the hierarchy of their boxes, as
// stored values do; CGAL's meshes are copied outside of the time, since corefinement changes them. `hierarchy` says
// what ours takes to make. Compare lines of the same arguments.
#include <benchmark/benchmark.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <memory>
#include <optional>
#include <random>

#include "algebra3d/kernel/arrangement/arrangement.h"
#include "algebra3d/kernel/arrangement/divide_and_conquer.h"
#include "base/scheduler.h"
#include "cgal_mesh.h"
#include "models.h"
#include "page_faults.h"
#include "peak_memory.h"
#include "shapes.h"

namespace {

using namespace bench;
using algebra3d::BoxHierarchy;
using algebra3d::KeepRule;
using algebra3d::Operand;
using algebra3d::WindingVector;
namespace pmp = CGAL::Polygon_mesh_processing;
using Inexact = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;

// ---- ours -----------------------------------------------------------------------------------------------------------

/// A mesh as a stored value has it.
struct Solid {
  TriangleMesh mesh;
  std::unique_ptr<BoxHierarchy> hierarchy;

  explicit Solid(TriangleMesh triangles)
      : mesh(std::move(triangles)), hierarchy(std::make_unique<BoxHierarchy>(mesh)) {}
  explicit Solid(const Shape& shape) : Solid(mesh_of(shape)) {}
  Operand operand(std::uint32_t group) const { return {&mesh, group, hierarchy.get()}; }
};

bool in_any(const WindingVector& h) {
  return h[0] + h[1] > 0;
}
bool in_first_only(const WindingVector& h) {
  return h[0] > 0 && h[1] == 0;
}

TriangleMesh combined(const Solid& a, const Solid& b, const KeepRule& rule) {
  return algebra3d::combine_solids(std::array<Operand, 2>{a.operand(0), b.operand(1)}, rule).value();
}

/// As `union_aggr` does it.
TriangleMesh united(const std::vector<Solid>& solids) {
  std::vector<Operand> operands;
  for (const Solid& solid : solids) operands.push_back(solid.operand(0));
  return algebra3d::unite_solids(operands).value();
}

/// One after the other; the result of each step is made ready for the next one within the time.
TriangleMesh chained(const Shape& first, const std::vector<Solid>& others, const KeepRule& rule) {
  auto sum = std::make_unique<Solid>(first);
  for (const Solid& other : others) sum = std::make_unique<Solid>(combined(*sum, other, rule));
  return std::move(sum->mesh);
}

// ---- CGAL -----------------------------------------------------------------------------------------------------------

using NefKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Nef = CGAL::Nef_polyhedron_3<NefKernel>;

Nef nef_of(const Shape& shape) {
  CGAL::Polyhedron_3<NefKernel> polyhedron;
  CGAL::copy_face_graph(cgal_mesh_of<NefKernel>(shape), polyhedron);
  return Nef(polyhedron);
}

// ---- two spheres ----------------------------------------------------------------------------------------------------

/// bytes_per_triangle: peak memory of the operands, their hierarchies, the operation and its result, per triangle of
/// the operands.
void unite_ours(benchmark::State& state, const Shape& first, const Shape& second) {
  PeakMemory memory;
  const Solid a(first), b(second);
  memory.restart();
  std::size_t faces = combined(a, b, in_any).face_count();
  const double bytes = memory.bytes();
  const double faults_before = page_faults();
  for (auto step : state) faces = combined(a, b, in_any).face_count();
  state.counters["page_faults"] = benchmark::Counter(page_faults() - faults_before, benchmark::Counter::kAvgIterations);
  const auto triangles_in = static_cast<double>(a.mesh.face_count() + b.mesh.face_count());
  state.counters["triangles_in"] = triangles_in;
  state.counters["triangles_out"] = static_cast<double>(faces);
  state.counters["bytes_per_triangle"] = bytes / triangles_in;
}

template <typename Kernel>
void unite_by_corefinement(benchmark::State& state, const Shape& first, const Shape& second) {
  const auto a = cgal_mesh_of<Kernel>(first), b = cgal_mesh_of<Kernel>(second);
  std::size_t faces = 0;
  for (auto step : state) {
    state.PauseTiming();
    auto p = a, q = b;
    CgalMesh<Kernel> result;
    state.ResumeTiming();
    if (!pmp::corefine_and_compute_union(p, q, result)) return state.SkipWithError("refused");
    faces = result.number_of_faces();
  }
  state.counters["triangles_out"] = static_cast<double>(faces);
}

void spheres_ours(benchmark::State& state) {
  const auto n = static_cast<std::uint32_t>(state.range(0));
  unite_ours(state, sphere(n), other_sphere(n));
}
/// Arguments: frequency, and number of threads.
void spheres_threads_ours(benchmark::State& state) {
  const auto n = static_cast<std::uint32_t>(state.range(0));
  algebra3d::with_threads(static_cast<int>(state.range(1)), [&] { unite_ours(state, sphere(n), other_sphere(n)); });
}
void spheres_hierarchy(benchmark::State& state) {
  const Shape shape = sphere(static_cast<std::uint32_t>(state.range(0)));
  for (auto step : state) benchmark::DoNotOptimize(Solid(shape));
}

template <typename Kernel>
void spheres_corefine(benchmark::State& state) {
  const auto n = static_cast<std::uint32_t>(state.range(0));
  unite_by_corefinement<Kernel>(state, sphere(n), other_sphere(n));
}

void spheres_nef(benchmark::State& state) {
  const auto n = static_cast<std::uint32_t>(state.range(0));
  const Nef a = nef_of(sphere(n)), b = nef_of(other_sphere(n));
  for (auto step : state) benchmark::DoNotOptimize((a + b).number_of_facets());
}

BENCHMARK(spheres_ours)->Arg(7)->Arg(22)->Arg(71)->Arg(158)->Unit(benchmark::kMillisecond);
BENCHMARK(spheres_threads_ours)->ArgsProduct({{7, 22, 71, 158}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(spheres_hierarchy)->Arg(71)->Arg(158)->Unit(benchmark::kMillisecond);
BENCHMARK(spheres_corefine<Inexact>)->Arg(7)->Arg(22)->Arg(71)->Arg(158)->Unit(benchmark::kMillisecond);
BENCHMARK(spheres_corefine<Exact>)->Arg(7)->Arg(22)->Arg(71)->Unit(benchmark::kMillisecond);
BENCHMARK(spheres_nef)->Arg(7)->Unit(benchmark::kMillisecond)->Iterations(1);

// ---- a sphere and a copy that nearly coincides with it
// ---------------------------------------------------------------

Shape nearly_the_same(std::uint32_t n) {
  return moved(sphere(n), kAxis, 1e-9, {});
}

void near_coincident_ours(benchmark::State& state) {
  const auto n = static_cast<std::uint32_t>(state.range(0));
  unite_ours(state, sphere(n), nearly_the_same(n));
}

template <typename Kernel>
void near_coincident_corefine(benchmark::State& state) {
  const auto n = static_cast<std::uint32_t>(state.range(0));
  unite_by_corefinement<Kernel>(state, sphere(n), nearly_the_same(n));
}

BENCHMARK(near_coincident_ours)->Arg(32)->Unit(benchmark::kMillisecond);
BENCHMARK(near_coincident_corefine<Inexact>)->Arg(32)->Unit(benchmark::kMillisecond);

// ---- random cubes ---------------------------------------------------------------------------------------------------

std::vector<Shape> random_cubes(std::size_t count) {
  std::mt19937 random(1);  // NOLINT(cert-msc51-cpp): the same cubes in every run
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&](double size) { return Vec3{size * unit(random), size * unit(random), size * unit(random)}; };
  std::vector<Shape> cubes;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 axis = vector(1);
    cubes.push_back(moved(box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}), axis, 3 * unit(random), vector(2.5)));
  }
  return cubes;
}

std::vector<Solid> solids_of(const std::vector<Shape>& shapes) {
  std::vector<Solid> solids;
  for (const Shape& shape : shapes) solids.emplace_back(shape);
  return solids;
}

void cubes_chain_ours(benchmark::State& state) {
  const auto shapes = random_cubes(static_cast<std::size_t>(state.range(0)));
  const auto solids = solids_of(shapes);
  for (auto step : state) benchmark::DoNotOptimize(chained(shapes[0], solids, in_any).face_count());
}
void cubes_aggregate_ours(benchmark::State& state) {
  const auto solids = solids_of(random_cubes(static_cast<std::size_t>(state.range(0))));
  for (auto step : state) benchmark::DoNotOptimize(united(solids).face_count());
}

template <typename Kernel>
void cubes_chain_corefine(benchmark::State& state) {
  const auto shapes = random_cubes(static_cast<std::size_t>(state.range(0)));
  for (auto step : state) {
    auto sum = cgal_mesh_of<Kernel>(shapes[0]);
    for (std::size_t i = 1; i < shapes.size(); ++i) {
      auto other = cgal_mesh_of<Kernel>(shapes[i]);
      CgalMesh<Kernel> result;
      if (!pmp::corefine_and_compute_union(sum, other, result)) return state.SkipWithError("refused");
      sum = std::move(result);
    }
    benchmark::DoNotOptimize(sum.number_of_faces());
  }
}

/// All about one middle, so that each crosses each.
void crossing_cubes_ours(benchmark::State& state) {
  std::vector<Shape> shapes;
  for (std::int64_t i = 1; i <= state.range(0); ++i)
    shapes.push_back(moved(box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}), {1, static_cast<double>(i), 3},
                           7.0 * static_cast<double>(i), {}));
  const auto solids = solids_of(shapes);
  std::size_t faces = 0;
  for (auto step : state) faces = united(solids).face_count();
  state.counters["triangles_out"] = static_cast<double>(faces);
}
BENCHMARK(crossing_cubes_ours)->Arg(50)->Arg(200)->Unit(benchmark::kMillisecond);

BENCHMARK(cubes_chain_ours)->Arg(200)->Unit(benchmark::kMillisecond);
BENCHMARK(cubes_aggregate_ours)->Arg(200)->Unit(benchmark::kMillisecond);
BENCHMARK(cubes_chain_corefine<Inexact>)->Arg(200)->Unit(benchmark::kMillisecond);

// ---- Menger sponge --------------------------------------------------------------------------------------------------

/// Arguments: level, and 1 for the rotated one.
void sponge_ours(benchmark::State& state) {
  const auto level = static_cast<int>(state.range(0));
  const double radians = state.range(1) != 0 ? kRoot2 / 2 : 0;
  const auto solids = solids_of(rods(level, radians));
  std::size_t faces = 0;
  for (auto step : state) faces = chained(sponge_cube(level, radians), solids, in_first_only).face_count();
  state.counters["triangles_out"] = static_cast<double>(faces);
}

template <typename Kernel>
void sponge_corefine(benchmark::State& state) {
  const auto level = static_cast<int>(state.range(0));
  const double radians = state.range(1) != 0 ? kRoot2 / 2 : 0;
  const auto shapes = rods(level, radians);
  std::size_t faces = 0;
  for (auto step : state) {
    auto rest = cgal_mesh_of<Kernel>(sponge_cube(level, radians));
    for (const Shape& shape : shapes) {
      auto rod = cgal_mesh_of<Kernel>(shape);
      CgalMesh<Kernel> result;
      if (!pmp::corefine_and_compute_difference(rest, rod, result)) return state.SkipWithError("refused");
      rest = std::move(result);
    }
    faces = rest.number_of_faces();
  }
  state.counters["triangles_out"] = static_cast<double>(faces);
}

BENCHMARK(sponge_ours)
    ->Args({2, 0})
    ->Args({3, 0})
    ->Args({2, 1})
    ->Args({3, 1})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
BENCHMARK(sponge_corefine<Exact>)
    ->Args({2, 0})
    ->Args({3, 0})
    ->Args({2, 1})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

// ---- real models

const Shape& model_of(const benchmark::State& state) {
  return models().at(static_cast<std::size_t>(state.range(0)));
}

void models_ours(benchmark::State& state) {
  unite_ours(state, model_of(state), copy_of(model_of(state), state.range(1)));
}

template <typename Kernel>
void models_corefine(benchmark::State& state) {
  unite_by_corefinement<Kernel>(state, model_of(state), copy_of(model_of(state), state.range(1)));
}

void with_models(benchmark::internal::Benchmark* benchmark) {
  for (std::int64_t model = 0; model < static_cast<std::int64_t>(models().size()); ++model)
    for (const std::int64_t variant : {0, 1}) benchmark->Args({model, variant});
  benchmark->Unit(benchmark::kMillisecond);
}

void register_models() {
  if (models().empty()) return;  // a benchmark without arguments would run with none
  benchmark::RegisterBenchmark("models_ours", models_ours)->Apply(with_models);
  benchmark::RegisterBenchmark("models_corefine<Inexact>", models_corefine<Inexact>)->Apply(with_models);
}
[[maybe_unused]] const bool kAreModelsRegistered = (register_models(), true);

// ---- grid of touching cubes -----------------------------------------------------------------------------------------

void grid_ours(benchmark::State& state) {
  const auto n = static_cast<int>(state.range(0));
  std::vector<Shape> shapes;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) shapes.push_back(box({double(i), double(j), double(k)}, {i + 1.0, j + 1.0, k + 1.0}));
  const auto solids = solids_of(shapes);
  std::size_t faces = 0;
  for (auto step : state) faces = united(solids).face_count();
  state.counters["triangles_out"] = static_cast<double>(faces);
}
BENCHMARK(grid_ours)->Arg(10)->Arg(20)->Unit(benchmark::kMillisecond)->Iterations(1);

/// The grid with gaps of one unit in the last place.
void gaps_ours(benchmark::State& state) {
  const auto n = static_cast<int>(state.range(0));
  const auto below = [](int i) { return std::nextafter(i + 1.0, 0.0); };
  std::vector<Shape> shapes;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        shapes.push_back(box({double(i), double(j), double(k)}, {below(i), below(j), below(k)}));
  const auto solids = solids_of(shapes);
  std::size_t faces = 0;
  for (auto step : state) faces = united(solids).face_count();
  state.counters["triangles_out"] = static_cast<double>(faces);
}
BENCHMARK(gaps_ours)->Arg(20)->Unit(benchmark::kMillisecond)->Iterations(1);

// ---- many operands inside one another, and apart

void nested_ours(benchmark::State& state) {
  std::vector<Shape> shapes;
  for (std::int64_t i = 1; i <= state.range(0); ++i) {
    const auto r = static_cast<double>(i);
    shapes.push_back(box({-r, -r, -r}, {r, r, r}));
  }
  const auto solids = solids_of(shapes);
  for (auto step : state) benchmark::DoNotOptimize(united(solids).face_count());
}
void apart_ours(benchmark::State& state) {
  std::vector<Shape> shapes;
  for (int i = 0; i < state.range(0); ++i) {
    const double x = 2 * (i % 18), y = 2 * (i / 18 % 18), z = 2 * (i / 324);
    shapes.push_back(box({x, y, z}, {x + 1, y + 1, z + 1}));
  }
  const auto solids = solids_of(shapes);
  for (auto step : state) benchmark::DoNotOptimize(united(solids).face_count());
}
BENCHMARK(nested_ours)->Arg(1250)->Arg(2500)->Arg(5000)->Unit(benchmark::kMillisecond);
BENCHMARK(apart_ours)->Arg(1250)->Arg(2500)->Arg(5000)->Unit(benchmark::kMillisecond);

}  // namespace
