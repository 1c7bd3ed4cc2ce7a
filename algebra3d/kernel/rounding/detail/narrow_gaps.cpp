#include "algebra3d/kernel/rounding/detail/narrow_gaps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/kernel/distance/triangle_frame.h"
#include "algebra3d/kernel/halfedge/circulators.h"
#include "algebra3d/kernel/halfedge/edge_balance.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/search/box_hierarchy.h"
#include "algebra3d/kernel/search/boxes.h"
#include "base/disjoint_ids.h"
#include "base/id_vector.h"
#include "base/propagate.h"
#include "base/wide_vec3.h"

namespace algebra3d {
namespace {

/// A part of a face.
using Piece = TriangleFrame::Polygon;

/// Limits of the search: pairs of near faces, and parts of faces that are compared with another one. Beyond them the
/// grid is coarse for the solid, and gaps are not what makes it complicated.
std::size_t most_pairs(const TriangleMesh& solid) {
  return 10'000 + 16 * solid.face_count();
}
std::size_t most_parts(const TriangleMesh& solid) {
  return 40'000 + 64 * solid.face_count();
}
/// The largest cosine of the angle between the normals of faces that lie opposite to each other.
constexpr long double kOppositeCosine = -0.5L;
/// A part that is not cut reaches up to 1.5 margins beyond a face (TriangleFrame::clip).
constexpr long double kLargestReach = 1.5L;
/// Walls that touch are this far apart at most by errors of rounding, as a part of the largest coordinate.
constexpr double kRounding = 0x1p-50;

/// Gaps are looked for within a width at first that is so many times what faces that touch seem to be apart, then
/// within ever wider ones.
constexpr long double kNarrowest = 4, kWider = 32;

/// A face and one that it looks at across a gap.
struct Opposite {
  FaceId face, other;

  friend auto operator<=>(const Opposite&, const Opposite&) = default;
};

/// The walls of one gap or of several that share faces, and how wide it is.
struct Gap {
  std::vector<FaceId> walls;
  long double width = 0;
};

/// Looks for walls of narrow gaps.
class GapSearch {
 public:
  /// For gaps that are nowhere wider than `largest`.
  GapSearch(const TriangleMesh& solid, double largest)
      : solid_(solid), largest_(largest), is_gone_(solid.face_count()) {
    touching_ = static_cast<long double>(kRounding * largest_coordinate(solid));
    for (const FaceId face : faces(solid)) normals_.push_back(normal_of(face));
  }
  /// False if the pairs are too many.
  Result<bool> find_pairs(const Monitor& monitor);
  /// Gaps that are nowhere wider than `width`, in the order of their first faces. Sides of walls opposite to each other
  /// may lie as far beside each other.
  std::vector<Gap> gaps(long double width);
  /// True if the limit of the search has been reached; gaps mean nothing then.
  bool is_given_up() const { return parts_ > most_parts(solid_); }
  /// Walls are not looked at any more.
  void forget(const Gap& gap);
  bool is_gone(FaceId face) const { return is_gone_[face.index()]; }
  /// About how far faces that touch seem to be apart.
  long double touching() const { return touching_; }

 private:
  WideVec3 place(VertexId v) const { return WideVec3(solid_.point(v).approx); }
  WideVec3 normal_of(FaceId face) const;
  bool are_opposite(FaceId f, FaceId g) const { return dot(normals_[f], normals_[g]) < kOppositeCosine; }
  /// The second face of one of the pairs.
  const TriangleFrame& other_of(const Opposite& pair) const {
    return others_[static_cast<std::size_t>(&pair - pairs_.data())];
  }
  bool find_wall(std::span<const Opposite> pairs, Gap& wall, std::vector<Opposite>& across);
  bool has_opposite(const WideVec3& point, std::span<const Opposite> pairs, long double width);
  bool is_before(const Piece& part, FaceId face, FaceId other, long double width) const;

