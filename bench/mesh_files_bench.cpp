// Reading OBJ and OFF files of 2 million triangles, and writing them, beside CGAL's readers on the same file in the
// same run. Coordinates have six decimals, as most programs write them. Compare lines of the same format; all files lie
// in the system's cache.
#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
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

#include "stl/obj_reader.h"
#include "stl/obj_writer.h"
#include "stl/off_reader.h"
#include "stl/off_writer.h"

namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;

constexpr std::uint32_t kSteps = 1000;

enum class FileKind { obj, obj_with_attributes, off, off_binary };

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

bool write(FileKind kind, const std::filesystem::path& path, const algebra3d::PolygonSoup& soup) {
  if (kind == FileKind::obj) return stl::write_obj_file(path, soup, "torus").ok();
  if (kind == FileKind::obj_with_attributes) return write_with_attributes(path, soup);
  const auto format = kind == FileKind::off ? stl::Format::ascii : stl::Format::binary;
  return stl::write_off_file(path, soup, format).ok();
}

bool is_obj(FileKind kind) {
  return kind == FileKind::obj || kind == FileKind::obj_with_attributes;
}

/// A place for one file, which is removed at the end.
class TorusFile {
 public:
  explicit TorusFile(FileKind kind)
      : path_(std::filesystem::temp_directory_path() / (is_obj(kind) ? "mesh_files.obj" : "mesh_files.off")),
        is_written_(write(kind, path_, torus())) {}
  TorusFile(const TorusFile&) = delete;
  TorusFile& operator=(const TorusFile&) = delete;
  ~TorusFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }

  const std::filesystem::path& path() const { return path_; }
  bool is_written() const { return is_written_; }
  std::int64_t bytes() const { return static_cast<std::int64_t>(std::filesystem::file_size(path_)); }

 private:
  std::filesystem::path path_;
  bool is_written_;
};

void read_ours(benchmark::State& state, FileKind kind) {
  const TorusFile file(kind);
  if (!file.is_written()) return state.SkipWithError("the file cannot be written");
  for (auto step : state) {
    const auto read = is_obj(kind) ? stl::read_obj_file(file.path()) : stl::read_off_file(file.path());
    if (!read || read->soup.face_count() != 2U * kSteps * kSteps) return state.SkipWithError("not read");
  }
  state.SetBytesProcessed(state.iterations() * file.bytes());
}

void read_cgal(benchmark::State& state, FileKind kind) {
  const TorusFile file(kind);
  if (!file.is_written()) return state.SkipWithError("the file cannot be written");
  for (auto step : state) {
    std::vector<Point> points;
    std::vector<std::vector<std::size_t>> polygons;
    const bool is_read = is_obj(kind) ? CGAL::IO::read_OBJ(file.path().string(), points, polygons)
                                      : CGAL::IO::read_OFF(file.path().string(), points, polygons);
    if (!is_read || polygons.size() != 2U * kSteps * kSteps) return state.SkipWithError("not read");
  }
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
