#include "algebra3d/kernel/distance/detail/face_part.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace algebra3d::distances {
namespace {

/// A bound of the roundings of a point of an edge: of its coordinates, and twice that for each unit of the edge.
template <typename Number>
constexpr Number kOfPoint = std::numeric_limits<Number>::epsilon();

}  // namespace

template <typename Vector>
Vector FacePart<Vector>::centre() const {
  Vector sum;
  for (const Vector& corner : corner_span()) sum = sum + corner;
  return Number(1) / size * sum;
}

template <typename Vector>
bool FacePart<Vector>::cut(const CellSide<Vector>& side, FacePart& inside, FacePart& outside) const {
  constexpr Number kNear = 4 * std::numeric_limits<Number>::epsilon();
  std::array<Number, kMaxCorners> heights;  // NOLINT(cppcoreguidelines-pro-type-member-init): as far as used
  Number highest = 0, longest = 0;
  for (std::uint32_t i = 0; i < size; ++i) {
    heights[i] = dot(side.inward, corners[i] - side.point);
    highest = std::max(highest, std::abs(heights[i]));
  }
  for (std::uint32_t i = 0; i < size; ++i)
    if (std::abs(heights[i]) <= kNear * highest) heights[i] = 0;
  inside.size = outside.size = 0;
  int cut_count = 0, on_plane = 0;
  bool has_inside = false, has_outside = false;
  for (std::uint32_t i = 0; i < size; ++i) {
    const std::uint32_t next = i + 1 < size ? i + 1 : 0;
    const Number height = heights[i], other = heights[next];
    has_inside = has_inside || height > 0;
    has_outside = has_outside || height < 0;
    if (inside.size + 1 >= kMaxCorners || outside.size + 1 >= kMaxCorners) return false;
    if (height >= 0) inside.add(corners[i]);
    if (height <= 0) outside.add(corners[i]);
    on_plane += static_cast<int>(height == 0);
    if (!((height > 0 && other < 0) || (height < 0 && other > 0))) continue;
    const Vector edge = corners[next] - corners[i];
    const Vector point = corners[i] + height / (height - other) * edge;
    longest = std::max(longest, size_of(edge));
    inside.add(point);
    outside.add(point);
    ++cut_count;
  }
  if (!has_outside) {
    inside = *this;
    outside.size = 0;
    return true;
  }
  if (!has_inside) {
    outside = *this;
    inside.size = 0;
    return true;
  }
  if (cut_count + on_plane != 2) return false;
  inside.depth = outside.depth = depth + 1;
  inside.deviation = outside.deviation = deviation + (cut_count > 0 ? kOfPoint<Number> * (1 + 2 * longest) : 0);
  return true;
}

template <typename Vector>
std::array<FacePart<Vector>, 2> FacePart<Vector>::halves() const {
  FacePart first, second;
  first.depth = second.depth = depth + 1;
  first.deviation = second.deviation = deviation;
  if (size > 3) {
    const std::uint32_t middle = size / 2;
    for (std::uint32_t i = 0; i <= middle; ++i) first.add(corners[i]);
    for (std::uint32_t i = middle; i < size; ++i) second.add(corners[i]);
    second.add(corners[0]);
  } else {
    std::uint32_t longest = 0;
    Number length = -1;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const Number own = size_of(corners[(i + 1) % 3] - corners[i]);
      if (own > length) longest = i;
      length = std::max(length, own);
    }
    const Vector &a = corners[longest], &b = corners[(longest + 1) % 3], &c = corners[(longest + 2) % 3];
    const Vector middle = 0.5 * a + 0.5 * b;
    first.deviation = second.deviation = deviation + kOfPoint<Number>;
    for (const Vector& corner : {a, middle, c}) first.add(corner);
    for (const Vector& corner : {middle, b, c}) second.add(corner);
  }
  return {first, second};
}

template <typename Vector>
bool are_apart_seen_along(const Vector& sight, std::span<const Vector> first, std::span<const Vector> second,
                          decltype(Vector::x) reach) {
  using Number = decltype(Vector::x);
  const auto tells_apart = [&](const Vector& from, const Vector& to) {
    const Vector across = cross(sight, to - from);
    const auto range_of = [&](std::span<const Vector> points) {
      const Number begin = dot(across, points[0] - from);
      std::pair<Number, Number> range(begin, begin);
      for (const Vector& p : points.subspan(1)) {
        const Number at = dot(across, p - from);
        range = {std::min(range.first, at), std::max(range.second, at)};
      }
      return range;
    };
    const auto [first_least, first_most] = range_of(first);
    const auto [second_least, second_most] = range_of(second);
    return std::max(second_least - first_most, first_least - second_most) > reach * size_of(across);
  };
  const auto an_edge_tells = [&](std::span<const Vector> polygon) {
    for (std::size_t i = 0; i < polygon.size(); ++i)
      if (tells_apart(polygon[i], polygon[(i + 1) % polygon.size()])) return true;
    return false;
  };
  return an_edge_tells(first) || an_edge_tells(second);
}

template struct FacePart<Vec3>;
template struct FacePart<WideVec3>;
template bool are_apart_seen_along(const Vec3&, std::span<const Vec3>, std::span<const Vec3>, double);
template bool are_apart_seen_along(const WideVec3&, std::span<const WideVec3>, std::span<const WideVec3>, long double);

}  // namespace algebra3d::distances
