#include "algebra3d/values/spatial_relations/boundary_faces.h"

#include <utility>
#include <vector>

#include "base/box_corners.h"

namespace algebra3d {

BoundaryFaces::BoundaryFaces(const SpatialSet& set) {
  std::visit([this](const auto& kind) { take(kind); }, set);
}

void BoundaryFaces::take(const PointSet& set) {
  PointArray points;
  std::vector<IndexTriangle> faces;
  for (const ExactPoint& point : set.points) {
    const auto corner = static_cast<std::uint32_t>(points.size());
    faces.push_back({corner, corner, corner});
    points.push_back(point);
  }
  own({std::move(points), faces});
}

/// Along an axis without extent, corners are those of its lower end; so the sides of a flat box are rectangles, edges
/// and points of it.
void BoundaryFaces::take(const Box3& box) {
  PointArray points;
  auto extended_axes = 0U;
  for (std::uint32_t axis = 0; axis < 3; ++axis)
    if (box.min[axis] < box.max[axis]) extended_axes |= 1U << axis;
  for (unsigned i = 0; i < 8; ++i) points.push_back(ExactPoint(corner_of(box, i)));
  std::vector<IndexTriangle> faces(kBoxTriangles.begin(), kBoxTriangles.end());
  for (IndexTriangle& face : faces)
    for (auto& corner : face) corner &= extended_axes;
  own({std::move(points), faces});
}

void BoundaryFaces::refer_to(const Geometry& geometry) {
  mesh_ = &geometry.mesh;
  hierarchy_ = &geometry.hierarchy();
}

void BoundaryFaces::own(TriangleMesh mesh) {
  own_mesh_ = std::make_unique<const TriangleMesh>(std::move(mesh));
  own_hierarchy_ = std::make_unique<const BoxHierarchy>(*own_mesh_);
  mesh_ = own_mesh_.get();
  hierarchy_ = own_hierarchy_.get();
}

}  // namespace algebra3d
