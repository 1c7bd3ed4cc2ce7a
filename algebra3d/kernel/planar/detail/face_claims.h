#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "algebra3d/kernel/planar/detail/inside_triangles.h"
#include "base/id_vector.h"

namespace algebra3d::planar {

/// Two half-edges of one region of a triangulation that contradict each other about the face of the region. The second
/// is kNone if the region is unbounded and so belongs to no face.
struct ClaimConflict {
  HalfedgeId first, second;
};

/// Finds a region of a triangulation with segment marks (inside_triangles.h) whose half-edges contradict each other. A
/// marked half-edge says which face lies to its left: that of its segment, or none. If there is no contradiction, no
/// face overlaps itself or another, and each hole lies inside its outer cycle and outside the other holes. Cost:
/// linear.
std::optional<ClaimConflict> find_claim_conflict(const Subdivision& triangulation,
                                                 IdSpan<SegmentId, const std::uint32_t> face_of_segment);

}  // namespace algebra3d::planar
