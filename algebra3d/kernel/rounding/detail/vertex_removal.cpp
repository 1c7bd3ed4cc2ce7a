#include "algebra3d/kernel/rounding/detail/vertex_removal.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "algebra3d/kernel/rounding/detail/vertex_fan.h"
#include "base/propagate.h"
#include "base/scheduler.h"
#include "base/wide_vec3.h"

namespace algebra3d {
namespace {

/// The fan of a vertex that may contain thin triangles, of a height of at most two tolerances, whose orientation is
/// ignored. Computed in long doubles.
class ThinFan {
 public:
  /// Takes over a fan. The tolerance is in coordinate units.
  ThinFan(const TriangleStars& stars, const VertexFan& fan, long double tolerance);

  /// The least height of the triangles that replace the fan if the vertex is merged with this neighbour, which is given
  /// by its place in the ring. Nothing if they do not represent the surface: if the vertex is not within the tolerance
  /// of them, or if one that is not thin faces the other way than those that it replaces.
  std::optional<long double> least_height(std::size_t target) const;

 private:
  struct Triangle {
    WideVec3 normal;  // twice as long as the area
    long double height;
  };
  Triangle triangle(const WideVec3& apex, std::size_t side) const;
  bool is_thin(const Triangle& t) const { return t.height <= 2 * tolerance_; }
  bool is_replacement(const Triangle& t, std::size_t side, const WideVec3& target) const;
  bool faces_like_neighbours(const Triangle& t, std::size_t side) const;
  bool is_next_to_vertex(const Triangle& t, std::size_t side, const WideVec3& target) const;
  std::size_t next(std::size_t i) const { return i + 1 == ring_.size() ? 0 : i + 1; }

  long double tolerance_;
  std::vector<WideVec3> ring_;       // the vertex is the origin
  std::vector<Triangle> triangles_;  // between each neighbour and the next
};

/// The distance of the origin from a segment.
long double distance_from_origin(const WideVec3& a, const WideVec3& b) {
  const WideVec3 ab = b - a;
  const long double square = dot(ab, ab);
  const long double share = square > 0 ? std::clamp(-dot(a, ab) / square, 0.0L, 1.0L) : 0;
  return length(a + share * ab);
}

ThinFan::ThinFan(const TriangleStars& stars, const VertexFan& fan, long double tolerance) : tolerance_(tolerance) {
  const WideVec3 middle(stars.rounded_place(fan.vertex()));
  for (const std::uint32_t v : fan.ring()) ring_.push_back(WideVec3(stars.rounded_place(v)) - middle);
  for (std::size_t i = 0; i < ring_.size(); ++i) triangles_.push_back(triangle({}, i));
}

/// The triangle between an apex and the ring's vertex of this number and the next.
ThinFan::Triangle ThinFan::triangle(const WideVec3& apex, std::size_t side) const {
  const WideVec3 a = ring_[side] - apex, b = ring_[next(side)] - apex;
  const WideVec3 normal = cross(a, b);
  const long double longest = std::max({length(a), length(b), length(b - a)});
  return {normal, longest > 0 ? length(normal) / longest : 0};
}

/// True if it faces the same way as the nearest triangle of the fan on either side that is not thin.
bool ThinFan::faces_like_neighbours(const Triangle& t, std::size_t side) const {
  const std::size_t n = ring_.size();
  const auto agrees = [&](std::size_t step) {
    for (std::size_t i = (side + step) % n; i != side; i = (i + step) % n)
      if (!is_thin(triangles_[i])) return dot(t.normal, triangles_[i].normal) > 0;
    return false;
  };
  return agrees(1) || agrees(n - 1);
}

bool ThinFan::is_replacement(const Triangle& t, std::size_t side, const WideVec3& target) const {
  const Triangle& replaced = triangles_[side];
  const long double volume = std::abs(dot(target, t.normal));  // six times that of the tetrahedron between both
  if (is_thin(t)) return is_thin(replaced) || volume <= tolerance_ * length(replaced.normal);
  if (volume > tolerance_ * length(t.normal)) return false;
  return is_thin(replaced) ? faces_like_neighbours(t, side) : dot(t.normal, replaced.normal) > 0;
}

/// True if the vertex is over the triangle, or within the tolerance of one of its sides.
bool ThinFan::is_next_to_vertex(const Triangle& t, std::size_t side, const WideVec3& target) const {
  const WideVec3 &a = ring_[side], &b = ring_[next(side)];
  const auto is_near = [&](const WideVec3& from, const WideVec3& to) {
    return distance_from_origin(from, to) <= tolerance_;
  };
  const bool is_over = !is_thin(t) && dot(cross(target, a), t.normal) >= 0 && dot(cross(b, target), t.normal) >= 0;
  return is_over || is_near(target, a) || is_near(target, b) || is_near(a, b);
}

std::optional<long double> ThinFan::least_height(std::size_t target) const {
  const WideVec3& place = ring_[target];
  long double least = std::numeric_limits<long double>::max();
  bool is_near = length(place) <= tolerance_;
  for (std::size_t side = next(target); next(side) != target; side = next(side)) {
    const Triangle t = triangle(place, side);
    if (!is_replacement(t, side, place)) return std::nullopt;
    least = std::min(least, t.height);
    is_near = is_near || is_next_to_vertex(t, side, place);
  }
  return is_near ? std::optional(least) : std::nullopt;
}

/// Removing vertices makes others superfluous.
constexpr int kMaxPasses = 16;
/// Vertices with more neighbours stay: the cost is that of their cube.
constexpr std::size_t kMaxNeighbours = 60;

/// The neighbours of a vertex in their order.
using Ring = std::vector<std::uint32_t>;

/// The mesh while vertices are merged with neighbours. Concurrent calls of the const functions are safe.
class VertexRemoval {
 public:
  VertexRemoval(TriangleStars& stars, double tolerance, ThinTriangles thin)
      : stars_(stars), tolerance_(tolerance), thin_(thin), changed_in_(stars.original().vertex_count()) {}

