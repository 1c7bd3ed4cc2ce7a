#include "algebra3d/kernel/rounding/detail/near_features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d {
namespace {

using Corners = std::array<PointId, 3>;

/// Bounds of the relative error of a product of three vectors, and of a small error of a place.
constexpr long double kTripleProductError = 0x1p-60L;
constexpr long double kPlaceTolerance = 0x1p-4L;

bool contains(const Corners& corners, PointId p) {
  return std::ranges::find(corners, p) != corners.end();
}

/// The edge of a face that begins at a corner.
std::pair<PointId, PointId> edge(const Corners& corners, std::size_t i) {
  return {corners[i], corners[(i + 1) % 3]};
}

/// The joins of one pair of faces.
class PairJoins {
 public:
  PairJoins(SnappedFaces& faces, double reach, const CoordinateGrid& grid, FeatureJoins& joins)
      : faces_(faces), reach_(reach), grid_(grid), joins_(joins) {}

  bool merge_vertices(const Corners& s, const Corners& t);
  bool lead_edges_through_vertices(const Corners& edges_of, const Corners& vertices_of);
  bool join_edges(const Corners& s, const Corners& t);
  bool divide_at_vertex(std::size_t face, const Corners& vertices_of);
  bool divide_where_pierced(std::size_t face, const Corners& edges_of);

 private:
  WideVec3 place(PointId p) const { return faces_.place(p); }
  bool lead(PointId a, PointId b, PointId through);
  bool join_edges(PointId a, PointId b, PointId c, PointId d);
  std::optional<WideVec3> crossing(PointId from, PointId to, const Corners& corners) const;
  PointId new_vertex(const WideVec3& place);

  SnappedFaces& faces_;
  double reach_;
  const CoordinateGrid& grid_;
  FeatureJoins& joins_;
};

PointId PairJoins::new_vertex(const WideVec3& place) {
  const Vec3 p = place.rounded();
  return faces_.add_point({grid_.nearest(p.x), grid_.nearest(p.y), grid_.nearest(p.z)});
}

bool PairJoins::lead(PointId a, PointId b, PointId through) {
  if (through == a || through == b) return false;
  joins_.led[ordered(a, b)].push_back(through);
  return true;
}

bool PairJoins::merge_vertices(const Corners& s, const Corners& t) {
  bool any = false;
  for (const PointId p : s)
    for (const PointId q : t)
      if (p != q && length(place(p) - place(q)) <= reach_) {
        joins_.merged.push_back(ordered(p, q));
        any = true;
      }
  return any;
}

bool PairJoins::lead_edges_through_vertices(const Corners& edges_of, const Corners& vertices_of) {
  bool any = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [a, b] = edge(edges_of, i);
    const WideVec3 direction = place(b) - place(a);
    for (const PointId p : vertices_of) {
      const WideVec3 from = place(p) - place(a);
      const long double along = dot(from, direction), whole = dot(direction, direction);
      if (!(along > 0 && along < whole)) continue;
      if (length(cross(direction, from)) <= reach_ * std::sqrt(whole)) any |= lead(a, b, p);
    }
  }
  return any;
}

bool PairJoins::join_edges(const Corners& s, const Corners& t) {
  bool any = false;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const auto [a, b] = edge(s, i);
      const auto [c, d] = edge(t, j);
      if (a != c && a != d && b != c && b != d) any |= join_edges(a, b, c, d);
    }
  return any;
}

bool PairJoins::join_edges(PointId a, PointId b, PointId c, PointId d) {
  const WideVec3 ab = place(b) - place(a), cd = place(d) - place(c), ac = place(c) - place(a);
  const WideVec3 normal = cross(ab, cd);
  const long double share = dot(cross(ac, cd), normal) / dot(normal, normal);
  if (!(share > 0 && share < 1)) return false;
  const WideVec3 p = place(a) + share * ab;
  const long double other_share = dot(p - place(c), cd) / dot(cd, cd);
  if (!(other_share > 0 && other_share < 1)) return false;
  const WideVec3 q = place(c) + other_share * cd;
  // Not that of the lines, which says little of edges that are nearly parallel.
  if (!(length(p - q) <= reach_)) return false;
  const PointId middle = new_vertex(0.5L * (p + q));
  const bool leads_first = lead(a, b, middle);
  return lead(c, d, middle) || leads_first;
}

