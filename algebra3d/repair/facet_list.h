#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/repair/weld.h"

namespace algebra3d {

/// The facets of a file on their way to a solid. Points are doubles; no two are equal, but some may be unused.
/// Who changes points or triangles calls `changed` before anyone asks for the mesh.
class FacetList {
 public:
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Triangle> triangles;

  explicit FacetList(const WeldedTriangles& welded) : points(welded.points.approx()), triangles(welded.triangles) {}
  /// Of all faces of a mesh whose points are doubles; it need not be linked again.
  explicit FacetList(std::shared_ptr<const TriangleMesh> mesh) : points(mesh->points().approx()) {
    triangles.reserve(mesh->face_count());
    for (std::uint32_t f = 0; f < mesh->face_count(); ++f) triangles.push_back(mesh->triangle(FaceId(f)));
    mesh_ = std::move(mesh);
  }

  const Vec3& corner(std::size_t triangle, std::size_t i) const { return points[triangles[triangle][i]]; }
  Vec3 middle(std::size_t triangle) const {
    return (1.0 / 3) * corner(triangle, 0) + (1.0 / 3) * corner(triangle, 1) + (1.0 / 3) * corner(triangle, 2);
  }

  /// The facets linked, face i being triangle i. Stays what it is for those who hold it. Cost: linear, the first time
  /// after a change.
  std::shared_ptr<const TriangleMesh> mesh() const {
    if (mesh_ == nullptr) mesh_ = std::make_shared<const TriangleMesh>(PointArray(points), triangles);
    assert(is_linked());
    return mesh_;
  }
  void changed() { mesh_.reset(); }

 private:
  bool is_linked() const {
    const auto is_same = [&](const auto& triangle) {
      return mesh_->triangle(FaceId(static_cast<std::uint32_t>(&triangle - triangles.data()))) == triangle;
    };
    return mesh_->face_count() == triangles.size() && std::ranges::all_of(triangles, is_same);
  }

  mutable std::shared_ptr<const TriangleMesh> mesh_;
};

}  // namespace algebra3d