  const TriangleMesh& solid_;
  double largest_;
  long double touching_;
  IdVector<FaceId, WideVec3> normals_;
  std::vector<Opposite> pairs_;        // sorted; each both ways
  std::vector<TriangleFrame> others_;  // per pair, of its second face
  std::vector<bool> is_gone_;          // per face
  std::size_t parts_ = 0;              // that were compared with a face
};

WideVec3 GapSearch::normal_of(FaceId face) const {
  const auto [a, b, c] = solid_.triangle(face);
  const WideVec3 n = cross(place(VertexId(b)) - place(VertexId(a)), place(VertexId(c)) - place(VertexId(a)));
  const long double size = length(n);
  return size > 0 ? (1 / size) * n : WideVec3{};
}

Result<bool> GapSearch::find_pairs(const Monitor& monitor) {
  const BoxHierarchy hierarchy(solid_, largest_);
  const std::size_t most = most_pairs(solid_);
  std::size_t looked_at = 0;
  hierarchy.for_each_pair(
      [&](auto first, auto second) {
        const FaceId f(first), g(second);
        if (are_opposite(f, g)) {
          pairs_.push_back({f, g});
          pairs_.push_back({g, f});
        }
        return ++looked_at <= most;
      },
      [&] { return !monitor.is_cancelled(); });
  A3D_TRY(monitor.check());
  if (looked_at > most) return false;
  std::ranges::sort(pairs_);
  for (const Opposite& pair : pairs_) others_.emplace_back(solid_.corners(pair.other));
  return true;
}

/// Whether the part of a face lies before another one, with no more than the width between them.
bool GapSearch::is_before(const Piece& part, FaceId face, FaceId other, long double width) const {
  const WideVec3 n = normals_[face], m = normals_[other];
  const WideVec3 start = place(VertexId(solid_.triangle(other)[0]));
  return std::ranges::all_of(part, [&](const WideVec3& corner) {
    const long double height = dot(m, start - corner) / dot(m, n);
    return height >= -touching_ && height <= width;
  });
}

/// Whether one of the other faces of some pairs is not much farther from a point than the width.
bool GapSearch::has_opposite(const WideVec3& point, std::span<const Opposite> pairs, long double width) {
  parts_ += pairs.size();
  return std::ranges::any_of(pairs, [&](const Opposite& pair) {
    const TriangleFrame& other = other_of(pair);
    return !is_gone_[pair.other.index()] && other.squared_distance_of(point) <= 4 * width * width;
  });
}

/// Whether the face of some pairs is a wall of a gap of the given width, which becomes that at this wall; adds the
/// pairs of which the other face lies opposite to a part of it.
bool GapSearch::find_wall(std::span<const Opposite> pairs, Gap& wall, std::vector<Opposite>& across) {
  const long double width = std::exchange(wall.width, 0);
  const FaceId face = wall.walls.front();
  Piece whole;
  for (const VertexId corner : vertices_of(solid_, face)) whole.push_back(place(corner));
  const WideVec3 middle = (1.0L / 3) * (whole[0] + whole[1] + whole[2]);
  if (!has_opposite(middle, pairs, width)) return false;
  std::vector<Piece> open{std::move(whole)};
  std::vector<Opposite> found;
  for (const Opposite& pair : pairs) {
    if (is_gone_[pair.other.index()]) continue;
    const TriangleFrame& other = other_of(pair);
    std::vector<Piece> rest;
    bool covers = false;
    for (Piece& piece : open) {
      std::vector<Piece> beyond;
      const Piece part = other.clip(piece, width / kLargestReach, beyond);
      const long double distance = std::sqrt(other.squared_distance_of(part));
      if (distance > 2 * width || !is_before(part, face, pair.other, width)) {
        rest.push_back(std::move(piece));
        continue;
      }
      covers = true;
      wall.width = std::max(wall.width, distance);
      std::ranges::move(beyond, std::back_inserter(rest));
    }
    parts_ += open.size();
    if (covers) found.push_back(pair);
    open = std::move(rest);
    if (open.empty() || is_given_up()) break;
  }
  if (!open.empty()) return false;
  across.insert(across.end(), found.begin(), found.end());
  return true;
}

std::vector<Gap> GapSearch::gaps(long double width) {
  std::vector<bool> is_wall(solid_.face_count());
  std::vector<Gap> walls;  // each alone
  std::vector<Opposite> across;
  for (auto begin = pairs_.begin(); begin != pairs_.end();) {
    const FaceId face = begin->face;
    const auto end = std::find_if(begin, pairs_.end(), [&](const Opposite& pair) { return pair.face != face; });
    Gap wall{{face}, width};
    if (!is_gone_[face.index()] && find_wall({begin, end}, wall, across)) {
      is_wall[face.index()] = true;
      walls.push_back(std::move(wall));
    }
    begin = end;
  }
  DisjointIds<FaceId> together(solid_.face_count());
  for (const Opposite& pair : across)
    if (is_wall[pair.other.index()]) together.unite(pair.face, pair.other);
  // The first face of each gap represents it, so its wall comes first.
  std::vector<Gap> gaps;
  IdVector<FaceId, std::size_t> gap_of(solid_.face_count());
  for (const Gap& wall : walls) {
    const FaceId face = wall.walls.front(), first = together.find(face);
    if (face == first) {
      gap_of[face] = gaps.size();
      gaps.push_back(wall);
      continue;
    }
    Gap& gap = gaps[gap_of[first]];
    gap.walls.push_back(face);
    gap.width = std::max(gap.width, wall.width);
  }
  return gaps;
}

void GapSearch::forget(const Gap& gap) {
  for (const FaceId wall : gap.walls) is_gone_[wall.index()] = true;
}

/// The places to which vertices move, while gaps are closed.
class GapClosing {
 public:
  GapClosing(const TriangleMesh& solid, const RoundedVertices& vertices, double spacing)
      : solid_(solid),
        places_(std::vector(vertices.points.approx().begin(), vertices.points.approx().end())),
        spacing_(spacing) {}

