#pragma once

#include <utility>
#include <vector>

#include "algebra3d/halfedge/handle.h"

namespace algebra3d {

/// Pairs of faces of one mesh, in each the lower number first.
using FacePairs = std::vector<std::pair<FaceId, FaceId>>;

}  // namespace algebra3d
