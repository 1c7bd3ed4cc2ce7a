// Half-edge meshes beside CGAL::Surface_mesh and OpenMesh: built from indexed faces, rings traversed, normals of faces
// and vertices; on a closed mesh of a million triangles and one of half a million quadrilaterals, in the order of the
// rows of a torus ("good") and in random order. Ours reorders what arrives in random order, as a part of building; the
// others keep the order. "by_hand" are loops over the mesh as users write them, in place of the functions of CGAL.
// Normals of vertices: "vertex_normals" is the function alone, "all_normals" begins with the points and makes those of
// the faces as well where the function takes them from there: that of OpenMesh and the loop by hand do, ours and
// CGAL's do not. OpenMesh's "correct" normals are sums of cross products of edges, from the points.
// The counter is the number of bytes per face.
#include <benchmark/benchmark.h>

#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#ifdef BENCH_WITH_OPENMESH
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#endif

#include <malloc.h>

#include <optional>
#include <string>
#include <vector>

#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/normals.h"
#include "algebra3d/kernel/halfedge/polygon_mesh.h"
#include "algebra3d/kernel/soup/spatial_order.h"
#include "base/scheduler.h"
#include "indexed_faces.h"

namespace {

using namespace bench;
using algebra3d::FaceId;
using algebra3d::PolygonLayout;
using algebra3d::PolygonMesh;
using algebra3d::PolygonSoup;
using algebra3d::VertexId;

constexpr std::uint32_t kSide = 707;  // 999,698 triangles, 499,849 quadrilaterals

enum class Order : std::uint8_t { good, random };

const IndexedFaces& faces_of(std::uint32_t degree, Order order) {
  static const IndexedFaces triangles = torus_of_triangles(kSide), random_triangles = shuffled(triangles);
  static const IndexedFaces quads = torus_of_quadrilaterals(kSide), random_quads = shuffled(quads);
  if (degree == 3) return order == Order::good ? triangles : random_triangles;
  return order == Order::good ? quads : random_quads;
}

// A structure has `build` (from `input` of the faces, if it has that, else from the faces), `one_ring` (a sum over the
// centroids of all neighbourhoods and their sizes), `face_normals`, `vertex_normals`, and `takes_face_normals` if that
// needs those of the faces.

template <std::uint32_t kDegree>
struct Ours {
  static constexpr std::uint32_t degree = kDegree;
  static constexpr bool takes_face_normals = false;
  using Mesh = std::conditional_t<kDegree == 3, TriangleMesh, PolygonMesh>;
  struct Built {
    Mesh mesh;
    std::vector<Vec3> of_faces, of_vertices;
  };

  using Input = std::conditional_t<kDegree == 3, algebra3d::WeldedTriangles, PolygonSoup>;

