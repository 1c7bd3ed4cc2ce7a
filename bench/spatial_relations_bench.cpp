// Predicates on solids beside CGAL's on the same meshes in the same run: do_intersect of surfaces and
// Side_of_triangle_mesh, with the kernel that CGAL recommends for these, which decides exactly for doubles. Trees are
// made before, on both sides. Compare lines of the same arguments.
#include <benchmark/benchmark.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>

#include <cmath>
#include <random>
#include <vector>

#include "algebra3d/values/spatial_relations/point_location.h"
#include "algebra3d/values/spatial_relations/relation.h"
#include "cgal_mesh.h"
#include "shapes.h"

namespace {

using algebra3d::Box3;
using algebra3d::ExactPoint;
using algebra3d::Placement;
using algebra3d::PointRef;
using algebra3d::Vec3;
using algebra3d::Volume3d;
using bench::mesh_of;
using bench::Shape;
using bench::sphere;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = bench::CgalMesh<Kernel>;
using CgalTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<CgalMesh>>>;

Shape moved(Shape shape, const Vec3& by) {
  for (Vec3& p : shape.points) p = p + by;
  return shape;
}

Volume3d solid(const Shape& shape) {
  Volume3d result = Volume3d::trusted(mesh_of(shape));
  result.geometry().hierarchy();
  result.geometry().components();
  return result;
}

/// Two spheres of radius 1, side by side along a diagonal, so that their boxes meet: the second is the first, moved by
/// twice the support in that direction and a gap in hundredths. At 0 they touch in a corner, but for rounding.
std::pair<Shape, Shape> pair_of_spheres(std::int64_t frequency, std::int64_t hundredths) {
  const Shape first = sphere(static_cast<std::uint32_t>(frequency));
  const Vec3 direction = (1 / std::sqrt(3.0)) * Vec3{1, 1, 1};
  double highest = 0;
  for (const Vec3& p : first.points) highest = std::max(highest, dot(p, direction));
  return {first, moved(first, (2 * highest + 0.01 * static_cast<double>(hundredths)) * direction)};
}

void solids_intersect(benchmark::State& state) {
  const auto [a, b] = pair_of_spheres(state.range(0), state.range(1));
  const Volume3d first = solid(a), second = solid(b);
  bool result = false;
  for (auto _ : state) {
    result = *do_meet(first, second);
    benchmark::ClobberMemory();
  }
  state.SetLabel(result ? "meet" : "apart");
}

void solids_intersect_cgal(benchmark::State& state) {
  const auto [a, b] = pair_of_spheres(state.range(0), state.range(1));
  const CgalMesh first = bench::cgal_mesh_of<Kernel>(a), second = bench::cgal_mesh_of<Kernel>(b);
  CgalTree first_tree(faces(first).begin(), faces(first).end(), first);
  CgalTree second_tree(faces(second).begin(), faces(second).end(), second);
  first_tree.build();
  second_tree.build();
  const CGAL::Side_of_triangle_mesh<CgalMesh, Kernel> in_first(first_tree), in_second(second_tree);
  bool result = false;
  for (auto _ : state) {
    result = first_tree.do_intersect(second_tree) || in_first(*second.points().begin()) != CGAL::ON_UNBOUNDED_SIDE ||
             in_second(*first.points().begin()) != CGAL::ON_UNBOUNDED_SIDE;
    benchmark::ClobberMemory();
  }
  state.SetLabel(result ? "meet" : "apart");
}

void solids_touch(benchmark::State& state) {
  const auto [a, b] = pair_of_spheres(state.range(0), state.range(1));
  const Volume3d first = solid(a), second = solid(b);
  for (auto _ : state) benchmark::DoNotOptimize(*do_touch(first, second));
}

/// Spheres of 80 triangles at random places, and the pairs whose boxes meet.
struct Scene {
  explicit Scene(std::size_t count) {
    std::mt19937_64 random(1);  // NOLINT(cert-msc51-cpp): the same in every run
    const double side = 43.4 * std::cbrt(static_cast<double>(count) / 10000);
    std::uniform_real_distribution<double> place(0, side);
    const Shape plain = sphere(2);
    for (std::size_t i = 0; i < count; ++i) {
      const double x = place(random), y = place(random);
      solids.push_back(solid(moved(plain, {x, y, place(random)})));
    }
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = i + 1; j < count; ++j)
        if (solids[i].box().intersects(solids[j].box())) pairs.emplace_back(i, j);
  }

  std::vector<Volume3d> solids;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
};

void join_of_small_solids(benchmark::State& state) {
  const Scene scene(static_cast<std::size_t>(state.range(0)));
  std::size_t hits = 0;
  for (auto _ : state) {
    hits = 0;
    for (const auto& [i, j] : scene.pairs) hits += *do_meet(scene.solids[i], scene.solids[j]) ? 1 : 0;
  }
  state.counters["pairs"] = static_cast<double>(scene.pairs.size());
  state.counters["hits"] = static_cast<double>(hits);
}

std::vector<Vec3> random_points(std::size_t count) {
  std::mt19937_64 random(2);  // NOLINT(cert-msc51-cpp): the same in every run
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::vector<Vec3> points(count);
  for (Vec3& p : points) p = {coordinate(random), coordinate(random), coordinate(random)};
  return points;
}

void points_in_solid(benchmark::State& state) {
  const Volume3d ball = solid(sphere(static_cast<std::uint32_t>(state.range(0))));
  const std::vector<Vec3> points = random_points(static_cast<std::size_t>(state.range(1)));
  const std::vector<PointRef> refs(points.begin(), points.end());
  std::size_t inside = 0;
  for (auto _ : state) {
    const auto places = place_in_solid(refs, ball.geometry());
    inside = static_cast<std::size_t>(std::ranges::count(places, Placement::inside));
  }
  state.counters["inside"] = static_cast<double>(inside);
}

void points_in_solid_cgal(benchmark::State& state) {
  const CgalMesh mesh = bench::cgal_mesh_of<Kernel>(sphere(static_cast<std::uint32_t>(state.range(0))));
  const CGAL::Side_of_triangle_mesh<CgalMesh, Kernel> side(mesh);
  const std::vector<Vec3> points = random_points(static_cast<std::size_t>(state.range(1)));
  benchmark::DoNotOptimize(side(Kernel::Point_3(0, 0, 0)));
  std::size_t inside = 0;
  for (auto _ : state) {
    inside = 0;
    for (const Vec3& p : points) inside += side(Kernel::Point_3(p.x, p.y, p.z)) == CGAL::ON_BOUNDED_SIDE ? 1 : 0;
  }
  state.counters["inside"] = static_cast<double>(inside);
}

/// Spheres that cross, touch or nearly touch, and the latter from 10^2 to 10^6 triangles.
void with_pairs(benchmark::internal::Benchmark* benchmark) {
  for (const std::int64_t hundredths : {1, 0, -1}) benchmark->Args({16, hundredths});
  for (const std::int64_t frequency : {2, 7, 22, 71, 100, 224}) benchmark->Args({frequency, 1});
  benchmark->Unit(benchmark::kMicrosecond);
}

BENCHMARK(solids_intersect)->Apply(with_pairs);
BENCHMARK(solids_intersect_cgal)->Apply(with_pairs);
BENCHMARK(solids_touch)->Args({16, 0})->Args({16, -1})->Unit(benchmark::kMicrosecond);
BENCHMARK(join_of_small_solids)->Arg(10000)->Unit(benchmark::kMillisecond);
BENCHMARK(points_in_solid)->Args({71, 1000000})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(points_in_solid_cgal)->Args({71, 100000})->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
