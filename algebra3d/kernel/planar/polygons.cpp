#include "algebra3d/kernel/planar/polygons.h"

#include <algorithm>

#include "algebra3d/kernel/exact/predicates.h"

namespace algebra3d {

std::size_t Polygons::heap_bytes() const {
  return corners.heap_bytes() + (cycle_ends.size() + face_ends.size()) * sizeof(std::uint32_t);
}

std::strong_ordering operator<=>(const Polygons& a, const Polygons& b) {
  const std::size_t common = std::min(a.corners.size(), b.corners.size());
  for (std::size_t i = 0; i < common; ++i)
    if (const auto order = compare(a.corners[i], b.corners[i]); std::is_neq(order)) return order;
  if (const auto order = a.corners.size() <=> b.corners.size(); std::is_neq(order)) return order;
  if (const auto order = a.cycle_ends <=> b.cycle_ends; std::is_neq(order)) return order;
  return a.face_ends <=> b.face_ends;
}

Box3 box_around(const Polygons& polygons) {
  Box3 box;
  for (std::size_t i = 0; i < polygons.corners.size(); ++i) box.extend(box_of(polygons.corners[i]));
  return box;
}

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
