// Decimation beside OpenMesh, CGAL and meshoptimizer, to a tenth of the triangles: spheres with waves and dents, a
// knobbly torus, a rough terrain (the one surface with a boundary), and the solids in the files that ALGEBRA3D_MODELS
// names; with vertices and triangles in order, and shuffled. The meshes of the peers are built before the clock starts,
// and their results are not taken out of them; ours goes from mesh to mesh. `deviation` is the Hausdorff distance from
// the mesh by our exact search, in parts of a million of half the largest extent, and `crossing` whether the result is
// not a valid volume (of the terrain, surface).
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
#include <string>

#include "algebra3d/kernel/distance/farthest_point.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/simplification/simplification.h"
#include "algebra3d/kernel/validity/validity.h"
#include "indexed_faces.h"
#include "models.h"
#include "shapes.h"

namespace {

using namespace bench;

enum class Model : std::uint8_t { small_sphere, sphere, torus, terrain, file };

/// A model; files by their numbers.
struct Choice {
  Model model;
  std::size_t file;
  bool is_shuffled;

  friend auto operator<=>(const Choice&, const Choice&) = default;
};

/// With waves of some wavelengths, and triangles in order along the faces of the icosahedron.
Shape waves_on_sphere(std::uint32_t frequency) {
  Shape shape = sphere(frequency);
  for (Vec3& p : shape.points)
    p = (1 + 0.05 * std::sin(7 * p.x) * std::cos(9 * p.y) + 0.01 * std::sin(31 * p.z + 20 * p.x)) * p;
  return shape;
}

/// Half a million triangles, with knobs.
Shape knobbly_torus() {
  const IndexedFaces faces = torus_of_triangles(500);
  Shape shape{faces.points, {}};
  for (Vec3& p : shape.points) {
    const double u = std::atan2(p.y, p.x), v = std::atan2(p.z, std::hypot(p.x, p.y) - 3);
    const double radius = 1 + 0.1 * std::sin(12 * u) * std::sin(5 * v) + 0.01 * std::sin(60 * u + 9 * v);
    p = {(3 + radius * std::cos(v)) * std::cos(u), (3 + radius * std::cos(v)) * std::sin(u), radius * std::sin(v)};
  }
  for (std::size_t i = 0; i < faces.corners.size(); i += 3)
    shape.triangles.push_back({faces.corners[i], faces.corners[i + 1], faces.corners[i + 2]});
  return shape;
}

/// Half a million triangles over a square of side 2: hills of five wavelengths, and noise of a fifth of an edge.
Shape rough_terrain() {
  constexpr std::uint32_t kSide = 500;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> noise(-0.2, 0.2);
  Shape shape;
  for (std::uint32_t i = 0; i <= kSide; ++i) {
    for (std::uint32_t j = 0; j <= kSide; ++j) {
      const double x = 2.0 * i / kSide - 1, y = 2.0 * j / kSide - 1;
      double z = noise(random) * 2 / kSide;
      for (int k = 0; k < 5; ++k) {
        const double wave = 3 << k;
        z += 0.4 / wave * std::sin(wave * x + k) * std::cos(wave * (y - 0.3 * x));
      }
      shape.points.push_back({x, y, z});
    }
  }
  for (std::uint32_t i = 0; i < kSide; ++i) {
    for (std::uint32_t j = 0; j < kSide; ++j) {
      const std::uint32_t a = i * (kSide + 1) + j, b = a + kSide + 1;
      shape.triangles.push_back({a, b, b + 1});
      shape.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return shape;
}

Shape shuffled_shape(Shape shape) {
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

Shape made(Model model, std::size_t file) {
  switch (model) {
    case Model::small_sphere:
      return waves_on_sphere(22);
    case Model::sphere:
      return waves_on_sphere(224);
    case Model::torus:
      return knobbly_torus();
    case Model::terrain:
      return rough_terrain();
    case Model::file:
      break;
  }
  return models()[file];
}

const Shape& shape_for(const Choice& choice) {
  static std::map<Choice, Shape> shapes;
  Shape& shape = shapes[choice];
  if (!shape.points.empty()) return shape;
  shape = made(choice.model, choice.file);
  if (choice.is_shuffled) shape = shuffled_shape(std::move(shape));
  return shape;
}

double half_extent(const Shape& shape) {
  const Vec3 size = algebra3d::Box3::around(shape.points).max - algebra3d::Box3::around(shape.points).min;
  return std::max({size.x, size.y, size.z}) / 2;
}

void report(benchmark::State& state, const Shape& before, const Shape& after) {
  const TriangleMesh a = mesh_of(before), b = mesh_of(after);
  const algebra3d::BoxHierarchy a_boxes(a), b_boxes(b);
  const algebra3d::DistanceOperand from{&a, &a_boxes}, to{&b, &b_boxes};
  const auto farthest =
      algebra3d::farthest_point(std::array{algebra3d::FarthestSearch{from, to}, algebra3d::FarthestSearch{to, from}});
  state.counters["triangles"] = static_cast<double>(after.triangles.size());
  state.counters["deviation"] = 1e6 * farthest.value()->upper_bound / half_extent(before);
  const bool is_valid =
      algebra3d::is_closed(a) ? algebra3d::prove_volume(b)->is_valid() : algebra3d::prove_surface(b)->is_valid();
  state.counters["crossing"] = is_valid ? 0 : 1;
}

Shape shape_of(const TriangleMesh& mesh) {
  Shape shape{mesh.points().approx(), {}};
  for (std::size_t f = 0; f < mesh.face_count(); ++f) shape.triangles.push_back(mesh.triangle(algebra3d::FaceId(f)));
  return shape;
}

template <auto kSimplify>
void ours(benchmark::State& state, const Choice& choice) {
  const Shape& shape = shape_for(choice);
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
/// With the proof that the result is a valid volume or surface.
auto with_proof(const TriangleMesh& mesh, std::size_t count) {
  return algebra3d::is_closed(mesh) ? algebra3d::simplified_volume(mesh, {count})
                                    : algebra3d::simplified_surface(mesh, {count});
}

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
void run_cgal(benchmark::State& state, const Choice& choice, const Simplify& simplify) {
  const Shape& shape = shape_for(choice);
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
void cgal_garland_heckbert(benchmark::State& state, const Choice& choice) {
  run_cgal(state, choice, [](CgalMesh& mesh) {
    const sms::GarlandHeckbert_plane_policies<CgalMesh, Kernel> policies(mesh);
    sms::edge_collapse(mesh, sms::Count_ratio_stop_predicate<CgalMesh>(0.1),
                       CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
  });
}
#endif
void cgal_lindstrom_turk(benchmark::State& state, const Choice& choice) {
  run_cgal(state, choice, [](CgalMesh& mesh) {
    sms::edge_collapse(mesh, sms::Count_ratio_stop_predicate<CgalMesh>(0.1),
                       CGAL::parameters::get_cost(sms::LindstromTurk_cost<CgalMesh>())
                           .get_placement(sms::LindstromTurk_placement<CgalMesh>()));
  });
}

#ifdef BENCH_WITH_OPENMESH
struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using OpenMesh_ = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

void openmesh_decimater(benchmark::State& state, const Choice& choice) {
  const Shape& shape = shape_for(choice);
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
#endif

#ifdef BENCH_WITH_MESHOPTIMIZER
/// It works on floats.
void meshoptimizer(benchmark::State& state, const Choice& choice) {
  const Shape& shape = shape_for(choice);
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
#endif

using Work = void (*)(benchmark::State&, const Choice&);

void add(const std::string& name, Work work, const std::string& model, const Choice& choice) {
  benchmark::RegisterBenchmark((model + (choice.is_shuffled ? "/random/" : "/good/") + name).c_str(),
                               [=](benchmark::State& state) { work(state, choice); })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

void add_all(const std::string& model, const Choice& choice) {
  add("ours", ours<as_mesh>, model, choice);
  add("ours_with_proof", ours<with_proof>, model, choice);
#ifdef BENCH_WITH_EIGEN3
  add("cgal_garland_heckbert", cgal_garland_heckbert, model, choice);
#endif
  add("cgal_lindstrom_turk", cgal_lindstrom_turk, model, choice);
#ifdef BENCH_WITH_OPENMESH
  add("openmesh", openmesh_decimater, model, choice);
#endif
#ifdef BENCH_WITH_MESHOPTIMIZER
  add("meshoptimizer", meshoptimizer, model, choice);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  for (const bool is_shuffled : {false, true}) {
    add_all("small_sphere", {Model::small_sphere, 0, is_shuffled});
    add_all("sphere", {Model::sphere, 0, is_shuffled});
    add_all("torus", {Model::torus, 0, is_shuffled});
    add_all("terrain", {Model::terrain, 0, is_shuffled});
    for (std::size_t file = 0; file < models().size(); ++file)
      add_all("model_" + std::to_string(file + 1), {Model::file, file, is_shuffled});
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
