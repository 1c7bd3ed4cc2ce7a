#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "algebra3d/kernel/planar/detail/ids.h"
#include "algebra3d/kernel/planar/polygons.h"
#include "base/id_vector.h"

namespace algebra3d::planar {

/// The cycle and face of each corner and segment of polygons; segment i begins at corner i. Refers to the polygons,
/// which must outlive it.
class PolygonPlaces {
 public:
  explicit PolygonPlaces(const Polygons& polygons);

  std::uint32_t cycle_of(std::uint32_t corner) const { return cycle_of_[corner]; }
  std::uint32_t face_of(std::uint32_t corner) const { return face_of_[corner]; }
  std::uint32_t face_of(SegmentId segment) const { return face_of_[segment.index()]; }
  /// Of all segments.
  IdSpan<SegmentId, const std::uint32_t> faces() const {
    return IdSpan<SegmentId, const std::uint32_t>(std::span(face_of_));
  }
  /// The neighbours of a corner in its cycle.
  std::uint32_t after(std::uint32_t corner) const;
  std::uint32_t before(std::uint32_t corner) const;

  /// `face 1, cycle 2`.
  std::string cycle_name(std::uint32_t corner) const;
  /// `segment (0 0)-(2 2) of face 1, cycle 2`.
  std::string segment_name(SegmentId segment) const;
  /// `corner (0 0) of face 1, cycle 2`.
  std::string corner_name(std::uint32_t corner) const;

 private:
  const Polygons& polygons_;
  std::vector<std::uint32_t> cycle_of_, face_of_;  // of each corner
};

}  // namespace algebra3d::planar