  static Input input(const IndexedFaces& faces) {
    Input result;
    if constexpr (kDegree == 3) {
      result.points = PointArray(faces.points);
      for (std::size_t h = 0; h < faces.corners.size(); h += 3)
        result.triangles.push_back({faces.corners[h], faces.corners[h + 1], faces.corners[h + 2]});
    } else {
      result.points = faces.points;
      result.corners = faces.corners;
      for (std::size_t h = kDegree; h <= faces.corners.size(); h += kDegree)
        result.face_starts.push_back(static_cast<std::uint32_t>(h));
    }
    return result;
  }
  static Built build(const Input& faces, Order order) {
    if (order == Order::good) return {mesh_of(faces), {}, {}};
    if constexpr (kDegree == 3)
      return {mesh_of(reordered(faces, algebra3d::spatial_order(faces.points.approx(), faces.triangles))), {}, {}};
    else
      return {mesh_of(in_spatial_order(faces)), {}, {}};
  }
  static Mesh mesh_of(Input faces) {
    if constexpr (kDegree == 3)
      return {std::move(faces.points), faces.triangles};
    else
      return {PointArray(std::move(faces.points)),
              PolygonLayout::of_degree(kDegree),
              {faces.corners.begin(), faces.corners.end()}};
  }
  static std::size_t bytes(const Built& built) { return built.mesh.heap_bytes(); }
  static double one_ring(const Built& built) {
    const Mesh& mesh = built.mesh;
    const std::vector<Vec3>& points = mesh.points().approx();
    constexpr std::size_t kVerticesPerTask = 20000;
    std::vector<double> sums((mesh.vertex_count() + kVerticesPerTask - 1) / kVerticesPerTask);
    algebra3d::parallel_for(sums.size(), 1, [&](std::size_t task) {
      const std::size_t end = std::min(mesh.vertex_count(), (task + 1) * kVerticesPerTask);
      double total = 0;
      for (std::size_t v = task * kVerticesPerTask; v < end; ++v) {
        Vec3 sum;
        double valence = 0;
        for (const VertexId neighbour : adjacent_vertices(mesh, VertexId(v))) {
          sum = sum + points[neighbour.index()];
          ++valence;
        }
        total += valence + (sum.x + sum.y + sum.z) / valence;
      }
      sums[task] = total;
    });
    double result = 0;
    for (const double sum : sums) result += sum;
    return result;
  }
  static void prepare(Built& built) {
    built.of_faces.resize(built.mesh.face_count());
    built.of_vertices.resize(built.mesh.vertex_count());
  }
  static void face_normals(Built& built) { algebra3d::face_normals(built.mesh, built.of_faces); }
  static void vertex_normals(Built& built) { algebra3d::vertex_normals(built.mesh, built.of_vertices); }
};

using Kernel = CGAL::Simple_cartesian<double>;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;

template <std::uint32_t kDegree>
struct Cgal {
  static constexpr std::uint32_t degree = kDegree;
  static constexpr bool takes_face_normals = false;
  using FaceNormals = CgalMesh::Property_map<CgalMesh::Face_index, Kernel::Vector_3>;
  using VertexNormals = CgalMesh::Property_map<CgalMesh::Vertex_index, Kernel::Vector_3>;
  struct Built {
    CgalMesh mesh;
    FaceNormals of_faces;
    VertexNormals of_vertices;
  };

  static Built build(const IndexedFaces& faces, Order /*order*/) {
    Built built;
    CgalMesh& mesh = built.mesh;
    const auto face_count = static_cast<std::uint32_t>(faces.face_count());
    mesh.reserve(static_cast<std::uint32_t>(faces.points.size()), face_count * kDegree / 2, face_count);
    for (const Vec3& p : faces.points) mesh.add_vertex({p.x, p.y, p.z});
    std::array<CgalMesh::Vertex_index, kDegree> corners;
    for (std::size_t h = 0; h < faces.corners.size(); h += kDegree) {
      for (std::size_t i = 0; i < kDegree; ++i) corners[i] = CgalMesh::Vertex_index(faces.corners[h + i]);
      mesh.add_face(corners);
    }
    return built;
  }
  static double one_ring(const Built& built) {
    const CgalMesh& mesh = built.mesh;
    double total = 0;
    for (const auto v : mesh.vertices()) {
      double x = 0, y = 0, z = 0, valence = 0;
      for (const auto neighbour : vertices_around_target(mesh.halfedge(v), mesh)) {
        const auto& p = mesh.point(neighbour);
        x += p.x(), y += p.y(), z += p.z(), ++valence;
      }
      total += valence + (x + y + z) / valence;
    }
    return total;
  }
  static void prepare(Built& built) {
    CgalMesh& mesh = built.mesh;
    built.of_faces = mesh.add_property_map<CgalMesh::Face_index, Kernel::Vector_3>("f:normal").first;
    built.of_vertices = mesh.add_property_map<CgalMesh::Vertex_index, Kernel::Vector_3>("v:normal").first;
  }
  static void face_normals(Built& built) {
    CGAL::Polygon_mesh_processing::compute_face_normals(built.mesh, built.of_faces);
  }
  static void vertex_normals(Built& built) {
    CGAL::Polygon_mesh_processing::compute_vertex_normals(built.mesh, built.of_vertices);
  }
};

/// Normals of faces from two edges or diagonals, those of vertices from the sum of the normals of the faces, weighted
/// by angle, as ours are.
template <std::uint32_t kDegree>
struct CgalByHand : Cgal<kDegree> {
  static constexpr bool takes_face_normals = true;
  using Built = typename Cgal<kDegree>::Built;