  /// Whether the rims of the gap lie upon each other after the vertices have moved, if need be to common places.
  bool close(const Gap& gap);
  const Vec3& place(VertexId v) const { return places_[v]; }

 private:
  bool is_closed(const Gap& gap) const;
  std::vector<VertexId> corners_of(const Gap& gap) const;
  void join(VertexId v, VertexId to);

  const TriangleMesh& solid_;
  IdVector<VertexId, Vec3> places_;
  double spacing_;
};

bool GapClosing::is_closed(const Gap& gap) const {
  EdgeBalance balance;
  for (const FaceId wall : gap.walls)
    for (const HalfedgeId h : halfedges_of(solid_, wall))
      balance.add(PointRef(place(solid_.origin(h))), PointRef(place(solid_.target(h))), 1);
  return balance.is_zero();
}

/// In the order of their x-coordinates.
std::vector<VertexId> GapClosing::corners_of(const Gap& gap) const {
  std::vector<VertexId> vertices;
  for (const FaceId wall : gap.walls)
    for (const VertexId corner : vertices_of(solid_, wall)) vertices.push_back(corner);
  std::ranges::sort(vertices);
  const auto repeated = std::ranges::unique(vertices);
  vertices.erase(repeated.begin(), repeated.end());
  std::ranges::stable_sort(vertices, {}, [&](VertexId v) { return solid_.point(v).approx.x; });
  return vertices;
}

/// Moves the vertex to the place of another one, if that is near enough.
void GapClosing::join(VertexId v, VertexId to) {
  const Vec3 way = place(to) - solid_.point(v).approx;
  if (std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)}) <= spacing_) places_[v] = place(to);
}

bool GapClosing::close(const Gap& gap) {
  if (is_closed(gap)) return true;
  const std::vector<VertexId> vertices = corners_of(gap);
  std::vector<Vec3> before;
  for (const VertexId v : vertices) before.push_back(place(v));
  const auto reach = static_cast<double>(gap.width);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3 own = solid_.point(vertices[i]).approx;
    for (std::size_t j = i + 1; j < vertices.size(); ++j) {
      const Vec3 way = solid_.point(vertices[j]).approx - own;
      if (way.x > reach) break;
      if (length(way) <= reach) join(vertices[j], vertices[i]);
    }
  }
  if (is_closed(gap)) return true;
  for (std::size_t i = 0; i < vertices.size(); ++i) places_[vertices[i]] = before[i];
  return false;
}

/// The faces that stay, and the places of their vertices.
ClosedGaps without(const TriangleMesh& solid, const GapSearch& search, const GapClosing& closing) {
  std::vector<FaceId> staying;
  for (const FaceId face : faces(solid))
    if (!search.is_gone(face)) staying.push_back(face);
  ClosedGaps result{submesh(solid, staying), {}, {}, 0};
  for (const FaceId face : faces(solid))
    if (search.is_gone(face))
      for (const VertexId corner : vertices_of(solid, face)) result.rims.intern(PointRef(closing.place(corner)));
  IdVector<VertexId, bool> is_used(solid.vertex_count());
  std::vector<Vec3> places;
  RoundedVertices& vertices = result.vertices;
  for (const FaceId face : staying)  // as submesh numbers them
    for (const VertexId v : vertices_of(solid, face)) {
      if (is_used[v]) continue;
      is_used[v] = true;
      places.push_back(closing.place(v));
      vertices.movements.push_back(distance_to_rounded(solid.point(v), places.back()));
      if (vertices.movements.back() > 0) ++vertices.moved;
      vertices.largest_movement = std::max(vertices.largest_movement, vertices.movements.back());
    }
  vertices.points = PointArray(std::move(places));
  return result;
}

}  // namespace

Result<std::optional<ClosedGaps>> with_closed_gaps(const TriangleMesh& solid, const RoundedVertices& vertices,
                                                   double spacing, const Monitor& monitor) {
  GapSearch search(solid, spacing);
  A3D_ASSIGN(const bool are_few, search.find_pairs(monitor));
  if (!are_few) return std::optional<ClosedGaps>();
  GapClosing closing(solid, vertices, spacing);
  std::size_t count = 0;
  // Narrow gaps first: what lies beside their walls is not taken for a part of them.
  for (long double width = kNarrowest * search.touching(); width < kWider * spacing; width *= kWider) {
    for (const Gap& gap : search.gaps(std::min<long double>(width, spacing))) {
      A3D_TRY(monitor.check());
      if (!closing.close(gap)) continue;
      search.forget(gap);
      ++count;
    }
    if (search.is_given_up()) return std::optional<ClosedGaps>();
  }
  if (count == 0) return std::optional<ClosedGaps>();
  ClosedGaps closed = without(solid, search, closing);
  closed.count = count;
  return std::optional(std::move(closed));
}

}  // namespace algebra3d
