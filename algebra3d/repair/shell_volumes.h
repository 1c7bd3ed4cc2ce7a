#pragma once

#include <cstdint>
#include <span>

#include "algebra3d/halfedge/triangle_mesh.h"

namespace algebra3d {

/// A number somewhere within a distance from another one.
struct Estimate {
  double value, error;
};

/// The volume that some faces of a mesh of doubles enclose, which have to be closed. The error is infinite where
/// doubles are too small or too large to tell. Cost: linear in the faces, a tenth of exact_volume.
Estimate estimated_volume(const TriangleMesh& mesh, std::span<const std::uint32_t> faces);

}  // namespace algebra3d
