// Times of what is drawn of a solid: its shape, the search tree, the file, and levels of detail beside meshoptimizer's
// sloppy simplification. The solid is a sphere with waves, its triangles in spatial order as after an import. The
// argument is the frequency of the sphere: 224 gives a million triangles, 707 ten million. `deviation` is how far
// vertices were moved, in parts of a million of the radius.
#include <benchmark/benchmark.h>

#ifdef BENCH_WITH_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "algebra3d/kernel/soup/spatial_order.h"
#include "algebra3d/values/display/glb.h"
#include "algebra3d/values/display/levels_of_detail.h"
#include "algebra3d/values/display/shape_of_value.h"
#include "algebra3d/values/display/triangle_tree.h"
#include "algebra3d/values/types/codec.h"
#include "algebra3d/values/types/spatial.h"
#include "shapes.h"

namespace {

using algebra3d::Value;

const Value& solid(const benchmark::State& state) {
  static std::map<std::int64_t, Value> solids;
  const std::int64_t frequency = state.range(0);
  if (const auto found = solids.find(frequency); found != solids.end()) return found->second;
  bench::DrawnShape shape = bench::sphere(static_cast<std::uint32_t>(frequency));
  for (algebra3d::Vec3& p : shape.points)
    p = (1 + 0.05 * std::sin(7 * p.x) * std::cos(9 * p.y) + 0.01 * std::sin(31 * p.z + 20 * p.x)) * p;
  const algebra3d::TriangleMesh mesh(algebra3d::PointArray(std::move(shape.points)), shape.triangles);
  return solids.emplace(frequency, Value::of(algebra3d::Volume3d::trusted(algebra3d::in_spatial_order(mesh))))
      .first->second;
}

void decoding(benchmark::State& state) {
  const std::string bytes = algebra3d::encode(solid(state));
  for (auto step : state)
    benchmark::DoNotOptimize(
        algebra3d::decode(algebra3d::TypeOf<algebra3d::Volume3d>::type(), bytes, algebra3d::Origin::own_store));
  state.counters["MB"] = static_cast<double>(bytes.size()) / 1e6;
}

void whole_shape(benchmark::State& state) {
  const Value& value = solid(state);
  for (auto step : state) benchmark::DoNotOptimize(algebra3d::shape_of(value));
}

void search_tree(benchmark::State& state) {
  const algebra3d::DrawnShape shape = *algebra3d::shape_of(solid(state));
  for (auto step : state) {
    state.PauseTiming();
    algebra3d::DrawnShape copy = shape;
    state.ResumeTiming();
    algebra3d::add_tree(copy);
    state.counters["moved"] = copy.face_ids.empty() ? 0 : 1;
  }
}

void file(benchmark::State& state) {
  algebra3d::DrawnShape shape = *algebra3d::shape_of(solid(state));
  algebra3d::add_tree(shape);
  const std::array<algebra3d::GlbNode, 1> nodes = {{{0, &shape}}};
  for (auto step : state) {
    const std::string bytes = *algebra3d::glb_of(nodes);
    state.counters["MB"] = static_cast<double>(bytes.size()) / 1e6;
  }
}

constexpr std::array<std::size_t, 3> kCounts = {2000000, 200000, 20000};

void levels(benchmark::State& state) {
  const Value& value = solid(state);
  for (auto step : state) {
    const auto made = *algebra3d::levels_of_detail(value, kCounts);
    for (std::size_t i = 0; i < kCounts.size(); ++i) {
      const std::string name = std::to_string(kCounts[i]);
      state.counters[name] = static_cast<double>(made[i].triangles.size());
      state.counters["deviation" + name] = 1e6 * made[i].deviation.value_or(0);
    }
  }
}

void models(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(224)->Arg(707)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
}
BENCHMARK(decoding)->Apply(models);
BENCHMARK(whole_shape)->Apply(models);
BENCHMARK(search_tree)->Apply(models);
BENCHMARK(file)->Apply(models);
BENCHMARK(levels)->Apply(models);

#ifdef BENCH_WITH_MESHOPTIMIZER
/// Positions and indices only: neither normals nor edges.
void meshoptimizer_sloppy(benchmark::State& state) {
  const algebra3d::DrawnShape shape = *algebra3d::shape_of(solid(state));
  std::vector<unsigned> result(3 * shape.triangles.size());
  for (auto step : state)
    for (const std::size_t count : kCounts) {
      float error = 0;
      const std::size_t indices = meshopt_simplifySloppy(
          result.data(), shape.triangles.front().data(), 3 * shape.triangles.size(), shape.positions.front().data(),
          shape.positions.size(), sizeof(algebra3d::DrawnShape::Position), std::min(3 * count, result.size()), 1e30F,
          &error);
      const std::string name = std::to_string(count);
      state.counters[name] = static_cast<double>(indices / 3);
    }
}
BENCHMARK(meshoptimizer_sloppy)->Apply(models);
#endif

}  // namespace
