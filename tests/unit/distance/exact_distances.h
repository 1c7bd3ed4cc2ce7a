#pragma once

#include <CGAL/Cartesian.h>
#include <CGAL/Gmpq.h>
#include <CGAL/intersections.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "algebra3d/kernel/distance/distance.h"

/// Distances by CGAL, over GMP rationals: the smallest of the squared distances of all pairs of faces, each from those
/// of edges with edges and corners with triangles. Shares neither code nor method with the layer.
namespace algebra3d::exact_distances {

using Kernel = CGAL::Cartesian<CGAL::Gmpq>;
using Point = Kernel::Point_3;
using Corners = std::vector<Point>;  // different ones of a face: one to three

inline CGAL::Gmpq number(const Rational& value) {
  return CGAL::Gmpq(value.text());
}
inline Point point(const RationalVec3& p) {
  return {number(p.x), number(p.y), number(p.z)};
}

inline Corners corners_of(const TriangleMesh& mesh, FaceId face) {
  std::set<Point> corners;
  for (const PointRef& corner : mesh.corners(face)) corners.insert(point(corner.rational()));
  return {corners.begin(), corners.end()};
}

inline CGAL::Gmpq between_edges(const Corners& a, const Corners& b) {
  std::optional<CGAL::Gmpq> least;
  const auto take = [&](const CGAL::Gmpq& distance) { least = least ? std::min(*least, distance) : distance; };
  for (const Point& p : a)
    for (const Point& q : b) take(CGAL::squared_distance(p, q));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = i + 1; j < a.size(); ++j) {
      const Kernel::Segment_3 edge(a[i], a[j]);
      for (const Point& q : b) take(CGAL::squared_distance(edge, q));
      for (std::size_t k = 0; k < b.size(); ++k)
        for (std::size_t l = k + 1; l < b.size(); ++l)
          take(CGAL::squared_distance(edge, Kernel::Segment_3(b[k], b[l])));
    }
  return *least;
}

inline CGAL::Gmpq squared_distance(const Corners& a, const Corners& b) {
  CGAL::Gmpq least = std::min(between_edges(a, b), between_edges(b, a));
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
    if (to.size() < 3) continue;
    const Kernel::Triangle_3 triangle(to[0], to[1], to[2]);
    for (const Point& p : from) least = std::min(least, CGAL::squared_distance(p, triangle));
    for (std::size_t i = 0; i < from.size(); ++i)
      for (std::size_t j = i + 1; j < from.size(); ++j)
        if (CGAL::do_intersect(Kernel::Segment_3(from[i], from[j]), triangle)) return 0;
  }
  return least;
}

inline CGAL::Gmpq squared_distance(const TriangleMesh& a, const TriangleMesh& b) {
  std::optional<CGAL::Gmpq> least;
  for (std::size_t f = 0; f < a.face_count(); ++f)
    for (std::size_t g = 0; g < b.face_count(); ++g) {
      const CGAL::Gmpq distance = squared_distance(corners_of(a, FaceId(f)), corners_of(b, FaceId(g)));
      least = least ? std::min(*least, distance) : distance;
    }
  return *least;
}

}  // namespace algebra3d::exact_distances
