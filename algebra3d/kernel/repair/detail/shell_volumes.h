#pragma once

#include <span>

#include "algebra3d/kernel/halfedge/triangle_mesh.h"

namespace algebra3d {

/// An estimated number with a proved bound of its error.
struct Estimate {
  double value, error;
};

/// Estimates the volume of closed faces of a mesh with double coordinates. The error is infinite where coordinates are
/// too small or too large for doubles. Cost: linear in the faces, a tenth of exact_volume.
Estimate estimated_volume(const TriangleMesh& mesh, std::span<const FaceId> faces);

}  // namespace algebra3d
