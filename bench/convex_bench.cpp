// Convex hulls beside CGAL's convex_hull_3 on the same points in the same run, with the kernel that CGAL recommends for
// it, which decides exactly for doubles. Ours ends with the mesh of a valid solid without superfluous corners, CGAL's
// with a Surface_mesh. Smallest balls, ours exact, beside CGAL's Min_sphere_of_spheres_d in doubles. Boxes and
// cylinders with their proved ratios. Compare lines of the same arguments: the kind of the points and their number.
#include <benchmark/benchmark.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "algebra3d/kernel/convex/bounding_cylinder.h"
#include "algebra3d/kernel/convex/convex_hull.h"
#include "algebra3d/kernel/convex/enclosing_ball.h"
#include "algebra3d/kernel/convex/minimal_box.h"

namespace {

using algebra3d::PointArray;
using algebra3d::Vec3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

enum class Cloud : std::int64_t { cube, sphere, grid, cylinder };

Vec3 random_point(Cloud cloud, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  std::normal_distribution<double> normal;
  const Vec3 p{unit(random), unit(random), unit(random)};
  switch (cloud) {
    case Cloud::sphere: {
      const Vec3 direction{normal(random), normal(random), normal(random)};
      return (1 / length(direction)) * direction;
    }
    case Cloud::cylinder:
      return {std::cos(3 * p.x), std::sin(3 * p.x), p.y < 0 ? -1.0 : 1.0};
    default:
      return p;
  }
}

std::vector<Vec3> points_of(Cloud cloud, std::int64_t count) {
  std::vector<Vec3> points;
  if (cloud == Cloud::grid) {
    const auto side = static_cast<std::int64_t>(std::llround(std::cbrt(static_cast<double>(count))));
    for (std::int64_t i = 0; i < side * side * side; ++i)
      points.push_back(
          {static_cast<double>(i / side / side), static_cast<double>(i / side % side), static_cast<double>(i % side)});
    return points;
  }
  std::mt19937_64 random(7);
  for (std::int64_t i = 0; i < count; ++i) points.push_back(random_point(cloud, random));
  return points;
}

std::vector<Vec3> points_of(const benchmark::State& state) {
  return points_of(static_cast<Cloud>(state.range(0)), state.range(1));
}

std::vector<Kernel::Point_3> cgal_points_of(const benchmark::State& state) {
  std::vector<Kernel::Point_3> points;
  for (const Vec3& p : points_of(state)) points.emplace_back(p.x, p.y, p.z);
  return points;
}

void hull_ours(benchmark::State& state) {
  const PointArray points(points_of(state));
  std::size_t vertices = 0;
  for (auto step : state) vertices = algebra3d::convex_hull(points).value().value().vertex_count();
  state.counters["vertices"] = static_cast<double>(vertices);
}

void hull_cgal(benchmark::State& state) {
  const std::vector<Kernel::Point_3> points = cgal_points_of(state);
  std::size_t vertices = 0;
  for (auto step : state) {
    CGAL::Surface_mesh<Kernel::Point_3> mesh;
    CGAL::convex_hull_3(points.begin(), points.end(), mesh);
    vertices = mesh.number_of_vertices();
  }
  state.counters["vertices"] = static_cast<double>(vertices);
}

void ball_ours(benchmark::State& state) {
  const PointArray points(points_of(state));
  for (auto step : state)
    state.counters["radius"] = algebra3d::smallest_enclosing_ball(points).value()->squared_radius.nearest_root();
}

void ball_cgal(benchmark::State& state) {
  using Ball = CGAL::Min_sphere_of_spheres_d<CGAL::Min_sphere_of_points_d_traits_3<Kernel, double>>;
  const std::vector<Kernel::Point_3> points = cgal_points_of(state);
  for (auto step : state) state.counters["radius"] = Ball(points.begin(), points.end()).radius();
}

void box_ours(benchmark::State& state) {
  const algebra3d::TriangleMesh hull = algebra3d::convex_hull(PointArray(points_of(state))).value().value();
  for (auto step : state) state.counters["ratio"] = algebra3d::minimal_box(hull).value()->ratio;
}

void cylinder_ours(benchmark::State& state) {
  const algebra3d::TriangleMesh hull = algebra3d::convex_hull(PointArray(points_of(state))).value().value();
  for (auto step : state) state.counters["ratio"] = algebra3d::bounding_cylinder(hull).value()->ratio;
}

void with(benchmark::internal::Benchmark* benchmark, const std::vector<Cloud>& clouds,
          const std::vector<std::int64_t>& counts) {
  for (const Cloud cloud : clouds)
    for (const std::int64_t count : counts) benchmark->Args({static_cast<std::int64_t>(cloud), count});
  benchmark->Unit(benchmark::kMillisecond)->MinTime(0.1);
}
void with_clouds(benchmark::internal::Benchmark* benchmark) {
  with(benchmark, {Cloud::cube, Cloud::sphere, Cloud::grid}, {1'000, 10'000, 100'000, 1'000'000});
}
void with_rims(benchmark::internal::Benchmark* benchmark) {
  with(benchmark, {Cloud::cylinder}, {1'000, 10'000, 100'000, 1'000'000});
}
/// CGAL takes seconds for more.
void with_few_on_rims(benchmark::internal::Benchmark* benchmark) {
  with(benchmark, {Cloud::cylinder}, {1'000});
}
BENCHMARK(hull_ours)->Apply(with_clouds)->Apply(with_rims);
BENCHMARK(hull_cgal)->Apply(with_clouds)->Apply(with_few_on_rims);
BENCHMARK(ball_ours)->Apply(with_clouds);
BENCHMARK(ball_cgal)->Apply(with_clouds);
void with_hulls(benchmark::internal::Benchmark* benchmark) {
  with(benchmark, {Cloud::cube, Cloud::sphere}, {1'000, 10'000, 100'000});
}
BENCHMARK(box_ours)->Apply(with_hulls);
BENCHMARK(cylinder_ours)->Apply(with_hulls);

}  // namespace