  /// How a vertex goes: it becomes one with the vertex at the place `target` of its ring.
  struct Merger {
    Ring ring;
    std::size_t target;
  };
  /// Nothing if the vertex must stay. `fan` is room to work in.
  std::optional<Merger> merger(std::uint32_t vertex, VertexFan& fan) const;
  void merge(std::uint32_t vertex, const Merger& merger);

  /// From here on it is asked what has changed.
  void begin_pass() {
    ++pass_;
    changed_.clear();
  }
  /// True if this is how the vertex goes, though others have gone in this pass.
  bool still_holds(std::uint32_t vertex, const Merger& merger) const {
    return changed_in_[vertex] != pass_ && keeps_manifold(merger.ring, merger.target);
  }
  /// The vertices whose triangles have changed in this pass, in no order.
  const std::vector<std::uint32_t>& changed() const { return changed_; }

 private:
  const Vec3& rounded_place(std::uint32_t vertex) const { return stars_.rounded_place(vertex); }
  WideVec3 place(std::uint32_t vertex) const { return WideVec3(rounded_place(vertex)); }
  bool keeps_manifold(const Ring& ring, std::size_t target) const;
  bool are_near(std::uint32_t vertex, const Ring& ring, std::size_t from, std::size_t to) const;
  bool follows_surface(std::uint32_t vertex, const Ring& ring, std::size_t target) const;
  long double least_height(std::uint32_t vertex, const Ring& ring, std::size_t target) const;

  /// A neighbour, given by its place in the ring, with which the vertex may be merged, judged by the triangles around
  /// it, and the least height of those that replace them.
  struct Target {
    double height;
    std::size_t place;
  };
  std::vector<Target> thick_targets(VertexFan& fan) const;
  std::vector<Target> all_targets(const VertexFan& fan) const;

