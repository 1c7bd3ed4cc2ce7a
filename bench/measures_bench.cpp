// Hausdorff distances beside CGAL's bounded_error_symmetric_Hausdorff_distance, which computes with doubles and an
// absolute error bound that is given; ours bounds the error relatively by a billionth, and gives the exact distance of
// the point that it finds. Hits of rays beside CGAL's AABB tree with exact predicates and inexact parameters, which
// gives each triangle that is hit. Compare lines of the same arguments: the frequencies of two spheres, and how far the
// second one is moved, in hundredths; it is turned too. Where it is not moved, the largest distance is in the inside of
// faces.
#include <benchmark/benchmark.h>

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>

#include <random>
#include <vector>

#include "algebra3d/values/measures/hausdorff_distance.h"
#include "algebra3d/values/measures/ray_hits.h"
#include "cgal_mesh.h"
#include "shapes.h"

namespace {

using namespace bench;
using algebra3d::RationalVec3;
using algebra3d::Surface3d;
using algebra3d::Volume3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CgalMesh<Kernel>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<SurfaceMesh>>>;

struct SpherePair {
  Shape first, second;

  explicit SpherePair(const benchmark::State& state)
      : first(sphere(static_cast<std::uint32_t>(state.range(0)))),
        second(moved(sphere(static_cast<std::uint32_t>(state.range(1))), {1, 2, 3}, 1,
                     static_cast<double>(state.range(2)) * Vec3{0.01, 0.004, 0.002})) {}
};

void hausdorff_ours(benchmark::State& state) {
  const SpherePair pair(state);
  const Volume3d a = Volume3d::trusted(mesh_of(pair.first)), b = Volume3d::trusted(mesh_of(pair.second));
  a.geometry().hierarchy();
  b.geometry().hierarchy();
  for (auto step : state) {
    const auto found = algebra3d::hausdorff_distance(a, b);
    state.counters["distance"] = (*found)->squared_distance.nearest_root();
  }
}

void hausdorff_cgal(benchmark::State& state) {
  const SpherePair pair(state);
  const SurfaceMesh a = cgal_mesh_of<Kernel>(pair.first), b = cgal_mesh_of<Kernel>(pair.second);
  const double error = 1e-6;
  for (auto step : state)
    state.counters["distance"] =
        CGAL::Polygon_mesh_processing::bounded_error_symmetric_Hausdorff_distance<CGAL::Sequential_tag>(a, b, error);
}

void with_spheres(benchmark::internal::Benchmark* benchmark) {
  benchmark->Args({7, 9, 5})->Args({32, 36, 5})->Args({71, 80, 5});
  benchmark->Args({7, 9, 0})->Args({22, 25, 0})->Unit(benchmark::kMillisecond);
}
BENCHMARK(hausdorff_ours)->Apply(with_spheres);
BENCHMARK(hausdorff_cgal)->Apply(with_spheres);

/// Rays from the inside of the sphere.
std::vector<std::pair<Vec3, Vec3>> random_rays() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-0.5, 0.5);
  std::vector<std::pair<Vec3, Vec3>> rays;
  for (int i = 0; i < 200; ++i)
    rays.push_back(
        {{number(random), number(random), number(random)}, {number(random), number(random), number(random)}});
  return rays;
}

void rays_ours(benchmark::State& state) {
  const Volume3d solid = Volume3d::trusted(mesh_of(sphere(static_cast<std::uint32_t>(state.range(0)))));
  solid.geometry().hierarchy();
  const auto rays = random_rays();
  std::size_t hits = 0;
  for (auto step : state)
    for (const auto& [origin, direction] : rays)
      hits += algebra3d::ray_hits(solid, RationalVec3(origin), RationalVec3(direction)).size();
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
}

void rays_cgal(benchmark::State& state) {
  const SurfaceMesh mesh = cgal_mesh_of<Kernel>(sphere(static_cast<std::uint32_t>(state.range(0))));
  Tree tree(faces(mesh).first, faces(mesh).second, mesh);
  tree.build();
  const auto rays = random_rays();
  std::vector<Tree::Intersection_and_primitive_id<Kernel::Ray_3>::Type> found;
  for (auto step : state)
    for (const auto& [origin, direction] : rays) {
      found.clear();
      const Kernel::Ray_3 ray({origin.x, origin.y, origin.z}, Kernel::Vector_3(direction.x, direction.y, direction.z));
      tree.all_intersections(ray, std::back_inserter(found));
    }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
}

BENCHMARK(rays_ours)->Arg(7)->Arg(71)->Unit(benchmark::kMillisecond);
BENCHMARK(rays_cgal)->Arg(7)->Arg(71)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
