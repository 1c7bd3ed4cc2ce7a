#include "algebra3d/kernel/halfedge/halfedge_mesh.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "algebra3d/kernel/halfedge/detail/manifold_linker.h"
#include "algebra3d/kernel/halfedge/detail/mesh_linker.h"
#include "base/shrink.h"

namespace algebra3d {
namespace {

template <typename Vector>
std::size_t capacity_bytes(const Vector& values) {
  return values.capacity() * sizeof(typename Vector::value_type);
}

}  // namespace

template <typename Layout>
HalfedgeMesh<Layout>::HalfedgeMesh(PointArray points, Layout layout, LargeVector<std::uint32_t> origins,
                                   LargeVector<std::uint32_t> opposites, LargeVector<HalfedgeId> outgoing, Links links)
    : Structure(std::move(layout), std::move(points), std::move(origins), std::move(opposites), std::move(outgoing),
                nullptr) {
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
    : Structure(linked, std::move(points), linked.origins_, linked.opposites_, linked.outgoing_, linked.nonmanifold_) {
  assert(points_.size() == linked.points_.size());
}

template <typename Layout>
std::size_t HalfedgeMesh<Layout>::heap_bytes() const {
  std::size_t bytes = points_.heap_bytes() + layout_bytes(static_cast<const Layout&>(*this)) +
                      capacity_bytes(origins_) + capacity_bytes(opposites_) + capacity_bytes(outgoing_);
  if (nonmanifold_)
    bytes += sizeof(NonManifoldTables) + capacity_bytes(nonmanifold_->edge_starts) +
             capacity_bytes(nonmanifold_->edge_halfedges) + capacity_bytes(nonmanifold_->vertices) +
             capacity_bytes(nonmanifold_->fan_starts) + capacity_bytes(nonmanifold_->fans);
  return bytes;
}

template class HalfedgeMesh<TriangleLayout>;
template class HalfedgeMesh<PolygonLayout>;

}  // namespace algebra3d
