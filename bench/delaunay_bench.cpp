// triangulate beside CGAL's Constrained_Delaunay_triangulation_2 on the same polygons in the same run, both from
// corners to the triangles inside. CGAL has the kernel that it recommends for this (exact predicates, inexact
// constructions), gets the points in bulk, which it sorts in space, then the constraints by vertex handles, and its own
// function marks what lies inside. Compare lines of the same arguments: numbers of corners.
#include <benchmark/benchmark.h>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "algebra3d/kernel/planar/boundary_polygons.h"
#include "algebra3d/kernel/planar/constrained_delaunay.h"
#include "algebra3d/kernel/planar/noding.h"
#include "algebra3d/kernel/planar/polygon_validity.h"
#include "support/plane_shapes.h"

namespace {

using algebra3d::Polygons;
using algebra3d::Vec3;
namespace shapes = algebra3d::plane_shapes;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;

template <typename Base = CGAL::Constrained_triangulation_face_base_2<Kernel>>
struct FaceBase : Base {
  using Base::Base;
  template <typename Structure>
  struct Rebind_TDS {
    using Other = FaceBase<typename Base::template Rebind_TDS<Structure>::Other>;
  };
  int depth = -1;
};
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase<>>>;

/// Marks every triangle with the number of constraints to the outside, by layers, and counts the odd ones.
std::size_t inside_count(Triangulation& triangulation) {
  std::vector<Triangulation::Face_handle> open{triangulation.infinite_face()}, next;
  std::size_t count = 0;
  for (int depth = 0; !open.empty(); ++depth, std::swap(open, next), next.clear()) {
    while (!open.empty()) {
      const auto face = open.back();
      open.pop_back();
      if (face->depth >= 0) continue;
      face->depth = depth;
      count += depth % 2;
      for (int i = 0; i < 3; ++i)
        if (face->neighbor(i)->depth < 0) (face->is_constrained(i) ? next : open).push_back(face->neighbor(i));
    }
  }
  return count;
}

void ours(benchmark::State& state, const Polygons& polygons) {
  std::size_t count = 0;
  for (auto step : state) {
    const auto triangles = triangulate(polygons);
    if (!triangles.ok()) return state.SkipWithError(triangles.error().message.c_str());
    count = triangles->size();
  }
  state.counters["corners"] = static_cast<double>(polygons.corners.size());
  state.counters["triangles"] = static_cast<double>(count);
}

void cgal(benchmark::State& state, const Polygons& polygons) {
  std::size_t count = 0;
  for (auto step : state) {
    std::vector<Kernel::Point_2> points;
    for (const Vec3& p : polygons.corners.approx()) points.emplace_back(p.x, p.y);
    std::vector<std::pair<std::size_t, std::size_t>> segments;
    for (std::size_t cycle = 0; cycle < polygons.cycle_count(); ++cycle) {
      const std::size_t begin = polygons.first_corner(cycle), end = polygons.cycle_ends[cycle];
      for (std::size_t i = begin; i < end; ++i) segments.emplace_back(i, i + 1 == end ? begin : i + 1);
    }
    Triangulation triangulation;
    triangulation.insert_constraints(points.begin(), points.end(), segments.begin(), segments.end());
    count = inside_count(triangulation);
  }
  state.counters["corners"] = static_cast<double>(polygons.corners.size());
  state.counters["triangles"] = static_cast<double>(count);
}

void defect(benchmark::State& state, const Polygons& polygons) {
  for (auto step : state) {
    const auto found = polygon_defect(polygons);
    if (!found.ok() || found->has_value()) return state.SkipWithError("a defect");
  }
  state.counters["corners"] = static_cast<double>(polygons.corners.size());
}

void boundary(benchmark::State& state, const Polygons& polygons) {
  std::vector<algebra3d::DirectedEdge> edges;
  for (std::size_t cycle = 0; cycle < polygons.cycle_count(); ++cycle) {
    const std::uint32_t begin = polygons.first_corner(cycle), end = polygons.cycle_ends[cycle];
    for (std::uint32_t i = begin; i < end; ++i) edges.emplace_back(i, i + 1 == end ? begin : i + 1);
  }
  for (auto step : state) {
    const auto noded_edges = noded(polygons.corners, edges);
    if (!noded_edges.ok()) return state.SkipWithError(noded_edges.error().message.c_str());
    const auto result = boundary_polygons(polygons.corners, *noded_edges);
    if (!result.ok()) return state.SkipWithError(result.error().message.c_str());
  }
  state.counters["corners"] = static_cast<double>(polygons.corners.size());
}

std::mt19937_64 random_numbers() {
  return std::mt19937_64(1);  // NOLINT(cert-msc51-cpp): the same in every run
}

Polygons maze(std::int64_t corners) {
  auto random = random_numbers();
  const auto size = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(corners) / 2));
  return shapes::polygons_of({{shapes::maze(size, random)}});
}
Polygons shaken_maze(std::int64_t corners) {
  auto random = random_numbers();
  const auto size = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(corners) / 2));
  return shapes::polygons_of({{shapes::shaken(shapes::maze(size, random), 0.24, random)}});
}
Polygons snowflake(std::int64_t corners) {
  return shapes::polygons_of(
      {{shapes::snowflake(static_cast<int>(std::lround(std::log(static_cast<double>(corners) / 3) / std::log(4))))}});
}
Polygons rings(std::int64_t corners) {
  auto random = random_numbers();
  return shapes::polygons_of(shapes::rings(10, static_cast<std::size_t>(corners) / 20, random));
}
Polygons comb(std::int64_t corners) {
  return shapes::polygons_of({{shapes::comb(static_cast<std::size_t>(corners) / 4, static_cast<double>(corners))}});
}

