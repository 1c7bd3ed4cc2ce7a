// import_oracle [FILE...]: imports mesh files, repairs what is not a solid, and has CGAL examine every result: its
// polygon mesh processing with exact coordinates says whether it is closed, free of self-intersections and bounds a
// volume, and its polygon soup tools (equal points and polygons merged, polygons oriented) give a volume of their own.
// Without files, takes them from standard input, one in each line.
//
// import_oracle --turned N [FILE...]: whether each file, in N random positions, turned, moved and scaled, has as many
// bodies, or none. Prints the positions in which it has not, with both statuses; the last line counts them. Bodies that
// touch as given come apart when their coordinates are rounded, or overlap: those that differ only if such bodies
// count one by one are named `touching` and counted by themselves.
//
// For each file one line of fields with tabs between: file, status, `solid` or `undefined`, triangles, volume, CGAL's
// volume (`-` if its tools give nothing closed), seconds for reading and making the solid, largest distance from the
// facets, what was changed (steps, with commas between), what CGAL finds wrong, the triangles of the file, their area,
// the length of their edges that an odd number of them has, the area of the solid, and the area that it should have by
// the report: seen, less what was left out or lies inside, plus what was added.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/kernel/distance/distance.h"
#include "algebra3d/kernel/exact/exact_sum.h"
#include "algebra3d/kernel/search/box_hierarchy.h"
#include "algebra3d/values/constructions/solid_components.h"
#include "algebra3d/values/conversions/import_solid.h"
#include "base/disjoint_sets.h"
#include "support/cgal_verdict.h"
#include "support/placement.h"

namespace {

using namespace algebra3d;
namespace pmp = CGAL::Polygon_mesh_processing;
using Inexact = CGAL::Exact_predicates_inexact_constructions_kernel;

double volume_of(const TriangleMesh& mesh) {
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) triangles.push_back(mesh.triangle(FaceId(f)));
  return exact_volume(mesh.points(), triangles)->nearest_double();
}

/// By CGAL's tools alone, from the facets of the file.
std::string volume_by_cgal(const std::string& path) {
  const auto file = read_mesh_file(path, nullptr);
  if (!file) return "-";
  std::vector<Inexact::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  for (const auto& triangle : file->soup.triangles) {
    polygons.push_back({points.size(), points.size() + 1, points.size() + 2});
    for (const Vec3& corner : triangle) points.emplace_back(corner.x, corner.y, corner.z);
  }
  pmp::repair_polygon_soup(points, polygons);
  pmp::orient_polygon_soup(points, polygons);
  if (polygons.empty() || !pmp::is_polygon_soup_a_polygon_mesh(polygons)) return "-";
  CGAL::Surface_mesh<Inexact::Point_3> mesh;
  pmp::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  if (!CGAL::is_closed(mesh)) return "-";
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", std::abs(pmp::volume(mesh)));
  return text;
}

/// Sums over the triangles of a file as they are read.
struct Given {
  std::size_t triangles = 0;
  double area = 0, boundary = 0;  ///< the boundary: edges that an odd number of triangles has, by equal coordinates
};

Given given_in(const std::string& path) {
  Given given;
  const auto file = read_mesh_file(path, nullptr);
  if (!file) return given;
  std::map<std::pair<std::array<double, 3>, std::array<double, 3>>, bool> is_odd;
  for (const auto& triangle : file->soup.triangles) {
    ++given.triangles;
    given.area += length(cross(triangle[1] - triangle[0], triangle[2] - triangle[0])) / 2;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &a = triangle[i], &b = triangle[(i + 1) % 3];
      const auto ends = std::minmax(std::array{a.x, a.y, a.z}, std::array{b.x, b.y, b.z});
      bool& odd = is_odd[{ends.first, ends.second}];
      odd = !odd;
    }
  }
  for (const auto& [ends, odd] : is_odd) {
    const auto& [a, b] = ends;
    if (odd) given.boundary += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  }
  return given;
}

double area_of(const TriangleMesh& mesh) {
  double area = 0;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const TriangleRef t = mesh.corners(FaceId(f));
    area += length(cross(t[1].approx - t[0].approx, t[2].approx - t[0].approx)) / 2;
  }
  return area;
}

/// The area that the solid should have.
double accounted_area(const ImportedSolid& imported, double seen) {
  if (!imported.repair || !imported.repair->amounts) return seen;
  const RepairAmounts& amounts = *imported.repair->amounts;
  const auto area = [](const Amount& amount) { return amount.in_doubles().value_or(0); };
  return area(amounts.area_seen) - area(amounts.left_out.area) - area(amounts.inside.area) + area(amounts.added.area);
}

