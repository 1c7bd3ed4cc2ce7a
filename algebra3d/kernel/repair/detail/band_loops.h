#pragma once

#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/halfedge/topology.h"
#include "algebra3d/kernel/repair/scaled_triangles.h"
#include "base/id_vector.h"
#include "base/strong_id.h"

namespace algebra3d {

/// A BandLoop.
using LoopId = StrongId<struct LoopTag>;

/// A simple closed boundary loop with the data for joining it to another one by a band. In the direction in which new
/// triangles run along it.
struct BandLoop {
  std::vector<VertexId> vertices;
  std::vector<Vec3> normals;    ///< per vertex: the unit normal of the triangle at the edge to the next one
  std::uint32_t component = 0;  ///< of the surface; see FaceComponents
  Box3 box;                     ///< scaled, like the area
  double area = 0;              ///< lower bound of the area of any cover of the loop, scaled

  double diameter() const { return length(box.max - box.min); }
};

/// The simple boundary loops of a mesh. Cost: linear.
IdVector<LoopId, BandLoop> band_loops(const TriangleMesh& mesh, const FaceComponents& components,
                                      const BinaryScale& scale);

/// Triangles between two loops.
struct Band {
  LoopId first, second;
  bool flips_one = false;  ///< the two components have opposite orientations
  std::vector<TriangleMesh::Triangle> triangles;
  double area = 0;
  double bend = 0;  ///< mean cosine of the angles between its triangles and those beyond the loops; -1: folded back
};

/// The band between two loops. It begins at their two nearest vertices and takes the shorter diagonal at each step. It
/// follows the first loop forwards and the second backwards, or both forwards if one component is to be flipped.
Band band_between(const IdVector<LoopId, BandLoop>& loops, LoopId first, LoopId second, bool flips_one,
                  const std::vector<Vec3>& points, const BinaryScale& scale);

}  // namespace algebra3d
