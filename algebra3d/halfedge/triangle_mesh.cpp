#include "algebra3d/halfedge/triangle_mesh.h"

#include <algorithm>
#include <cassert>

#include "algebra3d/halfedge/detail/nonmanifold_tables.h"

namespace algebra3d {
namespace {

template <typename Vector>
std::size_t capacity_bytes(const Vector& values) {
  return values.capacity() * sizeof(typename Vector::value_type);
}

std::span<const HalfedgeId> list(const std::vector<std::uint32_t>& starts, const std::vector<HalfedgeId>& values,
                                 std::size_t n) {
  return std::span(values).subspan(starts[n], starts[n + 1] - starts[n]);
}

}  // namespace

std::span<const HalfedgeId> TriangleMesh::edge_halfedges(HalfedgeId h) const {
  assert(is_nonmanifold(h));
  return nonmanifold_edge(opposites_[h.index()] & ~kNoOpposite);
}

std::size_t TriangleMesh::nonmanifold_edge_count() const {
  return nonmanifold_ ? nonmanifold_->edge_starts.size() - 1 : 0;
}

std::span<const HalfedgeId> TriangleMesh::nonmanifold_edge(std::size_t n) const {
  return list(nonmanifold_->edge_starts, nonmanifold_->edge_halfedges, n);
}

bool TriangleMesh::is_nonmanifold(VertexId v) const {
  return nonmanifold_ && std::ranges::binary_search(nonmanifold_->vertices, v.index());
}

std::span<const HalfedgeId> TriangleMesh::fans(VertexId v) const {
  if (nonmanifold_) {
    const auto& vertices = nonmanifold_->vertices;
    const auto found = std::ranges::lower_bound(vertices, v.index());
    if (found != vertices.end() && *found == v.index())
      return list(nonmanifold_->fan_starts, nonmanifold_->fans, static_cast<std::size_t>(found - vertices.begin()));
  }
  return {&outgoing_[v.index()], is_isolated(v) ? std::size_t{0} : std::size_t{1}};
}

std::vector<VertexId> TriangleMesh::nonmanifold_vertices() const {
  std::vector<VertexId> result;
  if (!nonmanifold_) return result;
  result.reserve(nonmanifold_->vertices.size());
  for (const std::uint32_t v : nonmanifold_->vertices) result.emplace_back(v);
  return result;
}

TriangleRef TriangleMesh::corners(FaceId f) const {
  const Triangle t = triangle(f);
  return {points_[t[0]], points_[t[1]], points_[t[2]]};
}

std::size_t TriangleMesh::heap_bytes() const {
  std::size_t bytes = points_.heap_bytes() + planes_.heap_bytes() + capacity_bytes(origins_) +
                      capacity_bytes(opposites_) + capacity_bytes(outgoing_);
  if (nonmanifold_)
    bytes += sizeof(NonManifold) + capacity_bytes(nonmanifold_->edge_starts) +
             capacity_bytes(nonmanifold_->edge_halfedges) + capacity_bytes(nonmanifold_->vertices) +
             capacity_bytes(nonmanifold_->fan_starts) + capacity_bytes(nonmanifold_->fans);
  return bytes;
}

}  // namespace algebra3d
