#include "algebra3d/kernel/planar/detail/cycles.h"

#include <compare>
#include <utility>

#include "algebra3d/kernel/exact/predicates.h"
#include "base/interruption_scope.h"

namespace algebra3d::planar {

int rotation(const PointArray& corners, std::uint32_t begin, std::uint32_t end) {
  std::uint32_t first = begin;
  for (std::uint32_t i = begin + 1; i < end; ++i)
    if (std::is_lt(compare(corners[i], corners[first]))) first = i;
  const std::uint32_t before = first == begin ? end - 1 : first - 1, after = first + 1 == end ? begin : first + 1;
  return orient2d(Projection::xy, corners[before], corners[first], corners[after]);
}

std::vector<DirectedEdge> segments_of(const Polygons& polygons, const std::vector<bool>& is_reversed) {
  std::vector<DirectedEdge> segments = algebra3d::segments_of(polygons);
  for (std::size_t cycle = 0; cycle < polygons.cycle_count(); ++cycle) {
    if (!is_reversed[cycle]) continue;
    for (std::uint32_t i = polygons.first_corner(cycle); i < polygons.cycle_ends[cycle]; ++i)
      std::swap(segments[i].first, segments[i].second);
  }
  return segments;
}

std::vector<bool> reversed_cycles(const Polygons& polygons) {
  std::vector<bool> is_reversed(polygons.cycle_count());
  for (std::size_t face = 0; face < polygons.face_count(); ++face) {
    poll_interruption_at(face);
    for (std::uint32_t cycle = polygons.first_cycle(face); cycle < polygons.face_ends[face]; ++cycle) {
      const int turn = rotation(polygons.corners, polygons.first_corner(cycle), polygons.cycle_ends[cycle]);
      is_reversed[cycle] = cycle == polygons.first_cycle(face) ? turn < 0 : turn > 0;
    }
  }
  return is_reversed;
}

}  // namespace algebra3d::planar