bool PairJoins::divide_at_vertex(std::size_t face, const Corners& vertices_of) {
  const Corners& corners = faces_.corners(face);
  const WideVec3 a = place(corners[0]), ab = place(corners[1]) - a, ac = place(corners[2]) - a;
  const WideVec3 normal = cross(ab, ac);
  for (const PointId v : vertices_of) {
    if (contains(corners, v)) continue;
    const WideVec3 p = place(v) - a;
    const long double b_share = dot(cross(p, ac), normal), c_share = dot(cross(ab, p), normal);
    const bool is_over = b_share > 0 && c_share > 0 && b_share + c_share < dot(normal, normal);
    if (!is_over || std::abs(dot(p, normal)) > reach_ * length(normal)) continue;
    joins_.divided.emplace(face, v);
    return true;
  }
  return false;
}

/// Where an edge that meets a triangle in a point pierces it: within a small part of the reach, since the triangle
/// would be led to any other place. Nothing if an end of the edge lies in the triangle's plane.
std::optional<WideVec3> PairJoins::crossing(PointId from, PointId to, const Corners& corners) const {
  const WideVec3 direction = place(to) - place(from), back = place(corners[0]) - place(from);
  const WideVec3 ab = place(corners[1]) - place(corners[0]), ac = place(corners[2]) - place(corners[0]);
  const WideVec3 normal = cross(ab, ac);
  const long double way = length(direction), steepness = dot(direction, normal), share = dot(back, normal) / steepness;
  const long double error = kTripleProductError * length(ab) * length(ac) * (length(back) + way) * way;
  if (error < kPlaceTolerance * reach_ * std::abs(steepness))
    return share > 0 && share < 1 ? std::optional(place(from) + share * direction) : std::nullopt;
  // The triangle is a needle, or nearly parallel to the edge.
  const auto exactly = [&](PointId p) { return faces_.point(p).rational(); };
  const RationalVec3 start = exactly(from), line = exactly(to) - start, corner = exactly(corners[0]);
  const RationalVec3 exact_normal = cross(exactly(corners[1]) - corner, exactly(corners[2]) - corner);
  const Rational height = dot(corner - start, exact_normal), whole = dot(line, exact_normal);
  if (height.sign() == 0 || height == whole) return std::nullopt;
  return WideVec3(ExactPoint(start + (height / whole) * line).approx());
}

bool PairJoins::divide_where_pierced(std::size_t face, const Corners& edges_of) {
  const Corners corners = faces_.corners(face);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [from, to] = edge(edges_of, i);
    if (contains(corners, from) || contains(corners, to)) continue;
    if (intersect_segment_triangle(faces_.point(from), faces_.point(to), faces_.triangle(face)) != Contact::point)
      continue;
    const auto where = crossing(from, to, corners);
    if (!where) continue;
    const PointId v = new_vertex(*where);
    const bool leads = lead(from, to, v);
    if (!contains(corners, v)) joins_.divided.emplace(face, v);
    if (leads || !contains(corners, v)) return true;
  }
  return false;
}

}  // namespace

bool join_near_features(SnappedFaces& faces, std::size_t first, std::size_t second, double reach,
                        const CoordinateGrid& grid, FeatureJoins& joins) {
  PairJoins pair(faces, reach, grid, joins);
  const Corners s = faces.corners(first), t = faces.corners(second);
  if (pair.merge_vertices(s, t)) return true;
  bool any = false;
  for (const Corners& edges_of : {s, t})
    for (const Corners& vertices_of : {s, t}) any |= pair.lead_edges_through_vertices(edges_of, vertices_of);
  if (any || pair.join_edges(s, t)) return true;
  any = pair.divide_at_vertex(first, t);
  any |= pair.divide_at_vertex(second, s);
  if (any) return true;
  any = pair.divide_where_pierced(first, t);
  any |= pair.divide_where_pierced(second, s);
  return any;
}

void join_collinear_corners(const SnappedFaces& faces, std::size_t face, FeatureJoins& joins) {
  const Corners& corners = faces.corners(face);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [a, b] = edge(corners, i);
    const PointId between = corners[(i + 2) % 3];
    if (dot(faces.place(a) - faces.place(between), faces.place(b) - faces.place(between)) < 0)
      joins.led[ordered(a, b)].push_back(between);
  }
}

}  // namespace algebra3d
