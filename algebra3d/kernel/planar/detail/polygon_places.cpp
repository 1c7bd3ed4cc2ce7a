#include "algebra3d/kernel/planar/detail/polygon_places.h"

#include <fmt/format.h>

#include "algebra3d/kernel/planar/segment_text.h"

namespace algebra3d::planar {

PolygonPlaces::PolygonPlaces(const Polygons& polygons) : polygons_(polygons) {
  cycle_of_.reserve(polygons.corners.size());
  face_of_.reserve(polygons.corners.size());
  for (std::uint32_t face = 0; face < polygons.face_count(); ++face)
    for (std::uint32_t cycle = polygons.first_cycle(face); cycle < polygons.face_ends[face]; ++cycle) {
      cycle_of_.resize(polygons.cycle_ends[cycle], cycle);
      face_of_.resize(polygons.cycle_ends[cycle], face);
    }
}

std::uint32_t PolygonPlaces::after(std::uint32_t corner) const {
  const std::uint32_t cycle = cycle_of_[corner];
  return corner + 1 == polygons_.cycle_ends[cycle] ? polygons_.first_corner(cycle) : corner + 1;
}

std::uint32_t PolygonPlaces::before(std::uint32_t corner) const {
  const std::uint32_t cycle = cycle_of_[corner];
  return corner == polygons_.first_corner(cycle) ? polygons_.cycle_ends[cycle] - 1 : corner - 1;
}

std::string PolygonPlaces::cycle_name(std::uint32_t corner) const {
  const std::uint32_t face = face_of_[corner];
  return fmt::format("face {}, cycle {}", face + 1, cycle_of_[corner] - polygons_.first_cycle(face) + 1);
}

std::string PolygonPlaces::segment_name(SegmentId segment) const {
  const auto& corners = polygons_.corners;
  const std::uint32_t from = segment.index();
  return fmt::format("segment {} of {}", segment_text(corners[from], corners[after(from)]), cycle_name(from));
}

std::string PolygonPlaces::corner_name(std::uint32_t corner) const {
  return fmt::format("corner {} of {}", corner_text(polygons_.corners[corner]), cycle_name(corner));
}

}  // namespace algebra3d::planar
