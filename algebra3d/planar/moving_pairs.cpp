#include "algebra3d/planar/moving_pairs.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace algebra3d {
namespace {

constexpr std::size_t kFewSegments = 64;
constexpr std::size_t kMostSlabs = 32;

double largest_coordinate(const std::vector<MovingSegment>& segments) {
  double largest = 0;
  for (const MovingSegment& segment : segments)
    for (const Vec3& point : {segment.from.start.approx, segment.from.end.approx})
      largest = std::max({largest, std::abs(point.x), std::abs(point.y)});
  return largest;
}

double flat_length(const Vec3& v) {
  return std::abs(v.x) + std::abs(v.y);
}

}  // namespace

MovingPairs::MovingPairs(const std::vector<MovingSegment>& segments) : segments_(segments) {
  const auto count = static_cast<double>(segments.size());
  Vec3 movement;
  for (const MovingSegment& segment : segments)
    movement = movement + (1 / count) * (segment.from.end.approx - segment.from.start.approx);
  common_movement_ = {movement.x, movement.y, 0};
  // A position is made of six numbers, each off by a few units in the last place of the largest of them.
  roundings_ = 0x1p-47 * (largest_coordinate(segments) + flat_length(common_movement_)) + 0x1p-1000;
  if (segments.size() <= kFewSegments) return;
  double length = 0;
  double path = 0;
  for (const MovingSegment& segment : segments) {
    length += flat_length(segment.to.start.approx - segment.from.start.approx) +
              flat_length(segment.to.end.approx - segment.from.end.approx);
    path += flat_length(position(segment.from, 1) - position(segment.from, 0));
  }
  const double wanted = 2 * path / length;
  if (!(wanted > 1)) return;
  slab_count_ = std::bit_ceil(static_cast<std::size_t>(std::min<double>(kMostSlabs, std::ceil(wanted))));
}

TimeSlab MovingPairs::slab(std::size_t index) const {
  const auto count = static_cast<double>(slab_count_);  // a power of two, so the quotients are exact
  return {static_cast<double>(index) / count, static_cast<double>(index + 1) / count};
}

Vec3 MovingPairs::position(const MovingPoint& point, double s) const {
  const Vec3& start = point.start.approx;
  const Vec3& end = point.end.approx;
  return (1 - s) * start + s * end - s * common_movement_;
}

Box3 MovingPairs::swept(const MovingSegment& segment, const TimeSlab& slab) const {
  Box3 box;
  for (const MovingPoint& point : {segment.from, segment.to})
    for (const double s : {slab.from, slab.to}) {
      const Vec3 place = position(point, s);
      if (!std::isfinite(place.x) || !std::isfinite(place.y)) {
        const double all = Box3::kInfinity;
        return {{-all, -all, 0}, {all, all, 0}};
      }
      box.extend(Vec3{place.x, place.y, 0});
    }
  const Vec3 margin{roundings_, roundings_, 0};
  return {box.min - margin, box.max + margin};
}

rtree::RTree<std::uint32_t> MovingPairs::tree(std::size_t index) const {
  std::vector<rtree::Entry<std::uint32_t>> entries;
  entries.reserve(segments_.size());
  for (const MovingSegment& segment : segments_)
    entries.push_back({swept(segment, slab(index)), static_cast<std::uint32_t>(entries.size())});
  return rtree::RTree<std::uint32_t>::bulk_load(entries);
}

}  // namespace algebra3d