  static Kernel::Vector_3 unit(const Kernel::Vector_3& v) { return v / std::sqrt(v.squared_length()); }
  static void face_normals(Built& built) {
    const CgalMesh& mesh = built.mesh;
    for (const auto f : mesh.faces()) {
      const auto first = mesh.halfedge(f), second = mesh.next(first), third = mesh.next(second);
      const auto &a = mesh.point(mesh.target(first)), &b = mesh.point(mesh.target(second));
      const auto& c = mesh.point(mesh.target(third));
      if constexpr (kDegree == 3)
        built.of_faces[f] = unit(CGAL::cross_product(b - a, c - a));
      else
        built.of_faces[f] = unit(CGAL::cross_product(c - a, mesh.point(mesh.source(first)) - b));
    }
  }
  static void vertex_normals(Built& built) {
    const CgalMesh& mesh = built.mesh;
    for (const auto v : mesh.vertices()) {
      Kernel::Vector_3 sum(0, 0, 0);
      for (const auto h : halfedges_around_target(mesh.halfedge(v), mesh)) {
        const auto a = mesh.point(mesh.source(h)) - mesh.point(v),
                   b = mesh.point(mesh.target(mesh.next(h))) - mesh.point(v);
        const double angle = std::atan2(std::sqrt(CGAL::cross_product(a, b).squared_length()), a * b);
        sum = sum + angle * built.of_faces[mesh.face(h)];
      }
      built.of_vertices[v] = unit(sum);
    }
  }
};

#ifdef BENCH_WITH_OPENMESH
struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};

template <std::uint32_t kDegree>
struct OpenMeshes {
  static constexpr std::uint32_t degree = kDegree;
  static constexpr bool takes_face_normals = true;
  using Mesh =
      std::conditional_t<kDegree == 3, OpenMesh::TriMesh_ArrayKernelT<Traits>, OpenMesh::PolyMesh_ArrayKernelT<Traits>>;
  struct Built {
    Mesh mesh;
  };

  static Built build(const IndexedFaces& faces, Order /*order*/) {
    Built built;
    Mesh& mesh = built.mesh;
    mesh.reserve(faces.points.size(), faces.face_count() * kDegree / 2, faces.face_count());
    for (const Vec3& p : faces.points) mesh.add_vertex({p.x, p.y, p.z});
    std::array<OpenMesh::VertexHandle, kDegree> corners;
    for (std::size_t h = 0; h < faces.corners.size(); h += kDegree) {
      for (std::size_t i = 0; i < kDegree; ++i)
        corners[i] = OpenMesh::VertexHandle(static_cast<int>(faces.corners[h + i]));
      mesh.add_face(corners.data(), kDegree);
    }
    return built;
  }
  static double one_ring(const Built& built) {
    const Mesh& mesh = built.mesh;
    double total = 0;
    for (auto v = mesh.vertices_begin(); v != mesh.vertices_end(); ++v) {
      OpenMesh::Vec3d sum(0, 0, 0);
      double valence = 0;
      for (auto around = mesh.cvv_iter(*v); around.is_valid(); ++around) {
        sum += mesh.point(*around);
        ++valence;
      }
      total += valence + (sum[0] + sum[1] + sum[2]) / valence;
    }
    return total;
  }
  static void prepare(Built& built) {
    built.mesh.request_face_normals();
    built.mesh.request_vertex_normals();
  }
  static void face_normals(Built& built) { built.mesh.update_face_normals(); }
  static void vertex_normals(Built& built) { built.mesh.update_vertex_normals(); }
};

template <std::uint32_t kDegree>
struct OpenMeshesCorrect : OpenMeshes<kDegree> {
  static constexpr bool takes_face_normals = false;
  static void vertex_normals(typename OpenMeshes<kDegree>::Built& built) {
    for (const auto v : built.mesh.vertices()) {
      OpenMesh::Vec3d normal;
      built.mesh.calc_vertex_normal_correct(v, normal);
      built.mesh.set_normal(v, normal.normalize_cond());
    }
  }
};
#endif