  TriangleStars& stars_;
  double tolerance_;
  ThinTriangles thin_;
  std::uint32_t pass_ = 0;
  std::vector<std::uint32_t> changed_;     // in this pass
  std::vector<std::uint32_t> changed_in_;  // per vertex: the pass in which its triangles have changed last
};

/// The distance of two segments ab and cd. Source: [ericson2005], 5.1.9.
long double segment_distance(const WideVec3& a, const WideVec3& b, const WideVec3& c, const WideVec3& d) {
  const WideVec3 ab = b - a, cd = d - c, ca = a - c;
  const long double ab2 = dot(ab, ab), cd2 = dot(cd, cd), both = dot(ab, cd), along = dot(ab, ca), across = dot(cd, ca);
  const long double spread = ab2 * cd2 - both * both;
  long double s = spread > 0 ? std::clamp((both * across - along * cd2) / spread, 0.0L, 1.0L) : 0;
  const long double t = cd2 > 0 ? std::clamp((both * s + across) / cd2, 0.0L, 1.0L) : 0;
  s = ab2 > 0 ? std::clamp((both * t - along) / ab2, 0.0L, 1.0L) : 0;
  return length((a + s * ab) - (c + t * cd));
}

/// The link condition [dey1999]: the target has no other neighbours in the ring than those beside it.
bool VertexRemoval::keeps_manifold(const Ring& ring, std::size_t target) const {
  const std::size_t n = ring.size();
  std::size_t triangle_count = 0;
  std::vector<std::uint32_t> neighbours;
  stars_.for_each_at(ring[target], [&](std::uint32_t triangle) {
    ++triangle_count;
    neighbours.insert(neighbours.end(), stars_[triangle].begin(), stars_[triangle].end());
  });
  if (n == 3 && triangle_count == 3) return false;  // a tetrahedron
  for (std::size_t i = 0; i < n; ++i) {
    const bool is_beside = i == (target + 1) % n || (i + 1) % n == target;
    if (i != target && !is_beside && std::ranges::find(neighbours, ring[i]) != neighbours.end()) return false;
  }
  return true;
}

/// True if the chord between two of the ring is near all spokes that it passes on its way round the ring, from the one
/// forward to the other.
bool VertexRemoval::are_near(std::uint32_t vertex, const Ring& ring, std::size_t from, std::size_t to) const {
  const WideVec3 start = place(ring[from]), end = place(ring[to]), v = place(vertex);
  for (std::size_t i = (from + 1) % ring.size(); i != to; i = (i + 1) % ring.size())
    if (segment_distance(start, end, v, place(ring[i])) > tolerance_) return false;
  return true;
}

/// True if all edges between the target and the rest of the ring lie on the triangles around the vertex: an edge that
/// bends away, or lies beside a ring that is not convex, does not.
bool VertexRemoval::follows_surface(std::uint32_t vertex, const Ring& ring, std::size_t target) const {
  const std::size_t n = ring.size();
  for (std::size_t i = (target + 2) % n; (i + 1) % n != target; i = (i + 1) % n)
    if (!are_near(vertex, ring, target, i) && !are_near(vertex, ring, i, target)) return false;
  return true;
}

/// The least height of the triangles that replace those around the vertex if it is merged with one of its ring, 0 if
/// they do not represent the surface.
long double VertexRemoval::least_height(std::uint32_t vertex, const Ring& ring, std::size_t target) const {
  const WideVec3 v = place(vertex), w = place(ring[target]);
  long double least = std::numeric_limits<long double>::max();
  bool is_near = false;
  for (std::size_t i = (target + 1) % ring.size(); (i + 1) % ring.size() != target; i = (i + 1) % ring.size()) {
    const WideVec3 a = place(ring[i]), b = place(ring[(i + 1) % ring.size()]);
    const WideVec3 normal = cross(a - w, b - w);
    const long double size = length(normal);
    const long double distance = std::abs(dot(v - w, normal));
    if (!(dot(normal, cross(a - v, b - v)) > 0) || distance > tolerance_ * size) return 0;
    least = std::min(least, size / std::max({length(a - w), length(b - w), length(b - a)}));
    const bool is_over = dot(cross(a - w, v - w), normal) >= 0 && dot(cross(v - w, b - w), normal) >= 0;
    const auto is_on = [&](const WideVec3& end) {
      const WideVec3 edge = end - w;
      return dot(v - w, edge) > 0 && length(cross(v - w, edge)) <= tolerance_ * length(edge);
    };
    is_near = is_near || is_over || is_on(a) || is_on(b);
  }
  return is_near ? least : 0;
}

void VertexRemoval::merge(std::uint32_t vertex, const Merger& merger) {
  stars_.merge(vertex, merger.ring[merger.target]);
  for (const std::uint32_t v : merger.ring) {
    if (changed_in_[v] != pass_) changed_.push_back(v);
    changed_in_[v] = pass_;
  }
}

std::vector<VertexRemoval::Target> VertexRemoval::thick_targets(VertexFan& fan) const {
  std::vector<Target> targets;
  fan.measure(stars_, tolerance_);
  for (std::size_t place = 0; place < fan.ring().size(); ++place) {
    if (fan.bends(place)) continue;
    std::optional<double> height = fan.least_height(place);
    if (!height) height = static_cast<double>(least_height(fan.vertex(), fan.ring(), place));
    if (*height > 2 * tolerance_) targets.push_back({*height, place});
  }
  return targets;
}

std::vector<VertexRemoval::Target> VertexRemoval::all_targets(const VertexFan& fan) const {
  std::vector<Target> targets;
  const ThinFan thin(stars_, fan, tolerance_);
  for (std::size_t place = 0; place < fan.ring().size(); ++place)
    if (const auto height = thin.least_height(place)) targets.push_back({static_cast<double>(*height), place});
  return targets;
}

/// With that of the ring for which the least height is largest, the first one of several.
std::optional<VertexRemoval::Merger> VertexRemoval::merger(std::uint32_t vertex, VertexFan& fan) const {
  if (!fan.surround(stars_, vertex, kMaxNeighbours)) return std::nullopt;
  const Ring& ring = fan.ring();
  std::vector<Target> targets = thin_ == ThinTriangles::refused ? thick_targets(fan) : all_targets(fan);
  std::ranges::stable_sort(targets, std::ranges::greater(), &Target::height);
  for (const Target& target : targets)
    if (keeps_manifold(ring, target.place) && follows_surface(vertex, ring, target.place))
      return Merger{ring, target.place};
  return std::nullopt;
}

using Merger = VertexRemoval::Merger;

/// A vertex that may go, as long as nothing near it changes.
struct Candidate {
  std::uint32_t vertex;
  Merger merger;
};

constexpr std::size_t kVerticesPerTask = 500;

/// The vertices among these that may be removed, with the neighbours into which they are merged.
std::vector<Candidate> candidates(const VertexRemoval& removal, const std::vector<std::uint32_t>& vertices,
                                  const Monitor& monitor) {
  return parallel_collect(vertices.size(), kVerticesPerTask, [&](std::size_t first, std::size_t end) {
    std::vector<Candidate> found;
    VertexFan fan;
    for (std::size_t i = first; i < end && !monitor.is_cancelled(); ++i)
      if (auto merger = removal.merger(vertices[i], fan)) found.push_back({vertices[i], *std::move(merger)});
    return found;
  });
}

}  // namespace

// Most vertices must stay. Which may go is decided in parallel for all near which something has changed, and decided
// again only where a vertex that has gone since then was near.
Result<bool> remove_superfluous_vertices(TriangleStars& stars, const std::vector<bool>& may_go, double tolerance,
                                         const Monitor& monitor, ThinTriangles thin) {
  VertexRemoval removal(stars, tolerance, thin);
  const TriangleMesh& mesh = stars.original();
  std::vector<bool> is_in_play(may_go);
  std::vector<std::uint32_t> in_question;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    is_in_play[v] = may_go[v] && !mesh.is_nonmanifold(VertexId(v)) && !mesh.is_isolated(VertexId(v));
    if (is_in_play[v]) in_question.push_back(v);
  }
  bool has_changed = false;
  VertexFan fan;
  for (int pass = 0; pass < kMaxPasses && !in_question.empty(); ++pass) {
    removal.begin_pass();
    for (const auto& [vertex, merger] : candidates(removal, in_question, monitor)) {
      const std::optional<Merger> now = removal.still_holds(vertex, merger) ? merger : removal.merger(vertex, fan);
      if (!now) continue;
      removal.merge(vertex, *now);
      is_in_play[vertex] = false;
      has_changed = true;
    }
    A3D_TRY(monitor.check());
    in_question = removal.changed();
    std::erase_if(in_question, [&](std::uint32_t v) -> bool { return !is_in_play[v]; });
    std::ranges::sort(in_question);
  }
  return has_changed;
}

}  // namespace algebra3d
