// Import of a binary STL file (read, welded, put into spatial order, proved) beside CGAL on the same file in the same
// run: read as a polygon soup, welded, oriented, made a mesh and searched for self-intersections. CGAL answers whether
// the mesh is closed and whether some pair intersects; we also prove winding numbers. The kernel is the one CGAL
// recommends for this (exact predicates, inexact constructions). Compare lines of the same argument.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "algebra3d/operators/import_solid.h"
#include "stl/stl_writer.h"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace pmp = CGAL::Polygon_mesh_processing;

/// A knobbly torus of 4 * steps^2 triangles, in a file that is removed at the end.
class TorusFile {
 public:
  explicit TorusFile(std::size_t steps)
      : path_(std::filesystem::temp_directory_path() / ("import_bench_" + std::to_string(steps) + ".stl")) {
    algebra3d::TriangleSoup soup;
    const auto corner = [&](std::size_t i, std::size_t j) {
      const double u = std::numbers::pi * static_cast<double>(i % (2 * steps)) / static_cast<double>(steps);
      const double v = 2 * std::numbers::pi * static_cast<double>(j % steps) / static_cast<double>(steps);
      const double minor = 10 + std::sin(11 * u) * std::cos(7 * v);
      const double radius = 40 + minor * std::cos(v);
      const auto as_float = [](double x) { return static_cast<double>(static_cast<float>(x)); };
      return algebra3d::Vec3{as_float(radius * std::cos(u)), as_float(radius * std::sin(u)),
                             as_float(minor * std::sin(v))};
    };
    for (std::size_t i = 0; i < 2 * steps; ++i)
      for (std::size_t j = 0; j < steps; ++j) {
        soup.triangles.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
        soup.triangles.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
      }
    is_written_ = stl::write_stl_file(path_, soup, "torus", stl::Format::binary).ok();
  }
  TorusFile(const TorusFile&) = delete;
  TorusFile& operator=(const TorusFile&) = delete;
  ~TorusFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }

  const std::filesystem::path& path() const { return path_; }
  bool is_written() const { return is_written_; }

 private:
  std::filesystem::path path_;
  bool is_written_ = false;
};

void import_ours(benchmark::State& state) {
  const TorusFile file(static_cast<std::size_t>(state.range(0)));
  if (!file.is_written()) return state.SkipWithError("the file cannot be written");
  std::size_t triangles = 0;
  for (auto step : state) {
    const auto imported = algebra3d::import_solid(file.path());
    if (!imported || !imported->solid) return state.SkipWithError("no solid");
    triangles = imported->solid->mesh().face_count();
  }
  state.counters["triangles"] = static_cast<double>(triangles);
}

void import_cgal(benchmark::State& state) {
  const TorusFile file(static_cast<std::size_t>(state.range(0)));
  if (!file.is_written()) return state.SkipWithError("the file cannot be written");
  std::size_t triangles = 0;
  for (auto step : state) {
    std::vector<Kernel::Point_3> points;
    std::vector<std::vector<std::size_t>> polygons;
    if (!CGAL::IO::read_STL(file.path().string(), points, polygons)) return state.SkipWithError("not read");
    pmp::merge_duplicate_points_in_polygon_soup(points, polygons);
    pmp::orient_polygon_soup(points, polygons);
    Mesh mesh;
    pmp::polygon_soup_to_polygon_mesh(points, polygons, mesh);
    if (!CGAL::is_closed(mesh) || pmp::does_self_intersect(mesh)) return state.SkipWithError("no solid");
    triangles = mesh.number_of_faces();
  }
  state.counters["triangles"] = static_cast<double>(triangles);
}

BENCHMARK(import_ours)->Arg(100)->Arg(224)->Arg(707)->Unit(benchmark::kMillisecond);
BENCHMARK(import_cgal)->Arg(100)->Arg(224)->Arg(707)->Unit(benchmark::kMillisecond);

}  // namespace
