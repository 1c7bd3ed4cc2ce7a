#include "algebra3d/halfedge/triangle_mesh.h"

#include <cassert>
#include <utility>

namespace algebra3d {
namespace {

LargeVector<std::uint32_t> origins_of(std::span<const TriangleMesh::Triangle> triangles) {
  LargeVector<std::uint32_t> origins;
  origins.reserve(3 * triangles.size());
  for (const TriangleMesh::Triangle& triangle : triangles)
    origins.insert(origins.end(), triangle.begin(), triangle.end());
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
                           LargeVector<HalfedgeId> outgoing, FacePlanes planes)
    : HalfedgeMesh(std::move(points), {}, std::move(origins), std::move(opposites), std::move(outgoing),
                   Links::all_but_between_open_vertices),
      planes_(std::move(planes)) {
  assert(halfedge_count() % 3 == 0);
}

TriangleRef TriangleMesh::corners(FaceId f) const {
  const Triangle t = triangle(f);
  return {points()[t[0]], points()[t[1]], points()[t[2]]};
}

}  // namespace algebra3d
