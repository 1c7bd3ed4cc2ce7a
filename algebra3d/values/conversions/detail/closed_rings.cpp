#include "algebra3d/values/conversions/detail/closed_rings.h"

#include <utility>

#include "algebra3d/kernel/planar/segment_text.h"

namespace algebra3d {
namespace {

constexpr std::size_t kMaxRingCorners = std::size_t{1} << 31U;  // beyond, indices of corners and segments would not fit

}  // namespace

void ClosedRings::add_point(double x, double y) {
  const Vec3 point{x, y, 0};
  const bool is_first = corners_.size() == (cycle_ends_.empty() ? 0 : cycle_ends_.back());
  if (is_first || !(corners_.back() == point)) corners_.push_back(point);
}

Status ClosedRings::end_ring() {
  const std::size_t begin = cycle_ends_.empty() ? 0 : cycle_ends_.back();
  if (corners_.size() == begin) return Error{ErrorCode::invalid_value, "found a ring without points"};
  if (corners_.size() > kMaxRingCorners)
    return Error{ErrorCode::limit_exceeded, "found more than {} corners, which is the limit", kMaxRingCorners};
  if (!(corners_[begin] == corners_.back()))
    return Error{ErrorCode::invalid_value, "found a ring from {} to {}, expected its first point again at its end",
                 planar::corner_text(corners_[begin]), planar::corner_text(corners_.back())};
  if (corners_.size() > begin + 1) corners_.pop_back();
  cycle_ends_.push_back(static_cast<std::uint32_t>(corners_.size()));
  return {};
}

void ClosedRings::end_face() {
  const std::size_t begin = face_ends_.empty() ? 0 : face_ends_.back();
  if (cycle_ends_.size() > begin) face_ends_.push_back(static_cast<std::uint32_t>(cycle_ends_.size()));
}

Polygons ClosedRings::polygons() && {
  return {PointArray(std::move(corners_)), std::move(cycle_ends_), std::move(face_ends_)};
}

}  // namespace algebra3d
