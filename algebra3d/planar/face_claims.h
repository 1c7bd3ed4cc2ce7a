#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "algebra3d/planar/inside_triangles.h"

namespace algebra3d::planar {

/// Two half-edges that bound one region of a triangulation, of which not both can be right about the face that the
/// region belongs to. The second is kNone if the region is unbounded, and so belongs to none.
struct ClaimConflict {
  std::uint32_t first, second;
};

/// In a triangulation with segment marks (regions.h) each marked half-edge says which face lies to its left: that of
/// its segment, or none. Where all agree on every region and none claims the unbounded one, each step across a segment
/// of a face leads from the face to no face or back; so no face covers anything twice or overlaps another, and each
/// hole lies within its outer cycle and in no other hole. Gives a region where they do not agree, if there is one.
/// Cost: linear.
std::optional<ClaimConflict> find_claim_conflict(const Subdivision& triangulation,
                                                 std::span<const std::uint32_t> face_of_segment);

}  // namespace algebra3d::planar
