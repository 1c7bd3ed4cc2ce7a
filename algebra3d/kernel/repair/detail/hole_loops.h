#pragma once

#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "algebra3d/kernel/soup/loop_triangulation.h"
#include "base/id_vector.h"
#include "base/strong_id.h"

namespace algebra3d {

/// A HoleLoop.
using HoleId = StrongId<struct HoleTag>;

/// A simple closed boundary loop with the data for triangulating a cover. In the direction in which new triangles run
/// along it.
struct HoleLoop {
  std::vector<VertexId> vertices;
  Loop loop;        ///< the same corners as points, and per edge the corner of the triangle beyond it
  FaceId triangle;  ///< any triangle at the loop: shows the connected component

  /// The box around the loop.
  Box3 box() const;
  /// The diagonal of its box, in coordinate units.
  double diameter() const;
};

/// The simple boundary loops of a mesh; loops that visit a vertex more than once are cut there. Cost: linear.
IdVector<HoleId, HoleLoop> hole_loops(const TriangleMesh& mesh);

}  // namespace algebra3d
