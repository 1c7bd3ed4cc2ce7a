#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "base/polygon_soup.h"

/// Stops the fuzzer if a law does not hold.
inline void require(bool holds) {
  if (!holds) std::abort();
}

/// The invariants of a PolygonSoup that a reader gave: see there.
inline void require_sound(const algebra3d::PolygonSoup& soup) {
  for (const algebra3d::Vec3& point : soup.points) require(is_finite(point));
  require(!soup.face_starts.empty() && soup.face_starts.front() == 0);
  require(soup.face_starts.back() == soup.corners.size());
  for (std::size_t i = 0; i < soup.face_count(); ++i) require(soup.face_starts[i + 1] >= soup.face_starts[i] + 3);
  for (const std::uint32_t corner : soup.corners) require(corner < soup.points.size());
}
