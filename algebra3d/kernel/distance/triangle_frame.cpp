#include "algebra3d/kernel/distance/triangle_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace algebra3d {
namespace {

/// The distance up to which a polygon is left whole, in margins; one that reaches farther is cut at one margin.
constexpr long double kSlack = 1.5L;

/// The vector with length 1; zero stays.
WideVec3 normalised(const WideVec3& v) {
  const long double size = length(v);
  return size > 0 ? (1 / size) * v : v;
}

/// The part of a vector that is perpendicular to one of length 1, or to zero, with length 1.
WideVec3 perpendicular_to(const WideVec3& v, const WideVec3& part_of) {
  return normalised(part_of - dot(part_of, v) * v);
}

/// A vector of length 1 that is perpendicular to one of length 1, or to zero.
WideVec3 any_perpendicular(const WideVec3& v) {
  const long double x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
  const WideVec3 axis = x <= y && x <= z ? WideVec3(1, 0, 0) : y <= z ? WideVec3(0, 1, 0) : WideVec3(0, 0, 1);
  return perpendicular_to(v, axis);
}

/// The square of the distance of (x, y) from the segment between (0, 0) and (u, v).
long double squared_from_segment(long double x, long double y, long double u, long double v) {
  const long double square = u * u + v * v;
  const long double share = square > 0 ? std::clamp((x * u + y * v) / square, 0.0L, 1.0L) : 0;
  const long double dx = x - share * u, dy = y - share * v;
  return dx * dx + dy * dy;
}

/// The parts of a polygon on both sides of a plane: the one where heights over it are negative, then the other.
std::pair<TriangleFrame::Polygon, TriangleFrame::Polygon> divided(const TriangleFrame::Polygon& polygon,
                                                                  const std::vector<long double>& heights) {
  std::pair<TriangleFrame::Polygon, TriangleFrame::Polygon> parts;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t next = i + 1 == polygon.size() ? 0 : i + 1;
    if (heights[i] <= 0) parts.first.push_back(polygon[i]);
    if (heights[i] >= 0) parts.second.push_back(polygon[i]);
    if (!(heights[i] < 0 && heights[next] > 0) && !(heights[i] > 0 && heights[next] < 0)) continue;
    const long double share = heights[i] / (heights[i] - heights[next]);
    const WideVec3 crossing = polygon[i] + share * (polygon[next] - polygon[i]);
    parts.first.push_back(crossing);
    parts.second.push_back(crossing);
  }
  return parts;
}

}  // namespace

TriangleFrame::TriangleFrame(const TriangleRef& corners) {
  const std::array<WideVec3, 3> places{WideVec3(corners[0].approx), WideVec3(corners[1].approx),
                                       WideVec3(corners[2].approx)};
  std::size_t longest = 0;  // the side from this corner
  const auto side = [&](std::size_t i) { return places[(i + 1) % 3] - places[i]; };
  for (std::size_t i = 1; i < 3; ++i)
    if (dot(side(i), side(i)) > dot(side(longest), side(longest))) longest = i;
  start_ = places[longest];
  length_ = length(side(longest));
  along_ = normalised(side(longest));
  const WideVec3 to_tip = places[(longest + 2) % 3] - start_;
  foot_ = dot(along_, to_tip);
  const WideVec3 upwards = to_tip - foot_ * along_;
  height_ = length(upwards);
  // Over a needle, rounding turns it by more than the other directions: so it is made perpendicular once again.
  across_ = height_ > 0 ? perpendicular_to(along_, normalised(upwards)) : any_perpendicular(along_);
  normal_ = normalised(cross(length_ > 0 ? along_ : any_perpendicular(across_), across_));
}

long double TriangleFrame::squared_distance_of(const WideVec3& point) const {
  const WideVec3 p = point - start_;
  const long double x = dot(along_, p), y = dot(across_, p), z = dot(normal_, p);
  if (y >= 0 && y <= height_ && height_ > 0) {
    const long double share = y / height_;
    if (x >= share * foot_ && x <= length_ + share * (foot_ - length_)) return z * z;
  }
  return z * z + std::min({squared_from_segment(x, y, length_, 0), squared_from_segment(x, y, foot_, height_),
                           squared_from_segment(x - length_, y, foot_ - length_, height_)});
}

long double TriangleFrame::squared_distance_of(const Polygon& polygon) const {
  long double farthest = 0;
  for (const WideVec3& corner : polygon) farthest = std::max(farthest, squared_distance_of(corner));
  return farthest;
}

TriangleFrame::Polygon TriangleFrame::clip(Polygon polygon, long double margin, std::vector<Polygon>& rest) const {
  std::vector<long double> heights;
  const auto cut = [&](const WideVec3& outwards, long double offset) {
    heights.clear();
    for (const WideVec3& corner : polygon) heights.push_back(dot(outwards, corner - start_) - offset - margin);
    if (*std::ranges::max_element(heights) <= (kSlack - 1) * margin) return;
    auto [inside, outside] = divided(polygon, heights);
    if (inside.empty()) return;
    rest.push_back(std::move(outside));
    polygon = std::move(inside);
  };
  cut(normal_, 0);
  cut(-1 * normal_, 0);
  cut(-1 * along_, 0);
  cut(along_, length_);
  cut(-1 * across_, 0);
  cut(across_, height_);
  if (height_ <= margin) return polygon;
  const auto cut_slanted = [&](const WideVec3& edge, long double from) {
    const WideVec3 outwards = normalised(cross(edge, normal_));
    cut(outwards, from * dot(outwards, along_));
  };
  cut_slanted((foot_ - length_) * along_ + height_ * across_, length_);
  cut_slanted(-foot_ * along_ - height_ * across_, 0);
  return polygon;
}

}  // namespace algebra3d
