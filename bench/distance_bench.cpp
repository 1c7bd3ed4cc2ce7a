// Distances of meshes beside FCL's, which walks trees of oriented boxes (OBBRSS) and computes with doubles. The search
// alone is timed: ours has the hierarchy at hand that stored values have, FCL its trees. Ours is exact, with the
// nearest points as fractions; `error` is the difference of FCL's distance in roundings of the larger one. Compare
// lines of the same arguments: the frequency of the spheres, and the gap between them in thousandths of their radius;
// of linked tori, which are near each other in many places, the number of steps around each.
#include <benchmark/benchmark.h>

#ifdef BENCH_WITH_FCL
#include <fcl/fcl.h>
#endif

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "algebra3d/kernel/distance/distance.h"
#include "shapes.h"

namespace {

using namespace bench;
using algebra3d::BoxHierarchy;
using algebra3d::DistanceOperand;
using algebra3d::Rational;

struct Set {
  TriangleMesh mesh;
  BoxHierarchy hierarchy;

  explicit Set(const Shape& shape) : mesh(mesh_of(shape)), hierarchy(mesh) {}
  DistanceOperand operand() const { return {&mesh, &hierarchy}; }
};

struct Pair {
  Shape first, second;
};

Pair spheres(const benchmark::State& state) {
  const Shape first = sphere(static_cast<std::uint32_t>(state.range(0)));
  const double apart = 2 + 0.001 * static_cast<double>(state.range(1));
  return {first, moved(first, {1, 2, 3}, 1, {0.8 * apart, 0.6 * apart, 0})};
}

/// A torus around the z-axis, with twice as many triangles as steps around times a quarter of that along the tube.
Shape torus(std::uint32_t steps) {
  const std::uint32_t of_tube = steps / 4;
  Shape shape;
  const auto number = [&](std::uint32_t i, std::uint32_t j) { return i % steps * of_tube + j % of_tube; };
  for (std::uint32_t i = 0; i < steps; ++i) {
    for (std::uint32_t j = 0; j < of_tube; ++j) {
      const double around = 2 * std::numbers::pi * i / steps, along = 2 * std::numbers::pi * j / of_tube;
      const double radius = 1 + 0.3 * std::cos(along);
      shape.points.push_back({radius * std::cos(around), radius * std::sin(around), 0.3 * std::sin(along)});
      shape.triangles.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
      shape.triangles.push_back({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  }
  return shape;
}

/// Two tori that are linked like parts of a chain.
Pair linked_tori(const benchmark::State& state) {
  const Shape first = torus(static_cast<std::uint32_t>(state.range(0)));
  return {first, moved(first, {1, 0.1, 0}, 1.5, {1, 0, 0})};
}

double exact_distance(const Pair& pair) {
  const Set a(pair.first), b(pair.second);
  return algebra3d::closest_points(a.operand(), b.operand()).value()->squared_distance.nearest_root();
}

void measure_ours(benchmark::State& state, const Pair& pair) {
  const Set a(pair.first), b(pair.second);
  double distance = 0;
  for (auto step : state)
    distance = algebra3d::closest_points(a.operand(), b.operand()).value()->squared_distance.nearest_root();
  state.counters["distance"] = distance;
}

void distance_ours(benchmark::State& state) {
  measure_ours(state, spheres(state));
}

void tori_ours(benchmark::State& state) {
  measure_ours(state, linked_tori(state));
}

/// Whether the distance is at most half of what it is, or twice that.
void within_ours(benchmark::State& state) {
  const Pair pair = spheres(state);
  const Set a(pair.first), b(pair.second);
  const double distance = exact_distance(pair);
  for (auto step : state) {
    benchmark::DoNotOptimize(*algebra3d::are_within(a.operand(), b.operand(), Rational(distance / 2)));
    benchmark::DoNotOptimize(*algebra3d::are_within(a.operand(), b.operand(), Rational(distance * 2)));
  }
}

void with_pairs(benchmark::internal::Benchmark* benchmark) {
  for (const std::int64_t frequency : {2, 7, 22, 71, 224})
    for (const std::int64_t gap : {1, 100}) benchmark->Args({frequency, gap});
  benchmark->Unit(benchmark::kMillisecond);
}
void with_tori(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(64)->Arg(256)->Unit(benchmark::kMillisecond);
}
BENCHMARK(distance_ours)->Apply(with_pairs);
BENCHMARK(tori_ours)->Apply(with_tori);
BENCHMARK(within_ours)->Apply(with_pairs);

#ifdef BENCH_WITH_FCL
using Model = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<Model> model_of(const Shape& shape) {
  std::vector<fcl::Vector3d> points;
  for (const Vec3& p : shape.points) points.emplace_back(p.x, p.y, p.z);
  std::vector<fcl::Triangle> triangles;
  for (const auto& [a, b, c] : shape.triangles) triangles.emplace_back(a, b, c);
  auto model = std::make_shared<Model>();
  model->beginModel();
  model->addSubModel(points, triangles);
  model->endModel();
  return model;
}

void measure_fcl(benchmark::State& state, const Pair& pair) {
  const fcl::CollisionObjectd a(model_of(pair.first)), b(model_of(pair.second));
  double distance = 0;
  for (auto step : state) {
    fcl::DistanceResultd result;
    distance = fcl::distance(&a, &b, fcl::DistanceRequestd(true), result);
  }
  const double exact = exact_distance(pair);
  state.counters["distance"] = distance;
  state.counters["error"] = std::abs(distance - exact) / (exact * std::numeric_limits<double>::epsilon());
}

void distance_fcl(benchmark::State& state) {
  measure_fcl(state, spheres(state));
}

void tori_fcl(benchmark::State& state) {
  measure_fcl(state, linked_tori(state));
}
BENCHMARK(distance_fcl)->Apply(with_pairs);
BENCHMARK(tori_fcl)->Apply(with_tori);
#endif

}  // namespace
