#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/planar/moving_segments.h"
#include "rtree/rtree.h"

namespace algebra3d {

/// The segments of moving polygons, and which of them come near each other in the course of time.
///
/// What all of them have in common of their movement is left out, since it takes none nearer to another, and time is
/// divided into slabs in which the segments move no farther than they are long, about: so the boxes that they sweep
/// stay small.
class MovingPairs {
 public:
  /// Refers to the points of the segments.
  explicit MovingPairs(const std::vector<MovingSegment>& segments);

  std::size_t slab_count() const { return slab_count_; }
  TimeSlab slab(std::size_t index) const;
  /// A tree of the boxes that the segments sweep in a slab. Their pairs are those that may meet there.
  rtree::RTree<std::uint32_t> tree(std::size_t index) const;

 private:
  Vec3 position(const MovingPoint& point, double s) const;
  Box3 swept(const MovingSegment& segment, const TimeSlab& slab) const;

  const std::vector<MovingSegment>& segments_;
  Vec3 common_movement_;
  double roundings_ = 0;  ///< what the computed positions may be off by
  std::size_t slab_count_ = 1;
};

}  // namespace algebra3d