std::size_t heap_bytes_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// The faces as a structure wants them.
template <typename Structure>
decltype(auto) input_of(const IndexedFaces& faces) {
  if constexpr (requires { Structure::input(faces); })
    return Structure::input(faces);
  else
    return (faces);
}

template <typename Structure>
void build(benchmark::State& state, Order order) {
  const IndexedFaces& faces = faces_of(Structure::degree, order);
  const auto& input = input_of<Structure>(faces);
  std::optional<typename Structure::Built> built;
  std::size_t bytes = 0;
  for (auto step : state) {
    state.PauseTiming();
    built.reset();
    const std::size_t before = heap_bytes_in_use();
    state.ResumeTiming();
    built = Structure::build(input, order);
    state.PauseTiming();
    if constexpr (requires { Structure::bytes(*built); })
      bytes = Structure::bytes(*built);
    else
      bytes = heap_bytes_in_use() - before;
    state.ResumeTiming();
  }
  state.counters["bytes_per_face"] = static_cast<double>(bytes) / static_cast<double>(faces.face_count());
}

template <typename Structure>
typename Structure::Built prepared(Order order) {
  auto built = Structure::build(input_of<Structure>(faces_of(Structure::degree, order)), order);
  if constexpr (requires { Structure::prepare(built); }) Structure::prepare(built);
  Structure::face_normals(built);
  Structure::vertex_normals(built);
  return built;
}

template <typename Structure>
void one_ring(benchmark::State& state, Order order) {
  const auto built = prepared<Structure>(order);
  for (auto step : state) benchmark::DoNotOptimize(Structure::one_ring(built));
}

template <typename Structure>
void face_normals(benchmark::State& state, Order order) {
  auto built = prepared<Structure>(order);
  for (auto step : state) Structure::face_normals(built);
}

template <typename Structure>
void vertex_normals(benchmark::State& state, Order order) {
  auto built = prepared<Structure>(order);
  for (auto step : state) Structure::vertex_normals(built);
}

template <typename Structure>
void all_normals(benchmark::State& state, Order order) {
  auto built = prepared<Structure>(order);
  for (auto step : state) {
    if constexpr (Structure::takes_face_normals) Structure::face_normals(built);
    Structure::vertex_normals(built);
  }
}

using Work = void (*)(benchmark::State&, Order);

void add(const std::string& name, Work work, int threads) {
  for (const Order order : {Order::good, Order::random}) {
    const auto run = [=](benchmark::State& state) {
      if (threads == 0)
        work(state, order);
      else
        algebra3d::with_threads(threads, [&] { work(state, order); });
    };
    benchmark::RegisterBenchmark((name + (order == Order::good ? "/good" : "/random")).c_str(), run)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  }
}

template <typename Structure>
void add_all(const std::string& name, int threads = 0) {
  const std::string shape = Structure::degree == 3 ? "triangles" : "quadrilaterals";
  add("build/" + shape + "/" + name, build<Structure>, threads);
  add("one_ring/" + shape + "/" + name, one_ring<Structure>, threads);
  add("face_normals/" + shape + "/" + name, face_normals<Structure>, threads);
  add("vertex_normals/" + shape + "/" + name, vertex_normals<Structure>, threads);
  add("all_normals/" + shape + "/" + name, all_normals<Structure>, threads);
}

template <std::uint32_t kDegree>
void add_structures() {
  add_all<Ours<kDegree>>("ours");
  add_all<Ours<kDegree>>("ours_one_thread", 1);
  add_all<Cgal<kDegree>>("cgal");
  add_all<CgalByHand<kDegree>>("cgal_by_hand");
#ifdef BENCH_WITH_OPENMESH
  add_all<OpenMeshes<kDegree>>("openmesh");
  add("all_normals/" + std::string(kDegree == 3 ? "triangles" : "quadrilaterals") + "/openmesh_correct",
      all_normals<OpenMeshesCorrect<kDegree>>, 0);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  add_structures<3>();
  add_structures<4>();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
