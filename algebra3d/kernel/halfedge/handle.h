#pragma once

#include "base/strong_id.h"

namespace algebra3d {

/// The elements of a mesh.
using VertexId = StrongId<struct VertexKind>;
using HalfedgeId = StrongId<struct HalfedgeKind>;
using FaceId = StrongId<struct FaceKind>;

}  // namespace algebra3d
