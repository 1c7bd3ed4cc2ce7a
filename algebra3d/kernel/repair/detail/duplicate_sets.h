#pragma once

#include <vector>

#include "algebra3d/base/strong_id.h"
#include "algebra3d/kernel/halfedge/triangle_mesh.h"
#include "base/id_vector.h"

namespace algebra3d {

/// A set of at least two faces with the same three corners.
struct DuplicateSet {
  std::vector<FaceId> triangles;  ///< ascending
  int balance = 0;                ///< number of triangles with is_even, minus the number of others

  /// True if both orientations are equally frequent.
  bool is_balanced() const { return balance == 0; }
};

/// A set of duplicates.
using DuplicateSetId = StrongId<struct DuplicateSetTag>;
using DuplicateSets = IdVector<DuplicateSetId, DuplicateSet>;

/// The orientation of a triangle: true if its corners ascend in cyclic order.
bool is_even(const TriangleMesh::Triangle& triangle);

/// All sets of duplicate faces of a mesh. No face may repeat a corner. Cost: linear; n log n in the faces at
/// non-manifold edges.
DuplicateSets duplicate_sets(const TriangleMesh& mesh);

}  // namespace algebra3d
