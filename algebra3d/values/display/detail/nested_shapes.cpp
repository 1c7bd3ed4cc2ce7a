#include "algebra3d/values/display/detail/nested_shapes.h"

#include "algebra3d/values/display/detail/shape_parts.h"
#include "base/propagate.h"

namespace algebra3d::detail {
namespace {

Vec3 position_of(const DrawnShape& shape, const DrawnShape::Position& position) {
  return shape.origin + Vec3{position[0], position[1], position[2]};
}

/// Appends lists of numbers of positions, raised by `offset`.
template <typename Lists>
void append_raised(const Lists& from, std::uint32_t offset, Lists& to) {
  for (auto list : from) {
    for (auto& number : list) number += offset;
    to.push_back(list);
  }
}

void append_shape(const DrawnShape& from, DrawnShape& to) {
  const auto offset = static_cast<std::uint32_t>(to.positions.size());
  for (const DrawnShape::Position& position : from.positions)
    to.positions.push_back(position_in(to, position_of(from, position)));
  // Normals stand per position, also of those that no triangle has.
  if (!from.normals.empty() || !to.normals.empty()) {
    to.normals.resize(offset);
    to.normals.insert(to.normals.end(), from.normals.begin(), from.normals.end());
    to.normals.resize(to.positions.size());
  }
  append_raised(from.triangles, offset, to.triangles);
  append_raised(from.edges, offset, to.edges);
  append_raised(from.boundary, offset, to.boundary);
  append_raised(from.nonmanifold, offset, to.nonmanifold);
  append_raised(from.lines, offset, to.lines);
  for (const std::uint32_t point : from.points) to.points.push_back(point + offset);
  to.triangle_count += from.triangle_count;
}

}  // namespace

Result<DrawnShape> joined(std::span<const DrawnShape> shapes) {
  Box3 box;
  std::size_t position_count = 0;
  for (const DrawnShape& shape : shapes) {
    box.extend(shape.box);
    position_count += shape.positions.size();
  }
  if (position_count > std::numeric_limits<std::uint32_t>::max())
    return Error(ErrorCode::limit_exceeded, "a relation of {} vertices cannot be drawn as one shape", position_count);
  A3D_ASSIGN(DrawnShape all, shape_in(box));
  all.positions.reserve(position_count);
  for (const DrawnShape& shape : shapes) append_shape(shape, all);
  return all;
}

}  // namespace algebra3d::detail
