#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "base/indices.h"
#include "base/large_allocator.h"

namespace algebra3d {

/// The connectivity of a triangle mesh whose edges are collapsed. Half-edge 4f + i leaves corner i of face f; kNone
/// stands for no half-edge. A collapse of half-edge h from a to b removes b and the one or two faces of the edge; all
/// others keep their numbers. Vertices of non-manifold edges, and non-manifold ones, are *locked*: their edges are
/// never collapsed. One object, one thread; reading in parallel is safe.
class CollapseMesh {
 public:
  /// The places of a vertex.
  enum class Place : std::uint8_t { inside, boundary, locked };

  /// The longest ring that is walked: at vertices with more faces no edge is collapsed, so that the cost of a collapse
  /// is bounded.
  static constexpr std::size_t kMaxValence = 128;

  /// A face at a vertex, by its other corners in counter-clockwise order.
  struct Spoke {
    std::uint32_t first, second;
  };
  /// The faces around a vertex in counter-clockwise order.
  struct Ring {
    std::vector<Spoke> spokes;
    bool is_open = false;
  };

  explicit CollapseMesh(const TriangleMesh& mesh);

  static std::uint32_t next(std::uint32_t h) { return (h & 3U) == 2 ? h - 2 : h + 1; }
  static std::uint32_t prev(std::uint32_t h) { return (h & 3U) == 0 ? h + 2 : h - 1; }
  static std::uint32_t face(std::uint32_t h) { return h >> 2U; }

  std::uint32_t origin(std::uint32_t h) const { return faces_[face(h)].corners[h & 3U]; }
  std::uint32_t target(std::uint32_t h) const { return origin(next(h)); }
  std::uint32_t opposite(std::uint32_t h) const { return faces_[face(h)].opposites[h & 3U]; }
  std::size_t face_slots() const { return faces_.size(); }
  std::size_t face_count() const { return face_count_; }
  std::size_t vertex_count() const { return outgoing_.size(); }
  bool is_alive(std::uint32_t f) const { return faces_[f].is_alive != 0; }
  const std::array<std::uint32_t, 3>& corners(std::uint32_t f) const { return faces_[f].corners; }
  Place place(std::uint32_t v) const { return places_[v]; }
  void lock(std::uint32_t v) { places_[v] = Place::locked; }

  /// Whether the half-edge waits in a queue: a bit that the caller uses.
  bool is_queued(std::uint32_t h) const { return (faces_[face(h)].flags >> (h & 3U) & 1U) != 0; }
  void set_queued(std::uint32_t h) { faces_[face(h)].flags |= 1U << (h & 3U); }
  void clear_queued(std::uint32_t h) { faces_[face(h)].flags &= ~(1U << (h & 3U)); }

  /// Whether the edge is a crease. Of two edges that become one, one is enough.
  bool is_crease(std::uint32_t h) const { return (faces_[face(h)].flags >> (4U + (h & 3U)) & 1U) != 0; }
  /// Makes the half-edge one of a crease; its opposite is marked by a call of its own.
  void set_crease(std::uint32_t h) { faces_[face(h)].flags |= 16U << (h & 3U); }
  void prefetch(std::uint32_t h) const { __builtin_prefetch(&faces_[face(h)]); }

  /// The faces around a vertex that is not locked. False if they are more than kMaxValence.
  bool ring_of(std::uint32_t v, Ring& ring) const;
  /// True if the collapse of `h` keeps a manifold a manifold of the same topology; `a` and `b` are the rings of its
  /// origin and target. Source: [dey1999].
  bool meets_link_condition(std::uint32_t h, const Ring& a, const Ring& b) const;
  /// Collapses `h`; the link condition must hold. Its origin stays.
  void collapse(std::uint32_t h);

  /// The vertex that a vertex was merged into, itself if it is still there. Shortens the ways to it.
  std::uint32_t representative(std::uint32_t v);

 private:
  struct Face {
    std::array<std::uint32_t, 3> corners;
    std::uint32_t is_alive;
    std::array<std::uint32_t, 3> opposites;
    std::uint32_t flags;  // two bits for each half-edge: queued, crease
  };

  bool keeps_wing(std::uint32_t h) const;
  void remove_wing(std::uint32_t h);
  void link(std::uint32_t h, std::uint32_t to) {
    if (h != kNone) faces_[face(h)].opposites[h & 3U] = to;
  }
  std::uint32_t first_after_collapse(std::uint32_t h) const;

  LargeVector<Face> faces_;
  LargeVector<std::uint32_t> outgoing_;  // of a boundary vertex the first of its fan; unset at locked ones
  LargeVector<std::uint32_t> merged_into_;
  std::vector<Place> places_;
  std::size_t face_count_ = 0;
};

}  // namespace algebra3d
