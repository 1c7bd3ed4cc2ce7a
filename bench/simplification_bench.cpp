// Decimation beside OpenMesh, CGAL and meshoptimizer: spheres with waves and dents, to a tenth of their triangles. The
// meshes of the peers are built before the clock starts, and their results are not taken out of them; ours goes from
// mesh to mesh. `deviation` is the Hausdorff distance from the mesh by our exact search, in parts of a million of the
// radius, and `crossing` whether the result is no valid volume. The argument is the frequency of the sphere: 224 gives
// a million triangles.
#include <benchmark/benchmark.h>

#ifdef BENCH_WITH_OPENMESH
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#endif
#ifdef BENCH_WITH_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif
#ifdef BENCH_WITH_EIGEN3
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#endif
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_ratio_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <array>
#include <cmath>
#include <map>
#include <random>

#include "algebra3d/distance/farthest_point.h"
#include "algebra3d/simplification/simplification.h"
#include "algebra3d/validity/validity.h"
#include "shapes.h"

namespace {

using namespace bench;

/// With waves of some wavelengths, and triangles in order along the faces of the icosahedron; the second argument of a
/// benchmark is 1 if vertices and triangles are shuffled.
const Shape& model(const benchmark::State& state) {
  static std::map<std::pair<std::int64_t, std::int64_t>, Shape> models;
  Shape& shape = models[{state.range(0), state.range(1)}];
  if (!shape.points.empty()) return shape;
  shape = sphere(static_cast<std::uint32_t>(state.range(0)));
  for (Vec3& p : shape.points)
    p = (1 + 0.05 * std::sin(7 * p.x) * std::cos(9 * p.y) + 0.01 * std::sin(31 * p.z + 20 * p.x)) * p;
  if (state.range(1) == 0) return shape;
  std::mt19937 random(1);
  std::vector<std::uint32_t> order(shape.points.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::shuffle(order, random);
  std::vector<Vec3> points(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) points[order[i]] = shape.points[i];
  shape.points = std::move(points);
  for (auto& triangle : shape.triangles)
    for (std::uint32_t& corner : triangle) corner = order[corner];
  std::ranges::shuffle(shape.triangles, random);
  return shape;
}

void report(benchmark::State& state, const Shape& before, const Shape& after) {
  const TriangleMesh a = mesh_of(before), b = mesh_of(after);
  const algebra3d::BoxHierarchy a_boxes(a), b_boxes(b);
  const algebra3d::DistanceOperand from{&a, &a_boxes}, to{&b, &b_boxes};
  const auto farthest =
      algebra3d::farthest_point(std::array{algebra3d::FarthestSearch{from, to}, algebra3d::FarthestSearch{to, from}});
  state.counters["triangles"] = static_cast<double>(after.triangles.size());
  state.counters["deviation"] = 1e6 * farthest.value()->upper_bound;
  state.counters["crossing"] = algebra3d::prove_volume(b)->is_valid() ? 0 : 1;
}

Shape shape_of(const TriangleMesh& mesh) {
  Shape shape{mesh.points().approx(), {}};
  for (std::size_t f = 0; f < mesh.face_count(); ++f) shape.triangles.push_back(mesh.triangle(algebra3d::FaceId(f)));
  return shape;
}

template <auto kSimplify>
void ours(benchmark::State& state) {
  const Shape& shape = model(state);
  const TriangleMesh mesh = mesh_of(shape);
  TriangleMesh result;
  std::size_t repetitions = 0;
  for (auto step : state) {
    auto simplified = kSimplify(mesh, shape.triangles.size() / 10);
    result = std::move(simplified->mesh);
    repetitions = simplified->repetitions;
  }
  report(state, shape, shape_of(result));
  state.counters["repeated"] = static_cast<double>(repetitions);
}

auto as_mesh(const TriangleMesh& mesh, std::size_t count) {
  return algebra3d::simplified(mesh, {count});
}
/// With the proof that the result is a valid volume.
auto as_volume(const TriangleMesh& mesh, std::size_t count) {
  return algebra3d::simplified_volume(mesh, {count});
}

void models(benchmark::internal::Benchmark* benchmark) {
  for (const std::int64_t is_shuffled : {0, 1})
    for (const std::int64_t frequency : {22, 224}) benchmark->Args({frequency, is_shuffled});
  benchmark->Unit(benchmark::kMillisecond)->UseRealTime();
}
BENCHMARK(ours<as_mesh>)->Apply(models);
BENCHMARK(ours<as_volume>)->Apply(models);

using Kernel = CGAL::Simple_cartesian<double>;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace sms = CGAL::Surface_mesh_simplification;

Shape shape_of(const CgalMesh& mesh) {
  Shape shape;
  std::vector<std::uint32_t> numbers(mesh.num_vertices());
  for (const auto v : mesh.vertices()) {
    numbers[v] = static_cast<std::uint32_t>(shape.points.size());
    shape.points.push_back({mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z()});
  }
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    shape.triangles.push_back({numbers[mesh.source(h)], numbers[mesh.target(h)], numbers[mesh.target(mesh.next(h))]});
  }
  return shape;
}

template <typename Simplify>
void run_cgal(benchmark::State& state, const Simplify& simplify) {
  const Shape& shape = model(state);
  CgalMesh mesh;
  for (auto step : state) {
    state.PauseTiming();
    mesh.clear();
    for (const Vec3& p : shape.points) mesh.add_vertex({p.x, p.y, p.z});
    for (const auto& [a, b, c] : shape.triangles)
      mesh.add_face(CgalMesh::Vertex_index(a), CgalMesh::Vertex_index(b), CgalMesh::Vertex_index(c));
    state.ResumeTiming();
    simplify(mesh);
  }
  mesh.collect_garbage();
  report(state, shape, shape_of(mesh));
}

#ifdef BENCH_WITH_EIGEN3
void cgal_garland_heckbert(benchmark::State& state) {
  run_cgal(state, [](CgalMesh& mesh) {
    const sms::GarlandHeckbert_plane_policies<CgalMesh, Kernel> policies(mesh);
    sms::edge_collapse(mesh, sms::Count_ratio_stop_predicate<CgalMesh>(0.1),
                       CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
  });
}
BENCHMARK(cgal_garland_heckbert)->Apply(models);
#endif
void cgal_lindstrom_turk(benchmark::State& state) {
  run_cgal(state, [](CgalMesh& mesh) {
    sms::edge_collapse(mesh, sms::Count_ratio_stop_predicate<CgalMesh>(0.1),
                       CGAL::parameters::get_cost(sms::LindstromTurk_cost<CgalMesh>())
                           .get_placement(sms::LindstromTurk_placement<CgalMesh>()));
  });
}
BENCHMARK(cgal_lindstrom_turk)->Apply(models);

#ifdef BENCH_WITH_OPENMESH
struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using OpenMesh_ = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

void openmesh_decimater(benchmark::State& state) {
  const Shape& shape = model(state);
  Shape after;
  for (auto step : state) {
    state.PauseTiming();
    OpenMesh_ mesh;
    std::vector<OpenMesh_::VertexHandle> handles;
    for (const Vec3& p : shape.points) handles.push_back(mesh.add_vertex({p.x, p.y, p.z}));
    for (const auto& [a, b, c] : shape.triangles) mesh.add_face(handles[a], handles[b], handles[c]);
    state.ResumeTiming();
    mesh.request_face_normals();
    mesh.update_face_normals();
    OpenMesh::Decimater::DecimaterT<OpenMesh_> decimater(mesh);
    OpenMesh::Decimater::ModQuadricT<OpenMesh_>::Handle quadric;
    decimater.add(quadric);
    decimater.initialize();
    decimater.decimate_to_faces(0, shape.triangles.size() / 10);
    state.PauseTiming();
    mesh.garbage_collection();
    after = {};
    for (const auto v : mesh.vertices()) after.points.push_back({mesh.point(v)[0], mesh.point(v)[1], mesh.point(v)[2]});
    for (const auto f : mesh.faces()) {
      auto corner = mesh.cfv_iter(f);
      TriangleMesh::Triangle triangle{};
      for (std::uint32_t& number : triangle) number = static_cast<std::uint32_t>((corner++)->idx());
      after.triangles.push_back(triangle);
    }
    state.ResumeTiming();
  }
  report(state, shape, after);
}
BENCHMARK(openmesh_decimater)->Apply(models);
#endif

#ifdef BENCH_WITH_MESHOPTIMIZER
/// It works on floats.
void meshoptimizer(benchmark::State& state) {
  const Shape& shape = model(state);
  std::vector<float> points;
  for (const Vec3& p : shape.points)
    for (std::size_t axis = 0; axis < 3; ++axis) points.push_back(static_cast<float>(p[axis]));
  std::vector<unsigned> indices, result;
  for (const auto& triangle : shape.triangles) indices.insert(indices.end(), triangle.begin(), triangle.end());
  for (auto step : state) {
    result.resize(indices.size());
    result.resize(meshopt_simplify(result.data(), indices.data(), indices.size(), points.data(), shape.points.size(),
                                   3 * sizeof(float), indices.size() / 10, 1.0F, 0, nullptr));
  }
  Shape after{shape.points, {}};
  for (std::size_t i = 0; i < result.size(); i += 3)
    after.triangles.push_back({result[i], result[i + 1], result[i + 2]});
  report(state, shape, after);
}
BENCHMARK(meshoptimizer)->Apply(models);
#endif

}  // namespace

BENCHMARK_MAIN();
