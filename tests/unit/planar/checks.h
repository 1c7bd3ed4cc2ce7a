#pragma once

#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "algebra3d/kernel/exact/predicates.h"
#include "algebra3d/kernel/planar/boundary_polygons.h"
#include "algebra3d/kernel/planar/constrained_delaunay.h"
#include "algebra3d/kernel/planar/noding.h"
#include "algebra3d/kernel/planar/polygon_measures.h"
#include "algebra3d/kernel/planar/polygon_validity.h"
#include "base/indices.h"
#include "support/plane_shapes.h"

/// What the tests of the plane say about results, by CGAL's predicates over GMP rationals.
namespace algebra3d::plane_checks {

using Kernel = CGAL::Simple_cartesian<CGAL::Gmpq>;
using Point = Kernel::Point_2;
using Triangles = std::vector<IndexTriangle>;

inline Point to_cgal(PointRef p) {
  if (p.is_double()) return {CGAL::Gmpq(p.approx.x), CGAL::Gmpq(p.approx.y)};
  return {CGAL::Gmpq(p.coordinate(0).text()), CGAL::Gmpq(p.coordinate(1).text())};
}

inline std::vector<Point> to_cgal(const PointArray& points) {
  std::vector<Point> result;
  for (std::size_t i = 0; i < points.size(); ++i) result.push_back(to_cgal(points[i]));
  return result;
}

/// Segments of polygons, inside to the left.
inline std::vector<DirectedEdge> edges_of(const Polygons& polygons) {
  const Polygons turned = oriented(polygons);
  // `oriented` moves corners: corner i of a reversed cycle lies at begin + end - i, or stays if it is the first.
  std::vector<DirectedEdge> edges;
  for (std::size_t cycle = 0; cycle < polygons.cycle_count(); ++cycle) {
    const std::uint32_t begin = polygons.first_corner(cycle), end = polygons.cycle_ends[cycle];
    const bool is_same = equal(turned.corners[begin + 1], polygons.corners[begin + 1]);
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::uint32_t after = i + 1 == end ? begin : i + 1;
      edges.push_back(is_same ? DirectedEdge{i, after} : DirectedEdge{after, i});
    }
  }
  return edges;
}

/// What is wrong with the triangles as the constrained Delaunay triangulation of the noded edges; empty if nothing is.
/// Each triangle turns counter-clockwise; each edge of a triangle is a given one, or another triangle lies across it,
/// whose third corner is not in the circle of the first; each given edge has one triangle to its left, and the areas
/// are `doubled_area` in sum: so the triangles tile the region, and locally Delaunay is Delaunay.
inline std::string findings(const PointArray& points, const std::vector<DirectedEdge>& noded_edges,
                            const Triangles& triangles, const CGAL::Gmpq& doubled_area) {
  const std::vector<Point> p = to_cgal(points);
  std::vector<std::pair<DirectedEdge, std::uint32_t>> sides;  // with the corner to the left
  CGAL::Gmpq sum = 0;
  for (const auto& [a, b, c] : triangles) {
    if (CGAL::orientation(p[a], p[b], p[c]) != CGAL::LEFT_TURN) return "a triangle does not turn counter-clockwise";
    sum += 2 * CGAL::area(p[a], p[b], p[c]);
    sides.insert(sides.end(), {{{a, b}, c}, {{b, c}, a}, {{c, a}, b}});
  }
  if (sum != doubled_area) return "the areas do not add up";
  std::sort(sides.begin(), sides.end());
  std::vector<DirectedEdge> boundary;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const auto& [edge, left] = sides[i];
    if (i > 0 && sides[i - 1].first == edge) return "two triangles lie to the left of an edge";
    const std::pair<DirectedEdge, std::uint32_t> opposite{{edge.second, edge.first}, 0};
    const auto across = std::lower_bound(sides.begin(), sides.end(), opposite);
    if (across == sides.end() || across->first != opposite.first) {
      boundary.push_back(edge);
    } else if (CGAL::side_of_oriented_circle(p[edge.first], p[edge.second], p[left], p[across->second]) ==
               CGAL::ON_POSITIVE_SIDE) {
      return "a corner lies in a circle";
    }
  }
  std::vector<DirectedEdge> expected = noded_edges;
  std::sort(expected.begin(), expected.end());
  return boundary == expected ? "" : "the boundary is not what was given";
}