/// Two saws whose teeth point away from each other, so that each long edge crosses as many triangles as there are
/// teeth.
Polygons saws(std::int64_t corners) {
  auto random = random_numbers();
  const auto count = static_cast<double>(corners) / 2;
  std::vector<shapes::Face> faces;
  for (const double side : {1.0, -1.0}) {
    shapes::Cycle cycle{{0, side * 1e-6, 0}, {count, side * 1e-6, 0}};
    for (double x = count - 1; x > 0; --x)
      cycle.push_back({x, side * std::uniform_real_distribution<double>(1e-3, 2e-3)(random), 0});
    faces.push_back({cycle});
  }
  return shapes::polygons_of(faces);
}

#define ALGEBRA3D_PEERS(shape)                                                                         \
  void shape##_ours(benchmark::State& state) {                                                         \
    ours(state, shape(state.range(0)));                                                                \
  }                                                                                                    \
  void shape##_cgal(benchmark::State& state) {                                                         \
    cgal(state, shape(state.range(0)));                                                                \
  }                                                                                                    \
  BENCHMARK(shape##_ours)->RangeMultiplier(10)->Range(1000, 1'000'000)->Unit(benchmark::kMillisecond); \
  BENCHMARK(shape##_cgal)->RangeMultiplier(10)->Range(1000, 1'000'000)->Unit(benchmark::kMillisecond)

void shaken_maze_defect(benchmark::State& state) {
  defect(state, shaken_maze(state.range(0)));
}
void shaken_maze_noded_boundary(benchmark::State& state) {
  boundary(state, shaken_maze(state.range(0)));
}
BENCHMARK(shaken_maze_defect)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(shaken_maze_noded_boundary)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

ALGEBRA3D_PEERS(shaken_maze);
ALGEBRA3D_PEERS(maze);
ALGEBRA3D_PEERS(snowflake);
ALGEBRA3D_PEERS(rings);
ALGEBRA3D_PEERS(comb);
ALGEBRA3D_PEERS(saws);

}  // namespace
