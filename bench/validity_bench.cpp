// prove_volume beside CGAL's self-intersection test on the same meshes in the same run: geodesic spheres, with faces in
// the order of their making and shuffled, and tori. CGAL answers only whether there is an intersecting pair;
// prove_volume also proves edges, duplicates and winding numbers; is_star_shaped proves as much of spheres. The kernel
// is the one CGAL recommends for this (exact predicates, inexact constructions). Compare lines of the same arguments.
#include <benchmark/benchmark.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "algebra3d/kernel/validity/star_shape.h"
#include "algebra3d/kernel/validity/validity.h"
#include "cgal_mesh.h"
#include "shapes.h"

namespace {

using algebra3d::TriangleMesh;
using algebra3d::Vec3;
using bench::mesh_of;
using bench::Shape;
using bench::sphere;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// A surface over a grid that is closed in both directions.
Shape torus(std::uint32_t rows, std::uint32_t columns) {
  Shape shape;
  for (std::uint32_t i = 0; i < rows; ++i) {
    for (std::uint32_t j = 0; j < columns; ++j) {
      const double u = 2 * std::numbers::pi * i / rows, v = 2 * std::numbers::pi * j / columns;
      const double radius = 3 + std::cos(v);
      shape.points.push_back({radius * std::cos(u), radius * std::sin(u), std::sin(v)});
      const std::uint32_t i1 = (i + 1) % rows, j1 = (j + 1) % columns;
      const std::uint32_t a = i * columns + j, b = i1 * columns + j, c = i1 * columns + j1, d = i * columns + j1;
      shape.triangles.push_back({a, b, c});
      shape.triangles.push_back({a, c, d});
    }
  }
  return shape;
}

Shape shuffled(Shape shape) {
  std::ranges::shuffle(shape.triangles, std::mt19937(1));  // NOLINT(cert-msc51-cpp): the same order in every run
  return shape;
}

/// A cone with `sides` slivers that all meet in the apex, and as many in the base.
Shape cone(std::uint32_t sides) {
  Shape shape;
  shape.points = {{0, 0, 1}, {0, 0, 0}};
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    shape.points.push_back({std::cos(angle), std::sin(angle), 0});
    const std::uint32_t a = 2 + i, b = 2 + (i + 1) % sides;
    shape.triangles.push_back({0, a, b});
    shape.triangles.push_back({1, b, a});
  }
  return shape;
}

/// Cubes in a row, each a shell of its own.
Shape cubes(std::uint32_t count) {
  Shape shape;
  for (std::uint32_t n = 0; n < count; ++n) {
    const Vec3 corner{2.0 * (n % 22), 2.0 * (n / 22 % 22), 2.0 * (n / 484)};
    const Shape cube = bench::box(corner, corner + Vec3{1, 1, 1});
    shape.points.insert(shape.points.end(), cube.points.begin(), cube.points.end());
    for (const auto& [a, b, c] : cube.triangles) shape.triangles.push_back({8 * n + a, 8 * n + b, 8 * n + c});
  }
  return shape;
}

void prove(benchmark::State& state, const Shape& shape) {
  const TriangleMesh mesh = mesh_of(shape);
  for (auto step : state) {
    const auto report = prove_volume(mesh);
    if (!report.ok() || !report->is_valid()) state.SkipWithError(report.ok() ? report->text().c_str() : "error");
  }
  state.counters["triangles"] = static_cast<double>(shape.triangles.size());
}

void ask_cgal(benchmark::State& state, const Shape& shape) {
  const bench::CgalMesh<Kernel> mesh = bench::cgal_mesh_of<Kernel>(shape);
  for (auto step : state)
    if (CGAL::Polygon_mesh_processing::does_self_intersect(mesh)) state.SkipWithError("intersects");
  state.counters["triangles"] = static_cast<double>(shape.triangles.size());
}

void sphere_ours(benchmark::State& state) {
  prove(state, sphere(static_cast<std::uint32_t>(state.range(0))));
}
void sphere_star_shape(benchmark::State& state) {
  const TriangleMesh mesh = mesh_of(sphere(static_cast<std::uint32_t>(state.range(0))));
  for (auto step : state)
    if (!is_star_shaped(mesh, Vec3{})) state.SkipWithError("not star-shaped");
  state.counters["triangles"] = static_cast<double>(mesh.face_count());
}
void sphere_cgal(benchmark::State& state) {
  ask_cgal(state, sphere(static_cast<std::uint32_t>(state.range(0))));
}
void shuffled_sphere_ours(benchmark::State& state) {
  prove(state, shuffled(sphere(static_cast<std::uint32_t>(state.range(0)))));
}
void shuffled_sphere_cgal(benchmark::State& state) {
  ask_cgal(state, shuffled(sphere(static_cast<std::uint32_t>(state.range(0)))));
}
void torus_ours(benchmark::State& state) {
  const auto n = static_cast<std::uint32_t>(state.range(0));
  prove(state, torus(2 * n, n));
}
void torus_cgal(benchmark::State& state) {
  const auto n = static_cast<std::uint32_t>(state.range(0));
  ask_cgal(state, torus(2 * n, n));
}
void cone_ours(benchmark::State& state) {
  prove(state, cone(static_cast<std::uint32_t>(state.range(0))));
}
void cone_cgal(benchmark::State& state) {
  ask_cgal(state, cone(static_cast<std::uint32_t>(state.range(0))));
}
void cubes_ours(benchmark::State& state) {
  prove(state, cubes(static_cast<std::uint32_t>(state.range(0))));
}
void cubes_cgal(benchmark::State& state) {
  ask_cgal(state, cubes(static_cast<std::uint32_t>(state.range(0))));
}

// Frequencies for 20 thousand, 100 thousand and a million triangles.
BENCHMARK(sphere_ours)->Arg(32)->Arg(71)->Arg(224)->Unit(benchmark::kMillisecond);
BENCHMARK(sphere_star_shape)->Arg(32)->Arg(71)->Arg(224)->Unit(benchmark::kMillisecond);
BENCHMARK(sphere_cgal)->Arg(32)->Arg(71)->Arg(224)->Unit(benchmark::kMillisecond);
BENCHMARK(shuffled_sphere_ours)->Arg(71)->Unit(benchmark::kMillisecond);
BENCHMARK(shuffled_sphere_cgal)->Arg(71)->Unit(benchmark::kMillisecond);
BENCHMARK(torus_ours)->Arg(158)->Unit(benchmark::kMillisecond);
BENCHMARK(torus_cgal)->Arg(158)->Unit(benchmark::kMillisecond);
BENCHMARK(cone_ours)->Arg(1000)->Arg(10'000)->Unit(benchmark::kMillisecond);
BENCHMARK(cone_cgal)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK(cubes_ours)->Arg(10'000)->Unit(benchmark::kMillisecond);
BENCHMARK(cubes_cgal)->Arg(10'000)->Unit(benchmark::kMillisecond);

}  // namespace
