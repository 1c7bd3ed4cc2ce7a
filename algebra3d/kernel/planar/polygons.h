#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "algebra3d/base/box3.h"
#include "algebra3d/kernel/exact/point.h"
#include "base/indices.h"

namespace algebra3d {

/// Polygons with holes in the plane z = 0: corners in cycles, cycles in faces. The first cycle of a face is its outer
/// one, the others are its holes. Position and orientation are not restricted: polygon_validity.h checks whether they
/// bound a region.
struct Polygons {
  PointArray corners;                     ///< cycle by cycle, the first corner not repeated at the end; z is 0
  std::vector<std::uint32_t> cycle_ends;  ///< per cycle: one past its last corner
  std::vector<std::uint32_t> face_ends;   ///< per face: one past its last cycle

  std::size_t face_count() const { return face_ends.size(); }
  std::size_t cycle_count() const { return cycle_ends.size(); }
  std::uint32_t first_corner(std::size_t cycle) const { return cycle == 0 ? 0 : cycle_ends[cycle - 1]; }
  std::uint32_t first_cycle(std::size_t face) const { return face == 0 ? 0 : face_ends[face - 1]; }

  std::size_t heap_bytes() const;

  friend bool operator==(const Polygons&, const Polygons&) = default;
  /// Order by corners, then by cycles and faces.
  friend std::strong_ordering operator<=>(const Polygons& a, const Polygons& b);
};

/// Smallest box of doubles around all corners, flat at z = 0; outward-rounded.
Box3 box_around(const Polygons& polygons);

/// The segments of all cycles: segment i begins at corner i.
std::vector<DirectedEdge> segments_of(const Polygons& polygons);

}  // namespace algebra3d
