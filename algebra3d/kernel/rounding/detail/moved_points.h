#pragma once

#include <vector>

#include "algebra3d/base/strong_id.h"
#include "algebra3d/kernel/exact/point_table.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "base/id_vector.h"

namespace algebra3d {

/// New places of the vertices of a mesh, and for each an upper bound of how far it moved, in coordinate units. For a
/// rounded vertex the bound also covers all others that may have moved to the same place (rounded_vertices.h).
struct MovedVertices {
  PointArray points;
  std::vector<double> movements;
};

/// A point to which vertices have moved.
using PointId = StrongId<struct PointTag>;

/// The distinct points to which vertices have moved; vertices at equal places share one.
struct MovedPoints {
  explicit MovedPoints(const MovedVertices& moved);

  PointId of(VertexId vertex) const { return of_vertex[vertex]; }

  PointTable table;                     ///< numbered as the ids
  IdVector<PointId, Vec3> points;       ///< rounded
  IdVector<PointId, double> movements;  ///< the largest movement of the vertices at this point
  IdVector<VertexId, PointId> of_vertex;
  double largest_movement = 0;
};

}  // namespace algebra3d
