#include "algebra3d/kernel/rounding/detail/thin_fan.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace algebra3d {
namespace {

/// The distance of the origin from a segment.
long double distance_from_origin(const WideVec3& a, const WideVec3& b) {
  const WideVec3 ab = b - a;
  const long double square = dot(ab, ab);
  const long double share = square > 0 ? std::clamp(-dot(a, ab) / square, 0.0L, 1.0L) : 0;
  return length(a + share * ab);
}

}  // namespace

ThinFan::ThinFan(const TriangleStars& stars, const VertexFan& fan, long double tolerance) : tolerance_(tolerance) {
  const WideVec3 middle(stars.rounded_place(fan.vertex()));
  for (const std::uint32_t v : fan.ring()) ring_.push_back(WideVec3(stars.rounded_place(v)) - middle);
  for (std::size_t i = 0; i < ring_.size(); ++i) triangles_.push_back(triangle({}, i));
}

/// The triangle between an apex and the ring's vertex of this number and the next.
ThinFan::Triangle ThinFan::triangle(const WideVec3& apex, std::size_t side) const {
  const WideVec3 a = ring_[side] - apex, b = ring_[next(side)] - apex;
  const WideVec3 normal = cross(a, b);
  const long double longest = std::max({length(a), length(b), length(b - a)});
  return {normal, longest > 0 ? length(normal) / longest : 0};
}

/// True if it faces the same way as the nearest triangle of the fan on either side that is not thin.
bool ThinFan::faces_like_neighbours(const Triangle& t, std::size_t side) const {
  const std::size_t n = ring_.size();
  const auto agrees = [&](std::size_t step) {
    for (std::size_t i = (side + step) % n; i != side; i = (i + step) % n)
      if (!is_thin(triangles_[i])) return dot(t.normal, triangles_[i].normal) > 0;
    return false;
  };
  return agrees(1) || agrees(n - 1);
}

bool ThinFan::is_replacement(const Triangle& t, std::size_t side, const WideVec3& target) const {
  const Triangle& replaced = triangles_[side];
  const long double volume = std::abs(dot(target, t.normal));  // six times that of the tetrahedron between both
  if (is_thin(t)) return is_thin(replaced) || volume <= tolerance_ * length(replaced.normal);
  if (volume > tolerance_ * length(t.normal)) return false;
  return is_thin(replaced) ? faces_like_neighbours(t, side) : dot(t.normal, replaced.normal) > 0;
}

/// True if the vertex is over the triangle, or within the tolerance of one of its sides.
bool ThinFan::is_next_to_vertex(const Triangle& t, std::size_t side, const WideVec3& target) const {
  const WideVec3 &a = ring_[side], &b = ring_[next(side)];
  const auto is_near = [&](const WideVec3& from, const WideVec3& to) {
    return distance_from_origin(from, to) <= tolerance_;
  };
  const bool is_over = !is_thin(t) && dot(cross(target, a), t.normal) >= 0 && dot(cross(b, target), t.normal) >= 0;
  return is_over || is_near(target, a) || is_near(target, b) || is_near(a, b);
}

std::optional<long double> ThinFan::least_height(std::size_t target) const {
  const WideVec3& place = ring_[target];
  long double least = std::numeric_limits<long double>::max();
  bool is_near = length(place) <= tolerance_;
  for (std::size_t side = next(target); next(side) != target; side = next(side)) {
    const Triangle t = triangle(place, side);
    if (!is_replacement(t, side, place)) return std::nullopt;
    least = std::min(least, t.height);
    is_near = is_near || is_next_to_vertex(t, side, place);
  }
  return is_near ? std::optional(least) : std::nullopt;
}

}  // namespace algebra3d
