#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <utility>

#include "algebra3d/base/error.h"
#include "algebra3d/values/display/shape.h"

namespace algebra3d::detail {

/// An empty shape with origin and box. Errors: limit_exceeded.
inline Result<DrawnShape> shape_in(const Box3& box) {
  DrawnShape shape;
  shape.box = box;
  if (box.is_empty()) return shape;
  // Differences of floats must be floats, too.
  constexpr double kLargest = std::numeric_limits<float>::max() / 4;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!(box.max[axis] / 2 - box.min[axis] / 2 < kLargest))
      return Error(ErrorCode::limit_exceeded,
                   "nothing of this size can be drawn: it reaches from {} to {} along {}; at most {:.3} are possible",
                   box.min[axis], box.max[axis], "xyz"[axis], 2 * kLargest);
  shape.origin = 0.5 * box.min + 0.5 * box.max;
  return shape;
}

/// A shape whose points floats cannot distinguish, since its box is smaller than 2^-100 (8e-31), becomes one point in
/// its middle.
inline void draw_as_point_if_tiny(DrawnShape& shape) {
  constexpr double kLeast = 0x1p-100;  // so that differences have all digits of a float
  const Vec3 size = shape.box.max - shape.box.min;
  if (shape.is_empty() || !(std::max({size.x, size.y, size.z}) < kLeast)) return;
  DrawnShape point;
  point.box = shape.box;
  point.origin = shape.origin;
  point.triangle_count = shape.triangle_count;
  point.positions = {{0, 0, 0}};
  point.points = {0};
  shape = std::move(point);
}

inline DrawnShape::Position position_in(const DrawnShape& shape, const Vec3& point) {
  const Vec3 relative = point - shape.origin;
  return {static_cast<float>(relative.x), static_cast<float>(relative.y), static_cast<float>(relative.z)};
}

/// Adds a position and returns its number.
inline std::uint32_t add_position(DrawnShape& shape, const Vec3& point) {
  shape.positions.push_back(position_in(shape, point));
  return static_cast<std::uint32_t>(shape.positions.size() - 1);
}

/// Adds lines from each of consecutive positions to the next, and from the last to the first.
inline void add_loop(DrawnShape& shape, std::uint32_t first, std::uint32_t end) {
  for (std::uint32_t i = first; i < end; ++i) shape.lines.push_back({i, i + 1 < end ? i + 1 : first});
}

/// The normal of length 1, or zero, as bytes. None is drawn as up.
inline DrawnShape::Normal packed_normal(const Vec3& normal) {
  if (normal == Vec3{}) return {0, 0, 127, 0};
  const auto packed = [](double coordinate) {
    return static_cast<std::int8_t>(127 * coordinate + (coordinate < 0 ? -0.5 : 0.5));
  };
  return {packed(normal.x), packed(normal.y), packed(normal.z), 0};
}

}  // namespace algebra3d::detail