/// Checks triangles within a square of area 144 for edges of which all but the square's are given in both directions,
/// so that they are edges of triangles on both sides, with no more to ask of circles across them.
inline std::string slit_findings(const PointArray& points, const std::vector<DirectedEdge>& edges,
                                 const Triangles& triangles) {
  const std::vector<Point> p = to_cgal(points);
  std::map<std::pair<Point, Point>, Point> left;  // of each side of a triangle, the corner to its left
  CGAL::Gmpq sum = 0;
  for (const auto& t : triangles) {
    if (CGAL::orientation(p[t[0]], p[t[1]], p[t[2]]) != CGAL::LEFT_TURN) return "a triangle turns clockwise";
    sum += CGAL::area(p[t[0]], p[t[1]], p[t[2]]);
    for (std::size_t i = 0; i < 3; ++i)
      if (!left.emplace(std::pair(p[t[i]], p[t[(i + 1) % 3]]), p[t[(i + 2) % 3]]).second) return "triangles overlap";
  }
  if (sum != 144) return "the areas do not add up";
  const auto is_on_edge = [&](const Point& a, const Point& b) {
    return std::any_of(edges.begin(), edges.end(), [&](const DirectedEdge& e) {
      const Kernel::Segment_2 segment(p[e.first], p[e.second]);
      return e.first != e.second && segment.has_on(a) && segment.has_on(b);
    });
  };
  for (const auto& [side, corner] : left) {
    const auto across = left.find({side.second, side.first});
    if (across == left.end()) {
      if (!is_on_edge(side.first, side.second)) return "a side without a neighbour";
    } else if (CGAL::side_of_oriented_circle(side.first, side.second, corner, across->second) ==
                   CGAL::ON_POSITIVE_SIDE &&
               !is_on_edge(side.first, side.second)) {
      return "a corner lies in a circle";
    }
  }
  for (const auto& [from, to] : edges) {
    // Along the edge, side after side.
    const Kernel::Segment_2 segment(p[from], p[to]);
    Point at = p[from];
    while (at != p[to]) {
      const auto next = std::find_if(left.begin(), left.end(), [&](const auto& entry) {
        return entry.first.first == at && segment.has_on(entry.first.second) &&
               CGAL::squared_distance(at, p[to]) > CGAL::squared_distance(entry.first.second, p[to]);
      });
      if (next == left.end()) return "an edge is missing";
      at = next->first.second;
    }
  }
  return "";
}

inline CGAL::Gmpq doubled_area_by_cgal(const PointArray& points, const std::vector<DirectedEdge>& edges) {
  const std::vector<Point> p = to_cgal(points);
  CGAL::Gmpq sum = 0;
  for (const auto& [a, b] : edges) sum += p[a].x() * p[b].y() - p[b].x() * p[a].y();
  return sum;
}

/// Everything that is to hold of valid polygons: no defect; measures; triangles; noding; and boundaries, there and
/// back.
inline void check(const Polygons& polygons) {
  const auto defect = polygon_defect(polygons);
  ASSERT_TRUE(defect.ok());
  ASSERT_EQ(defect->value_or(""), "");
  const std::vector<DirectedEdge> edges = edges_of(polygons);
  const auto noded_edges = noded(polygons.corners, edges);
  ASSERT_TRUE(noded_edges.ok()) << noded_edges.error().message;
  const CGAL::Gmpq area = doubled_area_by_cgal(polygons.corners, edges);
  ASSERT_EQ(CGAL::Gmpq(doubled_area(polygons).text()), area);
  const auto triangles = triangulate(polygons);
  ASSERT_TRUE(triangles.ok()) << triangles.error().message;
  ASSERT_EQ(findings(polygons.corners, *noded_edges, *triangles, area), "");
  const auto from_noded = constrained_delaunay(polygons.corners, *noded_edges);
  ASSERT_TRUE(from_noded.ok());
  ASSERT_EQ(*from_noded, *triangles);

  const auto canonical = boundary_polygons(polygons.corners, *noded_edges);
  ASSERT_TRUE(canonical.ok()) << canonical.error().message;
  const auto canonical_defect = polygon_defect(*canonical);
  ASSERT_TRUE(canonical_defect.ok());
  ASSERT_EQ(canonical_defect->value_or(""), "");
  ASSERT_EQ(doubled_area(*canonical), doubled_area(polygons));
  ASSERT_EQ(oriented(*canonical), *canonical);
  const auto again = noded(canonical->corners, edges_of(*canonical));
  ASSERT_TRUE(again.ok());
  const auto twice = boundary_polygons(canonical->corners, *again);
  ASSERT_TRUE(twice.ok());
  ASSERT_EQ(*twice, *canonical);
}

}  // namespace algebra3d::plane_checks
