#include "algebra3d/rounding/detail/vertex_fan.h"

#include <algorithm>
#include <cmath>

namespace algebra3d {
namespace {

/// No less than the length of a vector.
double sum_of_sizes(const Vec3& v) {
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

}  // namespace

bool VertexFan::surround(const TriangleStars& stars, std::uint32_t vertex, std::size_t most_neighbours) {
  vertex_ = vertex;
  sides_.clear();
  stars.for_each_at(vertex, [&](std::uint32_t triangle) {
    const IndexTriangle& t = stars[triangle];
    const auto at = static_cast<std::size_t>(std::ranges::find(t, vertex) - t.begin());
    sides_.emplace_back(t[(at + 1) % 3], t[(at + 2) % 3]);
  });
  const std::size_t count = sides_.size();
  if (count < 3 || count > most_neighbours) return false;
  ring_.clear();
  // The side that follows is mostly the next one.
  for (std::size_t side = 0; ring_.size() < count;) {
    ring_.push_back(sides_[side].first);
    const std::uint32_t end = sides_[side].second;
    std::size_t tried = 0;
    do {
      side = side + 1 == count ? 0 : side + 1;
    } while (sides_[side].first != end && ++tried < count);
    if (sides_[side].first != end || (side == 0) != (ring_.size() == count)) return false;
  }
  sorted_ = ring_;
  std::ranges::sort(sorted_);
  return std::ranges::adjacent_find(sorted_) == sorted_.end();
}

void VertexFan::measure(const TriangleStars& stars, double tolerance) {
  const std::size_t count = ring_.size();
  const Vec3& middle = stars.rounded_place(vertex_);
  spokes_.resize(count);
  for (std::size_t i = 0; i < count; ++i) spokes_[i] = stars.rounded_place(ring_[i]) - middle;
  // The normal of the new triangle is that of the sector and the product of its side and the spoke.
  const double widened = (1 + 0x1p-40) * tolerance;
  sectors_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 &from = spokes_[i], &to = spokes_[i + 1 == count ? 0 : i + 1];
    const Vec3 normal = cross(from, to);
    sectors_[i] = {normal, widened * sum_of_sizes(normal),
                   widened * sum_of_sizes(to - from) + 0x1p-46 * sum_of_sizes(from) * sum_of_sizes(to)};
  }
  last_bent_ = 0;
}

bool VertexFan::bends(std::size_t target) {
  constexpr double kUnderflow = 0x1p-900;
  const Vec3& spoke = spokes_[target];
  const double reach = sum_of_sizes(spoke);
  const std::size_t count = ring_.size(), before = target == 0 ? count - 1 : target - 1;
  for (std::size_t tried = 0, i = last_bent_; tried < count; ++tried, i = i + 1 == count ? 0 : i + 1) {
    if (i == target || i == before) continue;  // these two go
    const double most = sectors_[i].fixed + sectors_[i].per_reach * reach;
    if (most < kUnderflow || !(std::abs(dot(sectors_[i].normal, spoke)) > most)) continue;
    last_bent_ = i;
    return true;
  }
  return false;
}

}  // namespace algebra3d
