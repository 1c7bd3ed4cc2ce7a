#pragma once

#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

#include "algebra3d/base/error.h"
#include "algebra3d/rounding/detail/snapped_faces.h"

namespace algebra3d {

/// Two faces, the one with the smaller number first.
using FacePair = std::pair<std::size_t, std::size_t>;

/// The pairs of faces that share more than a point or a whole edge of both, and at least one of which is open;
/// ascending. Faces without area, and faces with the same corners, cross nothing. Exact. Errors: interrupted. Cost:
/// linear, and that of the pairs whose boxes meet.
Result<std::vector<FacePair>> crossing_faces(const SnappedFaces& faces, const std::atomic<bool>* cancel);

}  // namespace algebra3d
