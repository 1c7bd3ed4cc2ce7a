#pragma once

#include <cstdint>
#include <vector>

#include "algebra3d/exact/point.h"

namespace algebra3d::arrangement {

/// The points of an arrangement, each once: equal coordinates have one number. Numbers count from 0 in order of first
/// use, so that they depend on nothing but the order of the calls.
class VertexPool {
 public:
  /// The number of the point, which is added if it is new. Coordinates that are no doubles are referred to, not copied:
  /// they must outlive the pool. Cost: constant expected.
  std::uint32_t intern(const PointRef& point);
  /// The same for a point that the pool keeps alive.
  std::uint32_t intern(const ExactPoint& point);

  PointRef operator[](std::uint32_t vertex) const { return {approx_[vertex], exact_[vertex]}; }
  std::size_t size() const { return approx_.size(); }

 private:
  void grow();

  std::vector<Vec3> approx_;
  std::vector<const ExactCoordinates*> exact_;  // null for doubles
  std::vector<ExactPoint> owned_;
  std::vector<std::uint32_t> slots_;  // open addressing, a power of two
};

}  // namespace algebra3d::arrangement
