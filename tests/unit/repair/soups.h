#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/exact/exact_sum.h"
#include "algebra3d/kernel/exact/vertical_line.h"
#include "algebra3d/kernel/halfedge/audit.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/repair/detail/convex_polygon.h"
#include "algebra3d/kernel/repair/detail/indexed_soup.h"
#include "algebra3d/kernel/repair/repair_report.h"
#include "algebra3d/kernel/soup/weld.h"
#include "algebra3d/kernel/validity/validity.h"
#include "base/triangle_soup.h"
#include "unit/arrangement/random_solids.h"
#include "unit/validity/sample_meshes.h"

/// Triangles that are not a solid, and what is known of them without the code under test.
namespace algebra3d::soups {

using solids::Chance;
using SoupTriangle = TriangleSoup::Triangle;

inline TriangleSoup soup_of(const TriangleMesh& mesh) {
  TriangleSoup soup;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const TriangleRef t = mesh.corners(FaceId(f));
    soup.triangles.push_back({t[0].approx, t[1].approx, t[2].approx});
  }
  return soup;
}
inline TriangleSoup soup_of(const IndexedSoup& indexed) {
  return soup_of(*indexed.mesh());
}
inline IndexedSoup indexed_soup(const TriangleSoup& soup) {
  return IndexedSoup(weld(soup.triangles));
}
/// Triangles between few points of a grid.
inline IndexedSoup random_triangles_on_grid(Chance& chance, int count, int size) {
  TriangleSoup soup;
  for (int i = 0; i < count; ++i)
    soup.triangles.push_back({chance.grid_point(size), chance.grid_point(size), chance.grid_point(size)});
  return indexed_soup(soup);
}
inline TriangleMesh mesh_of(const TriangleSoup& soup) {
  return *indexed_soup(soup).mesh();
}

inline TriangleSoup joined(TriangleSoup first, const TriangleSoup& second) {
  first.triangles.insert(first.triangles.end(), second.triangles.begin(), second.triangles.end());
  return first;
}
inline SoupTriangle turned(const SoupTriangle& t) {
  return {t[0], t[2], t[1]};
}
inline TriangleSoup turned(TriangleSoup soup) {
  for (SoupTriangle& t : soup.triangles) t = turned(t);
  return soup;
}
inline TriangleSoup shifted(TriangleSoup soup, const Vec3& shift) {
  for (SoupTriangle& t : soup.triangles)
    for (Vec3& corner : t) corner = corner + shift;
  return soup;
}
inline TriangleSoup scaled(TriangleSoup soup, double factor) {
  for (SoupTriangle& t : soup.triangles)
    for (Vec3& corner : t) corner = factor * corner;
  return soup;
}
inline TriangleSoup box_soup(const Vec3& low, const Vec3& high) {
  return soup_of(solids::box(low, high));
}
inline TriangleSoup cube_soup(double low, double high) {
  return soup_of(solids::cube(low, high));
}
/// A flat sheet of 4 by 4 squares, open all round.
inline TriangleSoup wall_of_squares() {
  TriangleSoup soup;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y) {
      const Vec3 a{double(x), double(y), 0}, c = a + Vec3{1, 1, 0};
      soup.triangles.push_back({a, a + Vec3{1, 0, 0}, c});
      soup.triangles.push_back({a, c, a + Vec3{0, 1, 0}});
    }
  return soup;
}

/// The triangles, each from its smallest corner on, sorted.
inline std::vector<SoupTriangle> in_order(const TriangleSoup& soup) {
  std::vector<SoupTriangle> triangles = soup.triangles;
  for (SoupTriangle& t : triangles) std::rotate(t.begin(), std::ranges::min_element(t), t.end());
  std::ranges::sort(triangles);
  return triangles;
}

using algebra3d::area_of;
inline double area_of(const TriangleSoup& soup) {
  double sum = 0;
  for (const SoupTriangle& t : soup.triangles) sum += soups::area_of(t);
  return sum;
}
inline double diagonal_of(const TriangleSoup& soup) {
  Box3 box;
  for (const SoupTriangle& t : soup.triangles)
    for (const Vec3& corner : t) box.extend(corner);
  return box.is_empty() ? 0 : length(box.max - box.min);
}

/// The mesh with coordinates that are multiples of 2^-12, so that middles of edges are doubles.
inline TriangleMesh on_grid(const TriangleMesh& mesh) {
  const auto rounded = [](double x) { return std::round(x * 0x1p12) * 0x1p-12; };
  return solids::mapped(mesh, [&](const Vec3& p) { return Vec3{rounded(p.x), rounded(p.y), rounded(p.z)}; });
}

/// Of places: how often the mesh goes round them, by lines upwards.
inline int winding_about(const TriangleMesh& mesh, const ExactPoint& point) {
  int winding = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const LineCrossing crossing = cross_vertical_line(point, mesh.corners(FaceId(f)));
    if (crossing.side == -1) winding += crossing.sign;
  }
  return winding;
}

inline void shuffle(TriangleSoup& soup, Chance& chance) {
  for (std::size_t i = soup.triangles.size(); i > 1; --i)
    std::swap(soup.triangles[i - 1], soup.triangles[static_cast<std::size_t>(chance.below(static_cast<int>(i)))]);
  for (SoupTriangle& t : soup.triangles) std::rotate(t.begin(), t.begin() + chance.below(3), t.end());
}
inline std::size_t index_below(Chance& chance, std::size_t limit) {
  return static_cast<std::size_t>(chance.below(static_cast<int>(limit)));
}

inline void expect_valid_volume(const TriangleMesh& mesh) {
  EXPECT_EQ(prove_volume(mesh)->text(), "");
  EXPECT_EQ(audit(mesh), std::vector<std::string>());
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) EXPECT_FALSE(mesh.is_isolated(VertexId(v)));
}

inline std::uint64_t count_of(const RepairReport& report, RepairStep step) {
  const RepairEntry* entry = report.find(step);
  return entry == nullptr ? 0 : entry->count;
}

/// Axis-parallel boxes with whole coordinates, and the volume that they cover together, counted cell by cell.
struct GridBox {
  std::array<int, 3> low, high;

  bool holds_cell(int x, int y, int z) const {
    return low[0] <= x && x < high[0] && low[1] <= y && y < high[1] && low[2] <= z && z < high[2];
  }
  TriangleSoup soup() const {
    return box_soup({double(low[0]), double(low[1]), double(low[2])},
                    {double(high[0]), double(high[1]), double(high[2])});
  }
};
inline int covered_cells(const std::vector<GridBox>& boxes, int size) {
  int count = 0;
  for (int x = 0; x < size; ++x)
    for (int y = 0; y < size; ++y)
      for (int z = 0; z < size; ++z)
        count += std::ranges::any_of(boxes, [&](const GridBox& box) { return box.holds_cell(x, y, z); }) ? 1 : 0;
  return count;
}
inline GridBox random_grid_box(Chance& chance, int size) {
  GridBox box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = chance.below(size);
    box.high[axis] = box.low[axis] + 1 + chance.below(size - box.low[axis]);
  }
  return box;
}

}  // namespace algebra3d::soups