void examine(const std::string& path) {
  const auto start = std::chrono::steady_clock::now();
  const auto imported = import_solid(path);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!imported) {
    std::printf("%s\t%s\tundefined\t0\t0\t-\t%g\t0\t\tfailed\t0\t0\t0\t0\t0\n", path.c_str(),
                imported.error().message.c_str(), seconds);
    return;
  }
  std::string steps;
  if (imported->repair)
    for (const RepairEntry& entry : imported->repair->entries)
      steps += (steps.empty() ? "" : ",") + std::string(name_of(entry.step));
  const double deviation = imported->repair ? imported->repair->deviation() : 0;
  const TriangleMesh empty, &mesh = imported->solid ? imported->solid->mesh() : empty;
  const Given given = given_in(path);
  std::printf("%s\t%s\t%s\t%zu\t%.17g\t%s\t%g\t%g\t%s\t%s\t%zu\t%.17g\t%.17g\t%.17g\t%.17g\n", path.c_str(),
              imported->status.c_str(), imported->solid ? "solid" : "undefined", mesh.face_count(), volume_of(mesh),
              volume_by_cgal(path).c_str(), seconds, deviation, steps.c_str(), oracle::complaint(mesh).c_str(),
              given.triangles, given.area, given.boundary, area_of(mesh), accounted_area(*imported, given.area));
  std::fflush(stdout);
}

/// The bodies of a file in one position, each with its cavities; -1 without a solid.
struct Bodies {
  std::ptrdiff_t count = -1;
  std::ptrdiff_t groups = -1;  ///< bodies that touch, or nearly, count as one
  std::string status;
};

/// Bodies nearer to each other than a billionth of their extent, or some thousand roundings of the largest coordinate,
/// count as one.
std::size_t groups_of(const TriangleMesh& mesh, const std::vector<std::vector<FaceId>>& bodies) {
  std::vector<BoxHierarchy> hierarchies;
  Box3 all;
  for (const auto& faces : bodies) {
    std::vector<std::uint32_t> numbers;
    for (const FaceId face : faces) numbers.push_back(face.index());
    all.extend(hierarchies.emplace_back(mesh, std::move(numbers)).bounds());
  }
  const Vec3 farthest = {std::max(-all.min.x, all.max.x), std::max(-all.min.y, all.max.y),
                         std::max(-all.min.z, all.max.z)};
  const double reach = std::max(1e-9 * length(all.max - all.min), 1e-12 * length(farthest));
  DisjointSets groups(bodies.size());
  std::size_t count = bodies.size();
  for (std::uint32_t i = 0; i < bodies.size(); ++i)
    for (std::uint32_t j = 0; j < i; ++j) {
      if (groups.find(i) == groups.find(j)) continue;
      const auto range = distance_range({&mesh, &hierarchies[i]}, {&mesh, &hierarchies[j]}, reach);
      if (!range || !*range || (*range)->lower > reach) continue;
      groups.unite(i, j);
      --count;
    }
  return count;
}

Bodies bodies_of(const TriangleSoup& soup) {
  const auto made = solid_from_soup(soup);
  if (!made || !made->mesh) return {-1, -1, made ? made->status() : made.error().message};
  const auto bodies = solid_components(*made->mesh, BoxHierarchy(*made->mesh));
  if (!bodies) return {-1, -1, bodies.error().message};
  return {static_cast<std::ptrdiff_t>(bodies->size()), static_cast<std::ptrdiff_t>(groups_of(*made->mesh, *bodies)),
          made->status()};
}

struct TurnedCount {
  std::size_t positions = 0, differing = 0;
  std::size_t differing_in_groups = 0;  ///< also if bodies that touch count as one
  std::size_t differing_in_kind = 0;    ///< a solid in one position, and none in the other
};

void turn(const std::string& path, std::uint64_t count, TurnedCount& counted) {
  const auto file = read_mesh_file(path, nullptr);
  if (!file) return;
  const Bodies given = bodies_of(file->soup);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    const Bodies here = bodies_of(Placement(seed).of(file->soup));
    ++counted.positions;
    if (here.count == given.count) continue;
    ++counted.differing;
    if (here.groups != given.groups) ++counted.differing_in_groups;
    if ((here.count < 0) != (given.count < 0)) ++counted.differing_in_kind;
    std::printf(
        "%s\t%s%td bodies in position %ju, %td as given; %td and %td if those that touch count as one\n"
        "  there: %s\n  given: %s\n",
        path.c_str(), here.groups == given.groups ? "touching: " : "", here.count, static_cast<std::uintmax_t>(seed),
        given.count, here.groups, given.groups, here.status.c_str(), given.status.c_str());
    std::fflush(stdout);
  }
}

}  // namespace

int main(int count, char** arguments) {
  std::vector<std::string> words(arguments + 1, arguments + count);
  std::uint64_t positions = 0;
  if (words.size() >= 2 && words.front() == "--turned") {
    positions = std::stoull(words[1]);
    words.erase(words.begin(), words.begin() + 2);
  }
  TurnedCount counted;
  const auto take = [&](const std::string& path) {
    if (positions > 0)
      turn(path, positions, counted);
    else
      examine(path);
  };
  std::ranges::for_each(words, take);
  if (words.empty())
    for (std::string path; std::getline(std::cin, path);) take(path);
  if (positions > 0)
    std::printf("%zu of %zu positions differ, %zu not by bodies that touch, %zu in whether there is a solid\n",
                counted.differing, counted.positions, counted.differing_in_groups, counted.differing_in_kind);
  return 0;
}
