#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "algebra3d/halfedge/relinked.h"
#include "algebra3d/halfedge/triangle_mesh.h"
#include "algebra3d/repair/weld.h"

namespace algebra3d {

/// The facets of a file on their way to a solid. Points are doubles; no two are equal, but some may be unused.
/// Who changes triangles calls `changed` before anyone asks for the mesh; points stay as they are.
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
  /// after a change, and less if most of the facets were linked before.
  std::shared_ptr<const TriangleMesh> mesh() const {
    if (mesh_ == nullptr && before_ == nullptr)
      mesh_ = std::make_shared<const TriangleMesh>(PointArray(points), triangles);
    if (mesh_ == nullptr)
      mesh_ = std::make_shared<const TriangleMesh>(relinked(*before_, faces_before(), PointArray(points), triangles));
    before_.reset();
    assert(is_linked());
    return mesh_;
  }
  void changed() {
    if (mesh_ != nullptr) before_ = std::exchange(mesh_, nullptr);
  }

 private:
  bool is_linked() const {
    const auto is_same = [&](const auto& triangle) {
      return mesh_->triangle(FaceId(static_cast<std::uint32_t>(&triangle - triangles.data()))) == triangle;
    };
    return mesh_->face_count() == triangles.size() && std::ranges::all_of(triangles, is_same);
  }

  /// Which facet each was when they were linked last, as far as that is easily told. Facets keep their order, though
  /// some go, change or are added at the end.
  std::vector<std::uint32_t> faces_before() const {
    constexpr std::size_t kFarthest = 16;
    std::vector<std::uint32_t> was(triangles.size(), kNewFace);
    std::size_t next = 0;
    for (std::size_t i = 0; i < triangles.size() && next < before_->face_count(); ++i) {
      const std::size_t end = std::min(next + kFarthest, before_->face_count());
      std::size_t found = next;
      while (found < end && before_->triangle(FaceId(found)) != triangles[i]) ++found;
      if (found < end) was[i] = static_cast<std::uint32_t>(found);
      next = found < end ? found + 1 : next + 1;
    }
    return was;
  }

  mutable std::shared_ptr<const TriangleMesh> mesh_;
  mutable std::shared_ptr<const TriangleMesh> before_;  // before the last changes; none once mesh_ is there
};

}  // namespace algebra3d
