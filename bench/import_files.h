#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

#include "base/box_corners.h"
#include "base/polygon_soup.h"
#include "base/triangle_soup.h"
#include "mesh_formats/obj/obj_writer.h"
#include "mesh_formats/off/off_writer.h"
#include "removed_file.h"
#include "stl/stl_writer.h"

/// Mesh files for import_bench: a knobbly torus, clean or with defects at places that are spread over it evenly.
namespace bench {

using algebra3d::PolygonSoup;
using algebra3d::TriangleSoup;
using algebra3d::Vec3;

enum class Format { stl, ascii_stl, obj, off };

/// What is wrong at a place.
enum class Defect {
  hole,       ///< eight triangles are missing
  flipped,    ///< a triangle is turned over
  crack,      ///< a triangle has one corner a fiftieth of an edge aside
  duplicate,  ///< a triangle is there twice
  body,       ///< a cube of half an edge's length sticks in the surface
  all,        ///< one after the other
};

inline Vec3 as_floats(const Vec3& p) {
  const auto as_float = [](double x) { return static_cast<double>(static_cast<float>(x)); };
  return {as_float(p.x), as_float(p.y), as_float(p.z)};
}

/// A torus of 4 * steps^2 triangles: 2 * steps by steps squares, all coordinates floats.
class Torus {
 public:
  explicit Torus(std::uint32_t steps) : steps_(steps) {}

  std::uint32_t square_count() const { return 2 * steps_ * steps_; }
  /// The n-th of `count` squares that are spread evenly both ways: rows in order, columns by the golden ratio.
  std::uint32_t spread_square(std::uint32_t n, std::uint32_t count) const {
    const auto row = static_cast<std::uint32_t>(std::uint64_t{n} * 2 * steps_ / count);
    const double turns = n / std::numbers::phi;
    return row * steps_ + static_cast<std::uint32_t>((turns - std::floor(turns)) * steps_);
  }
  std::uint32_t vertex(std::uint32_t i, std::uint32_t j) const { return i % (2 * steps_) * steps_ + j % steps_; }
  Vec3 point(std::uint32_t i, std::uint32_t j) const {
    const double u = std::numbers::pi * (i % (2 * steps_)) / steps_, v = 2 * std::numbers::pi * (j % steps_) / steps_;
    const double minor = 10 + std::sin(11 * u) * std::cos(7 * v);
    const double radius = 40 + minor * std::cos(v);
    return as_floats({radius * std::cos(u), radius * std::sin(u), minor * std::sin(v)});
  }
  /// The two triangles of a square.
  std::array<TriangleSoup::Triangle, 2> triangles(std::uint32_t square) const {
    const std::uint32_t i = square / steps_, j = square % steps_;
    const Vec3 a = point(i, j), b = point(i + 1, j), c = point(i + 1, j + 1), d = point(i, j + 1);
    return {{{a, b, c}, {a, c, d}}};
  }
  /// The square and its three neighbours in both directions.
  std::array<std::uint32_t, 4> block(std::uint32_t square) const {
    const std::uint32_t i = square / steps_, j = square % steps_;
    return {vertex(i, j), vertex(i + 1, j), vertex(i, j + 1), vertex(i + 1, j + 1)};
  }
  PolygonSoup polygons() const;

 private:
  std::uint32_t steps_;
};

inline PolygonSoup Torus::polygons() const {
  PolygonSoup soup;
  for (std::uint32_t i = 0; i < 2 * steps_; ++i)
    for (std::uint32_t j = 0; j < steps_; ++j) soup.points.push_back(point(i, j));
  for (std::uint32_t i = 0; i < 2 * steps_; ++i)
    for (std::uint32_t j = 0; j < steps_; ++j) {
      soup.add_face(std::array{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      soup.add_face(std::array{vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  return soup;
}

inline void add_cube(TriangleSoup& soup, const Vec3& middle, double size) {
  const Vec3 half{size / 2, size / 2, size / 2};
  const algebra3d::Box3 box{middle - half, middle + half};
  const auto corner = [&](unsigned i) { return as_floats(algebra3d::corner_of(box, i)); };
  for (const auto& [a, b, c] : algebra3d::kBoxTriangles) soup.triangles.push_back({corner(a), corner(b), corner(c)});
}

/// The triangles of a square with a defect that is not a hole.
inline void add_faulty(TriangleSoup& soup, const std::array<TriangleSoup::Triangle, 2>& square, Defect defect) {
  auto [first, second] = square;
  const Vec3 diagonal = first[2] - first[0];
  if (defect == Defect::flipped) std::swap(first[1], first[2]);
  if (defect == Defect::crack) first[0] = as_floats(first[0] + (1.0 / 50) * diagonal);
  soup.triangles.push_back(first);
  soup.triangles.push_back(second);
  if (defect == Defect::duplicate) soup.triangles.push_back(first);
  if (defect == Defect::body) add_cube(soup, square[0][2], std::sqrt(dot(diagonal, diagonal)) / 2);
}

/// The torus with `count` defects.
inline TriangleSoup faulty_torus(std::uint32_t steps, Defect defect, std::uint32_t count) {
  const Torus torus(steps);
  std::map<std::uint32_t, Defect> defects;  // by square
  std::vector<bool> is_missing(torus.square_count());
  for (std::uint32_t n = 0; n < count; ++n) {
    const std::uint32_t square = torus.spread_square(n, count);
    const Defect kind = defect == Defect::all ? Defect(n % 5) : defect;
    if (kind != Defect::hole) defects[square] = kind;
    if (kind == Defect::hole)
      for (const std::uint32_t one : torus.block(square)) is_missing[one] = true;
  }
  TriangleSoup soup;
  for (std::uint32_t square = 0; square < torus.square_count(); ++square) {
    if (is_missing[square]) continue;
    const auto found = defects.find(square);
    const auto triangles = torus.triangles(square);
    if (found != defects.end())
      add_faulty(soup, triangles, found->second);
    else
      soup.triangles.insert(soup.triangles.end(), triangles.begin(), triangles.end());
  }
  return soup;
}

/// A file of one format.
class TemporaryFile : public RemovedFile {
 public:
  /// Of a clean torus.
  TemporaryFile(Format format, std::uint32_t steps) : RemovedFile(path_for(format)) {
    const Torus torus(steps);
    if (format == Format::obj) set_written(mesh_formats::write_obj_file(path(), torus.polygons(), "torus").ok());
    if (format == Format::off)
      set_written(mesh_formats::write_off_file(path(), torus.polygons(), mesh_formats::Encoding::ascii).ok());
    if (format == Format::stl || format == Format::ascii_stl) write_stl(format, faulty_torus(steps, Defect::all, 0));
  }
  /// Of triangles, as binary STL.
  explicit TemporaryFile(const TriangleSoup& soup) : RemovedFile(path_for(Format::stl)) {
    write_stl(Format::stl, soup);
  }

 private:
  static std::filesystem::path path_for(Format format) {
    const char* const ending = format == Format::obj ? ".obj" : format == Format::off ? ".off" : ".stl";
    return std::filesystem::temp_directory_path() / ("import_bench_" + std::to_string(getpid()) + ending);
  }
  void write_stl(Format format, const TriangleSoup& soup) {
    const auto form = format == Format::ascii_stl ? mesh_formats::Encoding::ascii : mesh_formats::Encoding::binary;
    set_written(mesh_formats::write_stl_file(path(), soup, "torus", form).ok());
  }
};

}  // namespace bench
