#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/soup/weld.h"
#include "base/id_vector.h"

namespace algebra3d {

/// The triangle soup that a repair changes, as indices into shared points. Points are distinct, have double coordinates
/// and never change; some may be unused. To move a vertex, a step lets its triangles use another point. A step changes
/// `triangles` and calls `changed` before it asks for the mesh again.
class IndexedSoup {
 public:
  std::vector<Vec3> points;
  IdVector<FaceId, TriangleMesh::Triangle> triangles;

  explicit IndexedSoup(const WeldedTriangles& welded) : points(welded.points.approx()), triangles(welded.triangles) {}
  /// Takes the faces of a mesh with double coordinates. The mesh is kept, so it need not be linked again.
  explicit IndexedSoup(std::shared_ptr<const TriangleMesh> mesh);

  const Vec3& point(VertexId vertex) const { return points[vertex.index()]; }
  const Vec3& corner(FaceId triangle, std::size_t i) const { return points[triangles[triangle][i]]; }
  /// The mean of the corners; rounded.
  Vec3 middle(FaceId triangle) const {
    return (1.0 / 3) * corner(triangle, 0) + (1.0 / 3) * corner(triangle, 1) + (1.0 / 3) * corner(triangle, 2);
  }
  /// Twice the vector area; rounded.
  Vec3 normal(FaceId triangle) const {
    return cross(corner(triangle, 1) - corner(triangle, 0), corner(triangle, 2) - corner(triangle, 0));
  }
  double area(FaceId triangle) const { return length(normal(triangle)) / 2; }
  /// The diagonal of the box around all triangles; 0 if there are none.
  double diagonal() const;

  /// The half-edge mesh of the triangles; face i is triangle i. It stays valid for its holders when the soup changes.
  /// Cost: linear at the first call after a change; less if most triangles were linked before.
  std::shared_ptr<const TriangleMesh> mesh() const;
  /// To be called after `triangles` was changed directly.
  void changed();

  /// Adds triangles at the end.
  void add(const std::vector<TriangleMesh::Triangle>& more);
  /// Reverses the orientation of a triangle.
  void flip(FaceId triangle);
  /// Drops the triangles whose flag is set; triangles beyond the flags stay. The order is kept. False if no flag is
  /// set.
  bool drop(const IdVector<FaceId, bool>& is_dropped);

 private:
  bool is_linked() const;
  std::vector<std::uint32_t> faces_before() const;

  mutable std::shared_ptr<const TriangleMesh> mesh_;
  mutable std::shared_ptr<const TriangleMesh> before_;  // the mesh before the last changes; null while mesh_ is valid
};

}  // namespace algebra3d
