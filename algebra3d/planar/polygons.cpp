#include "algebra3d/planar/polygons.h"

namespace algebra3d {

std::vector<DirectedEdge> segments_of(const Polygons& polygons) {
  std::vector<DirectedEdge> segments;
  segments.reserve(polygons.corners.size());
  for (std::size_t cycle = 0; cycle < polygons.cycle_count(); ++cycle) {
    const std::uint32_t first = polygons.first_corner(cycle), end = polygons.cycle_ends[cycle];
    for (std::uint32_t i = first; i < end; ++i) segments.emplace_back(i, i + 1 < end ? i + 1 : first);
  }
  return segments;
}

}  // namespace algebra3d
