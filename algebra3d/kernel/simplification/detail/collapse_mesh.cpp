#include "algebra3d/kernel/simplification/detail/collapse_mesh.h"

#include "base/scheduler.h"

namespace algebra3d {
namespace {

constexpr std::size_t kMeshGrain = 1U << 14U;

std::uint32_t numbered(HalfedgeId h) {
  return h.is_valid() ? h.index() / 3 * 4 + h.index() % 3 : kNone;
}

}  // namespace

CollapseMesh::CollapseMesh(const TriangleMesh& mesh)
    : faces_(mesh.face_count()),
      outgoing_(mesh.vertex_count()),
      merged_into_(mesh.vertex_count()),
      places_(mesh.vertex_count(), Place::inside),
      face_count_(mesh.face_count()) {
  parallel_for(mesh.face_count(), kMeshGrain, [&](std::size_t f) {
    const FaceId id(f);
    Face& face = faces_[f];
    for (std::uint32_t i = 0; i < 3; ++i) {
      face.corners[i] = mesh.origin(TriangleMesh::halfedge(id, i)).index();
      face.opposites[i] = numbered(mesh.opposite(TriangleMesh::halfedge(id, i)));
    }
    face.is_alive = 1;
    face.flags = 0;
  });
  parallel_for(mesh.vertex_count(), kMeshGrain, [&](std::size_t v) {
    const HalfedgeId out = mesh.outgoing(VertexId(v));
    outgoing_[v] = numbered(out);
    merged_into_[v] = static_cast<std::uint32_t>(v);
    if (!out.is_valid() || mesh.is_nonmanifold(VertexId(v)))
      places_[v] = Place::locked;
    else if (!mesh.opposite(out).is_valid())
      places_[v] = Place::boundary;
  });
  for (std::size_t n = 0; n < mesh.nonmanifold_edge_count(); ++n)
    for (const HalfedgeId h : mesh.nonmanifold_edge(n))
      for (const VertexId v : {mesh.origin(h), mesh.target(h)}) lock(v.index());
}

bool CollapseMesh::ring_of(std::uint32_t v, Ring& ring) const {
  ring.spokes.clear();
  ring.is_open = false;
  const std::uint32_t first = outgoing_[v];
  for (std::uint32_t h = first;;) {
    if (ring.spokes.size() == kMaxValence) return false;
    ring.spokes.push_back({target(h), origin(prev(h))});
    h = opposite(prev(h));
    if (h == first) return true;
    if (h == kNone) {
      ring.is_open = true;
      return true;
    }
  }
}

/// Whether the third corner of the face of `h` keeps three faces, or two and a boundary: with fewer, the two faces that
/// are joined at it would be one and the same, or nothing would be left of it.
bool CollapseMesh::keeps_wing(std::uint32_t h) const {
  const std::uint32_t left = opposite(prev(h)), right = opposite(next(h));
  if (left == kNone && right == kNone) return false;
  if (left == kNone || right == kNone) return true;
  return opposite(next(left)) != prev(right);
}

bool CollapseMesh::meets_link_condition(std::uint32_t h, const Ring& a, const Ring& b) const {
  const std::uint32_t o = opposite(h);
  if (o != kNone && a.is_open && b.is_open) return false;
  if (!keeps_wing(h) || (o != kNone && !keeps_wing(o))) return false;
  // The corners beside the edge are the only common neighbours.
  std::size_t common = 0;
  const auto count_common = [&](std::uint32_t v) {
    for (const Spoke& spoke : a.spokes) common += static_cast<std::size_t>(spoke.first == v);
    if (a.is_open) common += static_cast<std::size_t>(a.spokes.back().second == v);
  };
  for (const Spoke& spoke : b.spokes) count_common(spoke.first);
  if (b.is_open) count_common(b.spokes.back().second);
  return common == (o == kNone ? 1U : 2U);
}

/// The first half-edge of the fan of the origin of `h` after its collapse, among those of faces that stay.
std::uint32_t CollapseMesh::first_after_collapse(std::uint32_t h) const {
  const std::uint32_t o = opposite(h), a = origin(h), b = target(h);
  const bool is_of_target = places_[b] == Place::boundary;
  const std::uint32_t first = outgoing_[is_of_target ? b : a];
  // Inside, any half-edge of a face that stays will do.
  if (face(first) == face(h)) return is_of_target || places_[a] == Place::inside ? opposite(prev(h)) : kNone;
  if (o != kNone && face(first) == face(o))
    return places_[a] == Place::inside && !is_of_target ? opposite(prev(h)) : opposite(prev(o));
  return first;
}

/// Removes the face of `h`, and links those along its other two edges.
void CollapseMesh::remove_wing(std::uint32_t h) {
  const std::uint32_t left = opposite(prev(h)), right = opposite(next(h));
  const std::uint32_t c = origin(prev(h));
  if (outgoing_[c] == prev(h)) outgoing_[c] = right != kNone ? right : left == kNone ? kNone : next(left);
  link(left, right);
  link(right, left);
  if (left != kNone && right != kNone && is_crease(left) != is_crease(right)) {
    set_crease(left);
    set_crease(right);
  }
  faces_[face(h)].is_alive = 0;
  faces_[face(h)].flags = 0;
  --face_count_;
}

void CollapseMesh::collapse(std::uint32_t h) {
  const std::uint32_t o = opposite(h), a = origin(h), b = target(h);
  const std::uint32_t first = first_after_collapse(h);
  const std::uint32_t start = outgoing_[b];
  for (std::uint32_t g = start; g != kNone;) {
    faces_[face(g)].corners[g & 3U] = a;
    g = opposite(prev(g));
    if (g == start) break;
  }
  if (places_[b] == Place::boundary) places_[a] = Place::boundary;
  outgoing_[a] = first;
  outgoing_[b] = kNone;
  merged_into_[b] = a;
  remove_wing(h);
  if (o != kNone) remove_wing(o);
}

std::uint32_t CollapseMesh::representative(std::uint32_t v) {
  for (; merged_into_[v] != v; v = merged_into_[v]) merged_into_[v] = merged_into_[merged_into_[v]];
  return v;
}

}  // namespace algebra3d
