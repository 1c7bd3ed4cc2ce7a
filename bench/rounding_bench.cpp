// The way out of exactness: rounding of results to doubles, with its proof, beside the proof of the operands and the
// operation (ours), and beside CGAL's corefinement with inexact constructions, whose rounded result may cross itself,
// and its test whether it does. Compare lines of the same arguments.
#include <benchmark/benchmark.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include "algebra3d/kernel/arrangement/divide_and_conquer.h"
#include "algebra3d/kernel/rounding/rounded_solid.h"
#include "algebra3d/kernel/validity/validity.h"
#include "cgal_mesh.h"
#include "models.h"
#include "shapes.h"

namespace {

using namespace bench;
using algebra3d::CoordinateGrid;
using algebra3d::Operand;
using algebra3d::WindingVector;
namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

std::uint32_t frequency(const benchmark::State& state) {
  return static_cast<std::uint32_t>(state.range(0));
}

TriangleMesh united(const TriangleMesh& a, const TriangleMesh& b) {
  const auto in_any = [](const WindingVector& h) { return h[0] + h[1] > 0; };
  return algebra3d::combine_solids(std::array<Operand, 2>{{{&a, 0}, {&b, 1}}}, in_any).value();
}

void round_in_steps(benchmark::State& state, const TriangleMesh& solid, const CoordinateGrid& grid) {
  for (auto step : state) {
    const auto rounded = algebra3d::rounded_solid(solid, grid).value();
    if (!rounded.mesh) return state.SkipWithError(rounded.reason.c_str());
    state.counters["triangles_in"] = static_cast<double>(solid.face_count());
    state.counters["triangles_out"] = static_cast<double>(rounded.mesh->face_count());
    state.counters["moved"] = static_cast<double>(rounded.moved_vertices);
    state.counters["distance"] = rounded.largest_movement / grid.spacing_up_to(1);
  }
}

void spheres_proof(benchmark::State& state) {
  const TriangleMesh a = mesh_of(sphere(frequency(state))), b = mesh_of(other_sphere(frequency(state)));
  for (auto step : state)
    benchmark::DoNotOptimize(prove_volume(a).value().is_valid() && prove_volume(b).value().is_valid());
}

void spheres_union(benchmark::State& state) {
  const TriangleMesh a = mesh_of(sphere(frequency(state))), b = mesh_of(other_sphere(frequency(state)));
  for (auto step : state) benchmark::DoNotOptimize(united(a, b).face_count());
}

void spheres_rounding(benchmark::State& state) {
  round_in_steps(state, united(mesh_of(sphere(frequency(state))), mesh_of(other_sphere(frequency(state)))),
                 CoordinateGrid::doubles());
}

/// The operation of the peer, and whether its result crosses itself.
void spheres_cgal_union_and_test(benchmark::State& state) {
  const CgalMesh<Kernel> a = cgal_mesh_of<Kernel>(sphere(frequency(state))),
                         b = cgal_mesh_of<Kernel>(other_sphere(frequency(state)));
  for (auto step : state) {
    state.PauseTiming();
    auto p = a, q = b;
    CgalMesh<Kernel> result;
    state.ResumeTiming();
    if (!pmp::corefine_and_compute_union(p, q, result)) return state.SkipWithError("refused");
    state.counters["crosses_itself"] = static_cast<double>(pmp::does_self_intersect(result));
  }
}

void with_sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(7)->Arg(22)->Arg(71)->Arg(158)->Unit(benchmark::kMillisecond)->UseRealTime();
}
BENCHMARK(spheres_proof)->Apply(with_sizes);
BENCHMARK(spheres_union)->Apply(with_sizes);
BENCHMARK(spheres_rounding)->Apply(with_sizes);
BENCHMARK(spheres_cgal_union_and_test)->Apply(with_sizes);

// ---- hard cases -----------------------------------------------------------------------------------------------------

/// A sphere without itself, turned by 10^-n degrees: walls of some thousand to some ten units. Arguments: frequency, n,
/// and 1 for floats.
void thin_shell_rounding(benchmark::State& state) {
  const double radians = std::pow(10.0, -static_cast<double>(state.range(1))) * std::numbers::pi / 180;
  const Shape shape = sphere(frequency(state));
  const TriangleMesh a = mesh_of(shape), b = mesh_of(moved(shape, {1, 2, 3}, radians, {}));
  const auto in_first_only = [](const WindingVector& h) { return h[0] > 0 && h[1] == 0; };
  const TriangleMesh solid =
      algebra3d::combine_solids(std::array<Operand, 2>{{{&a, 0}, {&b, 1}}}, in_first_only).value();
  round_in_steps(state, solid, state.range(2) != 0 ? CoordinateGrid::floats() : CoordinateGrid::doubles());
}
BENCHMARK(thin_shell_rounding)
    ->Args({7, 6, 0})
    ->Args({7, 10, 0})
    ->Args({22, 6, 0})
    ->Args({22, 10, 0})
    ->Args({22, 3, 1})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1)
    ->UseRealTime();

// ---- real models ----------------------------------------------------------------------------------------------------

/// The complete way, for a model (ALGEBRA3D_MODELS) united with a turned copy: the proof of both operands, the
/// operation, and the rounding.
struct ModelPair {
  explicit ModelPair(const benchmark::State& state)
      : first(mesh_of(models().at(static_cast<std::size_t>(state.range(0))))),
        second(mesh_of(copy_of(models().at(static_cast<std::size_t>(state.range(0))), 0))) {}

  TriangleMesh first, second;
};

void models_proof(benchmark::State& state) {
  const ModelPair pair(state);
  for (auto step : state)
    benchmark::DoNotOptimize(prove_volume(pair.first)->is_valid() && prove_volume(pair.second)->is_valid());
}
void models_union(benchmark::State& state) {
  const ModelPair pair(state);
  for (auto step : state) benchmark::DoNotOptimize(united(pair.first, pair.second).face_count());
}
void models_rounding(benchmark::State& state) {
  const ModelPair pair(state);
  round_in_steps(state, united(pair.first, pair.second), CoordinateGrid::doubles());
}

void with_models(benchmark::internal::Benchmark* benchmark) {
  for (std::int64_t model = 0; model < static_cast<std::int64_t>(models().size()); ++model) benchmark->Arg(model);
  benchmark->Unit(benchmark::kMillisecond)->UseRealTime();
}

void register_models() {
  if (models().empty()) return;  // a benchmark without arguments would run with none
  benchmark::RegisterBenchmark("models_proof", models_proof)->Apply(with_models);
  benchmark::RegisterBenchmark("models_union", models_union)->Apply(with_models);
  benchmark::RegisterBenchmark("models_rounding", models_rounding)->Apply(with_models);
}
[[maybe_unused]] const bool kAreModelsRegistered = (register_models(), true);

}  // namespace
