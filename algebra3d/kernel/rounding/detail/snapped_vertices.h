#pragma once

#include <optional>
#include <span>
#include <vector>

#include "algebra3d/kernel/exact/plane.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/rounding/detail/moved_points.h"
#include "base/id_vector.h"

namespace algebra3d {

/// The vertices of a mesh while they are moved into planes; each has up to three planes that it must not leave. Exact.
class SnappedVertices {
 public:
  /// The mesh must outlive this. No vertex moves farther than `farthest` from its place there.
  SnappedVertices(const TriangleMesh& mesh, double farthest)
      : mesh_(mesh), farthest_(farthest), moving_(mesh.vertex_count()) {}

  /// The place of a vertex now.
  RationalVec3 place(VertexId vertex) const;
  /// The nearest point of the plane that also lies in all planes which the vertex must not leave; none if there is
  /// none, or if it is too far away.
  std::optional<RationalVec3> place_in(const ExactPlane& plane, VertexId vertex) const;
  /// Moves a vertex to a point in all its planes.
  void move(VertexId vertex, RationalVec3 to);
  /// Adds a plane that the vertex, which lies in it, must not leave.
  void keep_in(const ExactPlane& plane, VertexId vertex);

  /// The positions of all vertices, with the distances from the old ones.
  MovedVertices result() const;

 private:
  struct MovingVertex {
    RationalVec3 place;
    std::vector<ExactPlane> planes;
  };

  MovingVertex& moving(VertexId vertex);
  std::span<const ExactPlane> kept_planes(VertexId vertex) const;

  const TriangleMesh& mesh_;
  double farthest_;
  IdVector<VertexId, std::optional<MovingVertex>> moving_;
};

/// The length; rounded.
double length(const RationalVec3& v);

}  // namespace algebra3d
