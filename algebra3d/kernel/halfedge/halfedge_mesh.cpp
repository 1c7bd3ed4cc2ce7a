#include "algebra3d/kernel/halfedge/halfedge_mesh.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "algebra3d/kernel/halfedge/detail/manifold_linker.h"
#include "algebra3d/kernel/halfedge/detail/mesh_linker.h"
#include "algebra3d/kernel/halfedge/detail/nonmanifold_tables.h"
#include "base/shrink.h"

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

template <typename Layout>
HalfedgeMesh<Layout>::HalfedgeMesh(PointArray points, Layout layout, LargeVector<std::uint32_t> origins,
                                   LargeVector<std::uint32_t> opposites, LargeVector<HalfedgeId> outgoing, Links links)
    : Layout(std::move(layout)),
      points_(std::move(points)),
      origins_(std::move(origins)),
      opposites_(std::move(opposites)),
      outgoing_(std::move(outgoing)) {
  // Without settled vertices no edge is linked.
  if (links == Links::all_but_between_open_vertices && outgoing_.empty()) links = Links::none;
  if (links == Links::none) opposites_.resize(origins_.size());
  assert(origins_.size() == opposites_.size() && origins_.size() <= kMaxHalfedges);
  assert(outgoing_.size() <= points_.size());
  assert(std::ranges::all_of(origins_, [&](std::uint32_t origin) { return origin < points_.size(); }));
  // A mesh lives long: it keeps hardly any spare capacity of the arrays that it was given.
  points_.shrink();
  shrink(origins_);
  shrink(opposites_);
  if (links == Links::all) {
    assert(outgoing_.size() == points_.size());
    return;
  }
  std::vector<std::uint32_t> open_corners;
  if (links == Links::all_but_between_open_vertices)
    open_corners = mesh_linker::open_corners(origins_, outgoing_.size());
  if (links != Links::some && ManifoldLinker<Layout>(*this, links, open_corners).link()) return;
  if (links == Links::proposed) links = Links::none;
  MeshLinker<Layout>(*this, links, std::move(open_corners)).build();
}

template <typename Layout>
HalfedgeMesh<Layout>::HalfedgeMesh(const HalfedgeMesh& linked, PointArray points)
    : Layout(linked),
      points_(std::move(points)),
      origins_(linked.origins_),
      opposites_(linked.opposites_),
      outgoing_(linked.outgoing_),
      nonmanifold_(linked.nonmanifold_) {
  assert(points_.size() == linked.points_.size());
}

template <typename Layout>
std::span<const HalfedgeId> HalfedgeMesh<Layout>::edge_halfedges(HalfedgeId h) const {
  assert(is_nonmanifold(h));
  return nonmanifold_edge(opposites_[h.index()] & ~kNoOpposite);
}

template <typename Layout>
std::size_t HalfedgeMesh<Layout>::nonmanifold_edge_count() const {
  return nonmanifold_ ? nonmanifold_->edge_starts.size() - 1 : 0;
}

template <typename Layout>
std::span<const HalfedgeId> HalfedgeMesh<Layout>::nonmanifold_edge(std::size_t n) const {
  return list(nonmanifold_->edge_starts, nonmanifold_->edge_halfedges, n);
}

template <typename Layout>
bool HalfedgeMesh<Layout>::is_nonmanifold(VertexId v) const {
  return nonmanifold_ && std::ranges::binary_search(nonmanifold_->vertices, v.index());
}

template <typename Layout>
std::span<const HalfedgeId> HalfedgeMesh<Layout>::fans(VertexId v) const {
  if (nonmanifold_) {
    const auto& vertices = nonmanifold_->vertices;
    const auto found = std::ranges::lower_bound(vertices, v.index());
    if (found != vertices.end() && *found == v.index())
      return list(nonmanifold_->fan_starts, nonmanifold_->fans, static_cast<std::size_t>(found - vertices.begin()));
  }
  return {&outgoing_[v.index()], is_isolated(v) ? std::size_t{0} : std::size_t{1}};
}

template <typename Layout>
std::vector<VertexId> HalfedgeMesh<Layout>::nonmanifold_vertices() const {
  std::vector<VertexId> result;
  if (!nonmanifold_) return result;
  result.reserve(nonmanifold_->vertices.size());
  for (const std::uint32_t v : nonmanifold_->vertices) result.emplace_back(v);
  return result;
}

template <typename Layout>
std::size_t HalfedgeMesh<Layout>::heap_bytes() const {
  std::size_t bytes = points_.heap_bytes() + this->layout_bytes() + capacity_bytes(origins_) +
                      capacity_bytes(opposites_) + capacity_bytes(outgoing_);
  if (nonmanifold_)
    bytes += sizeof(NonManifoldTables) + capacity_bytes(nonmanifold_->edge_starts) +
             capacity_bytes(nonmanifold_->edge_halfedges) + capacity_bytes(nonmanifold_->vertices) +
             capacity_bytes(nonmanifold_->fan_starts) + capacity_bytes(nonmanifold_->fans);
  return bytes;
}

template class HalfedgeMesh<TriangleLayout>;
template class HalfedgeMesh<PolygonLayout>;

}  // namespace algebra3d
