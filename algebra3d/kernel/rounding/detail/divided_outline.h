#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algebra3d/kernel/rounding/detail/moved_points.h"
#include "base/indices.h"
#include "base/wide_vec3.h"

namespace algebra3d {

/// A corner of the outline of a triangle whose sides have further corners.
struct OutlineCorner {
  PointId point;
  WideVec3 place;
  std::uint8_t sides;  ///< one bit for each side of the triangle on which it lies
};

/// A chord: two corners of an outline, by their positions.
using OutlineChord = std::pair<std::uint32_t, std::uint32_t>;

/// The triangles, as positions of corners, into which the outline of a triangle is divided: where corners are one
/// point, then along the chords, those that cross earlier ones left out, then by Delaunay's criterion from the longest
/// side. Outlines with the same points get the same triangles, whatever the triangles are to which they belonged; so
/// triangles that lie upon each other cancel. Domain: no chord has both ends on one side. Along each inner edge two
/// triangles meet. Exactness: rounded; the triangles may be flat. Cost: quadratic at worst.
std::vector<IndexTriangle> divided_outline(std::span<const OutlineCorner> outline,
                                           std::span<const OutlineChord> chords);

}  // namespace algebra3d
