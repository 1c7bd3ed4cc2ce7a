// Reading ASCII STL, OBJ and OFF files of 2 million triangles, and writing them, beside CGAL's readers on the same file
// in the same run. Coordinates have six decimals, as most programs write them; those of `stl_all_digits` are floats
// with all the digits of the double, as exportSTL writes them. Compare lines of the same format; all files lie in the
// system's cache.
#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "mesh_formats/obj/obj_reader.h"
#include "mesh_formats/obj/obj_writer.h"
#include "mesh_formats/off/off_reader.h"
#include "mesh_formats/off/off_writer.h"
#include "removed_file.h"
#include "stl/stl_reader.h"
#include "stl/stl_writer.h"

namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;

constexpr std::uint32_t kSteps = 1000;

enum class FileKind { stl, stl_all_digits, obj, obj_with_attributes, off, off_binary };

/// A knobbly torus of 2 * kSteps^2 triangles.
algebra3d::PolygonSoup torus() {
  algebra3d::PolygonSoup soup;
  const auto decimal = [](double x) { return std::round(x * 1e6) / 1e6; };
  for (std::uint32_t i = 0; i < kSteps; ++i)
    for (std::uint32_t j = 0; j < kSteps; ++j) {
      const double u = 2 * std::numbers::pi * i / kSteps;
      const double v = 2 * std::numbers::pi * j / kSteps;
      const double minor = 10 + std::sin(11 * u) * std::cos(7 * v);
      const double radius = 40 + minor * std::cos(v);
      soup.points.push_back(
          {decimal(radius * std::cos(u)), decimal(radius * std::sin(u)), decimal(minor * std::sin(v))});
    }
  const auto index = [](std::uint32_t i, std::uint32_t j) { return i % kSteps * kSteps + j % kSteps; };
  for (std::uint32_t i = 0; i < kSteps; ++i)
    for (std::uint32_t j = 0; j < kSteps; ++j) {
      soup.add_face(std::array{index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      soup.add_face(std::array{index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  return soup;
}

// With texture coordinates and normals, as programs that draw write them.
bool write_with_attributes(const std::filesystem::path& path, const algebra3d::PolygonSoup& soup) {
  std::ofstream file(path);
  file.precision(15);
  for (const auto& point : soup.points) file << "v " << point.x << ' ' << point.y << ' ' << point.z << '\n';
  for (std::size_t i = 0; i < soup.points.size(); ++i) file << "vt 0.123400 0.567800\nvn 0.1234 0.5678 0.1234\n";
  for (std::size_t i = 0; i < soup.face_count(); ++i) {
    file << 'f';
    for (const auto corner : soup.face(i)) file << ' ' << corner + 1 << '/' << corner + 1 << '/' << corner + 1;
    file << '\n';
  }
  return static_cast<bool>(file.flush());
}

std::array<algebra3d::Vec3, 3> triangle_of(const algebra3d::PolygonSoup& soup, std::size_t face) {
  const auto corners = soup.face(face);
  return {soup.points[corners[0]], soup.points[corners[1]], soup.points[corners[2]]};
}

bool write_stl_with_decimals(const std::filesystem::path& path, const algebra3d::PolygonSoup& soup) {
  std::ofstream file(path);
  file << std::fixed << "solid torus\n";  // six decimals
  const auto write_vector = [&](const algebra3d::Vec3& v) { file << ' ' << v.x << ' ' << v.y << ' ' << v.z << '\n'; };
  for (std::size_t i = 0; i < soup.face_count(); ++i) {
    const auto [a, b, c] = triangle_of(soup, i);
    const algebra3d::Vec3 normal = cross(b - a, c - a);
    write_vector((file << "  facet normal", (1 / length(normal)) * normal));
    file << "    outer loop\n";
    for (const algebra3d::Vec3& corner : {a, b, c}) write_vector((file << "      vertex", corner));
    file << "    endloop\n  endfacet\n";
  }
  file << "endsolid torus\n";
  return static_cast<bool>(file.flush());
}

bool write_stl_with_all_digits(const std::filesystem::path& path, const algebra3d::PolygonSoup& soup) {
  algebra3d::TriangleSoup triangles;
  for (std::size_t i = 0; i < soup.face_count(); ++i) triangles.triangles.push_back(triangle_of(soup, i));
  return mesh_formats::write_stl_file(path, triangles, "torus", mesh_formats::Encoding::ascii).ok();
}

bool write(FileKind kind, const std::filesystem::path& path, const algebra3d::PolygonSoup& soup) {
  if (kind == FileKind::stl) return write_stl_with_decimals(path, soup);
  if (kind == FileKind::stl_all_digits) return write_stl_with_all_digits(path, soup);
  if (kind == FileKind::obj) return mesh_formats::write_obj_file(path, soup, "torus").ok();
  if (kind == FileKind::obj_with_attributes) return write_with_attributes(path, soup);
  const auto format = kind == FileKind::off ? mesh_formats::Encoding::ascii : mesh_formats::Encoding::binary;
  return mesh_formats::write_off_file(path, soup, format).ok();
}

bool is_stl(FileKind kind) {
  return kind == FileKind::stl || kind == FileKind::stl_all_digits;
}

bool is_obj(FileKind kind) {
  return kind == FileKind::obj || kind == FileKind::obj_with_attributes;
}

/// The torus in a file.
class TorusFile : public RemovedFile {
 public:
  explicit TorusFile(FileKind kind)
      : RemovedFile(std::filesystem::temp_directory_path() / (is_stl(kind)   ? "mesh_files.stl"
                                                              : is_obj(kind) ? "mesh_files.obj"
                                                                             : "mesh_files.off")) {
    set_written(write(kind, path(), torus()));
  }
};

/// The number of faces that we read, 0 for an error.
std::size_t faces_read(FileKind kind, const std::filesystem::path& path) {
  if (is_stl(kind)) {
    const auto read = mesh_formats::read_stl_file(path);
    return read ? read->soup.triangles.size() : 0;
  }
  const auto read = is_obj(kind) ? mesh_formats::read_obj_file(path) : mesh_formats::read_off_file(path);
  return read ? read->soup.face_count() : 0;
}

/// The number of faces that CGAL reads.
std::size_t faces_read_by_cgal(FileKind kind, const std::string& path) {
  std::vector<Point> points;
  if (is_stl(kind)) {
    std::vector<std::array<int, 3>> triangles;
    return CGAL::IO::read_STL(path, points, triangles) ? triangles.size() : 0;
  }
  std::vector<std::vector<std::size_t>> polygons;
  const bool is_read =
      is_obj(kind) ? CGAL::IO::read_OBJ(path, points, polygons) : CGAL::IO::read_OFF(path, points, polygons);
  return is_read ? polygons.size() : 0;
}

void read_ours(benchmark::State& state, FileKind kind) {
  const TorusFile file(kind);
  if (!file.is_written()) return state.SkipWithError("the file cannot be written");
  for (auto step : state)
    if (faces_read(kind, file.path()) != 2U * kSteps * kSteps) return state.SkipWithError("not read");
  state.SetBytesProcessed(state.iterations() * file.bytes());
}

void read_cgal(benchmark::State& state, FileKind kind) {
  const TorusFile file(kind);
  if (!file.is_written()) return state.SkipWithError("the file cannot be written");
  for (auto step : state)
    if (faces_read_by_cgal(kind, file.path().string()) != 2U * kSteps * kSteps) return state.SkipWithError("not read");
  state.SetBytesProcessed(state.iterations() * file.bytes());
}

// To the disk and back: the file is not in place before the disk has it.
void write_ours(benchmark::State& state, FileKind kind) {
  const algebra3d::PolygonSoup soup = torus();
  const TorusFile file(kind);
  for (auto step : state)
    if (!write(kind, file.path(), soup)) return state.SkipWithError("the file cannot be written");
  state.SetBytesProcessed(state.iterations() * file.bytes());
}

BENCHMARK_CAPTURE(read_ours, stl, FileKind::stl)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_cgal, stl, FileKind::stl)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_ours, stl_all_digits, FileKind::stl_all_digits)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_cgal, stl_all_digits, FileKind::stl_all_digits)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_ours, obj, FileKind::obj)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_cgal, obj, FileKind::obj)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_ours, obj_with_attributes, FileKind::obj_with_attributes)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_cgal, obj_with_attributes, FileKind::obj_with_attributes)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_ours, off, FileKind::off)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_cgal, off, FileKind::off)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_ours, off_binary, FileKind::off_binary)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_cgal, off_binary, FileKind::off_binary)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(write_ours, obj, FileKind::obj)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(write_ours, off, FileKind::off)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(write_ours, off_binary, FileKind::off_binary)->Unit(benchmark::kMillisecond);

}  // namespace
