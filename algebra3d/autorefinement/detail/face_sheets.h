#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// The faces of any mesh in sheets without non-manifold edges, as few as are easily found.
struct FaceSheets {
  std::vector<std::vector<FaceId>> sheets;  ///< the faces of each, ascending
  std::vector<FaceId> others;               ///< faces that are in no sheet, ascending
};

/// Patches, which are faces that are connected across manifold edges, stay whole. Each goes to the first sheet that has
/// no face which runs along one of its non-manifold edges in the same direction. Those that do so with themselves, or
/// find no place in eight sheets, are the others. Deterministic. Cost: linear.
FaceSheets face_sheets(const TriangleMesh& mesh);

}  // namespace algebra3d
