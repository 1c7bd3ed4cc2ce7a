#include "algebra3d/kernel/halfedge/triangle_mesh.h"

#include <cassert>
#include <utility>

namespace algebra3d {
namespace {

LargeVector<std::uint32_t> origins_of(std::span<const TriangleMesh::Triangle> triangles) {
  LargeVector<std::uint32_t> origins(3 * triangles.size());
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) origins[3 * f + i] = triangles[f][i];
  return origins;
}

}  // namespace

TriangleMesh::TriangleMesh(PointArray points, std::span<const Triangle> triangles, FacePlanes planes)
    : HalfedgeMesh(std::move(points), {}, origins_of(triangles)), planes_(std::move(planes)) {}

TriangleMesh::TriangleMesh(PointArray points, LargeVector<std::uint32_t> origins, LargeVector<std::uint32_t> opposites,
                           FacePlanes planes)
    : HalfedgeMesh(std::move(points), {}, std::move(origins), std::move(opposites), {}, Links::some),
      planes_(std::move(planes)) {
  assert(halfedge_count() % 3 == 0);
}

TriangleMesh::TriangleMesh(PointArray points, LargeVector<std::uint32_t> origins, LargeVector<std::uint32_t> opposites,
                           LargeVector<HalfedgeId> outgoing, FacePlanes planes, std::shared_ptr<const FaceOrder> order)
    : HalfedgeMesh(std::move(points), {}, std::move(origins), std::move(opposites), std::move(outgoing),
                   Links::all_but_between_open_vertices),
      planes_(std::move(planes)),
      face_order_(std::move(order)) {
  assert(halfedge_count() % 3 == 0);
}

TriangleMesh::TriangleMesh(const TriangleMesh& linked, PointArray points) : HalfedgeMesh(linked, std::move(points)) {}

TriangleMesh TriangleMesh::with_proposed_links(PointArray points, LargeVector<std::uint32_t> origins,
                                               LargeVector<std::uint32_t> opposites) {
  assert(origins.size() % 3 == 0);
  return {std::move(points), {}, std::move(origins), std::move(opposites), {}, Links::proposed};
}

std::size_t TriangleMesh::heap_bytes() const {
  const std::size_t of_order = face_order_ == nullptr ? 0 : face_order_->faces.capacity() * sizeof(PlacedFace);
  return HalfedgeMesh::heap_bytes() + planes_.heap_bytes() + of_order;
}

TriangleRef TriangleMesh::corners(FaceId f) const {
  const Triangle t = triangle(f);
  return {points()[t[0]], points()[t[1]], points()[t[2]]};
}

}  // namespace algebra3d
